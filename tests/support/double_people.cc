// The doubles that find, describe and follow people.
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "plaza/core/error.h"
#include "plaza/data/track.h"
#include "tests/support/double_behavior.h"

namespace plaza::test {
namespace {

/// A number that observations carry.
struct TestMark final : FeatureOf<TestMark> {
  static constexpr std::string_view kFeature = "test-mark";
  explicit TestMark(std::uint64_t v) : value(v) {}
  static std::shared_ptr<const TestMark> load(std::string_view bytes) {
    if (bytes.size() != sizeof(value)) throw InternalError("a mark has 8 bytes");
    std::uint64_t read = 0;
    std::memcpy(&read, bytes.data(), sizeof(read));
    return std::make_shared<TestMark>(read);
  }
  std::optional<std::string> do_save() const override {
    return std::string(reinterpret_cast<const char*>(&value), sizeof(value));
  }
  std::uint64_t value;
};

/// One that can't be kept.
struct TestWhim final : FeatureOf<TestWhim> {
  static constexpr std::string_view kFeature = "test-whim";
};

/// Two people whose places depend on every pixel.
class TestDetector : public Detector {
 public:
  using Options = Work;
  static Declaration<Options> declare() {
    Parameters<Options> p;
    declare_work(p);
    return Declaration<Options>("test-detector", "Finds two people in any image.")
        .input<FrameSet>("images")
        .output<Observations>("two of them")
        .parameters(std::move(p));
  }
  TestDetector(const Options& options, const BuildContext&) : options_(options) {
    fail_if(options_, "constructor");
  }

 private:
  Diagnostics do_check() const override {
    if (options_.fail_in == "check") return refusal("/jitter_us");
    return {};
  }
  Observations do_detect(const NodeIo& io) const override {
    work(options_, io.frame());
    const std::uint64_t sum = checksum(io.in<FrameSet>(0));
    Observations found;
    for (std::uint64_t i = 0; i < 2; ++i) {
      Observation o;
      o.position_m = {static_cast<double>(mix(sum + i) % 1000) / 250.0 - 2, static_cast<double>(i)};
      o.probability = static_cast<double>(mix(sum ^ i) % 100) / 100;
      found.items.push_back(std::move(o));
    }
    return found;
  }
  void do_flush(NodeIo&) override { fail_if(options_, "flush"); }
  Options options_;
};

class TestDescriber : public Describer {
 public:
  struct Options : Work {
    std::string feature;
  };
  static Declaration<Options> declare() {
    Parameters<Options> p;
    declare_work(p);
    p.value("feature", &Options::feature).meaning("mark or whim: what people carry");
    return Declaration<Options>("test-describer", "Turns every second person.")
        .input<Observations>("people")
        .output<Observations>("the same with headings")
        .feature<TestMark>("a number of its own")
        .feature<TestWhim>("nothing")
        .parameters(std::move(p));
  }
  TestDescriber(const Options& options, const BuildContext&) : options_(options) {}

 private:
  void do_describe(const NodeIo& io, Observations& observations) override {
    work(options_, io.frame());
    for (std::size_t i = 0; i < observations.items.size(); i += 2) {
      observations.items[i].heading_rad = 0.25 * static_cast<double>(io.frame() % 12);
    }
    for (Observation& o : observations.items) {
      const auto seed = static_cast<std::uint64_t>(io.frame());
      if (options_.feature == "mark") o.features.set(std::make_shared<TestMark>(mix(seed)));
      if (options_.feature == "whim") o.features.set(std::make_shared<TestWhim>());
    }
  }
  Options options_;
};

/// Joins observations by their order; makes points final `delay` frames later, the rest at the end.
class TestAssociator : public Associator {
 public:
  struct Options : Work {
    std::int64_t delay = 3;
  };
  static Declaration<Options> declare() {
    Parameters<Options> p;
    declare_work(p);
    p.value("delay", &Options::delay).at_least(0).meaning("frames that points stay open");
    return Declaration<Options>("test-associator", "Takes the first for the first, always.")
        .input<Observations>("people")
        .output<Tracks>("their tracks")
        .parameters(std::move(p));
  }
  TestAssociator(const Options& options, const BuildContext&) : options_(options) {}

 private:
  AssociatorOutput do_push(const AssociatorInput& input) override {
    work(options_, input.frame);
    std::vector<TrackPoint>& points = open_[input.frame];
    TrackId id = 0;
    for (const Observation& o : input.observations->items) {
      ++pushed_;
      points.push_back(
          {.id = ++id,
           .frame = input.frame,
           .position_m = o.position_m + Eigen::Vector2d(0, 1e-3 * static_cast<double>(pushed_)),
           .heading_rad = o.heading_rad,
           .score = score_of(o),
           .observed = true,
           .final = false,
           .boxes = {}});
    }
    AssociatorOutput output;
    output.points = points;  // open ones first
    finalize(input.frame - options_.delay, output);
    return output;
  }
  AssociatorOutput do_flush_tracks() override {
    fail_if(options_, "flush");
    AssociatorOutput output;
    finalize(std::numeric_limits<std::int64_t>::max(), output);
    return output;
  }
  /// Of its mark where it has one.
  static double score_of(const Observation& o) {
    const auto* const mark = o.features.get<TestMark>();
    return mark != nullptr ? static_cast<double>(mark->value % 1000) / 1000 : o.probability;
  }
  void finalize(std::int64_t last, AssociatorOutput& output) {
    while (!open_.empty() && open_.begin()->first <= last) {
      for (TrackPoint& point : open_.begin()->second) {
        point.final = true;
        output.points.push_back(std::move(point));
      }
      open_.erase(open_.begin());
    }
  }
  Options options_;
  std::int64_t pushed_ = 0;
  std::map<std::int64_t, std::vector<TrackPoint>> open_;
};

}  // namespace

void register_people_doubles(ComponentRegistrar& registrar) {
  registrar.add<TestDetector>();
  registrar.add<TestDescriber>();
  registrar.add<TestAssociator>();
}

}  // namespace plaza::test
