// The doubles that give frames and learn from them.
#include <chrono>
#include <cstdint>
#include <istream>
#include <memory>
#include <optional>
#include <ostream>
#include <string>
#include <thread>
#include <utility>

#include "plaza/component/learner.h"
#include "plaza/data/ground_truth.h"
#include "tests/support/double_behavior.h"
#include "tests/support/execution_doubles.h"

namespace plaza::test {
namespace {

class TestSource : public Source {
 public:
  struct Options : Failure {
    std::int64_t frames = 40;
    bool live = false;
    bool announce = true;
    std::int64_t people_free = 0;
    std::int64_t backgrounds = 0;
    std::string content;
    std::int64_t delay_us = 0;
  };
  static Declaration<Options> declare() {
    Parameters<Options> p;
    declare_failure(p);
    p.value("frames", &Options::frames).at_least(0).meaning("how many");
    p.value("live", &Options::live).meaning("can be read only once");
    p.value("announce", &Options::announce).meaning("says how many before the end");
    p.value("people_free", &Options::people_free).meaning("first frames that show nobody");
    p.value("backgrounds", &Options::backgrounds).meaning("images of the empty place");
    p.value("content", &Options::content).meaning("stands for the files that it reads");
    p.value("delay_us", &Options::delay_us).unit("us").meaning("time that a frame takes");
    return Declaration<Options>("test-source", "Gives small made-up images.")
        .output<FrameSet>("images")
        .output<GroundTruth>("where people are")
        .parameters(std::move(p));
  }
  TestSource(const Options& options, const BuildContext& context)
      : options_(options), scene_(context.scene) {
    fail_if(options_, "constructor");
  }

 private:
  Diagnostics do_check() const override {
    if (options_.fail_in == "check") return refusal("/frames");
    return {};
  }
  SourceInfo do_open() override {
    fail_if(options_, "open");
    SourceInfo info{.frame_count = {}, .rereadable = !options_.live};
    if (options_.announce) info.frame_count = options_.frames;
    info.background_count = options_.backgrounds;
    return info;
  }
  std::shared_ptr<const FrameSet> do_background(std::int64_t index) override {
    fail_if(options_, "background", index);
    auto frames = std::make_shared<FrameSet>();
    frames->frame = index;
    frames->time_ns = scene_->time_of_frame(index);
    for (const Camera& camera : scene_->cameras) {
      frames->views.emplace_back(camera.height(), camera.width(), CV_8UC3, cv::Scalar::all(7));
    }
    return frames;
  }
  void do_seek(std::int64_t frame) override {
    fail_if(options_, "seek", frame);
    if (options_.live)
      throw InternalError("a live source can't go to frame " + std::to_string(frame));
    if (frame >= options_.frames) throw UserError("frame is beyond the end");
  }
  bool do_read(NodeIo& io) override {
    if (io.frame() >= options_.frames) return false;
    fail_if(options_, "process", io.frame());
    ++counters().reads;
    if (options_.delay_us > 0)
      std::this_thread::sleep_for(std::chrono::microseconds(options_.delay_us));
    auto frames = std::make_shared<FrameSet>();
    frames->frame = io.frame();
    frames->time_ns = io.time_ns();
    for (std::size_t v = 0; v < scene_->cameras.size(); ++v) {
      if (io.frame() % 7 == 3 && v == 1) {  // a view without an image
        frames->views.emplace_back();
        continue;
      }
      const Camera& camera = scene_->cameras[v];
      cv::Mat image(camera.height(), camera.width(), CV_8UC3);
      const std::uint64_t seed = mix(static_cast<std::uint64_t>(io.frame()) * 31 + v);
      for (int row = 0; row < image.rows; ++row) {
        for (int b = 0; b < image.cols * 3; ++b) {
          image.ptr(row)[b] =
              static_cast<unsigned char>(seed + static_cast<std::uint64_t>(row * b));
        }
      }
      frames->views.push_back(std::move(image));
    }
    io.out(0, std::move(frames));
    auto truth = std::make_shared<GroundTruth>();
    truth->people.push_back(
        {.id = 1,
         .position_m = Eigen::Vector2d(0.1 * static_cast<double>(io.frame()), 1),
         .heading_rad = {},
         .views = {}});
    io.out(1, std::move(truth));
    return true;
  }
  bool do_people_free(std::int64_t frame) const override { return frame < options_.people_free; }
  std::string do_content_key() const override { return options_.content; }

  Options options_;
  std::shared_ptr<const Scene> scene_;
};

/// A detector that knows how bright frames are on average, which it has to learn.
class TestLearner : public Detector, public Learner {
 public:
  struct Options : Failure {
    bool needs_frames = true;
    bool people_free = false;
    std::optional<std::int64_t> first;
    std::int64_t every = 1;
    std::int64_t at_least = 1;
    std::string extra;
  };
  static Declaration<Options> declare() {
    Parameters<Options> p;
    declare_failure(p);
    p.value("needs_frames", &Options::needs_frames).meaning("learns from frames");
    p.value("people_free", &Options::people_free).meaning("only from frames without people");
    p.value("first", &Options::first).meaning("only from the first ones");
    p.value("every", &Options::every).meaning("only from every n-th");
    p.value("at_least", &Options::at_least).meaning("frames needed");
    p.value("extra", &Options::extra).meaning("extra_key()");
    return Declaration<Options>("test-learner", "Finds one person where the mean frame number is.")
        .input<FrameSet>("images")
        .output<Observations>("one of them")
        .parameters(std::move(p));
  }
  TestLearner(const Options& options, const BuildContext&) : options_(options) {}
  Learner* learner() override { return this; }

 private:
  Observations do_detect(const NodeIo& io) const override {
    if (seen_ < 0) throw InternalError("was not taught");
    fail_if(options_, "process", io.frame());
    Observation o;
    o.position_m = {static_cast<double>(sum_), static_cast<double>(seen_)};
    o.probability = 1;
    Observations found;
    found.items.push_back(std::move(o));
    return found;
  }
  std::optional<LearningPlan> do_plan() const override {
    if (!options_.needs_frames) return std::nullopt;
    return LearningPlan{options_.people_free, options_.first, options_.every};
  }
  void do_learn(const FrameSet& frames) override {
    fail_if(options_, "learn", frames.frame);
    ++counters().learned_frames;
    sum_ += frames.frame;
  }
  void do_finish(std::int64_t seen) override {
    ++counters().learned_models;
    if (options_.needs_frames && seen < options_.at_least) {
      throw UserError("needs " + std::to_string(options_.at_least) + " frames to learn from, got " +
                      std::to_string(seen));
    }
    seen_ = seen;
  }
  void do_save(std::ostream& out) const override { out << "model " << sum_ << ' ' << seen_; }
  void do_load(std::istream& in) override {
    std::string word;
    in >> word >> sum_ >> seen_;
    if (!in || word != "model" || options_.fail_in == "load") {
      seen_ = -7;
      throw UserError("this is no model");
    }
    ++counters().loaded_models;
  }
  std::string do_extra_key() const override { return options_.extra; }

  Options options_;
  std::int64_t sum_ = 0;
  std::int64_t seen_ = -1;
};

}  // namespace

void register_frame_doubles(ComponentRegistrar& registrar) {
  registrar.add<TestSource>();
  registrar.add<TestLearner>();
}

}  // namespace plaza::test
