// What the sources make of the published files; skipped where they are absent.
#include <cstdlib>
#include <set>

#include "plugins/sources/detections/detections_source.h"
#include "plugins/sources/detections/ground_truth_source.h"
#include "tests/plugins/sources/source_harness.h"

namespace plaza::sources {
namespace {

std::filesystem::path data_folder() {
  if (const char* set = std::getenv("PLAZA_DATA")) return set;
  return std::filesystem::path(PLAZA_SOURCE_DIR) / "../shared/data";
}

#define SKIP_WITHOUT(path) \
  if (!std::filesystem::exists(path)) GTEST_SKIP() << (path) << " is absent"

struct Counted {
  std::size_t boxes = 0;
  std::set<std::int64_t> identities;
};

Counted count_pets(const std::string& file, bool area_only) {
  auto scene = test_scene({"View_001"}, 7);
  scene->area = {.min_m = {-14.07, -14.27}, .max_m = {4.98, 1.73}};
  GroundTruthSource::Options options;
  options.files["View_001"] = data_folder() / "pets2009-s2l1/gt" / file;
  options.area_only = area_only;
  Driver<GroundTruthSource> source(options, scene);
  EXPECT_THAT(texts(source->check()), ::testing::IsEmpty());
  EXPECT_EQ(source->open().frame_count, 795);
  Counted counted;
  for (std::int64_t frame = 0; frame < 795; ++frame) {
    const auto truth = source.read_as<GroundTruth>(frame);
    EXPECT_TRUE(truth->annotated);
    for (const TruePerson& person : truth->people) {
      EXPECT_TRUE(person.position_m);
      counted.boxes += person.views.size();
      counted.identities.insert(person.id);
    }
  }
  return counted;
}

TEST(GivenData, PetsGroundTruth) {
  SKIP_WITHOUT(data_folder() / "pets2009-s2l1/gt");
  const Counted area = count_pets("gt-area.txt", false);
  EXPECT_EQ(area.boxes, 3955U);
  EXPECT_EQ(area.identities.size(), 23U);
  const Counted full = count_pets("gt-full.txt", false);
  EXPECT_EQ(full.boxes, 4650U - 174U) << "174 rows have confidence 0";
  EXPECT_EQ(full.identities.size(), 19U);
  // gt-area was cut by other positions: 20 of its own lie up to 0.2 m outside
  const Counted cut = count_pets("gt-full.txt", true);
  EXPECT_LE(cut.boxes, area.boxes);
  EXPECT_GE(cut.boxes, area.boxes - 50);
}

TEST(GivenData, PetsDetectionsOfSevenViews) {
  const auto folder = data_folder() / "pets2009-s2l1/detections";
  SKIP_WITHOUT(folder);
  DetectionsSource::Options options;
  for (const std::string view : {"1", "3", "4", "5", "6", "7", "8"}) {
    options.files["View_00" + view] = folder / ("View_00" + view + ".txt");
  }
  options.missing_cameras = {"View_002"};
  std::vector<std::string> cameras;
  for (int view = 1; view <= 8; ++view) cameras.push_back("View_00" + std::to_string(view));
  Driver<DetectionsSource> source(options, test_scene(cameras, 7));
  EXPECT_THAT(texts(source->check()), ::testing::IsEmpty());
  EXPECT_EQ(source->open().frame_count, 795);
  const auto first = source.read_as<Detections>(0, 1);
  EXPECT_TRUE(first->views[1].empty());
  ASSERT_FALSE(first->views[0].empty());
  EXPECT_EQ(first->views[0][0].box,
            (Box{.left = 641.45, .top = 240.54, .width = 43.00, .height = 79.60}));
  EXPECT_EQ(first->views[0][0].score, 0.9999);
}

TEST(GivenData, TerraceBoxesAndPositions) {
  const auto folder = data_folder() / "epfl/terrace";
  SKIP_WITHOUT(folder);
  GroundTruthSource::Options options;
  std::vector<std::string> cameras;
  for (int camera = 0; camera < 4; ++camera) {
    cameras.push_back("c" + std::to_string(camera));
    options.files[cameras.back()] = folder / ("boxes-" + cameras.back() + ".txt");
  }
  options.ground = folder / "ground.csv";
  Driver<GroundTruthSource> source(options, test_scene(cameras, 25));
  EXPECT_THAT(texts(source->check()), ::testing::IsEmpty());
  const std::int64_t frames = source->open().frame_count.value();
  EXPECT_LE(frames, 5010);
  std::set<std::int64_t> identities;
  std::size_t positions = 0;
  for (std::int64_t frame = 0; frame < frames; ++frame) {
    const auto truth = source.read_as<GroundTruth>(frame);
    for (const TruePerson& person : truth->people) {
      identities.insert(person.id);
      positions += person.position_m ? 1 : 0;
    }
  }
  EXPECT_EQ(identities.size(), 9U);
  EXPECT_EQ(positions, 25423U);
}

}  // namespace
}  // namespace plaza::sources
