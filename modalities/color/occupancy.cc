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

/// Silhouette and gap, and these with the ring.
struct Surroundings {
  std::vector<RowSpan> near, outer;
};
Surroundings surroundings_of(const Silhouette& silhouette, const RingShape& ring, cv::Size image) {
  const auto pixels = [&](double share) {
    return static_cast<int>(std::lround(share * silhouette.box.height));
  };
  const int gap = pixels(ring.gap);
  return {dilated(silhouette.spans, gap, image),
          dilated(silhouette.spans, gap + std::max(1, pixels(ring.width)), image)};
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

/// From the counts of one region, what explained people account for of it.
void take_away_of(std::span<const BoundaryRun> runs, const cv::Rect& box,
                  std::span<const std::shared_ptr<const ExplainedPatch>> explained, Counts& from) {
  for (const auto& patch : explained) {
    if ((patch->box() & box).empty()) continue;
    const Counts away = patch->count(runs);
    from.set -= away.set;
    from.hidden += away.hidden;
  }
}

}  // namespace

bool tells(const SpanTemplate& shape, const Counts& inner, double least_visible) {
  const std::uint32_t inside = shape.inner_area - inner.hidden;
  return inside > 0 && inside >= least_visible * static_cast<double>(shape.full_area);
}

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

bool AreaCounts::any_in(const cv::Rect& box) const {
  if (empty() || box.empty()) return false;
  const std::uint32_t* const top = data() + static_cast<std::size_t>(box.y) * stride_;
  const std::uint32_t* const bottom = top + static_cast<std::size_t>(box.height) * stride_;
  const auto left = static_cast<std::size_t>(box.x);
  const std::size_t right = left + static_cast<std::size_t>(box.width);
  return bottom[right] - bottom[left] != top[right] - top[left];
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

void SpanTemplates::add_piece(const std::vector<RowSpan>& inner, const std::vector<RowSpan>& near,
                              const std::vector<RowSpan>& outer, double inside_share) {
  SpanTemplate t;
  t.inner = static_cast<std::uint32_t>(runs_.size());
  t.near = append(inner);
  t.inner_area = area(inner);
  t.outer = append(near);
  t.end = append(outer);
  t.near_area = area(near);
  t.outer_area = area(outer);
  t.near_box = box_of(near);
  t.outer_box = box_of(outer);
  t.full_area = static_cast<float>(t.inner_area / std::max(inside_share, 1e-9));
  templates_.push_back(t);
}

void SpanTemplates::add(const Silhouette& silhouette, const RingShape& ring) {
  if (parts_ != 1) throw std::invalid_argument("a silhouette in one piece among parts");
  const Surroundings s = surroundings_of(silhouette, ring, image_);
  add_piece(silhouette.spans, s.near, s.outer, silhouette.inside_share);
}

void SpanTemplates::add(const Silhouette& silhouette, const RingShape& ring, const BodyCuts& cuts) {
  if (cuts.parts() != parts_) throw std::invalid_argument("a body in another number of parts");
  const Surroundings s = surroundings_of(silhouette, ring, image_);
  const auto inner = cuts.split(silhouette.spans);
  const auto near = cuts.split(s.near), outer = cuts.split(s.outer);
  for (std::size_t k = 0; k < parts_; ++k) {
    add_piece(inner[k], near[k], outer[k], silhouette.inside_share);
  }
}

cv::Rect SpanTemplates::near_box(std::size_t body) const {
  cv::Rect box = at(body * parts_).near_box;
  for (std::size_t k = 1; k < parts_; ++k) box |= at(body * parts_ + k).near_box;
  return box;
}

TemplateCounts count(const SpanTemplates& templates, std::size_t index,
                     const AreaCounts& foreground, const AreaCounts& blind) {
  const SpanTemplate& t = templates.at(index);
  // most places are empty, and most hide nothing: their boxes tell
  const bool any_set = foreground.any_in(t.outer_box), any_blind = blind.any_in(t.outer_box);
  if (!any_set && !any_blind) return {};
  const auto counts = [&](std::uint32_t begin, std::uint32_t end) {
    const std::span<const BoundaryRun> runs = templates.runs(begin, end);
    return Counts{any_set ? count_in(runs, foreground) : 0, any_blind ? count_in(runs, blind) : 0};
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

void take_away(const SpanTemplates& templates, std::size_t index,
               std::span<const std::shared_ptr<const ExplainedPatch>> explained,
               TemplateCounts& counts) {
  const SpanTemplate& t = templates.at(index);
  take_away_of(templates.runs(t.inner, t.near), t.outer_box, explained, counts.inner);
  take_away_of(templates.runs(t.near, t.outer), t.outer_box, explained, counts.near);
  take_away_of(templates.runs(t.outer, t.end), t.outer_box, explained, counts.outer);
}

std::optional<double> occupancy(const SpanTemplates& templates, std::size_t index,
                                TemplateCounts counts,
                                std::span<const std::shared_ptr<const ExplainedPatch>> explained,
                                double least_visible) {
  const SpanTemplate& t = templates.at(index);
  take_away_of(templates.runs(t.inner, t.near), t.outer_box, explained, counts.inner);
  if (!tells(t, counts.inner, least_visible)) return std::nullopt;
  take_away_of(templates.runs(t.near, t.outer), t.outer_box, explained, counts.near);
  take_away_of(templates.runs(t.outer, t.end), t.outer_box, explained, counts.outer);
  return occupancy(t, counts, least_visible);
}

std::optional<double> occupancy(const SpanTemplates& templates, std::size_t index,
                                const Countable& seen, double least_visible) {
  return occupancy(templates, index, count(templates, index, seen.foreground, seen.blind),
                   seen.explained, least_visible);
}

}  // namespace plaza::color
