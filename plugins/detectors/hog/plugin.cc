#include "plaza/plugin.h"

#include "plugins/detectors/hog/hog.h"

PLAZA_PLUGIN(registrar) { registrar.add<plaza::HogDetector>(); }
