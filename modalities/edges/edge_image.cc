#include "modalities/edges/edge_image.h"

#include <opencv2/imgproc.hpp>

namespace plaza::edges {

void find_edges(const cv::Mat& image, const EdgeOptions& options, EdgeImage& out) {
  if (image.channels() == 3) {
    cv::cvtColor(image, out.grey, cv::COLOR_BGR2GRAY);
  } else {
    image.copyTo(out.grey);
  }
  if (options.blur_px > 0) {
    cv::GaussianBlur(out.grey, out.grey, {}, options.blur_px, options.blur_px,
                     cv::BORDER_REPLICATE);
  }
  cv::Sobel(out.grey, out.dx, CV_16S, 1, 0, 3, 1, 0, cv::BORDER_REPLICATE);
  cv::Sobel(out.grey, out.dy, CV_16S, 0, 1, 3, 1, 0, cv::BORDER_REPLICATE);
  if (options.method == EdgeMethod::kCanny) {
    cv::Canny(out.dx, out.dy, out.edges, options.low, options.high, true);
    return;
  }
  out.edges.create(out.grey.size());
  const double least = options.high * options.high;
  for (int y = 0; y < out.grey.rows; ++y) {
    const short *dx = out.dx[y], *dy = out.dy[y];
    unsigned char* edges = out.edges[y];
    for (int x = 0; x < out.grey.cols; ++x) {
      edges[x] = dx[x] * dx[x] + dy[x] * dy[x] >= least ? 255 : 0;
    }
  }
}

}  // namespace plaza::edges
