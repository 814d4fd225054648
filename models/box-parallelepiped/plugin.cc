#include "plaza/plugin.h"

#include "models/box-parallelepiped/box_parallelepiped.h"

PLAZA_PLUGIN(registrar) { registrar.add<plaza::BoxParallelepiped>(); }
