#include "modalities/edges/templates.h"

#include <algorithm>
#include <cmath>

namespace plaza::edges {

void EdgeTemplates::add(const Silhouette& silhouette, const TemplateOptions& options) {
  const auto count = static_cast<int>(layout_->directions().size());
  const cv::Rect inside({}, layout_->size());
  const std::size_t run_begin = runs_.size();
  runs_.resize(run_begin + static_cast<std::size_t>(count), 0);
  for (const ContourPoint& point : silhouette.contour) {
    // compared as floats: what lies far outside doesn't fit an int
    const float x = std::round(point.pixel.x()), y = std::round(point.pixel.y());
    const bool seen = x >= 0 && y >= 0 && x < static_cast<float>(inside.width) &&
                      y < static_cast<float>(inside.height);
    if (!seen || !point.normal.allFinite()) continue;
    const auto direction = static_cast<std::size_t>(nearest_direction(point.normal, count));
    points_.push_back(layout_->offset(direction, static_cast<int>(x), static_cast<int>(y)));
    ++runs_[run_begin + direction];
  }
  // planes lie in the block by rising direction
  std::sort(points_.begin() + static_cast<std::ptrdiff_t>(begins_.back()), points_.end());
  const std::size_t seen = points_.size() - begins_.back();
  begins_.push_back(points_.size());
  tells_.push_back(silhouette.inside_share >= options.min_visible &&
                   seen >= static_cast<std::size_t>(options.min_points));
  if (options.spans) {
    spans_.insert(spans_.end(), silhouette.spans.begin(), silhouette.spans.end());
    span_begins_.push_back(spans_.size());
  }
}

ContourMatcher::ContourMatcher(std::shared_ptr<const PlaneLayout> layout, double sigma_px,
                               double gate_px)
    : layout_(std::move(layout)), sigma_px_(sigma_px), gate_px_(gate_px) {
  std::vector<int> gates;
  for (const Direction& d : layout_->directions()) {
    const auto known = std::find(gates.begin(), gates.end(), d.gate);
    table_index_.push_back(static_cast<std::size_t>(known - gates.begin()));
    if (known != gates.end()) continue;
    gates.push_back(d.gate);
    Table& table = tables_.emplace_back();
    table.of[0] = std::uint64_t{1} << 32;
    for (int nearness = 1; nearness < 256; ++nearness) {
      const int steps = std::max(0, d.gate + 1 - nearness);
      table.of[nearness] = static_cast<std::uint64_t>(steps) * static_cast<std::uint64_t>(steps);
    }
  }
}

double ContourMatcher::log_likelihood(const std::uint8_t* block, const EdgeTemplates& templates,
                                      std::size_t index) const {
  // so many squares of at most 254 steps fit the low half
  constexpr std::size_t kMost = 65535;
  const std::span<const std::uint32_t> points = templates.points(index);
  const std::span<const std::uint32_t> runs = templates.runs(index);
  const std::uint32_t* p = points.data();
  double sum_px2 = 0;
  std::uint64_t outliers = 0;
  for (std::size_t d = 0; d < runs.size(); ++d) {
    if (runs[d] == 0) continue;
    const std::uint64_t* square = tables_[table_index_[d]].of;
    std::uint64_t squares = 0;
    for (std::size_t left = runs[d]; left > 0;) {
      const std::size_t count = std::min(left, kMost);
      std::uint64_t even = 0, odd = 0;
      std::size_t i = 0;
      for (; i + 1 < count; i += 2) {
        even += square[block[p[i]]];
        odd += square[block[p[i + 1]]];
      }
      if (i < count) even += square[block[p[i]]];
      const std::uint64_t both = even + odd;
      squares += both & 0xFFFFFFFF;
      outliers += both >> 32;
      p += count;
      left -= count;
    }
    const double step_px = layout_->directions()[d].step_px;
    sum_px2 += static_cast<double>(squares) * step_px * step_px;
  }
  sum_px2 += static_cast<double>(outliers) * gate_px_ * gate_px_;
  return -sum_px2 / (2 * static_cast<double>(points.size()) * sigma_px_ * sigma_px_);
}

std::optional<double> ContourMatcher::log_likelihood(const std::uint8_t* block,
                                                     const HiddenRegion& hidden,
                                                     const EdgeTemplates& templates,
                                                     std::size_t index, double least_share,
                                                     int least_points) const {
  const std::span<const std::uint32_t> points = templates.points(index);
  const std::span<const std::uint32_t> runs = templates.runs(index);
  const std::uint32_t* p = points.data();
  double sum_px2 = 0;
  std::uint64_t outliers = 0;
  std::size_t seen = 0;
  for (std::size_t d = 0; d < runs.size(); ++d) {
    const Direction& direction = layout_->directions()[d];
    const std::uint64_t* square = tables_[table_index_[d]].of;
    const std::uint8_t* hides = hidden.plane(direction.steep);
    const std::uint32_t plane_begin = layout_->plane_begin(d);
    std::uint64_t squares = 0;
    for (std::size_t i = 0; i < runs[d]; ++i, ++p) {
      if (hides[*p - plane_begin] != 0) continue;
      const std::uint64_t found = square[block[*p]];
      squares += found & 0xFFFFFFFF;
      outliers += found >> 32;
      ++seen;
    }
    sum_px2 += static_cast<double>(squares) * direction.step_px * direction.step_px;
  }
  if (seen < static_cast<std::size_t>(least_points) ||
      static_cast<double>(seen) < least_share * static_cast<double>(points.size())) {
    return std::nullopt;
  }
  sum_px2 += static_cast<double>(outliers) * gate_px_ * gate_px_;
  return -sum_px2 / (2 * static_cast<double>(seen) * sigma_px_ * sigma_px_);
}

}  // namespace plaza::edges
