// Runs that read from the cache what an earlier one computed: the same results, and less work.
#include <gmock/gmock.h>

#include "framework/cache/node_cache.h"
#include "tests/support/execution_fixture.h"

namespace plaza::test {
namespace {

class ReuseTest : public RunFixture {
 protected:
  ReuseTest() {
    options_.reuse = true;
    options_.least_gain = 0;  // doubles take no time
    options_.cache_limit_bytes = 100000000;
    options_.draw = false;
  }

  /// Everything that must not depend on what was computed and what was read: all but who worked.
  std::map<std::string, std::string> results(const std::string& out) const {
    auto contents = comparable(out);
    json summary = json::parse(contents.at("summary.json"));
    for (json& node : summary.at("nodes")) node.erase("calls");
    contents["summary.json"] = summary.dump(2);
    return contents;
  }

  std::int64_t calls(const std::string& out, const std::string& name) const {
    const json all = summary(out);
    for (const json& node : all.at("nodes")) {
      if (node.at("name") == name) return node.at("calls");
    }
    return -1;
  }

  /// What the run without any cache gives.
  std::map<std::string, std::string> reference(const json& nodes) {
    RunOptions options = options_;
    options.reuse = false;
    options.output_folder = folder_ / "reference";
    run_pipeline(read(nodes), double_scene(), options);
    return results("reference");
  }

  static json nodes_with(const char* node, const char* key, const json& value) {
    json nodes = plain_nodes();
    for (json& n : nodes) {
      if (n["name"] == node) n[key] = value;
    }
    return nodes;
  }
};

TEST_F(ReuseTest, TheSecondRunReadsEverythingAndGivesTheSame) {
  const auto expected = reference(plain_nodes());
  run(plain_nodes(), "first");
  const auto reads = counters().reads.load();
  const RunReport second = run(plain_nodes(), "second");
  EXPECT_EQ(results("first"), expected);
  EXPECT_EQ(results("second"), expected);
  EXPECT_EQ(counters().reads, reads) << "the source was not even asked";
  EXPECT_EQ(calls("first", "detector"), 40);
  EXPECT_EQ(calls("second", "detector"), 0);
  EXPECT_EQ(calls("second", "tracks"), 0);
  EXPECT_EQ(calls("second", "scores"), 40) << "evaluators always work";
  EXPECT_GT(second.node_seconds, 0) << "what was read has taken its time, once";
  EXPECT_THAT(second.notes, testing::Contains(testing::HasSubstr("camera 'right'")))
      << "what the source met is said again";
}

TEST_F(ReuseTest, OnlyWhatFollowsAChangeIsComputed) {
  run(plain_nodes(), "first");
  const json changed = nodes_with("tracks", "delay", 7);
  const auto expected = reference(changed);
  run(changed, "second");
  EXPECT_EQ(results("second"), expected);
  EXPECT_EQ(calls("second", "cameras"), 0);
  EXPECT_EQ(calls("second", "detector"), 0);
  EXPECT_EQ(calls("second", "describer"), 0);
  EXPECT_EQ(calls("second", "tracks"), 40);
}

TEST_F(ReuseTest, AnyNumberOfThreadsReadsTheSame) {
  const auto expected = reference(plain_nodes());
  options_.threads = 4;
  run(plain_nodes(), "first");
  run(nodes_with("tracks", "delay", 7), "other");
  run(plain_nodes(), "second");
  EXPECT_EQ(results("first"), expected);
  EXPECT_EQ(results("second"), expected);
}

TEST_F(ReuseTest, OtherFramesSeedsAndContentAreOtherEntries) {
  run(plain_nodes(), "first");
  run(nodes_with("cameras", "content", "other files"), "content");
  EXPECT_EQ(calls("content", "detector"), 40);
  options_.end_frame = 20;
  const auto expected = reference(plain_nodes());
  run(plain_nodes(), "frames");
  EXPECT_EQ(calls("frames", "detector"), 20);
  EXPECT_EQ(results("frames"), expected);
  options_.first_frame = 10;
  const auto later = reference(plain_nodes());
  run(plain_nodes(), "later");
  run(plain_nodes(), "later again");
  EXPECT_EQ(calls("later", "detector"), 10);
  EXPECT_EQ(calls("later again", "detector"), 0);
  EXPECT_EQ(results("later again"), later);
}

TEST_F(ReuseTest, ADamagedEntryIsComputedAgain) {
  const auto expected = reference(plain_nodes());
  run(plain_nodes(), "first");
  const NodeCache cache(options_.cache_folder, 100000000);
  std::size_t damaged = 0;
  for (const CachedFile& file : cache.list()) {
    std::string text = read_text(file.file);
    text[text.size() / 2] = static_cast<char>(text[text.size() / 2] ^ 1);
    write_text(file.file, text);
    ++damaged;
  }
  EXPECT_GE(damaged, 4U);
  EXPECT_TRUE(run(plain_nodes(), "second").complete);
  EXPECT_EQ(results("second"), expected);
  EXPECT_TRUE(run(plain_nodes(), "third").complete);
  EXPECT_EQ(results("third"), expected);
  EXPECT_EQ(calls("third", "detector"), 0);
}

TEST_F(ReuseTest, FeaturesThatAreReadBackGiveTheSameTracks) {
  json nodes = nodes_with("describer", "feature", "mark");
  run(nodes, "first");
  nodes[3]["delay"] = 7;
  const auto expected = reference(nodes);
  run(nodes, "second");
  EXPECT_EQ(results("second"), expected);
  EXPECT_EQ(calls("second", "describer"), 0);
  EXPECT_EQ(calls("second", "tracks"), 40);
  const auto unmarked = reference(nodes_with("tracks", "delay", 7));
  EXPECT_NE(expected.at("tracks.ground.csv"), unmarked.at("tracks.ground.csv"))
      << "tracks depend on the features";
}

TEST_F(ReuseTest, WhatCarriesFeaturesThatCannotBeKeptIsComputedAgain) {
  json nodes = nodes_with("describer", "feature", "whim");
  run(nodes, "first");
  nodes[3]["delay"] = 7;
  const auto expected = reference(nodes);
  run(nodes, "second");
  EXPECT_EQ(results("second"), expected);
  EXPECT_EQ(calls("second", "detector"), 0) << "what is above it is kept";
  EXPECT_EQ(calls("second", "describer"), 40);
}

TEST_F(ReuseTest, RenderersAndSinksGetTheSameFromTheCache) {
  options_.draw = true;
  json nodes = plain_nodes();
  nodes.push_back({{"use", "test-renderer"}, {"name", "overlay"}});
  const auto expected = reference(nodes);
  run(nodes, "first");
  const auto reads = counters().reads.load();
  run(nodes, "second");
  EXPECT_EQ(results("first"), expected);
  EXPECT_EQ(results("second"), expected);
  EXPECT_EQ(counters().reads, reads);
}

TEST_F(ReuseTest, LearnersSeeTheRealSourceAndTheirNodesAreKept) {
  json nodes = plain_nodes();
  nodes[1]["use"] = "test-learner";
  const auto expected = reference(nodes);
  std::filesystem::remove_all(options_.cache_folder);
  run(nodes, "first");
  const auto learned = counters().learned_models.load();
  run(nodes, "second");
  EXPECT_EQ(results("first"), expected);
  EXPECT_EQ(results("second"), expected);
  EXPECT_EQ(counters().learned_models, learned);
  EXPECT_EQ(calls("second", "detector"), 0);
  nodes[1]["every"] = 3;  // learns anew: from the source, beside frames that are kept
  const auto other = reference(nodes);
  std::filesystem::remove_all(folder_ / "none");
  for (const auto& entry : std::filesystem::directory_iterator(options_.cache_folder)) {
    if (entry.path().extension() == ".learned") std::filesystem::remove(entry.path());
  }
  run(nodes, "third");
  EXPECT_EQ(results("third"), other);
  EXPECT_EQ(calls("third", "cameras"), 0) << "frames were kept";
  EXPECT_EQ(counters().learned_models, learned + 2) << "the reference and the third run";
}

TEST_F(ReuseTest, ARunThatFailsKeepsNothing) {
  const json failing = nodes_with("tracks", "fail_in", "process");
  json nodes = failing;
  nodes[3]["fail_at"] = 30;
  fault_of<UserError>(nodes);
  const NodeCache cache(options_.cache_folder, 100000000);
  EXPECT_TRUE(cache.list().empty());
  EXPECT_TRUE(run(plain_nodes(), "second").complete);
  EXPECT_EQ(calls("second", "detector"), 40);
}

TEST_F(ReuseTest, WhatIsFasterComputedThanReadIsNotKept) {
  options_.least_gain = 1e9;
  const auto expected = reference(plain_nodes());
  run(plain_nodes(), "first");
  run(plain_nodes(), "second");
  EXPECT_EQ(results("second"), expected);
  EXPECT_EQ(calls("second", "detector"), 40);
  const NodeCache cache(options_.cache_folder, 100000000);
  for (const CachedFile& file : cache.list()) {
    ASSERT_TRUE(file.info);
    EXPECT_TRUE(file.info->declined);
  }
}

TEST_F(ReuseTest, ACacheThatCannotBeWrittenIsANote) {
  options_.cache_folder = folder_.write("a-file", "no folder") / "below";
  const auto expected = reference(plain_nodes());
  const RunReport report = run(plain_nodes(), "first");
  EXPECT_TRUE(report.complete);
  EXPECT_EQ(results("first"), expected);
  EXPECT_THAT(report.notes, testing::Contains(testing::HasSubstr("are not kept")));
}

TEST_F(ReuseTest, TheCacheStaysWithinItsLimit) {
  options_.cache_limit_bytes = 20000;
  for (int delay = 0; delay < 6; ++delay) {
    run(nodes_with("tracks", "delay", delay), "out" + std::to_string(delay));
    std::uintmax_t bytes = 0;
    for (const CachedFile& file : NodeCache(options_.cache_folder, 0).list()) bytes += file.bytes;
    EXPECT_LE(bytes, 20000U);
  }
}

}  // namespace
}  // namespace plaza::test
