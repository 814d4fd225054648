#include "plaza/plugin.h"

#include "models/cylinder/cylinder.h"

PLAZA_PLUGIN(registrar) { registrar.add<plaza::Cylinder>(); }
