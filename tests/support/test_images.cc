// Test components: where images come from and what is measured in them, sources and modalities.
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/test_component_groups.h"

namespace plaza::test {
namespace {

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
        Diagnostic& missing = faults.emplace_back();
        missing.pointer = "/files/" + camera;
        missing.message = "there is no file " + file.string();
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
                      const Past& /*past*/) const override {
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
                         std::span<const std::uint32_t> /*which*/) const override {
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

}  // namespace

void register_test_images(ComponentRegistrar& registrar) {
  registrar.add<Video>();
  registrar.add<Synthetic>();
  registrar.add<TruthFile>();
  registrar.add<Edges>();
  registrar.add<Color>();
}

}  // namespace plaza::test
