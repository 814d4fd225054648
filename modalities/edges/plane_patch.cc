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
  for (std::size_t i = 0; i < patches_.size(); ++i) {
    if (!(patches_[i]->valid() & templates.box(index)).empty()) near_.push_back(i);
  }
  return !near_.empty();
}

void PatchedSums::sum(const EdgeTemplates& templates, std::size_t index, ContourSum* sums) {
  const ContourRuns whole = templates.runs(index);
  split(templates, index);
  of_part_.resize(whole.directions);
  const auto runs_of = [&](const Part& part) {
    return ContourRuns{part.begins.data(), part.lengths.data(), part.counts.data(), whole.peaks,
                       whole.directions};
  };
  sum_(planes_, runs_of(parts_.back()), sums);
  for (const std::size_t i : near_) {
    sum_(patches_[i]->bytes(), runs_of(parts_[i]), of_part_.data());
    for (std::size_t d = 0; d < whole.directions; ++d) {
      sums[d].squares += of_part_[d].squares;
      sums[d].outliers += of_part_[d].outliers;
    }
  }
}

void PatchedSums::split(const EdgeTemplates& templates, std::size_t index) {
  const PlaneLayout& layout = *templates.layout();
  const ContourRuns whole = templates.runs(index);
  const std::span<const std::uint16_t> rows = templates.rows(index);
  const auto clear = [&](Part& part) {
    part.begins.clear();
    part.lengths.clear();
    part.counts.assign(whole.directions, 0);
  };
  clear(parts_.back());
  for (const std::size_t i : near_) clear(parts_[i]);
  std::size_t run = 0;
  for (std::size_t d = 0; d < whole.directions; ++d) {
    const bool steep = layout.directions()[d].steep;
    const std::uint32_t stride = steep ? layout.wide_stride() : layout.tall_stride();
    const auto add = [&](Part& part, std::uint32_t begin, int length) {
      part.begins.push_back(begin);
      part.lengths.push_back(static_cast<std::uint8_t>(length));
      ++part.counts[d];
    };
    for (const std::size_t last = run + whole.counts[d]; run < last; ++run) {
      const int row = rows[run];
      const std::uint32_t row_begin =
          layout.plane_begin(d) + static_cast<std::uint32_t>(row) * stride;
      int column = static_cast<int>(whole.begins[run] - row_begin);
      const int end = column + whole.lengths[run];
      while (column < end) {  // pieces inside a patch and between them
        int piece_end = end;
        std::size_t inside = patches_.size();
        for (const std::size_t i : near_) {
          const cv::Rect& v = patches_[i]->valid();
          const int first_row = steep ? v.y : v.x, end_row = steep ? v.br().y : v.br().x;
          const int first = steep ? v.x : v.y, behind = steep ? v.br().x : v.br().y;
          if (row < first_row || row >= end_row || behind <= column || first >= end) continue;
          if (first <= column) {
            inside = i;
            piece_end = std::min(end, behind);
            break;
          }
          piece_end = std::min(piece_end, first);
        }
        const std::uint32_t begin =
            inside == patches_.size()
                ? row_begin + static_cast<std::uint32_t>(column)
                : patches_[inside]->offset(d, steep ? column : row, steep ? row : column);
        add(parts_[inside], begin, piece_end - column);
        column = piece_end;
      }
    }
  }
}

}  // namespace plaza::edges
