#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

namespace plaza {

/// Antialiased drawing with sub-pixel positions.
namespace canvas {

inline const cv::Scalar kPaper(246, 247, 247);
inline const cv::Scalar kInk(50, 45, 40);
inline const cv::Scalar kGrid(186, 178, 168);
inline const cv::Scalar kGridStrong(140, 130, 120);
inline const cv::Scalar kArea(20, 110, 235);
inline const cv::Scalar kBody(150, 100, 20);
inline const cv::Scalar kOccluder(160, 60, 150);

/// Colour of the i-th camera; neighbours differ well.
cv::Scalar camera_colour(std::size_t i);

void line(cv::Mat& image, const Eigen::Vector2d& a, const Eigen::Vector2d& b,
          const cv::Scalar& colour, int thickness = 1);
void polyline(cv::Mat& image, const std::vector<Eigen::Vector2d>& points, bool closed,
              const cv::Scalar& colour, int thickness = 1);
/// Filled, of the given opacity in (0, 1].
void fill(cv::Mat& image, const std::vector<Eigen::Vector2d>& points, const cv::Scalar& colour,
          double opacity);
/// Text with a light halo, legible on any background; `at` is its lower left corner.
void text(cv::Mat& image, const std::string& words, const Eigen::Vector2d& at,
          const cv::Scalar& colour, double size = 0.5);
/// The same, its middle at `at`.
void centred_text(cv::Mat& image, const std::string& words, const Eigen::Vector2d& at,
                  const cv::Scalar& colour, double size = 0.5);

}  // namespace canvas

/// Distance between grid lines that keeps the longer side of an area below 40 lines: 1, 2, 5, 10,
/// ... m.
double grid_step_m(const Eigen::Vector2d& size_m);

}  // namespace plaza
