#include "plaza/plugin.h"

#include "plugins/sources/detections/detections_source.h"
#include "plugins/sources/detections/ground_truth_source.h"

PLAZA_PLUGIN(registrar) {
  registrar.add<plaza::sources::DetectionsSource>();
  registrar.add<plaza::sources::GroundTruthSource>();
}
