#include "plaza/geometry/scene.h"

#include <cmath>

namespace plaza {

std::optional<std::size_t> Scene::camera_index(std::string_view camera_name) const {
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    if (cameras[i].name() == camera_name) return i;
  }
  return std::nullopt;
}

std::int64_t Scene::time_of_frame(std::int64_t frame) const {
  return std::llround(static_cast<double>(frame) * 1e9 / frame_rate_hz);
}

}  // namespace plaza
