// Test components: who finds, describes and follows people.
#include <memory>
#include <string>
#include <utility>

#include "tests/support/test_component_groups.h"

namespace plaza::test {
namespace {

class QuietDetector : public Detector {
 protected:
  Observations do_detect(const NodeIo& /*io*/) const override { return {}; }
};

class Boxes : public QuietDetector {
 public:
  struct Options {};
  static Declaration<Options> declare() {
    return Declaration<Options>("boxes", "Finds people by boxes.")
        .input<FrameSet>("images")
        .output<Observations>("people");
  }
  Boxes(const Options& /*options*/, const BuildContext& /*context*/) {}
};

class Grid : public QuietDetector {
 public:
  struct Options {
    int cells = 40;
    double margin_m = 1.5;
  };
  static Declaration<Options> declare() {
    Parameters<Options> p;
    p.value("cells", &Options::cells).at_least(2).meaning("cells per side");
    p.value("margin_m", &Options::margin_m).unit("m").at_least(0).meaning("reach beyond the area");
    p.part("shape", "shape", "cylinder").meaning("the body");
    ParameterSpec weight = detail::scalar_spec(ParameterType::kReal);
    weight.name = "weight";
    weight.default_value = 1.0;
    weight.minimum = 0;
    weight.meaning = "share of this modality";
    p.input_list("modalities", "Evidence", {weight}).items(1).meaning("what is searched for");
    return Declaration<Options>("grid", "Searches the ground for people.")
        .optional_input<ForegroundMask>("where to look")
        .output<Observations>("people")
        .parameters(std::move(p));
  }
  Grid(Options options, const BuildContext& context)
      : options_(options), shape_(context.part<ShapeModel>("shape")) {
    for (const InputReference& input : context.inputs("modalities")) {
      if (input.producer == nullptr) throw InternalError("input without a producer");
    }
  }

 private:
  Options options_;
  std::shared_ptr<ShapeModel> shape_;
};

class Oracle : public QuietDetector {
 public:
  struct Options {};
  static Declaration<Options> declare() {
    return Declaration<Options>("oracle", "Knows what it must not know.")
        .input<GroundTruth>("the truth")
        .output<Observations>("people");
  }
  Oracle(const Options& /*options*/, const BuildContext& /*context*/) {}
};

class Histogram : public Describer {
 public:
  struct Options {
    std::string label;
  };
  static Declaration<Options> declare() {
    Parameters<Options> p;
    p.value("label", &Options::label).meaning("name of the feature");
    return Declaration<Options>("histogram", "Describes colours.")
        .input<FrameSet>("images")
        .input<Observations>("people")
        .output<Observations>("the same people, described")
        .parameters(std::move(p));
  }
  Histogram(const Options& /*options*/, const BuildContext& /*context*/) {}

 protected:
  void do_describe(const NodeIo& /*io*/, Observations& /*observations*/) override {}
};

class QuietAssociator : public Associator {
 protected:
  AssociatorOutput do_push(const AssociatorInput& /*input*/) override { return {}; }
  AssociatorOutput do_flush_tracks() override { return {}; }
};

class Gnn : public QuietAssociator {
 public:
  enum class Reentry { kNew, kKeep };
  struct Options {
    double gate_m = 1.0;
    double decay = 0.5;
    Reentry reentry = Reentry::kNew;
  };
  static Declaration<Options> declare() {
    Parameters<Options> p;
    p.value("gate_m", &Options::gate_m)
        .unit("m")
        .above(0)
        .at_most(10)
        .meaning("gate")
        .source("thesis (6.1)");
    p.value("decay", &Options::decay).at_least(0).below(1).meaning("share that stays");
    p.choice("reentry", &Options::reentry, {"new", "keep"}).meaning("identity of who comes back");
    p.part("motion", "motion", "constant-velocity").meaning("how people move");
    return Declaration<Options>("gnn", "Assigns observations frame by frame.")
        .input<Observations>("people")
        .output<Tracks>("tracks")
        .output<Tracklets>("tracklets")
        .parameters(std::move(p));
  }
  Gnn(const Options& /*options*/, const BuildContext& /*context*/) {}
};

class Flow : public QuietAssociator {
 public:
  struct Options {};
  static Declaration<Options> declare() {
    Parameters<Options> p;
    p.part_list("affinities", "affinity").items(1, 4).meaning("what makes two one");
    return Declaration<Options>("flow", "Links tracklets.")
        .input<Tracklets>("tracklets")
        .output<Tracks>("tracks")
        .parameters(std::move(p));
  }
  Flow(const Options& /*options*/, const BuildContext& /*context*/) {}
};

}  // namespace

void register_test_people(ComponentRegistrar& registrar) {
  registrar.add<Boxes>();
  registrar.add<Grid>();
  registrar.add<Oracle>();
  registrar.add<Histogram>();
  registrar.add<Gnn>();
  registrar.add<Flow>();
}

}  // namespace plaza::test
