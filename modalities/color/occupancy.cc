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

struct Sums {
  std::uint32_t set = 0;     ///< foreground that counts
  std::uint32_t hidden = 0;  ///< pixels that don't count
};

Sums sums(std::span<const CountSpan> spans, const Countable& seen) {
  Sums sum;
  if (spans.empty()) return sum;
  const auto between = [](const RowCounts& counts, std::uint32_t begin, std::uint32_t end) {
    return static_cast<std::uint32_t>(counts[end] - counts[begin]);
  };
  const bool blind = !seen.blind.empty();
  auto next =
      std::upper_bound(seen.explained.begin(), seen.explained.end(), spans.front().begin,
                       [](std::uint32_t begin, const CountSpan& e) { return begin < e.end; });
  for (const CountSpan& s : spans) {
    sum.set += between(seen.foreground, s.begin, s.end);
    if (blind) sum.hidden += between(seen.blind, s.begin, s.end);
    while (next != seen.explained.end() && next->end <= s.begin) ++next;
    for (auto e = next; e != seen.explained.end() && e->begin < s.end; ++e) {
      const std::uint32_t begin = std::max(e->begin, s.begin), end = std::min(e->end, s.end);
      sum.set -= between(seen.foreground, begin, end);
      sum.hidden += end - begin;
      if (blind) sum.hidden -= between(seen.blind, begin, end);
    }
  }
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

std::vector<CountSpan> united(std::vector<CountSpan> spans) {
  std::sort(spans.begin(), spans.end(),
            [](const CountSpan& a, const CountSpan& b) { return a.begin < b.begin; });
  std::vector<CountSpan> out;
  for (const CountSpan& s : spans) {
    if (!out.empty() && s.begin <= out.back().end) {
      out.back().end = std::max(out.back().end, s.end);
    } else {
      out.push_back(s);
    }
  }
  return out;
}

std::optional<double> occupancy(const SpanTemplates& templates, std::size_t index,
                                const Countable& seen, double least_visible) {
  const SpanTemplate& t = templates.at(index);
  const Sums in = sums(templates.spans(t.inner, t.near), seen);
  const std::uint32_t inside = t.inner_area - in.hidden;
  if (inside == 0 || inside < least_visible * static_cast<double>(t.full_area)) return std::nullopt;
  const Sums near = sums(templates.spans(t.near, t.outer), seen);
  const Sums outer = sums(templates.spans(t.outer, t.end), seen);
  const double share = static_cast<double>(in.set) / inside;
  const std::uint32_t ring = t.outer_area - t.near_area - (outer.hidden - near.hidden);
  if (ring == 0) return share;
  return share - static_cast<double>(outer.set - near.set) / ring;
}

}  // namespace plaza::color
