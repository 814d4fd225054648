#include <algorithm>
#include <cmath>

#include "digest.h"
#include "stage.h"

namespace plaza::contract {
namespace {

constexpr std::int64_t kPatience = 100000;  // frames; a source that never ends is no clock
constexpr std::int64_t kFollowed = 200;     // frames asked of a follower

class SourceCheck {
 public:
  SourceCheck(const Stage& stage, Findings& findings) : stage_(stage), findings_(findings) {}

  void run() {
    const bool clock = stage_.trial().role == SourceRole::kClock;
    const auto source = stage_.make_as<Source>();
    const SourceInfo info = source->open(stage_.trial().role);
    const std::vector<std::string> all = read_from(*source, 0);
    if (clock) {
      findings_.require(!all.empty(), "gives no frame at all");
      findings_.require(static_cast<std::int64_t>(all.size()) < kPatience, "does not end");
      end_is_the_end(*source, static_cast<std::int64_t>(all.size()));
    } else {
      findings_.require(static_cast<std::int64_t>(all.size()) == kFollowed,
                        "a follower must not end");
    }
    if (all.empty()) return;
    backgrounds(*source, info.background_count);
    if (info.rereadable) {
      seeking(*source, all);
      if (clock) {
        findings_.must_throw<UserError>("seek() far beyond the end", "UserError", [&] {
          source->seek(static_cast<std::int64_t>(all.size()) + 1000);
        });
        findings_.step("seek(0) after a refused seek", [&] { source->seek(0); });
        compare(read_from(*source, 0), all,
                "reading again after a refused seek() gives other payloads");
      }
      source->open(stage_.trial().role);
      compare(read_from(*source, 0), all, "opening again does not start again at frame 0");
    }
    const auto second = stage_.make_as<Source>();
    const SourceInfo again = second->open(stage_.trial().role);
    if (info.background_count > 0 && again.background_count == info.background_count) {
      const std::int64_t last = info.background_count - 1;
      findings_.require(digest(*second->background(last)) == digest(*source->background(last)),
                        "a second source with the same parameters gives other backgrounds");
    }
    compare(read_from(*second, 0), all,
            "a second source with the same parameters gives other payloads");
    findings_.require(second->content_key() == stage_.make_as<Source>()->content_key(),
                      "content_key() changes though nothing outside changed");
  }

 private:
  /// Digests of all frames from `first` on.
  std::vector<std::string> read_from(Source& source, std::int64_t first) {
    std::vector<std::string> digests;
    const std::int64_t limit = stage_.trial().role == SourceRole::kClock ? kPatience : kFollowed;
    for (std::int64_t frame = first; frame < limit; ++frame) {
      const auto call = stage_.call(frame);
      const bool more = source.read(call->io());
      if (!more) {
        for (std::size_t i = 0; i < call->output_count(); ++i) {
          findings_.require(!call->output(i),
                            "emits a payload though read() says that the end was reached");
        }
        break;
      }
      for (std::size_t i = 0; i < call->output_count(); ++i)
        check_output(i, call->output(i), frame);
      digests.push_back(call->digest_of_outputs());
    }
    return digests;
  }

  void check_output(std::size_t index, const PayloadPtr& payload, std::int64_t frame) {
    if (!payload) return;  // e.g. a follower, or a clock's frame without an annotation
    const std::string& declared = stage_.declaration().outputs[index].type;
    if (payload->port() != declared) {
      findings_.add("output " + std::to_string(index) + " is declared as " + declared + " but is " +
                    std::string(payload->port()));
      return;
    }
    const std::size_t cameras = stage_.scene().cameras.size();
    if (const auto* frames = dynamic_cast<const FrameSet*>(payload.get())) {
      findings_.require(stage_.trial().role == SourceRole::kClock,
                        "a follower must not give Frames");
      check_frames(*frames, frame);
    }
    if (const auto* detections = dynamic_cast<const Detections*>(payload.get())) {
      findings_.require(detections->views.size() == cameras, "Detections need one list per camera");
      for (const auto& view : detections->views) {
        for (const ImageDetection& d : view) {
          const bool good = std::isfinite(d.box.left) && std::isfinite(d.box.top) &&
                            d.box.width > 0 && d.box.height > 0 && std::isfinite(d.score);
          findings_.require(good, "a detection's box is empty or not finite");
        }
      }
    }
    if (const auto* truth = dynamic_cast<const GroundTruth*>(payload.get())) {
      for (const TruePerson& person : truth->people) {
        for (const TrueView& view : person.views) {
          findings_.require(view.camera < cameras,
                            "a true view names a camera that the scene lacks");
          findings_.require(view.visibility >= 0 && view.visibility <= 1,
                            "a visibility is not in [0, 1]");
        }
      }
    }
  }

  void check_frames(const FrameSet& frames, std::int64_t frame) {
    const std::size_t cameras = stage_.scene().cameras.size();
    findings_.require(frames.frame == frame, "FrameSet::frame is not the frame that was asked for");
    findings_.require(frames.time_ns == stage_.scene().time_of_frame(frame),
                      "FrameSet::time_ns is not the scene's time of the frame");
    findings_.require(frames.views.size() == cameras, "a FrameSet needs one view per camera");
    for (std::size_t c = 0; c < std::min(cameras, frames.views.size()); ++c) {
      const cv::Mat& view = frames.views[c];
      if (view.empty()) continue;
      const Camera& camera = stage_.scene().cameras[c];
      findings_.require(view.type() == CV_8UC3, "images must be 8-bit BGR");
      findings_.require(view.cols == camera.width() && view.rows == camera.height(),
                        "an image has another size than its camera");
    }
  }

  /// What is learned from before the run; `source` may be anywhere in its frames.
  void backgrounds(Source& source, std::int64_t count) {
    for (std::int64_t i = 0; i < count; ++i) {
      findings_.step("background()", [&] { check_frames(*source.background(i), i); });
    }
    findings_.must_throw<std::out_of_range>("background() beyond those announced",
                                            "std::out_of_range", [&] { source.background(count); });
    if (count == 0) return;
    findings_.require(digest(*source.background(0)) == digest(*source.background(0)),
                      "a background is not the same when it is asked for again");
  }

  void end_is_the_end(Source& source, std::int64_t end) {
    const auto call = stage_.call(end);
    findings_.require(!source.read(call->io()),
                      "read() gives a frame after it said that the end was reached");
  }

  void seeking(Source& source, const std::vector<std::string>& all) {
    const auto count = static_cast<std::int64_t>(all.size());
    for (const std::int64_t frame : {std::int64_t{0}, count / 2, count - 1, std::int64_t{1}}) {
      if (frame >= count) continue;
      findings_.step("seek()", [&] {
        source.seek(frame);
        compare(read_from(source, frame), {all.begin() + frame, all.end()},
                "reading from a frame after seek() gives other payloads than reading up to it");
      });
    }
    findings_.step("seek()", [&] { source.seek(0); });
    compare(read_from(source, 0), all, "reading a second time gives other payloads");
  }

  void compare(const std::vector<std::string>& found, const std::vector<std::string>& wanted,
               const char* otherwise) {
    findings_.require(found == wanted, otherwise);
  }

  const Stage& stage_;
  Findings& findings_;
};

}  // namespace

void check_source(const Stage& stage, Findings& findings) { SourceCheck(stage, findings).run(); }

}  // namespace plaza::contract
