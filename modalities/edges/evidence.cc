#include "modalities/edges/evidence.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace plaza::edges {
namespace {

const cv::Vec3b kInk(235, 235, 235), kFaint(90, 90, 90), kNew(60, 200, 255);

cv::Mat3b black(cv::Size size) { return {size, cv::Vec3b(0, 0, 0)}; }

/// Edges that have all bits of `shown`, over those of `behind` in grey; `marked` in a colour.
cv::Mat picture_of(const LabelImage& labels, int shown, int behind, int marked) {
  cv::Mat3b image = black(labels.size());
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      const int label = labels.at(x, y);
      if ((label & shown) != 0) {
        image(y, x) = (label & marked) == marked ? kInk : kNew;
      } else if ((label & behind) != 0) {
        image(y, x) = kFaint;
      }
    }
  }
  return image;
}

/// Colour of a direction: hues round the circle, since directions are too; `share` of its light.
cv::Vec3b color_of(double turn, double share) {
  const auto channel = [&](double offset) {
    const double wave = 0.5 + 0.5 * std::cos(2 * CV_PI * (turn + offset));
    return cv::saturate_cast<unsigned char>(share * (40 + 215 * wave));
  };
  return {channel(1.0 / 3), channel(-1.0 / 3), channel(0)};
}

/// Nearness in [0, 1]: 1 on an edge, 0 beyond the gate.
double nearness(const EdgeEvidence& evidence, std::size_t d, int x, int y) {
  return static_cast<double>(evidence.nearness(d, x, y)) /
         (evidence.layout()->directions()[d].gate + 1);
}

/// Each pixel in the colour of the direction in which an edge is nearest.
cv::Mat directions_of(const EdgeEvidence& evidence) {
  const PlaneLayout& layout = *evidence.layout();
  cv::Mat3b image = black(layout.size());
  const std::size_t count = layout.directions().size();
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      std::size_t best = 0;
      double most = 0;
      for (std::size_t d = 0; d < count; ++d) {
        const double near = nearness(evidence, d, x, y);
        if (near > most) most = near, best = d;
      }
      if (most == 1) {
        image(y, x) = {255, 255, 255};
      } else if (most > 0) {
        image(y, x) = color_of(static_cast<double>(best) / static_cast<double>(count), most);
      }
    }
  }
  return image;
}

/// All planes side by side, each as large as fits (Figure 4.7c).
cv::Mat transform_of(const EdgeEvidence& evidence) {
  const PlaneLayout& layout = *evidence.layout();
  cv::Mat3b image = black(layout.size());
  const std::size_t count = layout.directions().size();
  const int columns = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(count))));
  const int rows = (static_cast<int>(count) + columns - 1) / columns;
  const double scale = 1.0 / columns;
  const cv::Size tile(static_cast<int>(image.cols * scale), static_cast<int>(image.rows * scale));
  if (tile.width < 8 || tile.height < 8) return image;
  const int top = (image.rows - rows * tile.height) / 2;
  for (std::size_t d = 0; d < count; ++d) {
    cv::Mat3b plane = black(layout.size());
    for (int y = 0; y < plane.rows; ++y) {
      for (int x = 0; x < plane.cols; ++x) {
        const double near = nearness(evidence, d, x, y);
        if (near > 0)
          plane(y, x) = color_of(static_cast<double>(d) / static_cast<double>(count), near);
      }
    }
    cv::Mat small;
    cv::resize(plane, small, tile, 0, 0, cv::INTER_AREA);
    const cv::Point corner(static_cast<int>(d) % columns * tile.width,
                           top + static_cast<int>(d) / columns * tile.height);
    small.copyTo(image({corner, tile}));
    cv::rectangle(image, {corner, tile}, cv::Scalar(70, 70, 70));
  }
  return image;
}

}  // namespace

int EdgeEvidence::nearness(std::size_t direction, int x, int y) const {
  for (const auto& patch : patches()) {
    if (patch->valid().contains({x, y})) return patch->bytes()[patch->offset(direction, x, y)];
  }
  return block_->planes.data()[layout_->offset(direction, x, y)];
}

std::vector<Picture> EdgeEvidence::pictures() const {
  std::vector<Picture> pictures;
  LabelImage labels(block_->labels.size());
  labels.copy(block_->labels);
  const auto explain = [&](const EdgePoint& p) {
    std::uint8_t& label = labels.at(p.x, p.y);
    label = static_cast<std::uint8_t>((label & ~kForeground) | kExplained);
  };
  if (left_ != nullptr) {
    for (const EdgePoint p : block_->points) explain(p);
    for (const EdgePoint p : left_->points) labels.at(p.x, p.y) = block_->labels.at(p.x, p.y);
  }
  if (hidden_ != nullptr) {
    for (const EdgePoint p : block_->points) {
      if (hidden_->at(p.x, p.y)) explain(p);
    }
  }
  if (background_ != nullptr && background_->known) {
    cv::Mat image;
    cv::cvtColor(background_->edges, image, cv::COLOR_GRAY2BGR);
    pictures.push_back({"background-edges", "edges of the background", image});
  }
  pictures.push_back({"all-edges", "edges of the image", picture_of(labels, kEdge, 0, kEdge)});
  pictures.push_back({"segmented-edges", "left by subtracting the background",
                      picture_of(labels, kSegmented, 0, kSegmented)});
  pictures.push_back({"linked-edges", "foreground (linked: yellow, explained: grey)",
                      picture_of(labels, kForeground, kExplained, kSegmented)});
  pictures.push_back({"directions", "where an edge is nearest, by colour", directions_of(*this)});
  pictures.push_back({"transform", "the transform, one tile per direction", transform_of(*this)});
  return shrink_.back(std::move(pictures));
}

}  // namespace plaza::edges
