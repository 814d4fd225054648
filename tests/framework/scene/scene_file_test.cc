#include "framework/scene/scene_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "plaza/core/error.h"
#include "tests/sdk/geometry/same_camera.h"
#include "tests/sdk/geometry/test_cameras.h"

namespace plaza {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr const char* kPinhole =
    R"({"format": "pinhole", "fx_px": 600, "fy_px": 600, "cx_px": 320, "cy_px": 240,
        "centre_m": [-8, 0, 3], "look_at_m": [0, 0, 1]})";

std::string scene_text(const std::string& calibration, const std::string& size = "[640, 480]",
                       const std::string& more = "") {
  return R"({"plaza_scene": 1, "name": "Yard", "frame_rate_hz": 12.5,
  "area": {"x_m": [-3, 3], "y_m": [-2, 2]},
  "cameras": [{"name": "left", "image_size": )" +
         size + R"(, "calibration": )" + calibration + "}]" + more + "}";
}

std::shared_ptr<const Scene> parse(const std::string& text) {
  return parse_scene(parse_json(text, "scene.json"));
}

std::string scene_fault(const std::string& text) {
  try {
    parse(text);
  } catch (const UserError& error) {
    return error.what();
  }
  return "no fault";
}

TEST(SceneFileTest, ReadsEverything) {
  const auto scene = parse(scene_text(kPinhole, "[640, 480]", R"(,
    "body": {"height_m": 1.8},
    "occluders": [{"camera": "left", "name": "pillar", "polygon_px": [[1, 2], [30, 2], [30, 40]]}])"));
  EXPECT_EQ(scene->name, "Yard");
  EXPECT_EQ(scene->frame_rate_hz, 12.5);
  EXPECT_EQ(scene->area.min_m, Eigen::Vector2d(-3, -2));
  EXPECT_EQ(scene->area.max_m, Eigen::Vector2d(3, 2));
  EXPECT_EQ(scene->body.height_m, 1.8);
  EXPECT_EQ(scene->body.radius_m, 0.30);
  ASSERT_EQ(scene->cameras.size(), 1u);
  EXPECT_EQ(scene->cameras[0].name(), "left");
  EXPECT_TRUE(scene->cameras[0].centre().isApprox(Eigen::Vector3d(-8, 0, 3)));
  ASSERT_EQ(scene->occluders.size(), 1u);
  EXPECT_EQ(scene->occluders[0].polygon_px[2], Eigen::Vector2d(30, 40));
}

TEST(SceneFileTest, LookingAtAPointPutsItAtThePrincipalPoint) {
  const auto scene = parse(scene_text(kPinhole));
  const auto pixel = scene->cameras[0].project({0, 0, 1});
  ASSERT_TRUE(pixel);
  EXPECT_LT((*pixel - Eigen::Vector2d(320, 240)).norm(), 1e-9);
  EXPECT_LT(scene->cameras[0].project({0, 0, 2})->y(), 240) << "up is up";
  EXPECT_LT(scene->cameras[0].project({0, 1, 1})->x(), 320) << "+y is left of +x";
}

TEST(SceneFileTest, RotationAndTranslationAreThePose) {
  const auto scene = parse(scene_text(
      R"({"format": "pinhole", "fx_px": 600, "fy_px": 600, "cx_px": 320, "cy_px": 240,
          "rotation": [0, -1, 0, 0, 0, -1, 1, 0, 0], "translation_m": [0, 2, 8]})"));
  EXPECT_TRUE(scene->cameras[0].centre().isApprox(Eigen::Vector3d(-8, 0, 2)));
}

TEST(SceneFileTest, ImagesSmallerThanTheCalibrationsAreScaled) {
  std::string calibration = kPinhole;
  calibration.insert(calibration.size() - 1, R"(, "calibrated_size": [640, 480])");
  const auto scene = parse(scene_text(calibration, "[320, 240]"));
  const auto pixel = scene->cameras[0].project({0, 0, 1});
  EXPECT_LT((*pixel - Eigen::Vector2d(159.75, 119.75)).norm(), 1e-9);
}

constexpr const char* kTsai =
    R"({"format": "tsai", "focal_mm": 20.161, "kappa1_per_mm2": 0.00148, "dpx_mm": 0.023,
        "dpy_mm": 0.0229, "sx": 1.02, "cx_px": 366.5, "cy_px": 305.8, "calibrated_size": [720, 576],
        "rotation": [0, -1, 0, 0, 0, -1, 1, 0, 0], "translation_m": [0.2, 2, 8]})";

TEST(SceneFileTest, TsaisNumbersMayStandInTheScene) {
  CameraFromWorld pose;
  pose.rotation << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  pose.translation << 0.2, 2, 8;
  TsaiIntrinsics in{20.161, 0.00148, 0.023, 0.0229, 1.02, 366.5, 305.8};
  const Camera full = Camera::tsai("left", {720, 576}, in, pose);
  test::expect_same_camera(parse(scene_text(kTsai, "[720, 576]"))->cameras[0], full);
  test::expect_same_camera(parse(scene_text(kTsai, "[360, 288]"))->cameras[0],
                           full.scaled({360, 288}));
  std::string without_sx = kTsai;
  without_sx.erase(without_sx.find(R"("sx": 1.02, )"), 12);
  in.sx = 1;
  test::expect_same_camera(parse(scene_text(without_sx, "[720, 576]"))->cameras[0],
                           Camera::tsai("left", {720, 576}, in, pose));
}

TEST(SceneFileTest, TsaisNumbersAreAllNeeded) {
  for (const char* key : {"focal_mm", "kappa1_per_mm2", "dpx_mm", "dpy_mm", "cx_px", "cy_px",
                          "rotation", "translation_m"}) {
    auto calibration = nlohmann::json::parse(kTsai);
    calibration.erase(key);
    EXPECT_THAT(scene_fault(scene_text(calibration.dump(), "[720, 576]")),
                HasSubstr("/cameras/0/calibration: \"" + std::string(key) + "\" is missing"));
  }
}

TEST(SceneFileTest, PixelsMayBeSkewed) {
  std::string calibration = kPinhole;
  calibration.insert(calibration.size() - 1, R"(, "skew_px": 30)");
  const Camera skewed = parse(scene_text(calibration))->cameras[0];
  const Camera straight = parse(scene_text(kPinhole))->cameras[0];
  const Eigen::Vector3d x(1, 0.5, 0.2);
  const Eigen::Vector2d a = *straight.project(x), b = *skewed.project(x);
  EXPECT_NEAR(b.x() - a.x(), 30 * (a.y() - 240) / 600, 1e-9);
  EXPECT_NEAR(b.y(), a.y(), 1e-9);
}

TEST(SceneFileTest, HomographiesInUnitsOfATopViewGiveTheSameCamera) {
  const Camera camera = parse(scene_text(kPinhole))->cameras[0];
  // top view: 10 units per metre, y downwards, origin at (-5, 4) m
  Eigen::Matrix3d metres_from_units;
  metres_from_units << 0.1, 0, -5, 0, -0.1, 4, 0, 0, 1;
  const auto homography = [&](double z) {
    Eigen::Matrix3d m;
    m << camera.pose().rotation.leftCols<2>(),
        camera.pose().rotation.col(2) * z + camera.pose().translation;
    Eigen::Matrix3d k;
    k << 600, 0, 320, 0, 600, 240, 0, 0, 1;
    return Eigen::Matrix3d(k * m * metres_from_units);
  };
  const auto text = [](const Eigen::Matrix3d& m) {
    std::string out = "[";
    for (int i = 0; i < 9; ++i) {
      char number[40];
      std::snprintf(number, sizeof number, "%s%.17g", i == 0 ? "" : ", ", m(i / 3, i % 3));
      out += number;
    }
    return out + "]";
  };
  const std::string common =
      R"(, "head_z_m": 1.75, "metres_per_unit": [0.1, -0.1], "origin_m": [-5, 4]})";
  const auto forward =
      parse(scene_text(R"({"format": "homographies", "ground": )" + text(homography(0)) +
                       R"(, "head": )" + text(homography(1.75)) + common));
  const auto backward = parse(scene_text(
      R"({"format": "homographies", "maps": "image-to-ground", "ground": )" +
      text(homography(0).inverse()) + R"(, "head": )" + text(homography(1.75).inverse()) + common));
  for (const auto& scene : {forward, backward}) {
    EXPECT_LT((scene->cameras[0].centre() - camera.centre()).norm(), 1e-6);
    EXPECT_LT((*scene->cameras[0].project({1, -1, 0.7}) - *camera.project({1, -1, 0.7})).norm(),
              1e-6);
  }
}

TEST(SceneFileTest, MatricesOfHomographiesMayStandInAFile) {
  const auto folder = std::filesystem::path(testing::TempDir()) / "plaza-homographies";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "h.json") << R"({"note": "x", "a": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]})";
  const std::string calibration =
      R"({"format": "homographies", "file": "h.json", "ground": "a", "head": "b", "head_z_m": 2})";
  std::ofstream(folder / "scene.json") << scene_text(calibration);
  try {
    read_scene(folder / "scene.json");
    FAIL() << "no fault";
  } catch (const UserError& error) {
    EXPECT_THAT(error.what(), HasSubstr("has no matrix \"b\""));
    EXPECT_THAT(error.what(), Not(HasSubstr("\"a\"")));
  }
  std::filesystem::remove_all(folder);
}

TEST(SceneFileTest, FaultsOfSeveralCamerasAreReportedTogether) {
  const std::string bad = R"({"format": "pinhole", "fx_px": -1, "fy_px": 600, "cx_px": 320,
      "centre_m": [-8, 0, 3], "look_at_m": [0, 0, 1]})";
  const std::string errors = scene_fault(
      R"({"plaza_scene": 1, "name": "Yard", "frame_rate_hz": 0, "area": {"x_m": [0, 1], "y_m": [0, 1]},
      "cameras": [{"name": "a", "image_size": [640, 480], "calibration": )" +
      bad + R"(}, {"name": "b", "image_size": [0, 480], "calibration": )" + bad + "}]}");
  EXPECT_THAT(errors, HasSubstr("/frame_rate_hz: must be greater than 0, not 0"));
  EXPECT_THAT(errors, HasSubstr("/cameras/0/calibration/fx_px: must be greater than 0"));
  EXPECT_THAT(errors, HasSubstr("/cameras/0/calibration: \"cy_px\" is missing"));
  EXPECT_THAT(errors, HasSubstr("/cameras/1/image_size: must be [width, height]"));
  EXPECT_THAT(errors, HasSubstr("/cameras/1/calibration/fx_px"));
}

TEST(SceneFileTest, RootMustBeAnObject) {
  EXPECT_EQ(scene_fault("[1]"), "scene.json:1:1: must be an object, { ... }");
  EXPECT_THAT(scene_fault("{}"), HasSubstr("\"plaza_scene\" is missing"));
}

TEST(SceneFileTest, SchemaAcceptsTheShippedScenesAndRefusesBrokenOnes) {
  if (std::system("python3 -c 'import jsonschema' > /dev/null 2>&1") != 0) {
    GTEST_SKIP() << "python3-jsonschema is not installed";
  }
  const auto script = std::filesystem::path(testing::TempDir()) / "plaza-scene-schema.py";
  std::ofstream(script) << R"(
import glob, json, sys, jsonschema
root = sys.argv[1]
schema = json.load(open(root + '/pipelines/scenes/scene.schema.json'))
validator = jsonschema.Draft202012Validator(schema)
validator.check_schema(schema)
shipped = [f for f in glob.glob(root + '/pipelines/scenes/*.json') if not f.endswith('.schema.json')]
assert len(shipped) >= 4
for f in shipped:
  for e in validator.iter_errors(json.load(open(f))): sys.exit(f + ': ' + e.message)
for name in ['misspelt-keys', 'wrong-types', 'no-cameras', 'wrong-version', 'name-with-slash',
             'unknown-format', 'unknown-unit', 'tsai-json-without-size', 'tsai-inline-misspelt', 'focal-length-not-positive',
             'everything-at-once']:
  f = root + '/tests/error/scenes/' + name + '.json'
  if validator.is_valid(json.load(open(f))): sys.exit(f + ' should be refused')
)";
  EXPECT_EQ(std::system(("python3 " + script.string() + " " + PLAZA_SOURCE_DIR).c_str()), 0);
  std::filesystem::remove(script);
}

}  // namespace
}  // namespace plaza
