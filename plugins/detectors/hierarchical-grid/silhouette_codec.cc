#include "plugins/detectors/hierarchical-grid/silhouette_codec.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "plaza/core/error.h"

namespace plaza {
namespace {

constexpr double kUnitsPerPixel = 64;
constexpr double kUnitsPerRadian = 65536 / (2 * std::numbers::pi);

/// Seven bits per byte, the least significant first; small numbers of either sign are short.
void put(std::int64_t value, std::string& bytes) {
  auto rest = (static_cast<std::uint64_t>(value) << 1) ^ static_cast<std::uint64_t>(value >> 63);
  while (rest >= 0x80) {
    bytes.push_back(static_cast<char>(static_cast<unsigned char>(rest | 0x80)));
    rest >>= 7;
  }
  bytes.push_back(static_cast<char>(rest));
}

void put_real(double value, std::string& bytes) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  for (unsigned i = 0; i < 8; ++i) {
    bytes.push_back(static_cast<char>(static_cast<unsigned char>(bits >> (8 * i))));
  }
}

class Reader {
 public:
  Reader(std::string_view bytes, std::size_t at) : bytes_(bytes), at_(at) {}
  std::size_t at() const { return at_; }

  std::int64_t number() {
    std::uint64_t value = 0;
    for (unsigned shift = 0;; shift += 7) {
      if (shift > 63) throw Error("a stored silhouette holds a number that is too long");
      const std::uint64_t b = byte();
      value |= (b & 0x7f) << shift;
      if (b < 0x80) break;
    }
    return static_cast<std::int64_t>(value >> 1) ^ -static_cast<std::int64_t>(value & 1);
  }
  double real() {
    std::uint64_t bits = 0;
    for (unsigned i = 0; i < 8; ++i) bits |= static_cast<std::uint64_t>(byte()) << (8 * i);
    const auto value = std::bit_cast<double>(bits);
    if (!std::isfinite(value)) throw Error("a stored silhouette holds a number that is not finite");
    return value;
  }
  /// A count of things that take at least `least` bytes each.
  std::size_t count(std::size_t least) {
    const std::int64_t n = number();
    if (n < 0 || static_cast<std::uint64_t>(n) > (bytes_.size() - at_) / least) {
      throw Error("a stored silhouette is longer than what is stored");
    }
    return static_cast<std::size_t>(n);
  }

 private:
  unsigned char byte() {
    if (at_ >= bytes_.size()) throw Error("a stored silhouette ends early");
    return static_cast<unsigned char>(bytes_[at_++]);
  }
  std::string_view bytes_;
  std::size_t at_;
};

}  // namespace

void encode(const Silhouette& s, std::string& bytes) {
  for (const double v : {s.box.left, s.box.top, s.box.width, s.box.height, s.inside_share}) {
    put_real(v, bytes);
  }
  put(static_cast<std::int64_t>(s.contour.size()), bytes);
  std::int64_t x = 0, y = 0, angle = 0;
  for (const ContourPoint& p : s.contour) {
    const std::int64_t next_x = std::llround(kUnitsPerPixel * p.pixel.x());
    const std::int64_t next_y = std::llround(kUnitsPerPixel * p.pixel.y());
    const std::int64_t next_angle =
        std::llround(kUnitsPerRadian * std::atan2(p.normal.y(), p.normal.x()));
    put(next_x - x, bytes);
    put(next_y - y, bytes);
    put(next_angle - angle, bytes);
    x = next_x, y = next_y, angle = next_angle;
  }
  put(static_cast<std::int64_t>(s.spans.size()), bytes);
  std::int64_t row = 0, begin = 0;
  for (const RowSpan& span : s.spans) {
    put(span.row - row, bytes);
    put(span.begin - begin, bytes);
    put(span.end - span.begin, bytes);
    row = span.row, begin = span.begin;
  }
}

Silhouette decode(std::string_view bytes, std::size_t& at) {
  Reader in(bytes, at);
  Silhouette s;
  for (double* v : {&s.box.left, &s.box.top, &s.box.width, &s.box.height, &s.inside_share}) {
    *v = in.real();
  }
  s.contour.resize(in.count(3));
  std::int64_t x = 0, y = 0, angle = 0;
  for (ContourPoint& p : s.contour) {
    x += in.number(), y += in.number(), angle += in.number();
    p.pixel << static_cast<float>(static_cast<double>(x) / kUnitsPerPixel),
        static_cast<float>(static_cast<double>(y) / kUnitsPerPixel);
    const double radians = static_cast<double>(angle) / kUnitsPerRadian;
    p.normal << static_cast<float>(std::cos(radians)), static_cast<float>(std::sin(radians));
  }
  s.spans.resize(in.count(3));
  std::int64_t row = 0, begin = 0;
  for (RowSpan& span : s.spans) {
    row += in.number(), begin += in.number();
    span.row = static_cast<std::int32_t>(row);
    span.begin = static_cast<std::int32_t>(begin);
    span.end = static_cast<std::int32_t>(begin + in.number());
  }
  at = in.at();
  return s;
}

}  // namespace plaza
