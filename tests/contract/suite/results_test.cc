// Nodes that judge and show results (evaluators, sinks, renderers) and break one promise at a time.
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/contract/suite/misbehaving.h"

namespace plaza::contract {
namespace {

/// The share of true people within 0.3 m of a track.
class Found final : public Evaluator {
 public:
  using Options = Fault;
  static Declaration<Options> declare() {
    Declaration<Options> d("found", "How many were found");
    d.input<Tracks>("tracks").input<GroundTruth>("truth");
    d.metric({"found", "share", "", Better::kHigher, "people that were found"});
    d.parameters(fault_parameter());
    return d;
  }
  Found(const Options& options, const BuildContext&) : fault_(options.fault) {}

 protected:
  void do_observe(const NodeIo& io) override {
    const auto* tracks = io.find<Tracks>(0);
    const auto* truth = io.find<GroundTruth>(1);
    if (fault_ == "needs-flush") (void)io.in<Tracks>(0);
    if (tracks == nullptr || truth == nullptr) return;
    for (const TruePerson& person : truth->people) {
      ++people_;
      for (const TrackPoint& p : tracks->points) {
        if ((p.position_m - *person.position_m).norm() < 0.3) {
          ++found_;
          break;
        }
      }
    }
  }
  Evaluation do_evaluate() override {
    Evaluation out;
    const double share = people_ > 0 || fault_ == "nan" ? found_ / people_ : 0;
    if (fault_ == "nothing" || people_ == 0) {
      if (fault_ == "nan") out["found"]["share"] = share;
      return out;
    }
    out["found"]["share"] = fault_ == "backwards" ? 1 - share : share;
    if (fault_ == "undeclared") out["found"]["luck"] = 0.5;
    if (fault_ == "other-section") out["lost"]["share"] = 0.5;
    if (fault_ == "random") out["found"]["share"] = share / ++calls_;
    return out;
  }

 private:
  std::string fault_;
  double people_ = 0, found_ = 0;
  static inline int calls_ = 0;
};

TEST(EvaluatorContractTest, EachBrokenPromiseIsCaught) {
  expect_caught<Found>({
      {"needs-flush", "the evaluation of a perfect result threw"},
      {"backwards", "is worse for a perfect result"},
      {"undeclared", "\"found.luck\", which is neither a declared metric nor a parameter"},
      {"other-section", "gives section \"lost\", of which it declares no metric"},
      {"random", "the same input gives other figures"},
      {"nothing", "gives none of its declared metrics"},
      {"nan", "not finite"},
  });
}

class Rows final : public Sink {
 public:
  using Options = Fault;
  static Declaration<Options> declare() {
    Declaration<Options> d("rows", "Counts observations");
    d.input<Observations>("people").optional_input<Tracks>("tracks").parameters(fault_parameter());
    return d;
  }
  Rows(const Options& options, const BuildContext& context)
      : fault_(options.fault), file_(context.output_folder / "rows.csv") {
    if (fault_ == "elsewhere")
      file_ = std::filesystem::temp_directory_path() / "plaza-contract-rows.csv";
  }

 protected:
  void do_write(const NodeIo& io) override {
    if (fault_ == "needs-tracks") (void)io.in<Tracks>(1);
    const auto* people = io.find<Observations>(0);
    text_ += std::to_string(people != nullptr ? people->items.size() : 0) + "\n";
    if (fault_ == "random") text_ += std::to_string(++calls_) + "\n";
  }
  std::vector<Artifact> do_finish(bool complete) override {
    if (fault_ == "partial" && !complete) throw InternalError("not done yet");
    if (fault_ == "half-line" && !complete) text_ += "12,";
    if (fault_ != "missing") std::ofstream(file_) << text_;
    return {{file_, fault_ == "mute" ? "" : "numbers of people"}};
  }

 private:
  std::string fault_;
  std::filesystem::path file_;
  std::string text_;
  static inline int calls_ = 0;
};

TEST(SinkContractTest, EachBrokenPromiseIsCaught) {
  expect_caught<Rows>({
      {"elsewhere", "an artifact lies outside the output folder"},
      {"needs-tracks", "threw: input 1 (Tracks) is not connected"},
      {"random", "the same input gives other files"},
      {"partial", "writing 20 frames threw: not done yet"},
      {"half-line", "rows.csv ends in the middle of a line"},
      {"missing", "the artifact rows.csv does not exist"},
      {"mute", "an artifact does not say what it is"},
  });
}

class Pages final : public Renderer {
 public:
  using Options = Fault;
  static Declaration<Options> declare() {
    Declaration<Options> d("pages", "A list of frames");
    d.input<FrameSet>("images").input<Tracks>("tracks").optional_input<GroundTruth>("truth");
    d.parameters(fault_parameter());
    return d;
  }
  Pages(const Options& options, const BuildContext& context)
      : fault_(options.fault), file_(context.output_folder / "pages.json") {}

 protected:
  void do_begin(std::int64_t, std::int64_t) override { pages_ = nlohmann::json::array(); }
  void do_render(const RenderFrame& frame) override {
    if (fault_ == "needs-truth" && frame.ground_truth == nullptr) throw InternalError("no truth");
    if (fault_ == "needs-images" && frame.frames->views.at(0).empty())
      throw InternalError("no image");
    pages_.push_back(frame.frame);
  }
  std::vector<Artifact> do_end(bool complete) override {
    std::string text = pages_.dump() + "\n";
    if (fault_ == "broken" && !complete) text = "[1,\n";
    std::ofstream(file_) << text;
    return {{file_, "frames"}};
  }

 private:
  std::string fault_;
  std::filesystem::path file_;
  nlohmann::json pages_;
};

TEST(RendererContractTest, EachBrokenPromiseIsCaught) {
  expect_caught<Pages>({
      {"needs-truth", "threw: no truth"},
      {"needs-images", "threw: no image"},
      {"broken", "pages.json is not valid JSON"},
  });
}

}  // namespace
}  // namespace plaza::contract
