// Whatever goes wrong, wherever: the error says where, and the folder holds valid files that say
// so.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <random>
#include <thread>

#include "tests/support/execution_fixture.h"

namespace plaza {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::lines_of;
using test::plain_nodes;
using test::RunFixture;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class FaultTest : public RunFixture {
 protected:
  static json with_failure(std::size_t node, const std::string& phase, std::int64_t frame,
                           const std::string& error = "user") {
    json nodes = plain_nodes();
    nodes.push_back({{"use", "test-renderer"}, {"name", "overlay"}});
    nodes[node]["fail_in"] = phase;
    nodes[node]["fail_at"] = frame;
    nodes[node]["error"] = error;
    return nodes;
  }

  /// All that a partial folder promises. Rows are of the first `frames` frames.
  void expect_valid_partial(const std::string& out, std::int64_t frames) {
    const json s = summary(out);
    EXPECT_EQ(s["complete"], false);
    EXPECT_NE(s["reason"], "");
    EXPECT_EQ(s["frames"], frames);
    for (const auto& [name, content] : test::contents_of(folder_ / out)) {
      EXPECT_FALSE(name.ends_with(".part")) << name;
      if (!name.ends_with(".csv") && !name.starts_with("tracks.")) continue;
      const auto columns = [](const std::string& row) {
        return std::count(row.begin(), row.end(), ',');
      };
      const auto rows = lines_of(folder_ / (out + "/" + name));
      for (const std::string& row : rows) {
        EXPECT_EQ(columns(row), columns(rows[0])) << name;
        if (row.starts_with("frame")) continue;
        EXPECT_LE(std::stoll(row), frames) << name;
      }
      EXPECT_TRUE(content.empty() || content.back() == '\n') << name;
    }
  }
};

struct NodeFault {
  std::size_t node;
  const char* name;
};

TEST_F(FaultTest, AnyNodeFailingInAFrameEndsTheRunCleanly) {
  for (const NodeFault fault : {NodeFault{0, "cameras"},
                                {1, "detector"},
                                {2, "describer"},
                                {3, "tracks"},
                                {4, "scores"},
                                {5, "sink"}}) {
    for (const int threads : {1, 4}) {
      options_.threads = threads;
      const std::string out = fault.name + std::to_string(threads);
      const auto error = fault_of<UserError>(with_failure(fault.node, "process", 12), out);
      EXPECT_EQ(error.context().component, fault.name);
      EXPECT_EQ(error.context().frame, 12);
      EXPECT_STREQ(error.what(), "asked to fail; ask for something else");
      expect_valid_partial(out, 12);
      EXPECT_EQ(summary(out)["reason"], "node '" + std::string(fault.name) +
                                            "', frame 13: asked to fail; ask for something else");
      EXPECT_EQ(lines_of(folder_ / (out + "/observations.ground.csv")).size(), 1u + 24);
      EXPECT_EQ(lines_of(folder_ / (out + "/sink.txt")).back(), "partial");
      EXPECT_FALSE(fs::exists(folder_ / (out + "/overlay.drawing"))) << "nothing is drawn";
      EXPECT_TRUE(summary(out)["evaluation"].empty()) << "what was not evaluated is absent";
    }
  }
}

TEST_F(FaultTest, TracksOpenAtTheFaultAreEndedByFlushing) {
  fault_of<UserError>(with_failure(1, "process", 12));
  EXPECT_EQ(lines_of(folder_ / "out/tracks.ground.csv").size(), 1u + 24)
      << "three frames of points were still open";
}

TEST_F(FaultTest, InTheFirstFrameNothingIsComplete) {
  fault_of<UserError>(with_failure(1, "process", 0));
  expect_valid_partial("out", 0);
}

TEST_F(FaultTest, FaultsAfterTheStreamKeepItsResults) {
  struct Case {
    std::size_t node;
    const char* phase;
    std::int64_t frame;
    const char* name;
  };
  for (const Case c : {Case{3, "flush", -1, "tracks"},
                       {4, "evaluate", -1, "scores"},
                       {5, "finish", -1, "sink"},
                       {6, "begin", -1, "overlay"},
                       {6, "render", 20, "overlay"},
                       {6, "end", -1, "overlay"}}) {
    for (const int threads : {1, 4}) {
      options_.threads = threads;
      const std::string out = std::string(c.phase) + std::to_string(threads);
      const auto error = fault_of<UserError>(with_failure(c.node, c.phase, c.frame), out);
      EXPECT_EQ(error.context().component, c.name) << c.phase;
      expect_valid_partial(out, 40);
      EXPECT_EQ(lines_of(folder_ / (out + "/observations.ground.csv")).size(), 81u) << c.phase;
      if (std::string(c.phase) == "render") {
        EXPECT_EQ(error.context().frame, 20);
        EXPECT_EQ(lines_of(folder_ / (out + "/overlay.drawing")).back(), "partial");
      }
    }
  }
}

TEST_F(FaultTest, FaultsOfTheCheckLeaveNothingBehind) {
  for (const char* phase : {"constructor", "check", "open"}) {
    json nodes = plain_nodes();
    nodes[0]["fail_in"] = phase;
    EXPECT_THROW(run(nodes), UserError) << phase;
    EXPECT_FALSE(fs::exists(folder_ / "out")) << phase;
  }
}

TEST_F(FaultTest, ForeignExceptionsBecomePlazasOwn) {
  for (const int threads : {1, 4}) {
    options_.threads = threads;
    const auto foreign = fault_of<InternalError>(with_failure(1, "process", 3, "foreign"));
    EXPECT_STREQ(foreign.what(), "a plugin's own trouble");
    EXPECT_EQ(foreign.context().component, "detector");
    EXPECT_EQ(foreign.context().frame, 3);
    const auto alien = fault_of<InternalError>(with_failure(2, "process", 3, "alien"));
    EXPECT_STREQ(alien.what(), "threw something that is not a std::exception");
    EXPECT_EQ(alien.context().component, "describer");
    const auto internal = fault_of<InternalError>(with_failure(4, "evaluate", -1, "foreign"));
    EXPECT_EQ(internal.context().component, "scores");
    EXPECT_FALSE(internal.context().frame);
  }
}

TEST_F(FaultTest, AFurtherFaultWhileEndingStandsBehindTheReason) {
  json nodes = with_failure(1, "process", 12);
  nodes[3]["fail_in"] = "flush";
  const auto error = fault_of<UserError>(nodes);
  EXPECT_EQ(error.context().component, "detector");
  EXPECT_EQ(summary()["reason"],
            "node 'detector', frame 13: asked to fail; ask for something else; also failed: "
            "node 'tracks': asked to fail; ask for something else");
}

TEST_F(FaultTest, UndeclaredMetricsAreThePluginsFault) {
  json nodes = plain_nodes();
  nodes[4]["undeclared"] = true;
  const auto error = fault_of<InternalError>(nodes);
  EXPECT_STREQ(error.what(),
               "gives tracking.surprise, which \"test-scores\" does not declare as a metric");
}

TEST_F(FaultTest, AnInterruptionAtAnyFrameLeavesValidPartialOutput) {
  json nodes = plain_nodes();
  nodes[0]["frames"] = 4000;
  nodes[0]["delay_us"] = 50;
  nodes.push_back({{"use", "test-renderer"}, {"name", "overlay"}});
  std::mt19937 random(5);
  for (int i = 0; i < 12; ++i) {
    options_.threads = 1 + i % 4;
    const auto delay = std::chrono::microseconds(std::uniform_int_distribution(0, 60000)(random));
    std::thread user([delay] {
      std::this_thread::sleep_for(delay);
      request_stop();
    });
    const std::string out = "out" + std::to_string(i);
    const RunReport report = run(nodes, out);
    user.join();
    EXPECT_FALSE(report.complete);
    EXPECT_EQ(report.stop_reason, "interrupted after " + std::to_string(report.frames) + " frames");
    expect_valid_partial(out, report.frames);
    EXPECT_EQ(lines_of(folder_ / (out + "/tracks.ground.csv")).size(),
              static_cast<std::size_t>(1 + 2 * report.frames));
    if (report.frames > 0) {
      EXPECT_EQ(summary(out)["evaluation"]["tracking"]["points"], 2 * report.frames);
    }
    EXPECT_FALSE(fs::exists(folder_ / (out + "/overlay.drawing")));
  }
}

TEST_F(FaultTest, AStopBelongsToOneRun) {
  request_stop();
  EXPECT_FALSE(run(plain_nodes()).complete);
  EXPECT_TRUE(run(plain_nodes()).complete);
}

TEST_F(FaultTest, AFullDiskNamesTheFileAndKeepsWhatIsComplete) {
  json nodes = plain_nodes();
  nodes[0]["frames"] = 3000;
  const rlimit limit{50000, RLIM_INFINITY};
  rlimit before{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  auto* const handler = std::signal(SIGXFSZ, SIG_IGN);
  ::setrlimit(RLIMIT_FSIZE, &limit);
  const auto error = fault_of<UserError>(nodes);
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_THAT(error.what(), HasSubstr("cannot write " + (folder_ / "out").string()));
  EXPECT_THAT(error.what(), HasSubstr("File too large"));
  const json s = summary();
  EXPECT_EQ(s["complete"], false);
  EXPECT_THAT(s["reason"].get<std::string>(), HasSubstr("File too large"));
  for (const auto& [name, content] : test::contents_of(folder_ / "out")) {
    EXPECT_FALSE(name.ends_with(".part")) << name;
    EXPECT_TRUE(content.empty() || content.back() == '\n') << name;
  }
  EXPECT_TRUE(fs::exists(folder_ / "out/observations.ground.csv"));
}

TEST_F(FaultTest, AnOutputFolderThatCantBeMadeIsTheUsersError) {
  test::write_text(folder_ / "file", "");
  const auto error = fault_of<UserError>(plain_nodes(), "file/out");
  EXPECT_THAT(error.what(), HasSubstr("cannot create the output folder"));
  EXPECT_THAT(error.what(), HasSubstr("--out"));
}

}  // namespace
}  // namespace plaza
