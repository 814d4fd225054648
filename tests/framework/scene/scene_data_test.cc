// The scenes that Plaza ships, with the real calibration files.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <vector>

#include "framework/config/pipeline.h"
#include "framework/scene/scene_file.h"

namespace plaza {
namespace {

std::filesystem::path data_folder() {
  const char* data = std::getenv("PLAZA_DATA");
  return data != nullptr ? data : PLAZA_SOURCE_DIR "/../shared/data";
}

class SceneDataTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::is_directory(data_folder())) GTEST_SKIP() << "no data; set PLAZA_DATA";
    setenv("PLAZA_DATA", data_folder().c_str(), 1);
  }
  static std::shared_ptr<const Scene> read(const std::string& name) {
    return read_scene(std::filesystem::path(PLAZA_SOURCE_DIR "/pipelines/scenes") / name);
  }
};

TEST_F(SceneDataTest, EveryShippedSceneIsAccepted) {
  int scenes = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(PLAZA_SOURCE_DIR "/pipelines/scenes")) {
    const std::string name = entry.path().filename().string();
    if (!name.ends_with(".json") || name.ends_with(".schema.json")) continue;
    EXPECT_NO_THROW(read(name)) << name;
    ++scenes;
  }
  EXPECT_GE(scenes, 4);
}

TEST(Scenes, TheDemoNeedsNoDataFolder) {
  // nothing of the scene may be read from there; the test below needs it for comparison
  const auto before = std::getenv("PLAZA_DATA");
  const std::string saved = before != nullptr ? before : "";
  setenv("PLAZA_DATA", "/nonexistent", 1);
  EXPECT_NO_THROW(read_scene(PLAZA_SOURCE_DIR "/pipelines/scenes/pets-view1.json"));
  before != nullptr ? setenv("PLAZA_DATA", saved.c_str(), 1) : unsetenv("PLAZA_DATA");
}

TEST_F(SceneDataTest, TheInlineNumbersOfViewOneAreTheOfficialOnes) {
  const auto own = read("pets-view1.json");
  const auto official = read("pets-seven-views.json");
  for (const Eigen::Vector3d& point :
       {Eigen::Vector3d(-14, -14, 0), Eigen::Vector3d(5, 1.7, 0), Eigen::Vector3d(-4, -7, 1.75)}) {
    const auto a = own->cameras[0].project(point);
    const auto b = official->cameras[0].project(point);
    ASSERT_TRUE(a && b);
    EXPECT_LT((*a - *b).norm(), 1e-6);
  }
}

TEST_F(SceneDataTest, PetsHasSevenViewsOfTheSamePlace) {
  const auto scene = read("pets-seven-views.json");
  ASSERT_EQ(scene->cameras.size(), 7u);
  EXPECT_EQ(scene->frame_rate_hz, 7);
  EXPECT_EQ(scene->cameras[0].width(), 768);
  EXPECT_EQ(scene->cameras[6].width(), 720);
  // the annotation's first person, at her feet in View 001 (gt-full.txt, frame 1, id 9)
  const auto feet = scene->cameras[0].project({-4.1554, -7.3591, 0});
  ASSERT_TRUE(feet);
  EXPECT_LT((*feet - Eigen::Vector2d(499 + 31.03 / 2, 158 + 75.17)).norm(), 2.83);
  for (const Camera& camera : scene->cameras) {
    EXPECT_GT(camera.centre().z(), 1) << camera.name();
    EXPECT_LT(camera.centre().z(), 15) << camera.name();
  }
}

TEST_F(SceneDataTest, TerraceBoxesStandOnTheTrueGroundPositions) {
  const auto scene = read("epfl-terrace.json");
  // ground.csv against the boxes of camera 0, whose bottoms are about 5 px low
  std::map<std::pair<int, int>, Eigen::Vector2d> truth;
  std::ifstream ground(data_folder() / "epfl/terrace/ground.csv");
  std::string line;
  std::getline(ground, line);
  int frame = 0, id = 0;
  double x = 0, y = 0, w = 0, h = 0;
  while (std::getline(ground, line)) {
    if (std::sscanf(line.c_str(), "%d,%d,%lf,%lf", &frame, &id, &x, &y) == 4)
      truth[{frame, id}] = {x, y};
  }
  for (std::size_t view = 0; view < 4; ++view) {
    std::vector<double> errors;
    std::ifstream boxes(data_folder() / ("epfl/terrace/boxes-c" + std::to_string(view) + ".txt"));
    while (std::getline(boxes, line)) {
      if (std::sscanf(line.c_str(), "%d,%d,%lf,%lf,%lf,%lf", &frame, &id, &x, &y, &w, &h) != 6)
        continue;
      const auto found = truth.find({frame, id});
      if (found == truth.end() || y + h > 280) continue;
      const auto there = scene->cameras[view].to_plane({x + w / 2, y + h - 5});
      if (there) errors.push_back((*there - found->second).norm());
    }
    ASSERT_GT(errors.size(), 1000u);
    std::nth_element(errors.begin(), errors.begin() + static_cast<long>(errors.size() / 2),
                     errors.end());
    EXPECT_LT(errors[errors.size() / 2], 0.3) << "median, metres, camera " << view;
  }
}

TEST_F(SceneDataTest, CampusCamerasStandAtEyeHeight) {
  const auto scene = read("epfl-campus.json");
  ASSERT_EQ(scene->cameras.size(), 3u);
  for (const Camera& camera : scene->cameras) {
    EXPECT_NEAR(camera.centre().z(), 1.95, 0.1) << camera.name();
  }
  EXPECT_NEAR(scene->cameras[0].centre().x(), 1.7749, 1e-4);
}

}  // namespace
}  // namespace plaza
