#include "plaza/plugin.h"

#include "models/motion/constant_velocity.h"

PLAZA_PLUGIN(registrar) { registrar.add<plaza::ConstantVelocity>(); }
