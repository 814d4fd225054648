#include "plaza/plugin.h"

#include "detection_scores.h"
#include "ground_scores.h"
#include "tracking_scores.h"

PLAZA_PLUGIN(registrar) {
  registrar.add<plaza::scores::DetectionScores>();
  registrar.add<plaza::scores::TrackingScores>();
  registrar.add<plaza::scores::GroundScores>();
}
