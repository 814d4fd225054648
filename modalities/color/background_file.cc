// The bytes of learned backgrounds: a header, then per view its size, colours and noise, then a sum
// over all of it. The kernel's cache guards against torn files; the sum here guards against a file
// that some other version, or a bit, has changed.
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <istream>
#include <ostream>
#include <string>

#include "modalities/color/background.h"
#include "plaza/core/error.h"

namespace plaza::color {
namespace {

constexpr std::array<char, 8> kMagic = {'P', 'Z', 'C', 'O', 'L', 'O', 'R', '1'};
constexpr std::uint32_t kMostViews = 1024;
constexpr std::uint32_t kLargestSide = 1 << 15;

class Sum {
 public:
  void add(const void* bytes, std::size_t count) {
    const auto* const p = static_cast<const unsigned char*>(bytes);
    for (std::size_t i = 0; i < count; ++i) value_ = (value_ ^ p[i]) * 1099511628211ULL;
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 14695981039346656037ULL;
};

[[noreturn]] void damaged(const std::string& what) {
  throw UserError("the stored background is damaged: " + what + "; it has to be learned again");
}

class Writer {
 public:
  explicit Writer(std::ostream& out) : out_(out) {}
  void bytes(const void* data, std::size_t count) {
    out_.write(static_cast<const char*>(data), static_cast<std::streamsize>(count));
    sum_.add(data, count);
  }
  void number(std::uint32_t value) { bytes(&value, sizeof value); }
  void end() {
    const std::uint64_t sum = sum_.value();
    out_.write(reinterpret_cast<const char*>(&sum), sizeof sum);
  }

 private:
  std::ostream& out_;
  Sum sum_;
};

class Reader {
 public:
  explicit Reader(std::istream& in) : in_(in) {}
  void bytes(void* data, std::size_t count) {
    raw(data, count);
    sum_.add(data, count);
  }
  std::uint32_t number() {
    std::uint32_t value = 0;
    bytes(&value, sizeof value);
    return value;
  }
  void end() {
    std::uint64_t sum = 0;
    raw(&sum, sizeof sum);
    if (sum != sum_.value()) damaged("its check sum is wrong");
    if (in_.peek() != std::istream::traits_type::eof()) damaged("something follows its end");
  }

 private:
  void raw(void* data, std::size_t count) {
    in_.read(static_cast<char*>(data), static_cast<std::streamsize>(count));
    if (static_cast<std::size_t>(in_.gcount()) != count) damaged("it ends too early");
  }
  std::istream& in_;
  Sum sum_;
};

template <class Archive>
void rows(Archive& archive, cv::Mat& matrix) {
  const std::size_t bytes = static_cast<std::size_t>(matrix.cols) * matrix.elemSize();
  for (int y = 0; y < matrix.rows; ++y) archive.bytes(matrix.ptr(y), bytes);
}

}  // namespace

void save_backgrounds(const std::vector<Background>& views, std::ostream& out) {
  Writer writer(out);
  writer.bytes(kMagic.data(), kMagic.size());
  writer.number(static_cast<std::uint32_t>(views.size()));
  for (const Background& view : views) {
    writer.number(static_cast<std::uint32_t>(view.image.cols));
    writer.number(static_cast<std::uint32_t>(view.image.rows));
    cv::Mat image = view.image;  // headers; rows() only reads them here
    cv::Mat noise = view.noise;
    rows(writer, image);
    rows(writer, noise);
  }
  writer.end();
}

std::vector<Background> load_backgrounds(std::istream& in) {
  Reader reader(in);
  std::array<char, 8> magic = {};
  reader.bytes(magic.data(), magic.size());
  if (magic != kMagic) damaged("it is of another format");
  const std::uint32_t count = reader.number();
  if (count > kMostViews) damaged("it speaks of " + std::to_string(count) + " views");
  std::vector<Background> views(count);
  for (Background& view : views) {
    const std::uint32_t width = reader.number();
    const std::uint32_t height = reader.number();
    if (width > kLargestSide || height > kLargestSide || (width == 0) != (height == 0)) {
      damaged("a view of " + std::to_string(width) + "x" + std::to_string(height));
    }
    if (width == 0) continue;
    view.image.create(static_cast<int>(height), static_cast<int>(width), CV_8UC3);
    view.noise.create(view.image.size(), CV_32FC1);
    rows(reader, view.image);
    rows(reader, view.noise);
  }
  reader.end();
  for (const Background& view : views) {
    for (int y = 0; y < view.noise.rows; ++y) {
      for (int x = 0; x < view.noise.cols; ++x) {
        const float sigma = view.noise.at<float>(y, x);
        if (!(std::isfinite(sigma) && sigma >= 0)) damaged("a pixel's noise is no number");
      }
    }
  }
  return views;
}

}  // namespace plaza::color
