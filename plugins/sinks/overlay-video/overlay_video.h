#pragma once

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "plaza/component/declaration.h"
#include "plugins/sinks/drawing/plan.h"
#include "plugins/sinks/drawing/trails.h"
#include "plugins/sinks/overlay-video/layout.h"
#include "plugins/sinks/overlay-video/video_file.h"
#include "plugins/sinks/overlay-video/view_painter.h"

namespace plaza::overlay {

/// Draws final tracks over every view and into a plan from above: a video, and still pictures of
/// it.
class OverlayVideo final : public Renderer {
 public:
  struct Options {
    std::string file = "overlay.mp4";
    Codec codec = Codec::kAuto;
    int width_px = 1280;
    Draw draw = Draw::kBoxes;
    double trail_s = 3;
    bool truth = false;
    bool area = true;
    int stills = 3;
    std::vector<std::int64_t> still_frames;
  };
  static Declaration<Options> declare();
  OverlayVideo(const Options& options, const BuildContext& context);

 private:
  Diagnostics do_check() const override;
  void do_begin(std::int64_t begin_frame, std::int64_t end_frame) override;
  void do_render(const RenderFrame& frame) override;
  std::vector<Artifact> do_end(bool complete) override;

  void paint_header(const RenderFrame& frame);
  void paint_plan(const RenderFrame& frame);
  void write_still(std::int64_t frame);

  Options options_;
  std::shared_ptr<const Scene> scene_;
  std::filesystem::path folder_;

  // from do_begin() to do_end()
  Layout layout_;
  cv::Mat canvas_;
  std::optional<drawing::Plan> plan_;
  std::optional<drawing::TrailMemory> trails_;
  std::int64_t trail_gap_frames_ = 1;
  std::vector<ViewPainter> painters_;
  std::unique_ptr<VideoFile> video_;
  std::set<std::int64_t> stills_;  ///< frames from 0
  std::int64_t begin_frame_ = 0, end_frame_ = 0;
  std::vector<Artifact> written_stills_;
};

/// `count` frames spread evenly over [begin, end): the middles of as many equal parts; every frame
/// when there are fewer.
std::set<std::int64_t> spread_frames(std::int64_t begin, std::int64_t end, std::int64_t count);

}  // namespace plaza::overlay
