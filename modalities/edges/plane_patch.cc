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

void PatchedSums::look_along(std::size_t direction, bool steep) {
  windows_.clear();
  for (const PlanePatch* patch : near_) {
    const cv::Rect &valid = patch->valid(), &window = patch->window();
    const PlaneLayout& layout = patch->layout();
    Window w;
    w.bytes = patch->bytes();
    w.stride = steep ? layout.wide_stride() : layout.tall_stride();
    w.origin = layout.plane_begin(direction) - (steep ? window.y : window.x) * w.stride -
               (steep ? window.x : window.y);
    w.first_row = steep ? valid.y : valid.x;
    w.end_row = steep ? valid.br().y : valid.br().x;
    w.first_column = steep ? valid.x : valid.y;
    w.end_column = steep ? valid.br().x : valid.br().y;
    windows_.push_back(w);
  }
}

void PatchedSums::sum(const EdgeTemplates& templates, std::size_t index, ContourSum* sums) {
  const PlaneLayout& layout = *templates.layout();
  const ContourRuns whole = templates.runs(index);
  const std::span<const std::uint16_t> rows = templates.rows(index);
  // a patch cuts a run into two more at most
  const std::size_t most = rows.size() * (2 * near_.size() + 1);
  if (bytes_.size() < most) {
    bytes_.resize(most);
    lengths_.resize(most);
  }
  pieces_ = 0;
  counts_.resize(whole.directions);
  std::size_t run = 0;
  for (std::size_t d = 0; d < whole.directions; ++d) {
    const bool steep = layout.directions()[d].steep;
    const std::uint32_t stride = steep ? layout.wide_stride() : layout.tall_stride();
    look_along(d, steep);
    const std::size_t first = pieces_;
    for (const std::size_t last = run + whole.counts[d]; run < last; ++run) {
      const std::uint32_t row_begin = layout.plane_begin(d) + rows[run] * stride;
      const int column = static_cast<int>(whole.begins[run] - row_begin);
      add_pieces(rows[run], column, column + whole.lengths[run], planes_ + row_begin);
    }
    counts_[d] = static_cast<std::uint32_t>(pieces_ - first);
  }
  sum_(bytes_.data(), {nullptr, lengths_.data(), counts_.data(), whole.peaks, whole.directions},
       sums);
}

void PatchedSums::add_pieces(int row, int column, int end, const std::uint8_t* row_begin) {
  while (column < end) {
    int piece_end = end;
    const Window* inside = nullptr;
    for (const Window& w : windows_) {
      if (!w.meets(row, column, end)) continue;
      if (w.first_column <= column) {
        inside = &w;
        piece_end = std::min(end, w.end_column);
        break;
      }
      piece_end = std::min(piece_end, w.first_column);
    }
    add(inside == nullptr ? row_begin + column
                          : inside->bytes + (inside->origin + row * inside->stride + column),
        piece_end - column);
    column = piece_end;
  }
}

}  // namespace plaza::edges
