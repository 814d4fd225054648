// Test components: what is done with results, an evaluator, sinks and a renderer.
#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/support/test_component_groups.h"

namespace plaza::test {
namespace {

class Scores : public Evaluator {
 public:
  struct Options {
    std::vector<double> thresholds = {0.5};
  };
  static Declaration<Options> declare() {
    Parameters<Options> p;
    p.value("thresholds", &Options::thresholds).above(0).at_most(1).meaning("overlaps swept");
    return Declaration<Options>("scores", "Compares with the truth.")
        .input<Tracks>("tracks")
        .input<GroundTruth>("the truth")
        .metric({"tracking", "MOTA", "", Better::kHigher, "tracking accuracy"})
        .parameters(std::move(p));
  }
  Scores(const Options& /*options*/, const BuildContext& /*context*/) {}

 protected:
  void do_observe(const NodeIo& /*io*/) override {}
  Evaluation do_evaluate() override { return {}; }
};

class QuietSink : public Sink {
 protected:
  void do_write(const NodeIo& /*io*/) override {}
  std::vector<Artifact> do_finish(bool /*complete*/) override { return {}; }
};

class Report : public QuietSink {
 public:
  struct Options {
    std::filesystem::path logo;
    std::vector<std::map<std::string, std::string>> columns;
  };
  static Declaration<Options> declare() {
    Parameters<Options> p;
    p.value("logo", &Options::logo).meaning("picture at the top");
    p.value("columns", &Options::columns).meaning("heading by language, of each column");
    return Declaration<Options>("report", "Writes a report.")
        .input<Tracks>("tracks")
        .parameters(std::move(p));
  }
  Report(const Options& /*options*/, const BuildContext& /*context*/) {}
};

class Faulty : public QuietSink {
 public:
  struct Options {};
  static Declaration<Options> declare() {
    return Declaration<Options>("faulty", "Fails when it is made.").input<Tracks>("tracks");
  }
  Faulty(const Options& /*options*/, const BuildContext& /*context*/) {
    throw std::runtime_error("index 7 of 3");
  }
};

class Overlay : public Renderer {
 public:
  struct Options {};
  static Declaration<Options> declare() {
    return Declaration<Options>("overlay", "Draws tracks into images.")
        .input<FrameSet>("images")
        .input<Tracks>("tracks")
        .optional_input<GroundTruth>("the truth, for comparison");
  }
  Overlay(const Options& /*options*/, const BuildContext& /*context*/) {}

 protected:
  void do_begin(std::int64_t /*begin*/, std::int64_t /*end*/) override {}
  void do_render(const RenderFrame& /*frame*/) override {}
  std::vector<Artifact> do_end(bool /*complete*/) override { return {}; }
};

}  // namespace

void register_test_results(ComponentRegistrar& registrar) {
  registrar.add<Scores>();
  registrar.add<Report>();
  registrar.add<Faulty>();
  registrar.add<Overlay>();
}

}  // namespace plaza::test
