#include "plaza/plugin.h"

#include "modalities/color/color.h"

PLAZA_PLUGIN(registrar) { registrar.add<plaza::ColorModality>(); }
