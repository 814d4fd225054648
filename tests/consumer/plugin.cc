#include "walking_direction.h"

PLAZA_PLUGIN(registrar) { registrar.add<consumer::WalkingDirection>(); }
