#include "modalities/common/shrink.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <span>
#include <stdexcept>
#include <utility>

namespace plaza {
namespace {

/// Rows [begin, end) of spans, all within one row of blocks, as spans of blocks.
void append_row(std::span<const RowSpan> spans, int times, std::vector<std::int32_t>& covered,
                std::vector<RowSpan>& out) {
  if (spans.empty()) return;
  std::int32_t first = spans.front().begin, last = spans.front().end;
  for (const RowSpan& s : spans) first = std::min(first, s.begin), last = std::max(last, s.end);
  const std::int32_t left = first / times, right = (last + times - 1) / times;
  covered.assign(static_cast<std::size_t>(right - left), 0);
  for (const RowSpan& s : spans) {
    for (std::int32_t block = s.begin / times; block * times < s.end; ++block) {
      covered[static_cast<std::size_t>(block - left)] +=
          std::min(s.end, (block + 1) * times) - std::max(s.begin, block * times);
    }
  }
  const std::int32_t row = spans.front().row / times;
  const std::int32_t half = (times * times + 1) / 2;
  for (std::int32_t block = left; block < right; ++block) {
    if (covered[static_cast<std::size_t>(block - left)] < half) continue;
    if (!out.empty() && out.back().row == row && out.back().end == block) {
      ++out.back().end;
    } else {
      out.push_back({row, block, block + 1});
    }
  }
}

}  // namespace

Shrink::Shrink(int times) : times_(times) {
  if (times < 1 || times > kMost) throw std::invalid_argument("shrink out of range");
}

bool Shrink::fits(const Scene& scene) const {
  Diagnostics faults;
  check(scene, faults);
  return faults.empty();
}

void Shrink::check(const Scene& scene, Diagnostics& faults) const {
  for (const Camera& camera : scene.cameras) {
    if (camera.width() % times_ == 0 && camera.height() % times_ == 0) continue;
    faults.push_back(fault_at(
        "/shrink", "images of camera '" + camera.name() + "' are " +
                       std::to_string(camera.width()) + "x" + std::to_string(camera.height()) +
                       ", which can't be divided by " + std::to_string(times_) +
                       "; choose a number that divides both, 1 leaves images as they are"));
  }
}

std::shared_ptr<const Scene> Shrink::operator()(std::shared_ptr<const Scene> scene) const {
  if (times_ == 1) return scene;
  auto small = std::make_shared<Scene>(*scene);
  for (Camera& camera : small->cameras) {
    camera = camera.scaled({camera.width() / times_, camera.height() / times_});
  }
  for (StaticOccluder& occluder : small->occluders) {
    for (Eigen::Vector2d& p : occluder.polygon_px) p = ((p.array() + 0.5) / times_ - 0.5).matrix();
  }
  return small;
}

cv::Mat Shrink::operator()(const cv::Mat& image) const {
  if (times_ == 1) return image;
  cv::Mat small;
  cv::resize(image, small, {image.cols / times_, image.rows / times_}, 0, 0, cv::INTER_AREA);
  return small;
}

Silhouette Shrink::operator()(Silhouette silhouette) const {
  if (times_ == 1) return silhouette;
  Silhouette small;
  small.inside_share = silhouette.inside_share;
  const double by = 1.0 / times_;
  small.box = {.left = silhouette.box.left * by + (0.5 * by - 0.5),
               .top = silhouette.box.top * by + (0.5 * by - 0.5),
               .width = silhouette.box.width * by,
               .height = silhouette.box.height * by};
  const auto factor = static_cast<float>(by);
  for (std::size_t i = 0; i < silhouette.contour.size(); i += static_cast<std::size_t>(times_)) {
    const ContourPoint& p = silhouette.contour[i];
    small.contour.push_back({((p.pixel.array() + 0.5F) * factor - 0.5F).matrix(), p.normal});
  }
  const std::span<const RowSpan> spans(silhouette.spans);
  std::vector<std::int32_t> covered;
  for (std::size_t begin = 0; begin < spans.size();) {
    std::size_t end = begin;
    while (end < spans.size() && spans[end].row / times_ == spans[begin].row / times_) ++end;
    append_row(spans.subspan(begin, end - begin), times_, covered, small.spans);
    begin = end;
  }
  return small;
}

cv::Mat Shrink::back(const cv::Mat& small) const {
  if (times_ == 1 || small.empty()) return small;
  cv::Mat large;
  cv::resize(small, large, small.size() * times_, 0, 0, cv::INTER_NEAREST);
  return large;
}

std::vector<Picture> Shrink::back(std::vector<Picture> pictures) const {
  for (Picture& picture : pictures) picture.image = back(picture.image);
  return pictures;
}

}  // namespace plaza
