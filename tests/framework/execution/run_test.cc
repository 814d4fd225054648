// What a run leaves behind when nothing goes wrong.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/execution_fixture.h"

namespace plaza {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::lines_of;
using test::plain_nodes;
using test::RunFixture;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsSupersetOf;
using ::testing::StartsWith;

class RunTest : public RunFixture {
 protected:
  // json::insert would take a braced object for a list of elements
  static void insert(json& nodes, int index, const json& node) {
    nodes.insert(nodes.begin() + index, node);
  }
};

TEST_F(RunTest, WritesTheContractsFiles) {
  const RunReport report = run(plain_nodes());
  EXPECT_TRUE(report.complete);
  EXPECT_EQ(report.frames, 40);
  std::vector<std::string> names;
  for (const auto& [name, content] : test::contents_of(folder_ / "out")) names.push_back(name);
  EXPECT_THAT(names,
              ElementsAre("observations.ground.csv", "resolved.json", "sink.txt", "summary.json",
                          "tracks.ground.csv", "tracks.left.txt", "tracks.right.txt"));
  const auto observations = lines_of(folder_ / "out/observations.ground.csv");
  EXPECT_EQ(observations.size(), 81u);
  EXPECT_EQ(observations[0], "frame,x_m,y_m,heading_deg,score");
  EXPECT_THAT(observations[1], StartsWith("1,"));
  const auto tracks = lines_of(folder_ / "out/tracks.ground.csv");
  EXPECT_EQ(tracks.size(), 81u) << "points that become final only at the end are there, too";
  EXPECT_EQ(tracks[0], "frame,id,x_m,y_m,heading_deg,score");
  EXPECT_THAT(tracks[1], StartsWith("1,1,"));
  EXPECT_THAT(tracks[2], StartsWith("1,2,"));
  EXPECT_THAT(tracks[80], StartsWith("40,2,"));
}

TEST_F(RunTest, SummaryHasTheContractsKeys) {
  run(plain_nodes());
  const json s = summary();
  std::vector<std::string> keys;
  for (const auto& [key, value] : s.items()) keys.push_back(key);
  EXPECT_THAT(keys, ElementsAre("branches", "cameras", "complete", "evaluation", "frames",
                                "frames_per_second", "nodes", "pipeline", "plaza", "seconds"));
  EXPECT_EQ(s["plaza"], 1);
  EXPECT_EQ(s["pipeline"], "Test");
  EXPECT_EQ(s["complete"], true);
  EXPECT_EQ(s["frames"], 40);
  EXPECT_EQ(s["cameras"], 2);
  ASSERT_EQ(s["nodes"].size(), 6u);
  for (const json& node : s["nodes"]) {
    EXPECT_EQ(node["calls"], 40) << node;
    EXPECT_GE(node["seconds"], 0.0);
  }
  EXPECT_EQ(s["nodes"][1]["name"], "detector");
  EXPECT_EQ(s["nodes"][1]["use"], "test-detector");
  EXPECT_EQ(s["evaluation"]["tracking"],
            json({{"points", 80}, {"truth", 40}, {"space", "ground"}}));
  EXPECT_NEAR(s["frames_per_second"].get<double>(), 40 / s["seconds"].get<double>(),
              0.01 * s["frames_per_second"].get<double>());
}

TEST_F(RunTest, ResolvedConfigurationIsWritten) {
  run(plain_nodes());
  const json resolved = json::parse(test::read_text(folder_ / "out/resolved.json"));
  EXPECT_EQ(resolved["nodes"][0]["use"], "test-source");
  EXPECT_EQ(resolved["nodes"][0]["frames"], 40);
}

TEST_F(RunTest, ParallelGivesTheSameBytes) {
  json nodes = plain_nodes();
  nodes[1]["jitter_us"] = 400;
  nodes[2]["jitter_us"] = 200;
  nodes[3]["jitter_us"] = 100;
  insert(nodes, 1, {{"use", "test-learner"}, {"name", "background"}, {"first", 5}});
  nodes.push_back({{"use", "test-renderer"}, {"name", "overlay"}});
  run(nodes, "1");
  const auto reference = comparable("1");
  EXPECT_GT(reference.size(), 7u);
  for (const int threads : {2, 3, 4, 8}) {
    for (const char* again : {"a", "b"}) {
      options_.threads = threads;
      const std::string out = std::to_string(threads) + again;
      run(nodes, out);
      auto contents = comparable(out);
      // the configuration is the same, but for the folder it was written from
      EXPECT_EQ(contents, reference) << threads << " threads";
    }
  }
}

TEST_F(RunTest, FramesOfARangeKeepTheirNumbers) {
  options_.first_frame = 10;
  options_.end_frame = 13;
  const RunReport report = run(plain_nodes());
  EXPECT_TRUE(report.complete);
  EXPECT_EQ(report.frames, 3);
  const auto rows = lines_of(folder_ / "out/observations.ground.csv");
  ASSERT_EQ(rows.size(), 7u);
  EXPECT_THAT(rows[1], StartsWith("11,"));
  EXPECT_THAT(rows[6], StartsWith("13,"));
  options_.first_frame = 0;
  options_.end_frame.reset();
  run(plain_nodes(), "all");
  const auto all = lines_of(folder_ / "all/observations.ground.csv");
  EXPECT_EQ(rows[1], all[21]) << "the same frame, whatever came before";
}

TEST_F(RunTest, ARangeMayReachBeyondTheEndButNotBeginThere) {
  options_.first_frame = 38;
  options_.end_frame = 100;
  EXPECT_EQ(run(plain_nodes()).frames, 2);
  options_.first_frame = 40;
  const auto error = fault_of<UserError>(plain_nodes(), "none");
  EXPECT_STREQ(error.what(), "--frames begins at 40, but 'cameras' has only 40 frames (0 to 39)");
  EXPECT_FALSE(fs::exists(folder_ / "none")) << "checked before anything is written";
}

TEST_F(RunTest, ASourceMayEndBeforeOrAfterWhatItAnnounced) {
  json nodes = plain_nodes();
  nodes[0]["announce"] = false;
  EXPECT_EQ(run(nodes).frames, 40);
  nodes[0]["frames"] = 0;
  EXPECT_EQ(run(nodes, "empty").frames, 0);
  EXPECT_EQ(lines_of(folder_ / "empty/tracks.ground.csv").size(), 1u);
}

TEST_F(RunTest, AnEarlierRunsFilesDoNotMixWithThisOnes) {
  test::write_text(folder_ / "out/tracks.left.txt", "of an earlier run\n");
  test::write_text(folder_ / "out/observations.ground.csv.part", "of a killed run\n");
  test::write_text(folder_ / "out/notes.txt", "the user's own\n");
  run({{{"use", "test-source"}, {"name", "cameras"}}});
  EXPECT_FALSE(fs::exists(folder_ / "out/tracks.left.txt"));
  EXPECT_FALSE(fs::exists(folder_ / "out/observations.ground.csv.part"));
  EXPECT_TRUE(fs::exists(folder_ / "out/notes.txt"));
}

TEST_F(RunTest, WithoutTracksThereAreObservations) {
  run({{{"use", "test-source"}, {"name", "cameras"}}, {{"use", "test-detector"}, {"name", "d"}}});
  EXPECT_EQ(lines_of(folder_ / "out/observations.ground.csv").size(), 81u);
  EXPECT_FALSE(fs::exists(folder_ / "out/tracks.ground.csv"));
}

TEST_F(RunTest, FurtherBranchesHaveFoldersAndFiguresOfTheirOwn) {
  json nodes = plain_nodes();
  insert(nodes, 3, {{"use", "test-associator"}, {"name", "plain"}, {"from", "detector"}});
  insert(nodes, 4, {{"use", "test-scores"}, {"name", "plain-scores"}});
  const RunReport report = run(nodes);
  EXPECT_EQ(lines_of(folder_ / "out/plain/tracks.ground.csv").size(), 81u);
  const auto plain = lines_of(folder_ / "out/plain/observations.ground.csv");
  const auto main = lines_of(folder_ / "out/observations.ground.csv");
  EXPECT_NE(plain, main) << "each shows what its tracks were made from: here without headings";
  EXPECT_THAT(plain[3], HasSubstr(",,"));
  const json s = summary();
  EXPECT_EQ(s["evaluation"]["tracking"]["points"], 80);
  EXPECT_EQ(s["branches"]["plain"]["tracking"]["points"], 80);
  EXPECT_EQ(report.branches.size(), 1u);
}

TEST_F(RunTest, EvaluatorsShareASectionUnlessTheyContradictEachOther) {
  json nodes = plain_nodes();
  nodes[4]["leave_out"] = {"truth"};
  nodes.push_back({{"use", "test-scores"}, {"name", "rest"}, {"leave_out", {"points", "space"}}});
  const json all = {{"points", 80}, {"truth", 40}, {"space", "ground"}};
  RunReport report = run(nodes);
  EXPECT_EQ(report.evaluation, (Evaluation{{"tracking", all}}));
  nodes.push_back({{"use", "test-scores"}, {"name", "less"}, {"flushed", false}});
  report = run(nodes, "contradiction");
  EXPECT_EQ(report.evaluation.size(), 2u);
  EXPECT_EQ(report.evaluation["tracking"], all);
  EXPECT_EQ(report.evaluation["tracking@less"]["points"], 74);
}

TEST_F(RunTest, RenderersGetImagesAgainWithFinalTracks) {
  json nodes = plain_nodes();
  nodes.push_back({{"use", "test-renderer"}, {"name", "overlay"}});
  options_.first_frame = 5;
  options_.end_frame = 9;
  const RunReport report = run(nodes);
  const auto rows = lines_of(folder_ / "out/overlay.drawing");
  ASSERT_EQ(rows.size(), 6u);
  EXPECT_EQ(rows[0], "5 to 9");
  EXPECT_THAT(rows[1], StartsWith("5 "));
  EXPECT_THAT(rows[1], HasSubstr(" 1 2 truth 0.5"));
  EXPECT_THAT(rows[4], HasSubstr(" 1 2 truth 0.8"));
  EXPECT_EQ(rows[5], "complete");
  EXPECT_EQ(summary()["nodes"][6]["calls"], 4);
  std::vector<std::string> what;
  for (const Artifact& a : report.artifacts) what.push_back(a.what);
  EXPECT_THAT(what, IsSupersetOf({"rows of the test sink", "a drawing", "tracks on the ground",
                                  "observations on the ground", "figures of the run"}));
  for (const Artifact& a : report.artifacts) EXPECT_TRUE(fs::is_regular_file(a.file)) << a.file;
}

TEST_F(RunTest, ALiveSourceIsKeptForLearningAndRendering) {
  json nodes = plain_nodes();
  insert(nodes, 1, {{"use", "test-learner"}, {"name", "background"}, {"first", 5}});
  nodes.push_back({{"use", "test-renderer"}, {"name", "overlay"}});
  run(nodes, "file");
  nodes[0]["live"] = true;
  for (const int threads : {1, 4}) {
    options_.threads = threads;
    options_.cache_folder = folder_ / ("cache" + std::to_string(threads));
    const std::string out = "live" + std::to_string(threads);
    run(nodes, out);
    auto file = comparable("file");
    auto live = comparable(out);
    file.erase("resolved.json");
    live.erase("resolved.json");
    EXPECT_EQ(live, file) << "the same images come back from the disk";
  }
}

TEST_F(RunTest, ALiveSourceNeedsAnEndToLearnFromAllOfIt) {
  json nodes = plain_nodes();
  nodes[0]["live"] = true;
  nodes[0]["announce"] = false;
  insert(nodes, 1, {{"use", "test-learner"}, {"name", "background"}});
  const auto error = fault_of<UserError>(nodes);
  EXPECT_EQ(error.context().component, "background");
  EXPECT_THAT(error.what(), HasSubstr("'cameras' is live and has no end"));
}

}  // namespace
}  // namespace plaza
