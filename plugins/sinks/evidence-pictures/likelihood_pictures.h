#pragma once

#include <opencv2/core/mat.hpp>
#include <span>
#include <vector>

#include "plaza/data/observation.h"
#include "plaza/geometry/camera.h"
#include "plugins/sinks/drawing/palette.h"

/// Pictures of a likelihood over the cells of the ground (thesis Figures 4.8-4.10).
namespace plaza::evidence_pictures {

/// Log-likelihoods as shares of the best cell's likelihood, exp(l - max), in [0, 1]; NaN stays NaN.
std::vector<double> relative_likelihood(std::span<const double> log_likelihood);

/// Colour of a share in [0, 1]: dark violet over green to yellow, brighter the more, for the colour
/// blind too (viridis).
drawing::Color likelihood_color(double share);

/// The image in grey with every cell's disk on the ground: the likelier, the larger and brighter.
/// Cells with less than a hundredth of the best one, or NaN, stay empty. `shares`: [row * columns +
/// column]; the image has the camera's size, or is empty.
cv::Mat likelihood_on_view(const cv::Mat& image, const Camera& camera, const GroundGrid& grid,
                           std::span<const double> shares);

/// The likelihood as a surface over the ground, seen from the south-west and above, with axes in
/// metres. Cells with NaN leave holes.
cv::Mat likelihood_surface(const GroundGrid& grid, std::span<const double> shares, cv::Size size);

}  // namespace plaza::evidence_pictures
