#include "modalities/common/body_scale.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace plaza {
namespace {

constexpr int kBlock = 8;        ///< pixels, of the tables of sizes
constexpr int kPlaces = 64;      ///< along each axis of the area, where bodies are tried
constexpr double kBeyond_m = 2;  ///< so far outside of the area people count as well

}  // namespace

BodyScale::BodyScale(const Camera& camera, const GroundArea& area, const Body& body)
    : body_m_(body.height_m), columns_((camera.width() + kBlock - 1) / kBlock) {
  const int rows = (camera.height() + kBlock - 1) / kBlock;
  px_per_m_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows), 0);
  box_px2_ = px_per_m_;
  const Eigen::Vector2d corner = area.min_m.array() - kBeyond_m;
  const Eigen::Vector2d extent = area.max_m - area.min_m + Eigen::Vector2d::Constant(2 * kBeyond_m);
  for (int i = 0; i < kPlaces * kPlaces; ++i) {
    const int column = i % kPlaces, row = i / kPlaces;
    const Eigen::Vector2d share((column + 0.5) / kPlaces, (row + 0.5) / kPlaces);
    const std::optional<Box> box = body_box(camera, corner + share.cwiseProduct(extent), body);
    if (!box) continue;
    const auto px_per_m = static_cast<float>(box->height / body.height_m);
    const auto first = [](double v, int n) {
      return static_cast<int>(std::clamp(std::floor(v / kBlock), 0.0, static_cast<double>(n)));
    };
    for (int r = first(box->top, rows); r < first(box->bottom() + kBlock, rows); ++r) {
      for (int c = first(box->left, columns_); c < first(box->right() + kBlock, columns_); ++c) {
        const auto at = static_cast<std::size_t>(r * columns_ + c);
        if (px_per_m_[at] != 0 && px_per_m_[at] <= px_per_m) continue;
        px_per_m_[at] = px_per_m;
        box_px2_[at] = static_cast<float>(box->width * box->height);
      }
    }
  }
}

float BodyScale::block(const std::vector<float>& values, int x, int y) const {
  return values[static_cast<std::size_t>(y / kBlock * columns_ + x / kBlock)];
}

}  // namespace plaza
