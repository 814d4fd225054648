#include "modalities/color/occupancy.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace plaza::color {
namespace {

std::uint32_t area(const std::vector<RowSpan>& spans) {
  std::uint32_t sum = 0;
  for (const RowSpan& s : spans) sum += static_cast<std::uint32_t>(s.end - s.begin);
  return sum;
}

}  // namespace

RowCounts::RowCounts(const cv::Mat& mask) {
  if (mask.cols > 65535) throw std::invalid_argument("the mask is too wide to be counted");
  counts_.resize((static_cast<std::size_t>(mask.cols) + 1) * static_cast<std::size_t>(mask.rows));
  recount(mask, 0, mask.rows);
}

void RowCounts::recount(const cv::Mat& mask, int first_row, int end_row) {
  for (int y = first_row; y < end_row; ++y) {
    const auto* const in = mask.ptr<uchar>(y);
    std::uint16_t* const out = counts_.data() + index(y, 0, mask.cols);
    unsigned count = 0;
    out[0] = 0;
    for (int x = 0; x < mask.cols; ++x) {
      count += in[x] != 0 ? 1U : 0U;
      out[x + 1] = static_cast<std::uint16_t>(count);
    }
  }
}

std::vector<RowSpan> dilated(const std::vector<RowSpan>& spans, int radius, cv::Size image) {
  std::vector<RowSpan> out;
  if (spans.empty()) return out;
  const int first = std::max(spans.front().row - radius, 0);
  const int last = std::min(spans.back().row + radius, image.height - 1);
  std::size_t begin = 0;
  std::vector<RowSpan> near;
  for (int row = first; row <= last; ++row) {
    while (begin < spans.size() && spans[begin].row < row - radius) ++begin;
    near.clear();
    for (std::size_t i = begin; i < spans.size() && spans[i].row <= row + radius; ++i) {
      near.push_back({row, std::max(spans[i].begin - radius, 0),
                      std::min(spans[i].end + radius, image.width)});
    }
    std::sort(near.begin(), near.end(),
              [](const RowSpan& a, const RowSpan& b) { return a.begin < b.begin; });
    const std::size_t row_start = out.size();
    for (const RowSpan& s : near) {
      if (out.size() > row_start && s.begin <= out.back().end) {
        out.back().end = std::max(out.back().end, s.end);
      } else {
        out.push_back(s);
      }
    }
  }
  return out;
}

std::uint32_t SpanTemplates::append(const std::vector<RowSpan>& spans) {
  for (const RowSpan& s : spans) {
    spans_.push_back({RowCounts::index(s.row, s.begin, image_.width),
                      RowCounts::index(s.row, s.end, image_.width)});
  }
  return static_cast<std::uint32_t>(spans_.size());
}

void SpanTemplates::add(const Silhouette& silhouette, const RingShape& ring) {
  SpanTemplate t;
  t.inner = static_cast<std::uint32_t>(spans_.size());
  t.near = t.outer = append(silhouette.spans);
  t.inner_area = area(silhouette.spans);
  if (t.inner_area > 0) {
    const auto pixels = [&](double share) {
      return static_cast<int>(std::lround(share * silhouette.box.height));
    };
    const int gap = pixels(ring.gap);
    const std::vector<RowSpan> near = dilated(silhouette.spans, gap, image_);
    const std::vector<RowSpan> all =
        dilated(silhouette.spans, gap + std::max(1, pixels(ring.width)), image_);
    t.outer = append(near);
    append(all);
    t.near_area = area(near);
    t.outer_area = area(all);
    t.full_area = static_cast<float>(t.inner_area / std::max(silhouette.inside_share, 1e-9));
  }
  t.end = static_cast<std::uint32_t>(spans_.size());
  templates_.push_back(t);
}

std::optional<double> occupancy(const SpanTemplates& templates, std::size_t index,
                                const RowCounts& foreground, const RowCounts& explained,
                                double least_visible) {
  const SpanTemplate& t = templates.at(index);
  const auto count = [&](const RowCounts& counts, std::uint32_t begin, std::uint32_t end) {
    std::uint32_t sum = 0;
    for (std::uint32_t i = begin; i < end; ++i) {
      const CountSpan& s = templates.span(i);
      sum += static_cast<std::uint32_t>(counts[s.end] - counts[s.begin]);
    }
    return sum;
  };
  std::uint32_t inside = t.inner_area;
  std::uint32_t ring = t.outer_area - t.near_area;
  if (!explained.empty()) {
    inside -= count(explained, t.inner, t.near);
    ring -= count(explained, t.outer, t.end) - count(explained, t.near, t.outer);
  }
  if (inside == 0 || inside < least_visible * static_cast<double>(t.full_area)) return std::nullopt;
  const std::uint32_t set_inside = count(foreground, t.inner, t.near);
  const double share = static_cast<double>(set_inside) / inside;
  if (ring == 0) return share;
  const std::uint32_t set_ring =
      count(foreground, t.outer, t.end) - count(foreground, t.near, t.outer);
  return share - static_cast<double>(set_ring) / ring;
}

}  // namespace plaza::color
