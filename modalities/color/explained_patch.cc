#include "modalities/color/explained_patch.h"

#include <algorithm>

namespace plaza::color {

ExplainedPatch::ExplainedPatch(std::span<const BoundaryRun> region, const cv::Rect& box,
                               const cv::Mat& foreground, const cv::Mat& blind,
                               std::span<const std::shared_ptr<const ExplainedPatch>> before)
    : box_(box) {
  const auto width = static_cast<std::size_t>(box.width);
  const auto height = static_cast<std::size_t>(box.height);
  // boundaries first: 1 where a span begins, -1 (255) where it ends; one column more, for its end
  std::vector<std::uint8_t> borders((width + 1) * height, 0);
  for (const BoundaryRun& r : region) {
    const bool right = r.plus_row > r.minus_row;
    const int begin = std::min(r.plus_row, r.minus_row), end = std::max(r.plus_row, r.minus_row);
    for (int y = begin; y < end; ++y) {
      std::uint8_t& border = borders[static_cast<std::size_t>(y - box.y) * (width + 1) +
                                     static_cast<std::size_t>(r.x - box.x)];
      border = static_cast<std::uint8_t>(border + (right ? 255 : 1));
    }
  }
  std::vector<const ExplainedPatch*> near;
  for (const auto& patch : before) {
    if (!(patch->box_ & box).empty()) near.push_back(patch.get());
  }
  region_.resize(width * height);
  counts_.resize((width + 1) * (height + 1));
  for (std::size_t y = 0; y < height; ++y) {
    const int row = box.y + static_cast<int>(y);
    const std::uint8_t* const set = foreground.ptr<uchar>(row) + box.x;
    const std::uint8_t* const unseen = blind.empty() ? nullptr : blind.ptr<uchar>(row) + box.x;
    const Counts* const above = counts_.data() + y * (width + 1);
    Counts* const out = counts_.data() + (y + 1) * (width + 1);
    std::uint8_t inside = 0;
    Counts sum;
    for (std::size_t x = 0; x < width; ++x) {
      inside = static_cast<std::uint8_t>(inside + borders[y * (width + 1) + x]);
      region_[y * width + x] = inside;
      std::uint32_t counts = inside;
      if (unseen != nullptr && unseen[x] != 0) counts = 0;
      for (const ExplainedPatch* patch : near) {
        if (patch->hides(box.x + static_cast<int>(x), row)) counts = 0;
      }
      sum.hidden += counts;
      sum.set += set[x] != 0 ? counts : 0;
      out[x + 1] = {above[x + 1].set + sum.set, above[x + 1].hidden + sum.hidden};
    }
  }
}

Counts ExplainedPatch::count(std::span<const BoundaryRun> runs) const {
  const auto stride = static_cast<std::size_t>(box_.width) + 1;
  Counts sum;
  for (const BoundaryRun& r : runs) {
    if (std::min(r.plus_row, r.minus_row) >= box_.y + box_.height) break;  // they go downwards
    // beyond the box the running counts are those of its border
    const int x = std::clamp(r.x - box_.x, 0, box_.width);
    const int plus = std::clamp(r.plus_row - box_.y, 0, box_.height);
    const int minus = std::clamp(r.minus_row - box_.y, 0, box_.height);
    const Counts& a =
        counts_[static_cast<std::size_t>(plus) * stride + static_cast<std::size_t>(x)];
    const Counts& b =
        counts_[static_cast<std::size_t>(minus) * stride + static_cast<std::size_t>(x)];
    sum.set += a.set - b.set;
    sum.hidden += a.hidden - b.hidden;
  }
  return sum;
}

}  // namespace plaza::color
