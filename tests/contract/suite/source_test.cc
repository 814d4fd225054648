// Sources that break one promise at a time.
#include <string>

#include "tests/contract/suite/misbehaving.h"

namespace plaza::contract {
namespace {

/// Ten frames of images.
class Clip final : public Source {
 public:
  using Options = Fault;
  static Declaration<Options> declare() {
    Declaration<Options> d("clip", "Ten grey frames");
    d.output<FrameSet>("images").parameters(fault_parameter());
    return d;
  }
  Clip(const Options& options, const BuildContext& context)
      : fault_(options.fault), scene_(context.scene) {
    if (fault_ == "throws") throw UserError("no film in the camera");
  }

 protected:
  Diagnostics do_check() const override {
    if (fault_ == "check")
      return {{.where = {}, .pointer = "/fault", .message = "film is missing"}};
    return {};
  }
  SourceInfo do_open() override {
    return {.frame_count = 10, .rereadable = true, .background_count = 3};
  }
  std::shared_ptr<const FrameSet> do_background(std::int64_t index) override {
    if (fault_ == "background-none") return nullptr;
    auto frames = std::make_shared<FrameSet>();
    frames->frame = index + (fault_ == "background-frame" ? 1 : 0);
    frames->time_ns = scene_->time_of_frame(index);
    const double grey = 20 + (fault_ == "background-random" ? ++calls_ % 100 : 0);
    for (const Camera& camera : scene_->cameras) {
      frames->views.emplace_back(camera.height(), camera.width(), CV_8UC3, cv::Scalar::all(grey));
    }
    if (fault_ == "background-views") frames->views.pop_back();
    if (fault_ == "background-moves") shift_ = 1;
    return frames;
  }
  void do_seek(std::int64_t frame) override {
    if (frame > 10 && fault_ != "seek-beyond") throw UserError("the clip has 10 frames");
    if (frame > 0 && fault_ == "seek-shift") shift_ = 1;
  }
  bool do_read(NodeIo& io) override {
    if (io.frame() >= 10 && fault_ != "resumes") {
      if (fault_ == "late") io.out(0, std::make_shared<FrameSet>());
      return false;
    }
    if (io.frame() == 10) return ended_ ? (emit(io), true) : !(ended_ = true);
    if (io.frame() > 10) return false;
    if (fault_ == "empty") return false;
    emit(io);
    return true;
  }

 private:
  void emit(NodeIo& io) {
    auto frames = std::make_shared<FrameSet>();
    frames->frame = io.frame() + (fault_ == "frame" ? 1 : 0);
    frames->time_ns = fault_ == "time" ? 0 : io.time_ns();
    const int type = fault_ == "grey" ? CV_8UC1 : CV_8UC3;
    const int wider = fault_ == "size" ? 2 : 0;
    double grey = 50.0 + static_cast<double>(io.frame() + shift_);
    if (fault_ == "random") grey += ++calls_ % 100;
    for (const Camera& camera : scene_->cameras) {
      frames->views.emplace_back(camera.height(), camera.width() + wider, type,
                                 cv::Scalar::all(grey));
    }
    if (fault_ == "views") frames->views.pop_back();
    if (fault_ == "type") {
      io.out(0, std::make_shared<Observations>());
    } else {
      io.out(0, std::move(frames));
    }
  }
  std::string fault_;
  std::shared_ptr<const Scene> scene_;
  std::int64_t shift_ = 0;
  bool ended_ = false;
  int calls_ = 0;
};

TEST(SourceContractTest, EachBrokenPromiseIsCaught) {
  expect_caught<Clip>({
      {"throws", "making the component threw: no film in the camera"},
      {"check", "check() finds fault with a trial that should work: /fault: film is missing"},
      {"empty", "gives no frame at all"},
      {"seek-beyond", "seek() far beyond the end must throw UserError"},
      {"seek-shift", "reading from a frame after seek() gives other payloads"},
      {"late", "emits a payload though read() says that the end was reached"},
      {"resumes", "gives a frame after it said that the end was reached"},
      {"frame", "FrameSet::frame is not the frame that was asked for"},
      {"time", "FrameSet::time_ns is not the scene's time"},
      {"grey", "images must be 8-bit BGR"},
      {"size", "an image has another size than its camera"},
      {"views", "a FrameSet needs one view per camera"},
      {"random", "reading a second time gives other payloads"},
      {"background-none", "announced a background that it does not give"},
      {"background-frame", "FrameSet::frame is not the frame that was asked for"},
      {"background-views", "a FrameSet needs one view per camera"},
      {"background-random", "a background is not the same when it is asked for again"},
      {"background-moves", "reading a second time gives other payloads"},
      {"type", "output 0 is declared as Frames but is Observations"},
  });
}

TEST(SourceContractTest, AFollowerGivesNoFramesAndDoesNotEnd) {
  Trial trial;
  trial.role = SourceRole::kFollower;
  EXPECT_THAT(
      violations(subject_of<Clip>(), trial),
      testing::IsSupersetOf({"a follower must not end", "a follower must not give Frames"}));
}

}  // namespace
}  // namespace plaza::contract
