#include "modalities/color/occupancy.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <tuple>

#include "modalities/color/explained_patch.h"

namespace plaza::color {
namespace {

std::uint32_t area(const std::vector<RowSpan>& spans) {
  std::uint32_t sum = 0;
  for (const RowSpan& s : spans) sum += static_cast<std::uint32_t>(s.end - s.begin);
  return sum;
}

cv::Rect box_of(const std::vector<RowSpan>& spans) {
  if (spans.empty()) return {};
  int left = spans.front().begin, right = spans.front().end;
  for (const RowSpan& s : spans) {
    left = std::min(left, s.begin);
    right = std::max(right, s.end);
  }
  return {left, spans.front().row, right - left, spans.back().row - spans.front().row + 1};
}

std::uint32_t count_in(std::span<const BoundaryRun> runs, const AreaCounts& counts) {
  const std::uint32_t* const at = counts.data();
  const std::size_t stride = counts.stride();
  std::uint32_t sum = 0;
  for (const BoundaryRun& r : runs) {
    sum += at[r.plus_row * stride + r.x] - at[r.minus_row * stride + r.x];
  }
  return sum;
}

bool tells(const SpanTemplate& shape, const Counts& inner, double least_visible) {
  const std::uint32_t inside = shape.inner_area - inner.hidden;
  return inside > 0 && inside >= least_visible * static_cast<double>(shape.full_area);
}

}  // namespace

AreaCounts::AreaCounts(const cv::Mat& mask) {
  if (mask.cols > 65535 || mask.rows > 65535) {
    throw std::invalid_argument("the mask is too large to be counted");
  }
  stride_ = static_cast<std::size_t>(mask.cols) + 1;
  counts_.resize(stride_ * (static_cast<std::size_t>(mask.rows) + 1));
  for (int y = 0; y < mask.rows; ++y) {
    const auto* const in = mask.ptr<uchar>(y);
    const std::uint32_t* const above = counts_.data() + static_cast<std::size_t>(y) * stride_;
    std::uint32_t* const out = counts_.data() + (static_cast<std::size_t>(y) + 1) * stride_;
    std::uint32_t row = 0;
    for (int x = 0; x < mask.cols; ++x) {
      row += in[x] != 0 ? 1U : 0U;
      out[x + 1] = above[x + 1] + row;
    }
  }
}

std::vector<BoundaryRun> boundary_of(const std::vector<RowSpan>& spans) {
  struct Step {
    std::int32_t x, row;
    bool right;
    auto operator<=>(const Step&) const = default;
  };
  std::vector<Step> steps;
  for (const RowSpan& s : spans) {
    steps.push_back({s.begin, s.row, false});
    steps.push_back({s.end, s.row, true});
  }
  // pieces of one column one below the other
  std::sort(steps.begin(), steps.end(), [](const Step& a, const Step& b) {
    return std::tie(a.x, a.right, a.row) < std::tie(b.x, b.right, b.row);
  });
  std::vector<BoundaryRun> runs;
  for (std::size_t i = 0; i < steps.size();) {
    std::size_t end = i + 1;
    while (end < steps.size() && steps[end].x == steps[i].x && steps[end].right == steps[i].right &&
           steps[end].row == steps[end - 1].row + 1) {
      ++end;
    }
    const auto top = static_cast<std::uint16_t>(steps[i].row);
    const auto bottom = static_cast<std::uint16_t>(steps[end - 1].row + 1);
    const auto x = static_cast<std::uint16_t>(steps[i].x);
    runs.push_back(steps[i].right ? BoundaryRun{x, bottom, top} : BoundaryRun{x, top, bottom});
    i = end;
  }
  std::sort(runs.begin(), runs.end(), [](const BoundaryRun& a, const BoundaryRun& b) {
    return std::tuple(std::min(a.plus_row, a.minus_row), a.x, a.plus_row) <
           std::tuple(std::min(b.plus_row, b.minus_row), b.x, b.plus_row);
  });
  return runs;
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
  const std::vector<BoundaryRun> runs = boundary_of(spans);
  runs_.insert(runs_.end(), runs.begin(), runs.end());
  return static_cast<std::uint32_t>(runs_.size());
}

void SpanTemplates::add(const Silhouette& silhouette, const RingShape& ring) {
  SpanTemplate t;
  t.inner = static_cast<std::uint32_t>(runs_.size());
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
    t.near_box = box_of(near);
    t.outer_box = box_of(all);
    t.full_area = static_cast<float>(t.inner_area / std::max(silhouette.inside_share, 1e-9));
  }
  t.end = static_cast<std::uint32_t>(runs_.size());
  templates_.push_back(t);
}

TemplateCounts count(const SpanTemplates& templates, std::size_t index,
                     const AreaCounts& foreground, const AreaCounts& blind) {
  const SpanTemplate& t = templates.at(index);
  const auto counts = [&](std::uint32_t begin, std::uint32_t end) {
    const std::span<const BoundaryRun> runs = templates.runs(begin, end);
    return Counts{count_in(runs, foreground), blind.empty() ? 0 : count_in(runs, blind)};
  };
  return {counts(t.inner, t.near), counts(t.near, t.outer), counts(t.outer, t.end)};
}

std::optional<double> occupancy(const SpanTemplate& shape, const TemplateCounts& counts,
                                double least_visible) {
  if (!tells(shape, counts.inner, least_visible)) return std::nullopt;
  const double share =
      static_cast<double>(counts.inner.set) / (shape.inner_area - counts.inner.hidden);
  const std::uint32_t ring =
      shape.outer_area - shape.near_area - (counts.outer.hidden - counts.near.hidden);
  if (ring == 0) return share;
  return share - static_cast<double>(counts.outer.set - counts.near.set) / ring;
}

std::optional<double> occupancy(const SpanTemplates& templates, std::size_t index,
                                TemplateCounts counts,
                                std::span<const std::shared_ptr<const ExplainedPatch>> explained,
                                double least_visible) {
  const SpanTemplate& t = templates.at(index);
  const auto take_away = [&](Counts& from, std::uint32_t begin, std::uint32_t end) {
    for (const auto& patch : explained) {
      if ((patch->box() & t.outer_box).empty()) continue;
      const Counts away = patch->count(templates.runs(begin, end));
      from.set -= away.set;
      from.hidden += away.hidden;
    }
  };
  take_away(counts.inner, t.inner, t.near);
  if (!tells(t, counts.inner, least_visible)) return std::nullopt;
  take_away(counts.near, t.near, t.outer);
  take_away(counts.outer, t.outer, t.end);
  return occupancy(t, counts, least_visible);
}

std::optional<double> occupancy(const SpanTemplates& templates, std::size_t index,
                                const Countable& seen, double least_visible) {
  return occupancy(templates, index, count(templates, index, seen.foreground, seen.blind),
                   seen.explained, least_visible);
}

}  // namespace plaza::color
