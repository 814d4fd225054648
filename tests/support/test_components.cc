#include "tests/support/test_components.h"

#include <stdexcept>
#include <utility>

namespace plaza::test {
namespace {

UserError fault(std::string pointer, std::string message) {
  Diagnostic diagnostic;
  diagnostic.pointer = std::move(pointer);
  diagnostic.message = std::move(message);
  return UserError(std::move(diagnostic));
}

/// A source that ends at once.
class EmptySource : public Source {
 protected:
  SourceInfo do_open() override { return {}; }
  void do_seek(std::int64_t /*frame*/) override {}
  bool do_read(NodeIo& /*io*/) override { return false; }
};

class Video : public EmptySource {
 public:
  struct Options {
    std::map<std::string, std::filesystem::path> files;
    std::optional<double> frame_rate_hz;
  };
  static Declaration<Options> declare() {
    Parameters<Options> p;
    p.value("files", &Options::files).required().items(1).meaning("one video file per camera");
    p.value("frame_rate_hz", &Options::frame_rate_hz)
        .unit("Hz")
        .above(0)
        .meaning("instead of the header's");
    return Declaration<Options>("video", "Reads one video file per camera.")
        .output<FrameSet>("images of all views")
        .parameters(std::move(p));
  }
  Video(Options options, const BuildContext& /*context*/) : options_(std::move(options)) {}

 protected:
  Diagnostics do_check() const override {
    Diagnostics faults;
    for (const auto& [camera, file] : options_.files) {
      if (!std::filesystem::exists(file)) {
        faults.push_back({{}, "/files/" + camera, "there is no file " + file.string()});
      }
    }
    return faults;
  }

 private:
  Options options_;
};

class Synthetic : public EmptySource {
 public:
  enum class Scenario { kWalk, kCrossing };
  struct Options {
    Scenario scenario = Scenario::kWalk;
    int frames = 500;
    bool shadows = false;
  };
  static Declaration<Options> declare() {
    Parameters<Options> p;
    p.choice("scenario", &Options::scenario, {"walk", "crossing"}).meaning("who goes where");
    p.value("frames", &Options::frames).at_least(1).meaning("length");
    p.value("shadows", &Options::shadows).meaning("whether bodies cast shadows");
    return Declaration<Options>("synthetic", "Renders a made-up world.")
        .output<FrameSet>("images of all views")
        .output<GroundTruth>("the truth")
        .parameters(std::move(p));
  }
  Synthetic(const Options& /*options*/, const BuildContext& /*context*/) {}
};

class TruthFile : public EmptySource {
 public:
  struct Options {
    std::filesystem::path file;
  };
  static Declaration<Options> declare() {
    Parameters<Options> p;
    p.value("file", &Options::file).required().meaning("MOTChallenge rows");
    return Declaration<Options>("ground-truth", "Reads the truth.")
        .output<GroundTruth>("the truth")
        .parameters(std::move(p));
  }
  TruthFile(const Options& /*options*/, const BuildContext& /*context*/) {}
};

class QuietModality : public Modality {
 protected:
  using Modality::Modality;
  Prepared do_prepare(const cv::Mat& /*image*/, std::size_t /*camera*/,
                      const cv::Mat& /*previous*/) const override {
    return {};
  }
  std::unique_ptr<TemplateBatch> do_sample(const ShapeModel& /*model*/,
                                           std::span<const Pose> /*poses*/,
                                           std::size_t /*camera*/) const override {
    return nullptr;
  }
  void do_match(const Evidence& /*evidence*/, const TemplateBatch& /*templates*/,
                std::span<const std::uint32_t> /*which*/,
                std::span<double> /*log_likelihood*/) const override {}
  EvidencePtr do_explain(const EvidencePtr& evidence, const TemplateBatch& /*templates*/,
                         std::size_t /*index*/) const override {
    return evidence;
  }
};

class Edges : public QuietModality {
 public:
  struct Options {
    int directions = 12;
    double sigma_px = 3.0;
  };
  static Declaration<Options> declare() {
    Parameters<Options> p;
    p.value("directions", &Options::directions)
        .at_least(1)
        .at_most(64)
        .meaning("bins of direction");
    p.value("sigma_px", &Options::sigma_px)
        .unit("px")
        .above(0)
        .meaning("tolerance")
        .source("thesis (4.1)");
    return Declaration<Options>("edges", "Foreground edges with their distance transform.")
        .source("thesis 4.1")
        .input<FrameSet>("images")
        .output<EvidenceSet>("edges")
        .parameters(std::move(p));
  }
  Edges(const Options& options, const BuildContext& context) : QuietModality(context) {
    if (options.directions % 2 != 0) {
      throw fault("/directions",
                  "directions come in pairs, " + std::to_string(options.directions) + " is odd");
    }
  }
};

class Color : public QuietModality {
 public:
  struct Options {
    std::vector<int> bins = {8, 8, 8};
  };
  static Declaration<Options> declare() {
    Parameters<Options> p;
    p.value("bins", &Options::bins).items(3, 3).at_least(2).meaning("bins of L, a and b");
    return Declaration<Options>("color", "Foreground by colour.")
        .input<FrameSet>("images")
        .output<EvidenceSet>("colours")
        .output<ForegroundMask>("foreground")
        .parameters(std::move(p));
  }
  Color(const Options& /*options*/, const BuildContext& context) : QuietModality(context) {}
};

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

class QuietShape : public ShapeModel {
 protected:
  Silhouette do_silhouette(const Pose& /*pose*/, const Camera& /*camera*/) const override {
    return {};
  }
  Body do_body() const override { return {}; }
};

class Cylinder : public QuietShape {
 public:
  struct Options {
    std::vector<double> radii_m = {0.12, 0.25, 0.18};
  };
  static Declaration<Options> declare() {
    Parameters<Options> p;
    p.value("radii_m", &Options::radii_m)
        .unit("m")
        .items(3, 3)
        .above(0)
        .meaning("of head, torso and legs");
    return Declaration<Options>("cylinder", "Three cylinders.").parameters(std::move(p));
  }
  Cylinder(const Options& options, const BuildContext& /*context*/) {
    if (options.radii_m[0] > options.radii_m[1]) {
      throw fault("/radii_m/0", "the head is wider than the torso");
    }
  }
};

class Cuboid : public QuietShape {
 public:
  struct Options {
    double width_m = 0.5;
  };
  static Declaration<Options> declare() {
    Parameters<Options> p;
    p.value("width_m", &Options::width_m).unit("m").above(0).meaning("width");
    return Declaration<Options>("cuboid", "A box.").parameters(std::move(p));
  }
  Cuboid(const Options& /*options*/, const BuildContext& /*context*/) {}
};

class ConstantVelocity : public MotionModel {
 public:
  struct Options {
    double sigma_mps2 = 1.0;
  };
  static Declaration<Options> declare() {
    Parameters<Options> p;
    p.value("sigma_mps2", &Options::sigma_mps2)
        .unit("m/s^2")
        .above(0)
        .meaning("of the acceleration");
    return Declaration<Options>("constant-velocity", "People keep going.").parameters(std::move(p));
  }
  ConstantVelocity(const Options& /*options*/, const BuildContext& /*context*/) {}

 protected:
  MotionState do_start(const Eigen::Vector2d& /*p*/, const Eigen::Matrix2d& /*c*/) const override {
    return {};
  }
  MotionState do_predict(const MotionState& state, double /*dt_s*/) const override { return state; }
  MotionState do_correct(const MotionState& state, const Eigen::Vector2d& /*p*/,
                         const Eigen::Matrix2d& /*c*/) const override {
    return state;
  }
  Eigen::Vector2d do_position(const MotionState& /*state*/) const override { return {0, 0}; }
  Eigen::Vector2d do_velocity(const MotionState& /*state*/) const override { return {0, 0}; }
  Eigen::Matrix2d do_position_covariance(const MotionState& /*state*/) const override {
    return Eigen::Matrix2d::Identity();
  }
};

class QuietAffinity : public AffinityTerm {
 protected:
  void do_evaluate(const AffinityEnd& /*from*/, std::span<const AffinityEnd> /*to*/,
                   std::span<double> /*log_affinity*/) const override {}
};

class Location : public QuietAffinity {
 public:
  struct Options {
    double weight = 1.0;
    double sigma_m = 0.3;
  };
  static Declaration<Options> declare() {
    Parameters<Options> p;
    p.value("weight", &Options::weight).at_least(0).meaning("weight");
    p.value("sigma_m", &Options::sigma_m).unit("m").above(0).meaning("spread");
    return Declaration<Options>("location", "Near is alike.").parameters(std::move(p));
  }
  Location(const Options& /*options*/, const BuildContext& /*context*/) {}
};

class Appearance : public QuietAffinity {
 public:
  struct Options {
    double weight = 1.0;
    std::optional<std::int64_t> rank;
  };
  static Declaration<Options> declare() {
    Parameters<Options> p;
    p.value("weight", &Options::weight).at_least(0).meaning("weight");
    p.value("rank", &Options::rank).at_least(1).meaning("rank, where there is one");
    return Declaration<Options>("appearance", "Same colours are alike.").parameters(std::move(p));
  }
  Appearance(const Options& /*options*/, const BuildContext& /*context*/) {}
};

class Mixture : public QuietAffinity {
 public:
  struct Options {};
  static Declaration<Options> declare() {
    Parameters<Options> p;
    p.part_list("terms", "affinity").meaning("what is mixed");
    return Declaration<Options>("mixture", "Several affinities in one.").parameters(std::move(p));
  }
  Mixture(const Options& /*options*/, const BuildContext& /*context*/) {}
};

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

class ToRegistry : public ComponentRegistrar {
 public:
  explicit ToRegistry(Registry& registry) : registry_(registry) {}

 protected:
  void do_add(ComponentDeclaration declaration, ComponentFactory factory) override {
    ComponentEntry entry;
    entry.declaration = std::move(declaration);
    entry.factory = std::move(factory);
    registry_.add(std::move(entry));
  }

 private:
  Registry& registry_;
};

}  // namespace

void register_components(ComponentRegistrar& registrar) {
  registrar.add<Video>();
  registrar.add<Synthetic>();
  registrar.add<TruthFile>();
  registrar.add<Edges>();
  registrar.add<Color>();
  registrar.add<Boxes>();
  registrar.add<Grid>();
  registrar.add<Oracle>();
  registrar.add<Histogram>();
  registrar.add<Gnn>();
  registrar.add<Flow>();
  registrar.add<Cylinder>();
  registrar.add<Cuboid>();
  registrar.add<ConstantVelocity>();
  registrar.add<Location>();
  registrar.add<Appearance>();
  registrar.add<Mixture>();
  registrar.add<Scores>();
  registrar.add<Report>();
  registrar.add<Faulty>();
  registrar.add<Overlay>();
}

Registry make_registry() {
  Registry registry;
  ToRegistry registrar(registry);
  register_components(registrar);
  return registry;
}

std::shared_ptr<const Scene> make_scene() { return std::make_shared<Scene>(); }

}  // namespace plaza::test
