#include "plaza/plugin.h"

#include "plugins/detectors/ground/boxes.h"
#include "plugins/detectors/ground/ground_fusion.h"

PLAZA_PLUGIN(registrar) {
  registrar.add<plaza::BoxesDetector>();
  registrar.add<plaza::GroundFusion>();
}
