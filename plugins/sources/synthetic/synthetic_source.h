#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "plaza/component/declaration.h"
#include "plugins/sources/synthetic/laboratory.h"

namespace plaza::synthetic {

/// Renders people who act out a scenario in front of the scene's cameras, and tells the truth about
/// them.
class SyntheticSource final : public Source {
 public:
  struct Options {
    std::string scenario = "four-crossing";
    std::int64_t seed = 1;
    std::int64_t frames = 500;
    std::int64_t backgrounds = 40;
    std::optional<int> people;
    int samples = 4;
    bool shadows = true;
    bool reflections = true;
    double shutter_ms = 12;
    double calibration_error_px = 1.0;
    double illumination_drift = 0.06;
    double light = 1;
    double light_from_s = 1;
    double light_seconds = 10;
    double shadow = 0;
    double shadow_from_s = 0;
    double shadow_mps = 0.15;
    double shadow_width_m = 1.2;
    double shadow_edge_m = 0.2;
    std::optional<double> moved_furniture_s;
    std::vector<std::string> lost_cameras;
    double lost_from_s = 0;
    double blur_px = 0.6;
    double vignetting = 0.25;
    double noise = 1.0;
    double colour_spread = 1.0;
    bool bayer = true;
  };

  static Declaration<Options> declare();
  SyntheticSource(const Options& options, const BuildContext& context);
  ~SyntheticSource() override;

 protected:
  Diagnostics do_check() const override;
  SourceInfo do_open() override;
  void do_seek(std::int64_t frame) override;
  bool do_read(NodeIo& io) override;
  std::shared_ptr<const FrameSet> do_background(std::int64_t index) override;

 private:
  LaboratoryOptions laboratory_options() const;
  const Laboratory& laboratory();

  Options options_;
  std::shared_ptr<const Scene> scene_;
  std::unique_ptr<Laboratory> laboratory_;  // from the first frame on: it takes seconds to build
};

}  // namespace plaza::synthetic
