#pragma once

#include <memory>
#include <string>
#include <vector>

#include "plaza/component/declaration.h"
#include "plaza/component/models.h"
#include "plugins/sinks/occluder-map/sight_counts.h"

namespace plaza::occluder_map {

/// Learns what of a place hides people: where they stand, by the other views or by the rest of
/// their body, but are never seen. Writes it as a scene's `occluders`, and a picture of each view
/// to judge it by.
class OccluderMap final : public Sink {
 public:
  struct Options {
    double min_probability = 0.5;
    int least_covered = 4;
    double most_seen = 0.25;
    int bridge_px = 9;
    int least_area_px = 50;
  };
  static Declaration<Options> declare();
  OccluderMap(const Options& options, const BuildContext& context);

 private:
  void do_write(const NodeIo& io) override;
  void do_write_rest(const NodeIo&) override {}
  std::vector<Artifact> do_finish(bool complete) override;
  SightCounts::Criterion criterion() const {
    return {options_.least_covered, options_.most_seen, options_.bridge_px, options_.least_area_px};
  }
  cv::Mat picture(std::size_t camera, const std::vector<Polygon>& occluders) const;

  Options options_;
  std::string name_;
  std::filesystem::path folder_;
  std::shared_ptr<const Scene> scene_;
  std::shared_ptr<const ShapeModel> shape_;
  std::vector<SightCounts> counts_;  ///< [camera]
  std::vector<cv::Mat> images_;      ///< [camera]: the last one
};

}  // namespace plaza::occluder_map
