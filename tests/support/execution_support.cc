#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "tests/support/execution_doubles.h"
#include "tests/support/into_registry.h"

namespace plaza::test {
namespace {

Camera camera(const std::string& name, double x_m) {
  CameraFromWorld pose;  // 3 m above the ground, looking along +y and down a little
  const double tilt = 0.5;
  pose.rotation << 1, 0, 0,                 //
      0, -std::sin(tilt), -std::cos(tilt),  //
      0, std::cos(tilt), -std::sin(tilt);
  pose.translation = -pose.rotation * Eigen::Vector3d(x_m, -4, 3);
  return Camera::pinhole(
      name, {64, 48}, {.fx_px = 50, .fy_px = 50, .cx_px = 32, .cy_px = 24, .distortion = {}}, pose);
}

}  // namespace

Registry double_registry() {
  Registry registry;
  IntoRegistry registrar(registry);
  register_doubles(registrar);
  return registry;
}

std::shared_ptr<const Scene> double_scene() {
  auto scene = std::make_shared<Scene>();
  scene->name = "test";
  scene->cameras = {camera("left", -1), camera("right", 1)};
  scene->area = {.min_m = {-5, -2}, .max_m = {5, 8}};
  scene->frame_rate_hz = 25;
  return scene;
}

std::string read_text(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw std::runtime_error("can't read " + file.string());
  std::ostringstream text;
  text << in.rdbuf();
  return std::move(text).str();
}

void write_text(const std::filesystem::path& file, const std::string& text) {
  std::filesystem::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << text;
}

std::vector<std::string> lines_of(const std::filesystem::path& file) {
  std::istringstream text(read_text(file));
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

std::map<std::string, std::string> contents_of(const std::filesystem::path& folder) {
  std::map<std::string, std::string> contents;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    contents[entry.path().lexically_relative(folder).string()] = read_text(entry.path());
  }
  return contents;
}

}  // namespace plaza::test
