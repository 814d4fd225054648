#include "tests/support/execution_doubles.h"

#include <chrono>
#include <istream>
#include <map>
#include <mutex>
#include <ostream>
#include <thread>

#include "plaza/component/learner.h"
#include "plaza/data/ground_truth.h"
#include "plaza/data/track.h"
#include "plaza/io/output_file.h"

namespace plaza::test {

Counters& counters() {
  static Counters all;
  return all;
}

namespace {

struct Failure {
  std::string fail_in;
  std::int64_t fail_at = -1;
  std::string error = "user";
};

template <class Options>
void declare_failure(Parameters<Options>& p) {
  // members of the base: the class of a member pointer is not converted when T is deduced
  p.value("fail_in", static_cast<std::string Options::*>(&Options::fail_in))
      .meaning("phase to fail in");
  p.value("fail_at", static_cast<std::int64_t Options::*>(&Options::fail_at))
      .meaning("frame to fail at");
  p.value("error", static_cast<std::string Options::*>(&Options::error)).meaning("how to fail");
}

void fail_if(const Failure& failure, const std::string& phase, std::int64_t frame = -1) {
  if (failure.fail_in != phase || failure.fail_at != frame) return;
  if (failure.error == "user") throw UserError("asked to fail; ask for something else");
  if (failure.error == "internal") throw InternalError("asked to fail");
  if (failure.error == "foreign") throw std::out_of_range("a plugin's own trouble");
  throw 42;
}

Diagnostics refusal(const std::string& pointer) {
  Diagnostic diagnostic;
  diagnostic.pointer = pointer;
  diagnostic.message = "can't be used; choose another";
  return {diagnostic};
}

/// Pseudo-random, but the same for the same frame.
std::uint64_t mix(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

void jitter(std::int64_t frame, std::int64_t limit_us) {
  if (limit_us <= 0) return;
  const auto us =
      mix(static_cast<std::uint64_t>(frame) + 99) % static_cast<std::uint64_t>(limit_us);
  std::this_thread::sleep_for(std::chrono::microseconds(us));
}

class TestSource : public Source {
 public:
  struct Options : Failure {
    std::int64_t frames = 40;
    bool live = false;
    bool announce = true;
    std::int64_t people_free = 0;
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
    return info;
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

std::uint64_t checksum(const FrameSet& frames) {
  std::uint64_t sum = 17;
  for (const cv::Mat& image : frames.views) {
    sum = mix(sum + 1);
    for (int row = 0; row < image.rows; ++row) {
      for (int b = 0; b < image.cols * 3; ++b) sum = sum * 131 + image.ptr(row)[b];
    }
  }
  return sum;
}

/// Two people whose places depend on every pixel.
class TestDetector : public Detector {
 public:
  struct Options : Failure {
    std::int64_t jitter_us = 0;
  };
  static Declaration<Options> declare() {
    Parameters<Options> p;
    declare_failure(p);
    p.value("jitter_us", &Options::jitter_us).unit("us").meaning("longest time that a frame takes");
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
    fail_if(options_, "process", io.frame());
    jitter(io.frame(), options_.jitter_us);
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
  struct Options : Failure {
    std::int64_t jitter_us = 0;
  };
  static Declaration<Options> declare() {
    Parameters<Options> p;
    declare_failure(p);
    p.value("jitter_us", &Options::jitter_us).unit("us").meaning("longest time that a frame takes");
    return Declaration<Options>("test-describer", "Turns every second person.")
        .input<Observations>("people")
        .output<Observations>("the same with headings")
        .parameters(std::move(p));
  }
  TestDescriber(const Options& options, const BuildContext&) : options_(options) {}

 private:
  void do_describe(const NodeIo& io, Observations& observations) override {
    fail_if(options_, "process", io.frame());
    jitter(io.frame(), options_.jitter_us);
    for (std::size_t i = 0; i < observations.items.size(); i += 2) {
      observations.items[i].heading_rad = 0.25 * static_cast<double>(io.frame() % 12);
    }
  }
  Options options_;
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

/// Joins observations by their order; makes points final `delay` frames later, the rest at the end.
class TestAssociator : public Associator {
 public:
  struct Options : Failure {
    std::int64_t delay = 3;
    std::int64_t jitter_us = 0;
  };
  static Declaration<Options> declare() {
    Parameters<Options> p;
    declare_failure(p);
    p.value("delay", &Options::delay).at_least(0).meaning("frames that points stay open");
    p.value("jitter_us", &Options::jitter_us).unit("us").meaning("longest time that a frame takes");
    return Declaration<Options>("test-associator", "Takes the first for the first, always.")
        .input<Observations>("people")
        .output<Tracks>("their tracks")
        .parameters(std::move(p));
  }
  TestAssociator(const Options& options, const BuildContext&) : options_(options) {}

 private:
  AssociatorOutput do_push(const AssociatorInput& input) override {
    fail_if(options_, "process", input.frame);
    jitter(input.frame, options_.jitter_us);
    std::vector<TrackPoint>& points = open_[input.frame];
    TrackId id = 0;
    for (const Observation& o : input.observations->items) {
      ++pushed_;
      points.push_back(
          {.id = ++id,
           .frame = input.frame,
           .position_m = o.position_m + Eigen::Vector2d(0, 1e-3 * static_cast<double>(pushed_)),
           .heading_rad = o.heading_rad,
           .score = o.probability,
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

class TestScores : public Evaluator {
 public:
  struct Options : Failure {
    bool undeclared = false;
    std::vector<std::string> leave_out;
    bool flushed = true;
  };
  static Declaration<Options> declare() {
    Parameters<Options> p;
    declare_failure(p);
    p.value("undeclared", &Options::undeclared).meaning("gives a metric that it does not declare");
    p.value("flushed", &Options::flushed).meaning("counts points that came at the end");
    p.value("leave_out", &Options::leave_out).meaning("figures not to give");
    return Declaration<Options>("test-scores", "Counts.")
        .input<Tracks>("counted")
        .optional_input<GroundTruth>("counted, too")
        .metric({"tracking", "points", "", Better::kHigher, "final points"})
        .metric({"tracking", "truth", "", Better::kNeither, "true people"})
        .parameters(std::move(p));
  }
  TestScores(const Options& options, const BuildContext&) : options_(options) {}

 private:
  void do_observe(const NodeIo& io) override {
    fail_if(options_, "process", io.frame());
    const auto* tracks = io.find<Tracks>(0);
    const bool at_end = !io.has(1);  // there is truth in every frame, but not when flushing
    if (tracks != nullptr && (options_.flushed || !at_end)) {
      for (const TrackPoint& p : tracks->points) points_ += p.final ? 1 : 0;
    }
    if (const auto* truth = io.find<GroundTruth>(1)) truth_ += truth->people.size();
  }
  Evaluation do_evaluate() override {
    fail_if(options_, "evaluate");
    nlohmann::json values = {{"points", points_}, {"truth", truth_}, {"space", "ground"}};
    if (options_.undeclared) values["surprise"] = 1;
    for (const std::string& key : options_.leave_out) values.erase(key);
    return {{"tracking", values}};
  }
  Options options_;
  std::int64_t points_ = 0;
  std::size_t truth_ = 0;
};

/// Writes a row for each call; its last line says how it ended.
class TestSink : public Sink {
 public:
  struct Options : Failure {
    std::string file = "sink.txt";
  };
  static Declaration<Options> declare() {
    Parameters<Options> p;
    declare_failure(p);
    p.value("file", &Options::file).meaning("where to");
    return Declaration<Options>("test-sink", "Writes what it sees.")
        .input<Tracks>("written")
        .parameters(std::move(p));
  }
  TestSink(const Options& options, const BuildContext& context)
      : options_(options), path_(context.output_folder / options.file) {}

 private:
  void do_write(const NodeIo& io) override {
    fail_if(options_, "process", io.frame());
    if (!file_) file_ = std::make_unique<OutputFile>(path_);
    const auto* tracks = io.find<Tracks>(0);
    file_->write(std::to_string(io.frame()) + " " +
                 std::to_string(tracks != nullptr ? tracks->points.size() : 0) + "\n");
  }
  std::vector<Artifact> do_finish(bool complete) override {
    fail_if(options_, "finish");
    if (!file_) return {};
    file_->write(complete ? "complete\n" : "partial\n");
    file_->commit();
    return {{path_, "rows of the test sink"}};
  }
  Options options_;
  std::filesystem::path path_;
  std::unique_ptr<OutputFile> file_;
};

class TestRenderer : public Renderer {
 public:
  using Options = Failure;
  static Declaration<Options> declare() {
    Parameters<Options> p;
    declare_failure(p);
    return Declaration<Options>("test-renderer", "Draws numbers.")
        .input<FrameSet>("images")
        .input<Tracks>("drawn")
        .optional_input<GroundTruth>("drawn, too")
        .parameters(std::move(p));
  }
  TestRenderer(const Options& options, const BuildContext& context)
      : options_(options), path_(context.output_folder / (context.name + ".drawing")) {}

 private:
  void do_begin(std::int64_t begin, std::int64_t end) override {
    fail_if(options_, "begin");
    file_ = std::make_unique<OutputFile>(path_);
    file_->write(std::to_string(begin) + " to " + std::to_string(end) + "\n");
  }
  void do_render(const RenderFrame& frame) override {
    fail_if(options_, "render", frame.frame);
    std::string row = std::to_string(frame.frame) + " " + std::to_string(checksum(*frame.frames));
    for (const TrackPoint& p : frame.tracks) row += " " + std::to_string(p.id);
    row += frame.ground_truth != nullptr
               ? " truth " + std::to_string(frame.ground_truth->people[0].position_m->x())
               : " no truth";
    file_->write(row + "\n");
  }
  std::vector<Artifact> do_end(bool complete) override {
    fail_if(options_, "end");
    if (!file_) return {};
    file_->write(complete ? "complete\n" : "partial\n");
    file_->commit();
    return {{path_, "a drawing"}};
  }
  Options options_;
  std::filesystem::path path_;
  std::unique_ptr<OutputFile> file_;
};

}  // namespace

void register_doubles(ComponentRegistrar& registrar) {
  registrar.add<TestSource>();
  registrar.add<TestDetector>();
  registrar.add<TestDescriber>();
  registrar.add<TestLearner>();
  registrar.add<TestAssociator>();
  registrar.add<TestScores>();
  registrar.add<TestSink>();
  registrar.add<TestRenderer>();
}

}  // namespace plaza::test
