#pragma once

#include <memory>
#include <vector>

#include "plaza/component/declaration.h"
#include "plugins/detectors/ground/partition.h"

namespace plaza {

/// Joins the observations of several views into one per person.
///
/// Which observations belong together is decided by assignment (partition()); whether a group is a
/// person, by the odds of its members, how well they agree, and the views that should see the
/// person and don't.
class GroundFusion final : public Detector {
 public:
  struct Options {
    double person_density_per_m2 = 0.03;
    double view_sigma_m = 0.15;
    double detection_probability = 0.6;
    double min_probability = 0.5;
    int min_views = 1;
    double min_distance_m = 0.0;
    double margin_m = 0.0;
  };
  static Declaration<Options> declare();
  GroundFusion(const Options& options, const BuildContext& context);

 private:
  Observations do_detect(const NodeIo& io) const override;

  std::vector<ViewMeasurement> measurements(const std::vector<Observation>& items) const;
  Observation fused(const MeasurementGroup& group, const std::vector<Observation>& items) const;

  Options options_;
  std::shared_ptr<const Scene> scene_;
};

}  // namespace plaza
