#include "modalities/edges/fast_transform.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <new>
#include <stdexcept>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace plaza::edges {
namespace {

constexpr std::size_t kMargin = 64;  // a cache line before the first plane and behind the last
constexpr std::align_val_t kAlignment{64};

/// At least one byte of padding, which stays 0, ends every row: what lies before a row and behind
/// it is "no edge", so that lines that leave the image need no test.
std::uint32_t padded(int columns) {
  return (static_cast<std::uint32_t>(columns) / kSweepBytes + 1) * kSweepBytes;
}

/// Bit i: whether bytes[i] is not 0; 64 bytes.
std::uint64_t nonzero_bits(const std::uint8_t* bytes) {
  std::uint64_t bits = 0;
#if defined(__SSE2__)
  for (int i = 0; i < 64; i += 16) {
    const __m128i v = _mm_loadu_si128(reinterpret_cast<const __m128i*>(bytes + i));
    const int zero = _mm_movemask_epi8(_mm_cmpeq_epi8(v, _mm_setzero_si128()));
    bits |= static_cast<std::uint64_t>(~zero & 0xFFFF) << i;
  }
#else
  for (int i = 0; i < 64; ++i) bits |= std::uint64_t{bytes[i] != 0} << i;
#endif
  return bits;
}

}  // namespace

PlaneLayout::PlaneLayout(cv::Size size, std::vector<Direction> directions)
    : size_(size), directions_(std::move(directions)) {
  if (size.width < 1 || size.height < 1 || size.width > 32767 || size.height > 32767) {
    throw std::invalid_argument("a transform needs an image of 1 to 32767 rows and columns");
  }
  if (directions_.empty()) throw std::invalid_argument("a transform needs a direction");
  wide_stride_ = padded(size.width);
  tall_stride_ = padded(size.height);
  std::size_t next = kMargin;
  for (const Direction& d : directions_) {
    plane_begin_.push_back(static_cast<std::uint32_t>(next));
    next += d.steep ? std::size_t{wide_stride_} * static_cast<std::size_t>(size.height)
                    : std::size_t{tall_stride_} * static_cast<std::size_t>(size.width);
  }
  bytes_ = next + kMargin;
  if (bytes_ > UINT32_MAX) throw std::invalid_argument("a transform of more than 4 GB");
}

cv::Point PlaneLayout::pixel(std::size_t direction, std::uint32_t offset) const {
  const std::uint32_t inside = offset - plane_begin_[direction];
  const bool steep = directions_[direction].steep;
  const std::uint32_t stride = steep ? wide_stride_ : tall_stride_;
  const int row = static_cast<int>(inside / stride), column = static_cast<int>(inside % stride);
  return steep ? cv::Point(column, row) : cv::Point(row, column);
}

ByteBlock::ByteBlock(std::size_t bytes)
    : size_(bytes), bytes_(static_cast<std::uint8_t*>(::operator new(bytes, kAlignment))) {
  std::memset(bytes_.get(), 0, bytes);
}
void ByteBlock::Free::operator()(std::uint8_t* p) const { ::operator delete(p, kAlignment); }

void append_points(const cv::Mat1b& edges, std::vector<EdgePoint>& points) {
  constexpr int kWord = 64;
  std::size_t count = points.size();
  for (int y = 0; y < edges.rows; ++y) {
    // room for a whole row, so that no point asks for it
    points.resize(count + static_cast<std::size_t>(edges.cols));
    const std::uint8_t* row = edges[y];
    for (int begin = 0; begin < edges.cols; begin += kWord) {
      // the word's edges as bits: no branch per pixel, which would be guessed wrong at every
      // contour
      std::uint64_t bits = 0;
      if (begin + kWord <= edges.cols) {
        bits = nonzero_bits(row + begin);
      } else {
        for (int x = begin; x < edges.cols; ++x) {
          bits |= std::uint64_t{row[x] != 0} << (x - begin);
        }
      }
      for (; bits != 0; bits &= bits - 1) {
        points[count++] = {static_cast<std::int16_t>(begin + std::countr_zero(bits)),
                           static_cast<std::int16_t>(y)};
      }
    }
  }
  points.resize(count);
}

FastTransform::FastTransform(std::shared_ptr<const PlaneLayout> layout, Sweep sweep)
    : layout_(std::move(layout)),
      sweep_(sweep),
      wide_(std::size_t{layout_->wide_stride()} * static_cast<std::size_t>(layout_->size().height)),
      tall_(std::size_t{layout_->tall_stride()} * static_cast<std::size_t>(layout_->size().width)) {
  const cv::Size size = layout_->size();
  longest_ = static_cast<std::size_t>(std::max(size.width, size.height));
  drift_.resize(layout_->directions().size() * longest_);
  for (std::size_t d = 0; d < layout_->directions().size(); ++d) {
    const Direction& direction = layout_->directions()[d];
    for (std::size_t row = 1; row < longest_; ++row) {
      const int r = static_cast<int>(row);
      drift_[d * longest_ + row] =
          static_cast<std::int8_t>(direction.shift(r) - direction.shift(r - 1));
    }
  }
}

void FastTransform::draw(const PlaneLayout& layout, cv::Point origin, std::uint8_t value) {
  const std::size_t wide = layout.wide_stride(), tall = layout.tall_stride();
  for (const EdgePoint p : drawn_) {
    const auto x = static_cast<std::size_t>(p.x - origin.x);
    const auto y = static_cast<std::size_t>(p.y - origin.y);
    wide_.data()[y * wide + x] = value;
    tall_.data()[x * tall + y] = value;
  }
}

void FastTransform::run(std::span<const EdgePoint> edges, ByteBlock& block) {
  if (block.size() < layout_->bytes()) throw std::invalid_argument("block is too small");
  draw(*layout_, {}, 0);  // what the last call drew is a twentieth of the image
  drawn_.assign(edges.begin(), edges.end());
  draw(*layout_, {}, 255);
  sweep_planes(*layout_, {}, block.data());
}

void FastTransform::run(std::span<const EdgePoint> edges, const cv::Rect& window,
                        const PlaneLayout& part, std::uint8_t* planes) {
  if ((window & cv::Rect({}, layout_->size())) != window || window.size() != part.size()) {
    throw std::invalid_argument("a window that isn't inside the image");
  }
  draw(*layout_, {}, 0);
  drawn_.clear();
  for (const EdgePoint p : edges) {
    if (window.contains({p.x, p.y})) drawn_.push_back(p);
  }
  std::memset(planes, 0, kMargin);
  std::memset(planes + part.bytes() - kMargin, 0, kMargin);
  draw(part, window.tl(), 255);
  sweep_planes(part, window.tl(), planes);
  draw(part, window.tl(), 0);
  drawn_.clear();
}

void FastTransform::run(const cv::Mat1b& edges, ByteBlock& block) {
  if (edges.size() != layout_->size()) throw std::invalid_argument("edges of another size");
  found_.clear();
  append_points(edges, found_);
  run(found_, block);
}

void FastTransform::sweep_planes(const PlaneLayout& layout, cv::Point origin,
                                 std::uint8_t* planes) {
  const cv::Size size = layout.size();
  for (std::size_t d = 0; d < layout.directions().size(); ++d) {
    const Direction& direction = layout.directions()[d];
    SweepTask task;
    task.plane = planes + layout.plane_begin(d);
    task.edges = direction.steep ? wide_.data() : tall_.data();
    task.rows = direction.steep ? size.height : size.width;
    task.columns = direction.steep ? size.width : size.height;
    task.stride = direction.steep ? layout.wide_stride() : layout.tall_stride();
    task.drift = drift_.data() + d * longest_ +
                 static_cast<std::size_t>(direction.steep ? origin.y : origin.x);
    task.peak = static_cast<std::uint8_t>(direction.gate + 1);
    sweep_(task);
  }
}

}  // namespace plaza::edges
