// From a study to checked runs.
#include "framework/study/expand.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "framework/study/prepare.h"
#include "plaza/core/error.h"
#include "tests/support/execution_doubles.h"

namespace plaza {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

class ExpandTest : public ::testing::Test {
 protected:
  Study study(const std::string& more) {
    return read_study_text(R"({ "plaza_study": 1, "pipeline": "p.json", )" + more + "}",
                           folder_ / "study.json");
  }
  PreparedStudy prepare(const std::string& more) { return prepare_study(study(more), registry_); }
  std::string faults(const std::string& more) {
    try {
      prepare(more);
    } catch (const UserError& error) {
      return error.what();
    }
    return "none";
  }

  test::TemporaryFolder folder_;
  Registry registry_ = test::double_registry();
  std::filesystem::path scene_ = folder_.write("scene.json", R"({ "plaza_scene": 1, "name": "One",
    "frame_rate_hz": 25, "area": { "x_m": [-4, 4], "y_m": [-3, 3] }, "cameras": [ { "name": "left",
    "image_size": [64, 48], "calibration": { "format": "pinhole", "fx_px": 50, "fy_px": 50,
    "cx_px": 31.5, "cy_px": 23.5, "centre_m": [0, -8, 2.5], "look_at_m": [0, -3, 1.2] } } ] })");
  std::filesystem::path pipeline_ = folder_.write("p.json", R"({ "plaza": 1, "scene": "scene.json",
    "nodes": [ { "use": "test-source", "name": "cameras" }, { "use": "test-detector" },
               { "use": "test-associator", "name": "tracks" }, { "use": "test-scores" } ] })");
};

TEST_F(ExpandTest, CombinesAllValuesTheFirstAxisSlowest) {
  const Study s = study(R"("axes": [ { "set": "/nodes/tracks/delay", "values": [1, 2] },
    { "set": "/nodes/cameras/frames", "values": [10, 20, 30] } ], "seeds": [4, 5])");
  const Expansion expansion = expand(s, registry_);
  ASSERT_EQ(expansion.variants.size(), 6U);
  EXPECT_THAT(expansion.variants[0].labels, ElementsAre("1", "10"));
  EXPECT_THAT(expansion.variants[1].labels, ElementsAre("1", "20"));
  EXPECT_THAT(expansion.variants[5].labels, ElementsAre("2", "30"));
  EXPECT_EQ(variant_text(s, expansion.variants[5]), "delay=2, frames=30");
  ASSERT_EQ(expansion.jobs.size(), 12U);
  EXPECT_EQ(expansion.jobs[11].variant, 5U);
  EXPECT_EQ(expansion.jobs[11].seed, 5U);
}

TEST_F(ExpandTest, RefusesMoreRunsThanAnybodyMeans) {
  std::string values = "0";
  for (int i = 1; i < 400; ++i) values += "," + std::to_string(i);
  const Study s = study(
      R"("axes": [ { "name": "a", "set": "/nodes/tracks/delay", "values": [)" + values +
      R"(] }, { "name": "b", "set": "/nodes/cameras/frames", "values": [)" + values + "] } ]");
  try {
    expand(s, registry_);
    FAIL() << "no fault";
  } catch (const UserError& error) {
    EXPECT_THAT(error.what(),
                HasSubstr("study.json:1:51: /axes: axes and seeds make more than 100000 runs"));
  }
}

TEST_F(ExpandTest, RefusesMoreSeedsThanAnybodyMeans) {
  std::string seeds = "0";
  for (std::size_t i = 1; i <= kMaxStudyJobs; ++i) seeds += "," + std::to_string(i);
  const Study s = study("\"seeds\": [" + seeds + "]");
  try {
    expand(s, registry_);
    FAIL() << "no fault";
  } catch (const UserError& error) {
    EXPECT_THAT(error.what(), HasSubstr("study.json:1:52: /seeds: axes and seeds make more than"));
  }
}

TEST_F(ExpandTest, ValuesReachThePipelineByTheRulesOfExtends) {
  const PreparedStudy prepared = prepare(R"("set": { "/nodes/cameras/frames": 12 }, "axes": [
    { "name": "joins", "set": "/nodes/tracks", "values": [ { "delay": 7 }, { "use": "test-associator" } ] },
    { "name": "nodes", "choices": [ { "name": "bare" }, { "name": "described", "nodes":
      [ { "use": "test-describer", "after": "test-detector" } ] } ] } ],
    "seeds": [9], "seed_parameters": ["/seed", "/nodes/tracks/jitter_us"])");
  ASSERT_EQ(prepared.jobs.size(), 4U);
  const nlohmann::json& bare = prepared.jobs[0].pipeline;
  EXPECT_EQ(bare["seed"], 9);
  EXPECT_EQ(bare["nodes"].size(), 4U);
  EXPECT_EQ(bare["nodes"][0]["frames"], 12);
  EXPECT_EQ(bare["nodes"][2]["delay"], 7);
  EXPECT_EQ(bare["nodes"][2]["jitter_us"], 9);
  const nlohmann::json& described = prepared.jobs[3].pipeline;
  EXPECT_EQ(described["nodes"].size(), 5U);
  EXPECT_EQ(described["nodes"][2]["use"], "test-describer");
  EXPECT_EQ(described["nodes"][3]["delay"], 3) << "the default: the base says nothing";
}

TEST_F(ExpandTest, NodesThatAreTheSameShareTheirKeys) {
  const PreparedStudy prepared =
      prepare(R"("axes": [ { "set": "/nodes/tracks/delay", "values": [1, 2] } ])");
  const auto& one = prepared.jobs[0].node_keys;
  const auto& two = prepared.jobs[1].node_keys;
  EXPECT_EQ(one[0], two[0]);
  EXPECT_EQ(one[1], two[1]);
  EXPECT_NE(one[2], two[2]) << "the associator differs";
  EXPECT_NE(one[3], two[3]) << "and so does what reads it";
  EXPECT_NE(prepared.jobs[0].key, prepared.jobs[1].key);
  EXPECT_NE(prepared.jobs[0].id, prepared.jobs[1].id);
  EXPECT_NE(
      prepare(R"("frames": "0:5", "axes": [ { "set": "/nodes/tracks/delay", "values": [1] } ])")
          .jobs[0]
          .node_keys[1],
      one[1]);
}

TEST_F(ExpandTest, FaultsOfAllVariantsAreReportedOnceWithTheirPlaceInTheStudy) {
  const std::string text = faults(R"("axes": [
    { "set": "/nodes/tracks/delay", "values": [1, -1, "x"] },
    { "set": "/nodes/cameras/frames", "values": [10, 20] },
    { "name": "typo", "set": "/nodes/trcks/delay", "values": [1] } ])");
  const std::string file = (folder_ / "study.json").string();
  EXPECT_THAT(text, AllOf(HasSubstr(file + ":2:51: /axes/0/values/1: "),
                          HasSubstr("(in delay=-1, frames=10, typo=1 and 1 more)"),
                          HasSubstr(file + ":2:55: /axes/0/values/2: "),
                          HasSubstr("there is no node \"trcks\"; did you mean \"tracks\"?")));
  EXPECT_EQ(text.find("trcks\"; did"), text.rfind("trcks\"; did")) << "once, not once per variant";
}

TEST_F(ExpandTest, WhatComponentsFindIsFoundBeforeAnythingRuns) {
  EXPECT_THAT(faults(R"("axes": [ { "name": "fails", "set": "/nodes/cameras/fail_in",
                                    "values": ["", "check"], "labels": ["no", "yes"] } ])"),
              HasSubstr("(in fails=yes)"));
}

TEST_F(ExpandTest, MetricsThatNobodyGivesAreFaults) {
  EXPECT_THAT(faults(R"("metrics": ["tracking.ponts"])"),
              HasSubstr("no evaluator of this study gives \"tracking.ponts\"; did you mean "
                        "\"tracking.points\"?"));
  EXPECT_EQ(faults(R"("metrics": ["tracking", "truth"])"), "none");
}

}  // namespace
}  // namespace plaza
