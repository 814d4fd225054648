// The official calibration of PETS 2009, View 001, against the annotated boxes.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "plaza/geometry/camera.h"

namespace plaza {
namespace {

Camera view_001() {
  const auto about = [](double angle, const Eigen::Vector3d& axis) {
    return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
  };
  CameraFromWorld pose;
  pose.rotation = about(-4.3056124791e-01, Eigen::Vector3d::UnitZ()) *
                  about(-8.9337703748e-01, Eigen::Vector3d::UnitY()) *
                  about(2.0405458695, Eigen::Vector3d::UnitX());
  pose.translation = {0.82873214225, -3.1754796051, 35.469298547};
  return Camera::tsai("View_001", {768, 576},
                      {5.5549183034, 5.1113043639e-03, 5.1273271277e-03, 4.65e-03, 1.0937855397,
                       3.2422149053e+02, 2.8256650051e+02},
                      pose);
}

struct Row {
  Box box;
  Eigen::Vector2d position_m;
};

std::vector<Row> annotated_rows(const char* name) {
  const char* data = std::getenv("PLAZA_DATA");
  const std::filesystem::path folder = data ? data : PLAZA_SOURCE_DIR "/../shared/data";
  std::ifstream file(folder / "pets2009-s2l1/gt" / name);
  std::vector<Row> rows;
  for (std::string line; std::getline(file, line);) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream fields(line);
    double frame = 0, id = 0, confidence = 0;
    Row row;
    fields >> frame >> id >> row.box.left >> row.box.top >> row.box.width >> row.box.height >>
        confidence >> row.position_m.x() >> row.position_m.y();
    if (fields) rows.push_back(row);
  }
  return rows;
}

TEST(CameraPetsTest, AnnotatedFeetReprojectOntoTheBoxes) {
  const auto rows = annotated_rows("gt-full.txt");
  if (rows.empty()) GTEST_SKIP() << "PETS 2009 ground truth not found; set PLAZA_DATA";
  const Camera camera = view_001();
  for (const Row& row : rows) {
    const auto pixel = camera.project({row.position_m.x(), row.position_m.y(), 0});
    ASSERT_TRUE(pixel);
    const Eigen::Vector2d feet(row.box.left + row.box.width / 2, row.box.bottom());
    ASSERT_LT((*pixel - feet).norm(), 2.83);
    // The annotation's pixels are shifted by 1.5 and rounded: what is left is the rounding.
    ASSERT_LT((*pixel + Eigen::Vector2d(1.5, 1.5) - feet).norm(), 0.75);
    const auto back = camera.to_plane(*pixel);
    ASSERT_TRUE(back);
    ASSERT_LT((*back - row.position_m).norm(), 1e-8);
  }
}

TEST(CameraPetsTest, BoxesDrawnFromTheBodyFitTheAnnotatedOnes) {
  const auto rows = annotated_rows("gt-area.txt");
  if (rows.empty()) GTEST_SKIP() << "PETS 2009 ground truth not found; set PLAZA_DATA";
  const Camera camera = view_001();
  double sum = 0;
  for (const Row& row : rows) {
    const auto box = body_box(camera, row.position_m, {1.75, 0.30});
    ASSERT_TRUE(box);
    sum += intersection_over_union(*box, row.box);
  }
  EXPECT_GT(sum / static_cast<double>(rows.size()), 0.75);
}

TEST(CameraPetsTest, TheCameraStandsWherePetsSaysItStood) {
  const Eigen::Vector3d centre = view_001().centre();
  EXPECT_NEAR(centre.x(), -30.0, 5);  // some 35 m from the area's middle
  EXPECT_GT(centre.z(), 3);
  EXPECT_LT(centre.z(), 15);
}

}  // namespace
}  // namespace plaza
