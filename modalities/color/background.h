#pragma once

#include <cstddef>
#include <iosfwd>
#include <opencv2/core/mat.hpp>
#include <vector>

namespace plaza::color {

/// What one view looks like without people. Empty matrices: nothing is known of this view.
struct Background {
  cv::Mat image;  ///< 8-bit BGR
  cv::Mat noise;  ///< float, 1 channel, grey levels: standard deviation of one channel of a pixel

  bool empty() const { return image.empty(); }
};

/// Learns the background of one view from frames in which every pixel is free of people most of the
/// time.
///
/// A pixel's colour is the median of each channel over the samples, its noise the median absolute
/// deviation from it, averaged over the channels and scaled to the standard deviation of a Gaussian
/// (x 1.4826); neither feels what happens in less than half of the samples. From a single sample
/// the noise is 0: the caller's least noise stands in for it.
///
/// Samples are kept as they are (images are shared, not copied), at most `most_samples` of them:
/// when there are more, every second one is dropped and from then on only every second frame is
/// taken, so that a recording of any length is sampled evenly.
class BackgroundLearner {
 public:
  explicit BackgroundLearner(std::size_t most_samples) : most_samples_(most_samples) {}

  /// `image` is 8-bit BGR and never written to afterwards. Throws UserError when it is of another
  /// size than those before.
  void add(const cv::Mat& image);
  std::size_t samples() const { return samples_.size(); }
  /// Empty when no image was added.
  Background background() const;

 private:
  std::size_t most_samples_;
  std::size_t stride_ = 1;  ///< of the images that are taken
  std::size_t seen_ = 0;
  std::vector<cv::Mat> samples_;
};

/// Writes the backgrounds of all views; load_backgrounds() gives the same bits back.
void save_backgrounds(const std::vector<Background>& views, std::ostream& out);
/// Throws UserError when the content is truncated, damaged or of another format.
std::vector<Background> load_backgrounds(std::istream& in);

}  // namespace plaza::color
