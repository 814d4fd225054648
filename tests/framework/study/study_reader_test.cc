// The language of studies: what is read, and what is said of what is wrong.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "framework/study/study.h"
#include "plaza/core/error.h"
#include "tests/support/temporary_folder.h"

namespace plaza {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class StudyReaderTest : public ::testing::Test {
 protected:
  Study read(const std::string& text) { return read_study_text(text, folder_ / "study.json"); }
  std::string faults(const std::string& text) {
    try {
      read(text);
    } catch (const UserError& error) {
      return error.what();
    }
    return "none";
  }
  test::TemporaryFolder folder_;
  std::filesystem::path pipeline_ = folder_.write("p.json", "{}");
};

std::vector<std::string> labels(const Axis& axis) {
  std::vector<std::string> out;
  for (const AxisValue& value : axis.values) out.push_back(value.label);
  return out;
}

TEST_F(StudyReaderTest, ReadsEveryFormOfAnAxis) {
  folder_.write("q.json", "{}");
  const Study study = read(R"({ "plaza_study": 1, "name": "All", "frames": "5:20",
    "axes": [
      { "set": "/nodes/tracks/gate_m", "values": [0.5, 1] },
      { "name": "detector", "set": ["/nodes/a", "/nodes/b"], "values": [{ "use": "x" }, { "use": "y" }] },
      { "set": "/nodes/tracks/affinities", "values": [[], [{ "use": "l" }, { "use": "m" }]] },
      { "pipelines": ["p.json", "q.json"] },
      { "scenes": ["p.json"], "labels": ["hall"] },
      { "frames": ["0:400", "400:"] },
      { "name": "how", "choices": [{ "name": "fast", "set": { "/nodes/x/y": 1 } }, { "name": "plain" }] } ],
    "seeds": [3, 7], "seed_parameters": ["/nodes/cameras/seed"],
    "metrics": ["tracking.MOTA"], "baseline": { "gate_m": 0.5, "how": "plain" }, "draw": true })");
  EXPECT_EQ(study.name, "All");
  ASSERT_EQ(study.axes.size(), 7U);
  EXPECT_EQ(study.axes[0].name, "gate_m");
  EXPECT_TRUE(study.axes[0].numeric());
  EXPECT_THAT(labels(study.axes[0]), ElementsAre("0.5", "1"));
  EXPECT_THAT(labels(study.axes[1]), ElementsAre("x", "y"));
  EXPECT_EQ(study.axes[1].values[0].change.settings.size(), 2U);
  EXPECT_FALSE(study.axes[1].numeric());
  EXPECT_THAT(labels(study.axes[2]), ElementsAre("none", "l+m"));
  EXPECT_THAT(labels(study.axes[3]), ElementsAre("p", "q"));
  EXPECT_EQ(study.axes[3].name, "pipeline");
  EXPECT_EQ(study.axes[3].values[1].change.pipeline, folder_ / "q.json");
  EXPECT_THAT(labels(study.axes[4]), ElementsAre("hall"));
  EXPECT_EQ(study.axes[5].values[1].change.frames, (FrameRange{400, std::nullopt}));
  EXPECT_THAT(labels(study.axes[6]), ElementsAre("fast", "plain"));
  EXPECT_THAT(study.seeds, ElementsAre(3U, 7U));
  EXPECT_EQ(study.baseline.values.at("gate_m"), "0.5");
  EXPECT_EQ(study.base.frames, (FrameRange{5, 20}));
  EXPECT_TRUE(study.draw);
}

TEST_F(StudyReaderTest, ReportsAllFaultsAtOnceWithTheirPlaces) {
  const std::string text = faults(R"({
  "plaza_study": 2,
  "piplines": 1,
  "pipeline": "nowhere.json",
  "frames": "7:3",
  "axes": [
    { "set": "nodes/x", "values": [1] },
    { "set": "/nodes/x/y", "values": [1, 1] },
    { "set": "/nodes/x/y", "values": [] },
    { "name": "z", "choices": [{ "nme": "a" }] },
    { "values": [1] }
  ],
  "seeds": [1, 1, -2],
  "metrics": [3],
  "baseline": { "zz": "a" },
  "draw": 1
})");
  const std::string file = (folder_ / "study.json").string();
  for (const char* fault :
       {":2:18: /plaza_study: expected 1, the version of the language of studies",
        ":3:3: /piplines: unknown key of a study; did you mean \"pipeline\"?",
        ":4:15: /pipeline: there is no file ", ":5:13: /frames: expected \"A:B\"",
        ":7:14: /axes/0/set: expected the place of a value",
        ":8:5: /axes/1: two values are called \"1\"; give \"labels\"",
        ":9:38: /axes/2/values: expected a list of values, at least one, got an empty list",
        ":10:34: /axes/3/choices/0/nme: unknown key of a choice; did you mean \"name\"?",
        ":11:5: /axes/4: an axis has exactly one of \"set\", \"pipelines\"",
        ":13:16: /seeds/1: seed 1 is there already", ":13:19: /seeds/2: expected a whole number",
        ":14:15: /metrics/0: expected a metric", ":15:17: /baseline/zz: there is no axis \"zz\"",
        ":16:11: /draw: expected true or false, got 1"}) {
    EXPECT_THAT(text, HasSubstr(file + fault));
  }
}

TEST_F(StudyReaderTest, NeedsAPipelineFromSomewhere) {
  EXPECT_THAT(faults(R"({ "plaza_study": 1 })"), HasSubstr("missing \"pipeline\""));
  EXPECT_EQ(faults(R"({ "plaza_study": 1, "axes": [{ "pipelines": ["p.json"] }] })"), "none");
  EXPECT_THAT(faults(R"({ "plaza_study": 1, "axes": [{ "name": "a", "choices":
              [{ "name": "x", "pipeline": "p.json" }, { "name": "y" }] }] })"),
              HasSubstr("missing \"pipeline\""));
}

TEST_F(StudyReaderTest, RefusesTwinsAndSeedsWithoutPlace) {
  EXPECT_THAT(faults(R"({ "plaza_study": 1, "pipeline": "p.json", "axes": [
              { "set": "/nodes/a/x", "values": [1] }, { "set": "/nodes/b/x", "values": [1] }] })"),
              HasSubstr("there is already an axis \"x\"; give another \"name\""));
  EXPECT_THAT(faults(R"({ "plaza_study": 1, "pipeline": "p.json", "seed_parameters": "/seed" })"),
              HasSubstr("\"seed_parameters\" says where \"seeds\" are set"));
  EXPECT_THAT(faults(R"({ "plaza_study": 1, "pipeline": "p.json", "axes": [
              { "set": "/nodes/a/x", "values": [1, 2] }], "baseline": { "x": 3 } })"),
              HasSubstr("axis \"x\" has no value \"3\"; it has \"1\", \"2\""));
}

TEST_F(StudyReaderTest, LabelsThatAreNumbersMakeAScale) {
  for (const char* scene : {"one.json", "four.json"}) folder_.write(scene, "{}");
  const Study s = read(R"({ "plaza_study": 1, "pipeline": "p.json", "axes": [
    { "name": "cameras", "scenes": ["one.json", "four.json"], "labels": [1, 4] },
    { "name": "words", "scenes": ["one.json", "four.json"], "labels": ["few", 4] } ] })");
  EXPECT_TRUE(s.axes[0].numeric());
  EXPECT_EQ(s.axes[0].values[1].number, 4);
  EXPECT_EQ(s.axes[0].values[1].label, "4");
  EXPECT_FALSE(s.axes[1].numeric());
}

}  // namespace
}  // namespace plaza
