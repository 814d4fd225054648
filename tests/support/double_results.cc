// The doubles that judge, write and draw.
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "plaza/data/ground_truth.h"
#include "plaza/data/track.h"
#include "plaza/io/output_file.h"
#include "tests/support/double_behavior.h"

namespace plaza::test {
namespace {

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

void register_result_doubles(ComponentRegistrar& registrar) {
  registrar.add<TestScores>();
  registrar.add<TestSink>();
  registrar.add<TestRenderer>();
}

}  // namespace plaza::test
