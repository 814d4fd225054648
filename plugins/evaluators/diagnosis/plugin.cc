#include "plaza/plugin.h"

#include "detection_errors.h"
#include "reliability.h"

PLAZA_PLUGIN(registrar) {
  registrar.add<plaza::diagnosis::DetectionErrors>();
  registrar.add<plaza::diagnosis::Reliability>();
}
