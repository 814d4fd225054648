#pragma once

#include <opencv2/core/mat.hpp>

namespace plaza::edges {

enum class EdgeMethod { kCanny, kSobel };

/// How edges are found. Thresholds are lengths of the gradient (Sobel 3 x 3, unscaled: a step of
/// one grey level gives up to 4).
struct EdgeOptions {
  EdgeMethod method = EdgeMethod::kCanny;
  double low = 60;     ///< Canny's lower threshold
  double high = 120;   ///< Canny's upper threshold, Sobel's only one
  double blur_px = 0;  ///< sigma of a Gaussian before; 0: none
};

/// Edges of one image with the gradients that give their orientation (thesis 4.3.2: Theta, G_x,
/// G_y). Buffers are reused from image to image.
struct EdgeImage {
  cv::Mat1b edges;   ///< 255 at edges, else 0
  cv::Mat1s dx, dy;  ///< Sobel gradients
  cv::Mat1b grey;    ///< as the gradients were taken from
};

/// `image`: 8-bit BGR or grey, not empty.
void find_edges(const cv::Mat& image, const EdgeOptions& options, EdgeImage& out);

}  // namespace plaza::edges
