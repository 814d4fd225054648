#include "modalities/edges/hidden_region.h"

#include <algorithm>

namespace plaza::edges {

HiddenRegion::HiddenRegion(const PlaneLayout& layout)
    : size_(layout.size()),
      wide_stride_(layout.wide_stride()),
      tall_stride_(layout.tall_stride()),
      wide_(wide_stride_ * static_cast<std::size_t>(size_.height), 0),
      tall_(tall_stride_ * static_cast<std::size_t>(size_.width), 0) {}

void HiddenRegion::add(std::span<const RowSpan> spans, int margin_px) {
  for (const RowSpan& span : spans) {
    const auto begin = static_cast<std::size_t>(std::max(span.begin - margin_px, 0));
    const auto end = static_cast<std::size_t>(std::min(span.end + margin_px, size_.width));
    for (const int row : {span.row - margin_px, span.row, span.row + margin_px}) {
      if (row < 0 || row >= size_.height) continue;
      const auto y = static_cast<std::size_t>(row);
      std::fill_n(wide_.data() + y * wide_stride_ + begin, end - begin, std::uint8_t{1});
      for (std::size_t x = begin; x < end; ++x) tall_[x * tall_stride_ + y] = 1;
    }
  }
}

}  // namespace plaza::edges
