#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <span>
#include <vector>

#include "plaza/data/ground_truth.h"
#include "plaza/data/track.h"
#include "plaza/geometry/scene.h"
#include "plugins/sinks/drawing/trails.h"

namespace plaza::overlay {

enum class Draw { kBoxes, kCylinders, kBoth };

struct ViewStyle {
  Draw draw = Draw::kBoxes;
  bool area = true;
  std::int64_t trail_gap_frames = 1;  ///< longer gaps are not bridged
};

/// What is drawn over one view in one frame.
struct ViewContent {
  cv::Mat image;  ///< empty: none in this frame
  std::span<const TrackPoint> tracks;
  const drawing::TrailMemory* trails = nullptr;
  const GroundTruth* truth = nullptr;  ///< null: not drawn
};

/// Draws one camera's tile: its image, or the ground grid as long as it has never shown one, or a
/// dark tile where its image is missing; then people from far to near.
class ViewPainter {
 public:
  ViewPainter(const Scene& scene, std::size_t camera, cv::Size tile, const ViewStyle& style);
  /// `tile` has the size given; it is overwritten.
  void paint(cv::Mat tile, const ViewContent& content);

 private:
  void paint_background(cv::Mat& tile, const cv::Mat& image);
  void paint_trails(cv::Mat& tile, const drawing::TrailMemory& trails) const;
  void paint_truth(cv::Mat& tile, const GroundTruth& truth) const;
  void paint_person(cv::Mat& tile, const TrackPoint& person) const;
  void paint_label(cv::Mat& tile, const TrackPoint& person) const;
  std::optional<Box> box_of(const TrackPoint& person) const;
  Box scaled(const Box& box) const;
  bool in_picture(const Box& box) const;

  std::size_t index_;
  Camera camera_;  ///< for a picture of the tile's size
  Body body_;
  GroundArea area_;
  cv::Size tile_;
  double scale_x_, scale_y_;  ///< tile pixels per image pixel
  double text_px_;
  int line_px_;
  ViewStyle style_;
  cv::Mat plain_;  ///< the tile of a view without images
  bool has_shown_image_ = false;
};

}  // namespace plaza::overlay
