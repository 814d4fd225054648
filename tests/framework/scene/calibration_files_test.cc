#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <opencv2/core.hpp>

#include "framework/scene/calibration.h"
#include "framework/scene/calibration_check.h"
#include "framework/scene/opencv_storage.h"
#include "framework/scene/text_position.h"
#include "plaza/core/error.h"

namespace plaza {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// What the reader says of a broken file.
template <class Parse>
std::string fault(const Parse& parse) {
  try {
    parse();
  } catch (const UserError& error) {
    return error.what();
  }
  return "no fault";
}

TEST(ParseNumberTest, TakesWholeTextsOnly) {
  EXPECT_EQ(parse_number(" 7.95e+02\n"), 795.0);
  EXPECT_EQ(parse_number("+1."), 1.0);
  EXPECT_EQ(parse_number("-.5"), -0.5);
  for (const char* text : {"", "  ", "5,5", "1 2", "0x10", "nan", "inf", "1e999", "--1"}) {
    EXPECT_EQ(parse_number(text), std::nullopt) << text;
  }
}

TEST(TextPositionTest, CountsFromOneAndSurvivesOffsetsBeyondTheEnd) {
  EXPECT_EQ(text_position("ab\ncd", 0, "f"), (FilePosition{"f", 1, 1}));
  EXPECT_EQ(text_position("ab\ncd", 4, "f"), (FilePosition{"f", 2, 2}));
  EXPECT_EQ(text_position("ab\ncd", 99, "f"), (FilePosition{"f", 2, 3}));
}

TEST(TsaiRotationTest, TurnsAboutXThenYThenZ) {
  const double half = std::acos(-1.0) / 2;
  EXPECT_TRUE((tsai_rotation(half, 0, 0) * Eigen::Vector3d::UnitY())
                  .isApprox(Eigen::Vector3d::UnitZ(), 1e-12));
  EXPECT_TRUE((tsai_rotation(half, half, 0) * Eigen::Vector3d::UnitY())
                  .isApprox(Eigen::Vector3d::UnitX(), 1e-12));
  EXPECT_TRUE((tsai_rotation(half, half, half) * Eigen::Vector3d::UnitY())
                  .isApprox(Eigen::Vector3d::UnitY(), 1e-12));
}

TEST(TsaiXmlTest, ReadsEveryNumber) {
  const Calibration c = parse_tsai_xml(
      R"(<?xml version="1.0" encoding="UTF-8"?>
<Camera name="v"><Geometry width="768" height="576" dpx="5e-3" dpy="4e-3"/>
<Intrinsic focal="5.5" kappa1="-0.01" cx="324" cy="282" sx="1.09"/>
<Extrinsic tx="1" ty="2" tz="3" rx="0.1" ry="0.2" rz="0.3"/></Camera>)",
      "v.xml");
  const auto& in = std::get<TsaiIntrinsics>(c.intrinsics);
  EXPECT_EQ(in.focal_mm, 5.5);
  EXPECT_EQ(in.kappa1_per_mm2, -0.01);
  EXPECT_EQ(in.dpx_mm, 5e-3);
  EXPECT_EQ(in.dpy_mm, 4e-3);
  EXPECT_EQ(in.sx, 1.09);
  EXPECT_EQ(in.cx_px, 324);
  EXPECT_EQ(in.cy_px, 282);
  EXPECT_EQ(c.image_size, Eigen::Vector2i(768, 576));
  EXPECT_EQ(c.pose.translation, Eigen::Vector3d(1, 2, 3));
  EXPECT_TRUE(c.pose.rotation.isApprox(tsai_rotation(0.1, 0.2, 0.3)));
  EXPECT_EQ(c.where.line, 2);
}

TEST(TsaiXmlTest, NamesEveryFaultAtItsLine) {
  EXPECT_EQ(fault([] {
              parse_tsai_xml("<Camera>\n <Geometry width='1' height='x'/>\n</Camera>", "v.xml");
            }),
            "v.xml:1:2: <Camera> lacks the element <Intrinsic>\n"
            "v.xml:1:2: <Camera> lacks the element <Extrinsic>\n"
            "v.xml:2:3: <Geometry> height=\"x\" is not a number\n"
            "v.xml:2:3: <Geometry> lacks the attribute \"dpx\"\n"
            "v.xml:2:3: <Geometry> lacks the attribute \"dpy\"");
  EXPECT_THAT(fault([] { parse_tsai_xml("", "v.xml"); }), HasSubstr("v.xml:1:1: "));
  EXPECT_THAT(fault([] { parse_tsai_xml("<Other/>", "v.xml"); }), HasSubstr("no element <Camera>"));
}

TEST(TsaiJsonTest, PicksTheCameraByIndex) {
  const std::string text = R"({"focal":[20,21],"kappa1":[0.1,0.2],"cx":[1,2],"cy":[3,4],
    "rx":[0,0.5],"ry":[0,0],"rz":[0,0],"tx":[5,6],"ty":[7,8],"tz":[9,10],"dx":0.023,"dy":[0.02,0.03]})";
  const Calibration c = parse_tsai_json(text, "t.json", 1);
  const auto& in = std::get<TsaiIntrinsics>(c.intrinsics);
  EXPECT_EQ(in.focal_mm, 21);
  EXPECT_EQ(in.dpx_mm, 0.023);
  EXPECT_EQ(in.dpy_mm, 0.03);
  EXPECT_EQ(in.sx, 1);
  EXPECT_EQ(c.pose.translation, Eigen::Vector3d(6, 8, 10));
  EXPECT_FALSE(c.image_size);
  EXPECT_THAT(fault([&] { parse_tsai_json(text, "t.json", 2); }),
              HasSubstr("t.json:1:10: /focal: has 2 cameras; there is no index 2"));
  EXPECT_THAT(fault([&] { parse_tsai_json("[]", "t.json", 0); }), HasSubstr("must be an object"));
}

TEST(RtkJsonTest, TakesTAsCentreOrAsTranslation) {
  const std::string text = R"({"0":{"R":[[0,-1,0],[0,0,-1],[1,0,0]],"T":[[1],[2],[3]],
    "K":[[600,0,320],[0,610,240],[0,0,1]],"k":[0.1,0.2,0.3],"p":[0.4,0.5]}})";
  const Calibration centre = parse_rtk_json(text, "r.json", "0", TranslationMeaning::kCentre);
  EXPECT_TRUE((-centre.pose.rotation.transpose() * centre.pose.translation)
                  .isApprox(Eigen::Vector3d(1, 2, 3)));
  const Calibration other = parse_rtk_json(text, "r.json", "0", TranslationMeaning::kTranslation);
  EXPECT_EQ(other.pose.translation, Eigen::Vector3d(1, 2, 3));
  const auto& in = std::get<PinholeIntrinsics>(other.intrinsics);
  EXPECT_EQ(in.fy_px, 610);
  EXPECT_EQ(in.distortion.k2, 0.2);
  EXPECT_EQ(in.distortion.k3, 0.3);
  EXPECT_EQ(in.distortion.p1, 0.4);
  EXPECT_EQ(in.distortion.p2, 0.5);
  EXPECT_THAT(fault([&] { parse_rtk_json(text, "r.json", "1", TranslationMeaning::kCentre); }),
              HasSubstr("there is no camera \"1\"; the file holds \"0\""));
}

/// A calibration as cv::FileStorage itself writes it; `name` tells the format.
std::string written_by_opencv(const std::string& name, const cv::Mat& rotation) {
  cv::FileStorage storage(name, cv::FileStorage::WRITE | cv::FileStorage::MEMORY);
  storage << "image_width" << 640 << "image_height" << 480;
  storage << "camera_matrix" << cv::Mat(cv::Matx33d(600, 0, 320.5, 0, 610, 240, 0, 0, 1));
  storage << "distortion_coefficients"
          << cv::Mat((cv::Mat_<double>(1, 5) << -0.1, 0.02, 1e-3, -2e-3, 0));
  storage << "R" << rotation << "T" << cv::Mat(cv::Vec3d(1, 2, 3)) << "note"
          << "a text";
  return storage.releaseAndGetString();
}

TEST(OpenCvTest, ReadsWhatFileStorageWritesInEveryFormat) {
  const cv::Mat rotation(cv::Matx33d(0, -1, 0, 0, 0, -1, 1, 0, 0));
  for (const char* name : {"c.yml", "c.xml", "c.json"}) {
    const TextFile file{written_by_opencv(name, rotation), name};
    const Calibration c = parse_opencv(file, nullptr);
    const auto& in = std::get<PinholeIntrinsics>(c.intrinsics);
    EXPECT_EQ(in.fx_px, 600) << name;
    EXPECT_EQ(in.fy_px, 610) << name;
    EXPECT_EQ(in.cx_px, 320.5) << name;
    EXPECT_EQ(in.cy_px, 240) << name;
    EXPECT_DOUBLE_EQ(in.distortion.k1, -0.1) << name;
    EXPECT_DOUBLE_EQ(in.distortion.p2, -2e-3) << name;
    EXPECT_EQ(c.image_size, Eigen::Vector2i(640, 480)) << name;
    EXPECT_EQ(c.pose.rotation(0, 1), -1) << name;
    EXPECT_EQ(c.pose.translation, Eigen::Vector3d(1, 2, 3)) << name;
  }
}

TEST(OpenCvTest, TakesRotationVectorsAndPosesInAnotherFile) {
  const TextFile intrinsics{"camera_matrix: [[500, 0, 320], [0, 500, 240], [0, 0, 1]]\n", "k.yml"};
  const TextFile pose{"%YAML:1.0\n---\nrvec: [0, 0, 1.5]\ntvec: [1, 2, 3]\n", "pose.yml"};
  const Calibration c = parse_opencv(intrinsics, &pose);
  EXPECT_TRUE(c.pose.rotation.isApprox(
      Eigen::AngleAxisd(1.5, Eigen::Vector3d::UnitZ()).toRotationMatrix()));
  EXPECT_THAT(fault([&] { parse_opencv(intrinsics, nullptr); }),
              HasSubstr("k.yml:1:1: no rotation"));
}

TEST(OpenCvTest, ReadsRosCameraInfo) {
  const Storage storage = parse_opencv_storage(
      "image_width: 640\nimage_height: 480\ncamera_name: left\ncamera_matrix:\n  rows: 3\n  cols: "
      "3\n"
      "  data: [1, 2, 3, 4, 5, 6, 7, 8, 9]\n",
      "ros.yaml");
  EXPECT_THAT(storage.at("camera_matrix").numbers, ElementsAre(1, 2, 3, 4, 5, 6, 7, 8, 9));
  EXPECT_EQ(storage.at("camera_matrix").where, (FilePosition{"ros.yaml", 4, 1}));
  EXPECT_FALSE(storage.at("camera_name").numeric);
}

TEST(OpenCvTest, SurvivesDamage) {
  for (const char* text :
       {"", " \n", "{", "<", "<opencv_storage>", "%YAML:1.0", "%YAML:1.0\n---\n", "- 1\n- 2\n",
        "a: &x [*x]\n", "a: [[[[[[[[1]]]]]]]]\n", "? [1, 2]\n: 3\n", "camera_matrix: *nothing\n",
        "camera_matrix: !!opencv-matrix\n   rows: 3\n  cols: 3\n", "\xff\xfe", "[1, 2"}) {
    EXPECT_THROW(parse_opencv({text, "c"}, nullptr), UserError) << text;
  }
  // ends the process inside OpenCV 4.6's own reader
  EXPECT_THROW(parse_opencv({"%YAML:1.0\n---\ncamera_matrix: !!opencv-matrix\n   rows: 3\n   : d\n"
                             "T: !!opencv-matrix\n   r rows: 3\n   data: [ 1., 2. ]\n",
                             "c"},
                            nullptr),
               UserError);
}

TEST(RotationCheckTest, ToleratesRoundingOnly) {
  const Eigen::Matrix3d r = tsai_rotation(0.3, -0.7, 2.1);
  EXPECT_EQ(rotation_fault(r), "");
  const Eigen::Matrix3d rounded = (r * 1e4).array().round() / 1e4;
  EXPECT_EQ(rotation_fault(rounded), "");
  const Eigen::Matrix3d nearest = nearest_rotation(rounded);
  EXPECT_LT((nearest * nearest.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-14);
  EXPECT_LT((nearest - r).norm(), 2e-4);
  EXPECT_THAT(rotation_fault(1.01 * r), HasSubstr("differs from the identity by 0.0201"));
  EXPECT_THAT(rotation_fault(-r), HasSubstr("reflection"));
  EXPECT_THAT(rotation_fault(Eigen::Matrix3d::Constant(std::nan(""))),
              HasSubstr("not orthonormal"));
}

}  // namespace
}  // namespace plaza
