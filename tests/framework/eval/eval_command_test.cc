#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/program_in_process.h"

namespace plaza {
namespace {

using nlohmann::json;
using test::Outcome;
using test::run_in_process;
using testing::AllOf;
using testing::HasSubstr;

class EvalCommand : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ =
        std::filesystem::path(testing::TempDir()) / (std::string("plaza_eval_") + test->name());
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  void write(const std::string& gt, const std::string& result) const {
    std::ofstream(folder_ / "gt.txt", std::ios::binary) << gt;
    std::ofstream(folder_ / "result.txt", std::ios::binary) << result;
  }
  Outcome eval(std::vector<std::string> more) const {
    std::vector<std::string> arguments{"eval", "--gt", (folder_ / "gt.txt").string(), "--result",
                                       (folder_ / "result.txt").string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_in_process(arguments);
  }
  json evaluation(std::vector<std::string> more) const {
    more.push_back("--json");
    const Outcome o = eval(std::move(more));
    EXPECT_EQ(o.status, 0) << o.errors;
    return json::parse(o.out)["evaluation"];
  }

  std::filesystem::path folder_;
};

constexpr const char* kTwoFrames = "1,1,0,0,10,10,1\n2,1,0,0,10,10,1\n";

TEST_F(EvalCommand, JsonHasTheKeysOfTheSummary) {
  write(kTwoFrames, "1,7,0,0,10,10,1\n2,8,0,0,10,10,1\n");
  const Outcome o = eval({"--json"});
  ASSERT_EQ(o.status, 0) << o.errors;
  const json report = json::parse(o.out);
  EXPECT_EQ(report["plaza"], 1);
  EXPECT_EQ(report["rules"], "MOT15");
  EXPECT_EQ(report["gt"], (folder_ / "gt.txt").string());
  EXPECT_EQ(report["counts"]["frames"], 2);
  EXPECT_EQ(report["counts"]["tracker_ids"], 2);
  const json& tracking = report["evaluation"]["tracking"];
  EXPECT_EQ(tracking["space"], "image");
  EXPECT_EQ(tracking["overlap"], 0.5);
  EXPECT_EQ(tracking["MOTA"], 0.5);
  EXPECT_EQ(tracking["IDS"], 1);
  EXPECT_EQ(tracking["GT"], 1);
  EXPECT_EQ(tracking["IDF1"], 0.5);
  for (const char* key : {"MOTP", "FN", "FP", "MT", "PT", "ML", "FM", "HOTA"}) {
    EXPECT_TRUE(tracking.contains(key)) << key;
  }
  EXPECT_EQ(report["evaluation"]["detection"]["MODA"], 1.0);
  EXPECT_EQ(report["evaluation"]["thesis"]["overlap"], 0.3);
  EXPECT_FALSE(report["evaluation"].contains("ground"));
}

TEST_F(EvalCommand, ThresholdsCanBeGiven) {
  write(kTwoFrames, "1,7,0,0,10,4,1\n2,7,0,0,10,4,1\n");
  EXPECT_EQ(evaluation({})["tracking"]["TP"], 0);
  EXPECT_EQ(evaluation({})["thesis"]["MODA"], 1.0);
  const json at_04 = evaluation({"--iou", "0.4"});
  EXPECT_EQ(at_04["tracking"]["TP"], 2);
  EXPECT_EQ(at_04["detection"]["overlap"], 0.4);
  EXPECT_EQ(at_04["thesis"]["overlap"], 0.4);
}

TEST_F(EvalCommand, WithoutIdentitiesThereIsNoTracking) {
  write(kTwoFrames, "1,-1,0,0,10,10,1\n1,-1,50,0,10,10,1\n2,-1,0,0,10,10,1\n");
  const json e = evaluation({});
  EXPECT_EQ(e["detection"]["TP"], 2);
  EXPECT_EQ(e["detection"]["FP"], 1);
  EXPECT_FALSE(e.contains("tracking"));
  EXPECT_FALSE(e["thesis"].contains("MOTA"));
  EXPECT_TRUE(e["thesis"].contains("MODA"));
}

TEST_F(EvalCommand, GroundHasTheFieldsDistances) {
  write("1,1,0,0\n2,1,0,0\n", "1,5,0.75,0\n2,5,0.25,0\n9,5,0,0\n");
  const json e = evaluation({"--rules", "ground"});
  EXPECT_EQ(e["ground"]["distance_m"], 1.0);
  EXPECT_EQ(e["ground"]["MOTA"], 1.0);
  EXPECT_EQ(e["ground"]["mean_error_m"], 0.5);
  EXPECT_EQ(e["detection"]["space"], "ground");
  EXPECT_EQ(e["detection"]["distance_m"], 0.5);
  EXPECT_EQ(e["detection"]["MODP"], 0.5);
  EXPECT_EQ(e["detection"]["FN"], 1);
  const json narrow = evaluation({"--rules", "ground", "--distance-m", "0.3"});
  EXPECT_EQ(narrow["ground"]["TP"], 1);
  EXPECT_EQ(narrow["detection"]["distance_m"], 0.3);
}

TEST_F(EvalCommand, GridCellsLieExactlyAtThresholds) {
  // 20 cells of 2.5 cm are not nearer than 0.5 m, and 40 are within 1 m.
  write("0,1,346,951\n5,1,100,100\n", "0,1,366,951\n5,1,140,100\n");
  const json e = evaluation({"--rules", "ground", "--unit-m", "0.025"});
  EXPECT_EQ(e["detection"]["TP"], 0);
  EXPECT_EQ(e["detection"]["distance_m"], 0.5);
  EXPECT_EQ(e["ground"]["TP"], 2);
  EXPECT_NEAR(e["ground"]["mean_error_m"].get<double>(), 0.75, 1e-12);
}

TEST_F(EvalCommand, MetresAndCellsCanMeet) {
  write("1 40 80\n", "frame,id,x_m,y_m,heading_deg,score\n1,3,1.1,2.0,,1\n");
  const json e = evaluation({"--rules", "ground", "--unit-m", "0.025"});
  EXPECT_NEAR(e["detection"]["MODP"].get<double>(), 0.8, 1e-9);
}

TEST_F(EvalCommand, MissingFramesAreToldApart) {
  write("1 0 0\n2 0 0\n", "1 0 0\n");
  const json detection = evaluation({"--rules", "ground"})["detection"];
  EXPECT_EQ(detection["MODA"], 0.5);
  EXPECT_EQ(detection["frames_with_results"]["MODA"], 1.0);
  EXPECT_EQ(detection["frames_with_results"]["frames"], 1);
  EXPECT_THAT(eval({"--rules", "ground"}).out, HasSubstr("Only 1 of these frames have results"));
}

TEST_F(EvalCommand, TableSaysHowItCounts) {
  write(kTwoFrames, kTwoFrames);
  const Outcome o = eval({"--rules", "MOT15"});
  EXPECT_EQ(o.status, 0);
  EXPECT_THAT(o.out, AllOf(HasSubstr("by MOT15: 2 frames, 2 true people, 2 in the result"),
                           HasSubstr("tracking: overlap >= 0.5; CLEAR MOT"), HasSubstr("MOTA"),
                           HasSubstr("thesis: overlap >= 0.3; equations (3.1)-(3.7)")));
  write("1,1,0,0\n", "1,1,0,0\n2,1,0,0\n");
  EXPECT_THAT(eval({"--rules", "ground"}).out,
              AllOf(HasSubstr("ground: distance <= 1 m"), HasSubstr("detection: distance < 0.5 m"),
                    HasSubstr("1 result rows are in frames without ground truth")));
}

TEST_F(EvalCommand, FaultsOfAFileAreShownWithTheirPlaces) {
  write(kTwoFrames, "1,1,0,0,10,10,1\n1,1,0,0,10,10,1\n9,2,0,x,10,10,1\n");
  const Outcome o = eval({"--last-frame", "2"});
  EXPECT_EQ(o.status, 2);
  const std::string file = (folder_ / "result.txt").string();
  EXPECT_THAT(o.errors,
              AllOf(HasSubstr(file + ":3:7: top 'x' is not a decimal number"),
                    HasSubstr(file + ":3:1: frame 9 comes after the last frame, 2"),
                    HasSubstr(file + ":2:1: id 1 a second time in frame 1 (first in line 1)")));
  EXPECT_EQ(o.out, "");
}

TEST_F(EvalCommand, EmptyAndMissingFilesAreErrors) {
  write(kTwoFrames, "");
  EXPECT_EQ(eval({}).status, 2);
  EXPECT_THAT(eval({}).errors, HasSubstr("result.txt:1: the file has no rows"));
  std::filesystem::remove(folder_ / "result.txt");
  EXPECT_THAT(eval({}).errors, HasSubstr("result.txt: no such file"));
  EXPECT_EQ(eval({}).status, 2);
}

TEST_F(EvalCommand, OptionsMustFitTheRules) {
  write(kTwoFrames, kTwoFrames);
  EXPECT_THAT(eval({"--rules", "ground", "--iou", "0.5"}).errors, HasSubstr("--iou is for boxes"));
  EXPECT_THAT(eval({"--distance-m", "1"}).errors, HasSubstr("--distance-m is for --rules ground"));
  EXPECT_THAT(eval({"--unit-m", "2"}).errors, HasSubstr("--unit-m is for --rules ground"));
  for (const char* iou : {"0", "1.5", "-1", "nan"})
    EXPECT_EQ(eval({"--iou", iou}).status, 2) << iou;
  EXPECT_EQ(eval({"--rules", "ground", "--distance-m", "0"}).status, 2);
  EXPECT_EQ(eval({"--rules", "ground", "--unit-m", "-1"}).status, 2);
  EXPECT_EQ(eval({"--rules", "MOT14"}).status, 2);
  EXPECT_EQ(eval({"--last-frame", "0"}).status, 2);
  EXPECT_EQ(run_in_process({"eval"}).status, 2);
}

}  // namespace
}  // namespace plaza
