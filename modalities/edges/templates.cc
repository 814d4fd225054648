#include "modalities/edges/templates.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace plaza::edges {
namespace {

constexpr std::size_t kMostDirections = 180;  // that the parameter allows

}  // namespace

EdgeTemplates::EdgeTemplates(std::shared_ptr<const PlaneLayout> layout)
    : layout_(std::move(layout)) {
  for (const Direction& d : layout_->directions()) {
    peaks_.push_back(static_cast<std::uint8_t>(d.gate + 1));
  }
}

void EdgeTemplates::add(const Silhouette& silhouette, const TemplateOptions& options) {
  const auto count = static_cast<int>(layout_->directions().size());
  const cv::Rect inside({}, layout_->size());
  std::vector<std::vector<std::uint32_t>> points(static_cast<std::size_t>(count));
  cv::Rect box;
  for (const ContourPoint& point : silhouette.contour) {
    // compared as floats: what lies far outside doesn't fit an int
    const float x = std::round(point.pixel.x()), y = std::round(point.pixel.y());
    const bool seen = x >= 0 && y >= 0 && x < static_cast<float>(inside.width) &&
                      y < static_cast<float>(inside.height);
    if (!seen || !point.normal.allFinite()) continue;
    const auto direction = static_cast<std::size_t>(nearest_direction(point.normal, count));
    box |= cv::Rect(static_cast<int>(x), static_cast<int>(y), 1, 1);
    points[direction].push_back(
        layout_->offset(direction, static_cast<int>(x), static_cast<int>(y)));
  }
  std::size_t seen = 0;
  for (std::size_t d = 0; d < points.size(); ++d) {
    std::vector<std::uint32_t>& of_direction = points[d];
    std::sort(of_direction.begin(), of_direction.end());
    const std::size_t first = begins_.size();
    for (const std::uint32_t point : of_direction) {
      const bool goes_on = begins_.size() > first && lengths_.back() < kLongestRun &&
                           point == begins_.back() + lengths_.back();
      if (goes_on) {
        ++lengths_.back();
      } else {
        begins_.push_back(point);
        lengths_.push_back(1);
        const cv::Point pixel = layout_->pixel(d, point);
        rows_.push_back(
            static_cast<std::uint16_t>(layout_->directions()[d].steep ? pixel.y : pixel.x));
      }
    }
    counts_.push_back(static_cast<std::uint32_t>(begins_.size() - first));
    seen += of_direction.size();
  }
  first_run_.push_back(begins_.size());
  boxes_.push_back(box);
  points_.push_back(static_cast<std::uint32_t>(seen));
  tells_.push_back(silhouette.inside_share >= options.min_visible &&
                   seen >= static_cast<std::size_t>(options.min_points));
  if (options.spans) {
    spans_.insert(spans_.end(), silhouette.spans.begin(), silhouette.spans.end());
    span_begins_.push_back(spans_.size());
  }
}

ContourMatcher::ContourMatcher(std::shared_ptr<const PlaneLayout> layout, double sigma_px,
                               double gate_px, const SumContourVersion& version)
    : layout_(std::move(layout)), sigma_px_(sigma_px), gate_px_(gate_px), version_(&version) {
  if (layout_->directions().size() > kMostDirections) {
    throw std::invalid_argument("contours are matched in at most 180 directions");
  }
}

double ContourMatcher::log_likelihood_of(std::span<const ContourSum> sums,
                                         std::uint64_t points) const {
  double sum_px2 = 0;
  std::uint64_t outliers = 0;
  for (std::size_t d = 0; d < sums.size(); ++d) {
    const double step_px = layout_->directions()[d].step_px;
    sum_px2 += static_cast<double>(sums[d].squares) * step_px * step_px;
    outliers += sums[d].outliers;
  }
  sum_px2 += static_cast<double>(outliers) * gate_px_ * gate_px_;
  return -sum_px2 / (2 * static_cast<double>(points) * sigma_px_ * sigma_px_);
}

void ContourMatcher::fetch(const std::uint8_t* block, const EdgeTemplates& templates,
                           std::size_t index) {
  for (const std::uint32_t begin : templates.begins(index)) __builtin_prefetch(block + begin);
}

double ContourMatcher::log_likelihood(const std::uint8_t* block, const EdgeTemplates& templates,
                                      std::size_t index) const {
  std::array<ContourSum, kMostDirections> sums;
  const ContourRuns runs = templates.runs(index);
  version_->run(block, runs, sums.data());
  return log_likelihood_of(std::span(sums).first(runs.directions), templates.points(index));
}

std::optional<double> ContourMatcher::log_likelihood(const std::uint8_t* block,
                                                     const HiddenRegion& hidden,
                                                     const EdgeTemplates& templates,
                                                     std::size_t index, double least_share,
                                                     int least_points) const {
  std::array<ContourSum, kMostDirections> sums;
  const ContourRuns runs = templates.runs(index);
  std::size_t run = 0, seen = 0;
  for (std::size_t d = 0; d < runs.directions; ++d) {
    const std::uint8_t* hides = hidden.plane(layout_->directions()[d].steep);
    const std::uint32_t plane_begin = layout_->plane_begin(d);
    for (const std::size_t end = run + runs.counts[d]; run < end; ++run) {
      for (std::uint32_t p = runs.begins[run]; p < runs.begins[run] + runs.lengths[run]; ++p) {
        if (hides[p - plane_begin] != 0) continue;
        ++seen;
        const int steps = std::max(0, runs.peaks[d] - block[p]);
        if (block[p] == 0) {
          ++sums[d].outliers;
        } else {
          sums[d].squares += static_cast<std::uint64_t>(steps * steps);
        }
      }
    }
  }
  if (seen < static_cast<std::size_t>(least_points) ||
      static_cast<double>(seen) < least_share * static_cast<double>(templates.points(index))) {
    return std::nullopt;
  }
  return log_likelihood_of(std::span(sums).first(runs.directions), seen);
}

}  // namespace plaza::edges
