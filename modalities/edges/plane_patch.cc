#include "modalities/edges/plane_patch.h"

#include <algorithm>

namespace plaza::edges {
namespace {

int largest_gate(const PlaneLayout& layout) {
  int most = 0;
  for (const Direction& d : layout.directions()) most = std::max(most, d.gate);
  return most;
}

cv::Rect grown(const cv::Rect& r, int by, cv::Size image) {
  return cv::Rect(r.x - by, r.y - by, r.width + 2 * by, r.height + 2 * by) & cv::Rect({}, image);
}

}  // namespace

PlanePatch::PlanePatch(const PlaneLayout& layout, const cv::Rect& valid,
                       std::span<const EdgePoint> edges, FastTransform& transform)
    : valid_(valid),
      // a line steps by at most a pixel along both axes, so that edges beyond aren't within the
      // gate
      window_(grown(valid, largest_gate(layout), layout.size())),
      layout_(window_.size(), layout.directions()),
      bytes_(std::make_unique_for_overwrite<std::uint8_t[]>(layout_.bytes())) {
  transform.run(edges, window_, layout_, bytes_.get());
}

PlanePatches patched(const PlaneLayout& layout, PlanePatches before,
                     std::span<const cv::Rect> removed, std::span<const EdgePoint> edges,
                     FastTransform& transform) {
  const int gate = largest_gate(layout);
  std::vector<cv::Rect> todo;
  for (const cv::Rect& r : removed) {
    cv::Rect valid = grown(r, gate, layout.size());
    for (bool alone = false; !alone;) {
      alone = true;
      const auto swallow = [&](const cv::Rect& other) {
        if ((other & valid).empty()) return false;
        valid |= other;
        alone = false;
        return true;
      };
      std::erase_if(todo, swallow);
      std::erase_if(before, [&](const auto& patch) { return swallow(patch->valid()); });
    }
    todo.push_back(valid);
  }
  for (const cv::Rect& valid : todo) {
    before.push_back(std::make_shared<const PlanePatch>(layout, valid, edges, transform));
  }
  return before;
}

bool PatchedSums::touches(const EdgeTemplates& templates, std::size_t index) {
  near_.clear();
  for (const auto& patch : patches_) {
    if (!(patch->valid() & templates.box(index)).empty()) near_.push_back(patch.get());
  }
  return !near_.empty();
}

void PatchedSums::sum(const EdgeTemplates& templates, std::size_t index, ContourSum* sums) {
  const PlaneLayout& layout = *templates.layout();
  const ContourRuns whole = templates.runs(index);
  const std::span<const std::uint16_t> rows = templates.rows(index);
  bytes_.clear();
  lengths_.clear();
  counts_.resize(whole.directions);
  std::size_t run = 0;
  for (std::size_t d = 0; d < whole.directions; ++d) {
    const bool steep = layout.directions()[d].steep;
    const std::uint32_t stride = steep ? layout.wide_stride() : layout.tall_stride();
    const std::size_t first = bytes_.size();
    for (const std::size_t last = run + whole.counts[d]; run < last; ++run) {
      const std::uint32_t row_begin = layout.plane_begin(d) + rows[run] * stride;
      const int column = static_cast<int>(whole.begins[run] - row_begin);
      add_pieces(d, steep, rows[run], column, column + whole.lengths[run], planes_ + row_begin);
    }
    counts_[d] = static_cast<std::uint32_t>(bytes_.size() - first);
  }
  sum_(bytes_.data(), {nullptr, lengths_.data(), counts_.data(), whole.peaks, whole.directions},
       sums);
}

void PatchedSums::add_pieces(std::size_t direction, bool steep, int row, int column, int end,
                             const std::uint8_t* row_begin) {
  while (column < end) {
    int piece_end = end;
    const PlanePatch* inside = nullptr;
    for (const PlanePatch* patch : near_) {
      const cv::Rect& v = patch->valid();
      const int first_row = steep ? v.y : v.x, end_row = steep ? v.br().y : v.br().x;
      const int first = steep ? v.x : v.y, behind = steep ? v.br().x : v.br().y;
      if (row < first_row || row >= end_row || behind <= column || first >= end) continue;
      if (first <= column) {
        inside = patch;
        piece_end = std::min(end, behind);
        break;
      }
      piece_end = std::min(piece_end, first);
    }
    add(inside == nullptr ? row_begin + column
                          : inside->bytes() + inside->offset(direction, steep ? column : row,
                                                             steep ? row : column),
        piece_end - column);
    column = piece_end;
  }
}

}  // namespace plaza::edges
