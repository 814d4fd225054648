// The learning phase: one shared pass, and a cache that is used exactly when it may be.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "framework/cache/component_key.h"
#include "framework/execution/learning_key.h"
#include "tests/support/execution_fixture.h"

namespace plaza {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::counters;
using test::RunFixture;
using ::testing::HasSubstr;

class LearningTest : public RunFixture {
 protected:
  LearningTest() { reset(); }

  static void reset() {
    counters().reads = 0;
    counters().learned_frames = 0;
    counters().learned_models = 0;
    counters().loaded_models = 0;
  }

  static json nodes(const json& learner = json::object(), const json& source = json::object()) {
    json cameras = {{"use", "test-source"}, {"name", "cameras"}};
    json background = {{"use", "test-learner"}, {"name", "background"}};
    cameras.update(source);
    background.update(learner);
    return {cameras, background};
  }

  /// The learned sum of frame numbers and their count, as the first observation tells them.
  std::string learned(const std::string& out = "out") {
    return test::lines_of(folder_ / (out + "/observations.ground.csv")).at(1);
  }

  fs::path entry() const {
    for (const auto& file : fs::directory_iterator(folder_ / "cache")) return file.path();
    return {};
  }

  std::int64_t models_learned_by(const json& n) {
    reset();
    run(n);
    return counters().learned_models;
  }
};

TEST_F(LearningTest, SeesAllFramesOfTheSourceWhateverTheRange) {
  options_.first_frame = 3;
  options_.end_frame = 5;
  run(nodes());
  EXPECT_EQ(learned(), "4,780.0000,40.0000,,1.000000");
}

TEST_F(LearningTest, SeesTheFramesItAskedFor) {
  run(nodes({{"first", 10}}), "first");
  EXPECT_EQ(learned("first"), "1,45.0000,10.0000,,1.000000");
  run(nodes({{"every", 15}}), "every");
  EXPECT_EQ(learned("every"), "1,45.0000,3.0000,,1.000000");  // 0, 15, 30
  run(nodes({{"people_free", true}, {"every", 2}}, {{"people_free", 7}}), "free");
  EXPECT_EQ(learned("free"), "1,12.0000,4.0000,,1.000000");  // 0, 2, 4, 6
  run(nodes({{"needs_frames", false}}), "nothing");
  EXPECT_EQ(learned("nothing"), "1,0.0000,0.0000,,1.000000");
}

TEST_F(LearningTest, BackgroundsAreForThoseWhoLearnWithoutPeople) {
  run(nodes({{"people_free", true}}, {{"backgrounds", 5}}), "backgrounds");
  EXPECT_EQ(learned("backgrounds"), "1,10.0000,5.0000,,1.000000");  // 0 to 4
  run(nodes({{"people_free", true}, {"every", 3}}, {{"backgrounds", 5}, {"people_free", 2}}),
      "and");
  EXPECT_EQ(learned("and"), "1,4.0000,3.0000,,1.000000");  // 0 and 3, then 1 of the frames
  run(nodes({{"people_free", true}, {"first", 1}}, {{"backgrounds", 4}}), "first");
  EXPECT_EQ(learned("first"), "1,6.0000,4.0000,,1.000000") << "\"first\" counts frames";
  run(nodes({{"first", 10}}, {{"backgrounds", 5}}), "others");
  EXPECT_EQ(learned("others"), "1,45.0000,10.0000,,1.000000") << "not for the others";
  EXPECT_EQ(summary("others")["frames"], 40) << "nor for the run";
}

TEST_F(LearningTest, AFaultInABackgroundNamesTheSource) {
  const auto error = fault_of<UserError>(nodes(
      {{"people_free", true}}, {{"backgrounds", 2}, {"fail_in", "background"}, {"fail_at", 1}}));
  EXPECT_EQ(error.context().component, "cameras");
}

TEST_F(LearningTest, AllLearnersShareOnePass) {
  json three = nodes({{"first", 10}});
  three.push_back({{"use", "test-learner"}, {"name", "second"}, {"first", 20}});
  three.push_back({{"use", "test-learner"}, {"name", "third"}, {"first", 15}, {"every", 5}});
  for (const int threads : {1, 4}) {
    reset();
    options_.threads = threads;
    options_.cache_folder = folder_ / ("cache" + std::to_string(threads));
    run(three);
    EXPECT_EQ(counters().reads, 20 + 40) << "one pass to learn, one to run";
    EXPECT_EQ(counters().learned_frames, 10 + 20 + 3);
  }
}

TEST_F(LearningTest, FramesThatNobodyWantsAreNotRead) {
  run(nodes({{"every", 20}}));
  EXPECT_EQ(counters().learned_frames, 2);
  EXPECT_LE(counters().reads, 2 + 1 + 40) << "the last one tells whether more than 40 follow";
}

TEST_F(LearningTest, NothingIsSoughtBeyondTheEnd) {
  for (const int every : {8, 13, 39, 40, 41}) {  // 40 frames: some ask for the first one behind
    reset();
    options_.cache_folder = folder_ / ("cache" + std::to_string(every));
    run(nodes({{"every", every}}));
    EXPECT_EQ(counters().learned_frames, (39 + every) / every) << every;
  }
}

TEST_F(LearningTest, TooFewFramesIsTheUsersError) {
  const auto error = fault_of<UserError>(nodes({{"people_free", true}, {"at_least", 3}}));
  EXPECT_EQ(error.context().component, "background");
  EXPECT_THAT(error.what(), HasSubstr("needs 3 frames to learn from, got 0"));
  EXPECT_EQ(summary()["complete"], false);
}

TEST_F(LearningTest, TheSecondRunLearnsNothing) {
  run(nodes(), "a");
  EXPECT_EQ(counters().learned_models, 1);
  reset();
  run(nodes(), "b");
  EXPECT_EQ(counters().learned_models, 0);
  EXPECT_EQ(counters().learned_frames, 0);
  EXPECT_EQ(counters().loaded_models, 1);
  EXPECT_EQ(counters().reads, 40);
  EXPECT_EQ(comparable("a"), comparable("b"));
}

TEST_F(LearningTest, EverythingItDependsOnIsInTheKey) {
  EXPECT_EQ(models_learned_by(nodes()), 1);
  EXPECT_EQ(models_learned_by(nodes()), 0);
  EXPECT_EQ(models_learned_by(nodes({{"every", 2}})), 1) << "its own parameters";
  EXPECT_EQ(models_learned_by(nodes({{"extra", "x"}})), 1) << "its extra key";
  EXPECT_EQ(models_learned_by(nodes(json::object(), {{"frames", 30}})), 1)
      << "the source's parameters";
  EXPECT_EQ(models_learned_by(nodes(json::object(), {{"content", "another file"}})), 1)
      << "the source's files";
  EXPECT_EQ(models_learned_by(nodes({{"name", "other"}})), 1) << "its name, which seeds it";
  json below = nodes();
  below.push_back({{"use", "test-associator"}, {"name", "tracks"}});
  EXPECT_EQ(models_learned_by(below), 0) << "not what stands below it";
}

TEST_F(LearningTest, TheSceneIsInTheKey) {
  auto scene = *test::double_scene();
  const std::string before = scene_fingerprint(scene);
  EXPECT_EQ(before, scene_fingerprint(*test::double_scene()));
  scene.area.max_m.x() += 0.5;
  EXPECT_NE(before, scene_fingerprint(scene));
  scene = *test::double_scene();
  scene.cameras[1] = scene.cameras[1].scaled({128, 96});
  EXPECT_NE(before, scene_fingerprint(scene));
  scene = *test::double_scene();
  scene.occluders.push_back(
      {.camera = "left", .name = "sign", .polygon_px = {{1, 2}, {3, 4}, {5, 1}}});
  EXPECT_NE(before, scene_fingerprint(scene));
}

TEST_F(LearningTest, ADamagedEntryIsLearnedAgain) {
  run(nodes(), "a");
  for (const std::size_t keep : {std::size_t{0}, std::size_t{5}, std::size_t{200}}) {
    test::write_text(entry(), test::read_text(entry()).substr(0, keep));
    EXPECT_EQ(models_learned_by(nodes()), 1) << keep << " bytes left";
    EXPECT_EQ(models_learned_by(nodes()), 0) << "and stored again";
  }
  std::string flipped = test::read_text(entry());
  flipped[flipped.size() - 12] ^= 1;
  test::write_text(entry(), flipped);
  EXPECT_EQ(models_learned_by(nodes()), 1);
}

TEST_F(LearningTest, AnEntryThatThePluginRefusesIsLearnedByAFreshObject) {
  run(nodes({{"fail_in", "load"}}), "a");
  reset();
  run(nodes({{"fail_in", "load"}}), "b");
  EXPECT_EQ(counters().learned_models, 1);
  EXPECT_EQ(comparable("a"), comparable("b")) << "nothing of the refused one is left";
}

TEST_F(LearningTest, ACacheThatCantBeWrittenIsANote) {
  test::write_text(folder_ / "cache", "a file, no folder");
  const RunReport report = run(nodes());
  EXPECT_TRUE(report.complete);
  EXPECT_THAT(
      report.notes,
      ::testing::Contains(HasSubstr("what 'background' learned is not kept for the next run")));
}

TEST_F(LearningTest, AFaultWhileLearningNamesNodeAndFrame) {
  for (const int threads : {1, 4}) {
    options_.threads = threads;
    const auto error = fault_of<UserError>(nodes({{"fail_in", "learn"}, {"fail_at", 7}}));
    EXPECT_EQ(error.context().component, "background");
    EXPECT_EQ(error.context().frame, 7);
    EXPECT_EQ(summary()["complete"], false);
    EXPECT_EQ(summary()["frames"], 0);
  }
}

TEST(FileIdentityTest, ChangesWithContentAndTime) {
  test::TemporaryFolder folder;
  const fs::path file = folder / "a";
  EXPECT_EQ(file_identity(file), "absent");
  test::write_text(file, "content");
  const std::string before = file_identity(file);
  EXPECT_EQ(before, file_identity(file));
  const auto time = fs::last_write_time(file);
  test::write_text(file, "Content");
  fs::last_write_time(file, time);
  EXPECT_NE(before, file_identity(file)) << "same size, same time, other bytes";
  fs::last_write_time(file, time + std::chrono::seconds(1));
  test::write_text(file, std::string(200000, 'x'));
  const std::string large = file_identity(file);
  EXPECT_NE(before, large);
  const std::string listing = file_identity(folder.path());
  test::write_text(folder / "b", "");
  EXPECT_NE(listing, file_identity(folder.path()));
}

}  // namespace
}  // namespace plaza
