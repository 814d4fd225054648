#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>

#include "modalities/color/background.h"

namespace plaza::color {

struct SettlingOptions {
  double after_s = 120;     ///< that something has to stay
  double interval_s = 0.2;  ///< at which it is looked at
};

/// What may be about to become background: for each pixel of the foreground, what it looks like and
/// for how long it has. Immutable after it was made.
struct Settling {
  cv::Mat candidate;    ///< 8-bit BGR, in the background's light
  cv::Mat1w age;        ///< looks in which the pixel was like this
  double unseen_s = 0;  ///< since the last look
};

/// Looks at an image (8-bit BGR, in the background's light) and its foreground, `seconds` after the
/// last one. A foreground pixel that looks as before grows older, one that looks otherwise
/// (somebody passes) four times as fast younger, and takes the new look at age 0; a
/// background pixel grows younger.
Settling settle(const Settling& before, const cv::Mat& image, const cv::Mat& foreground,
                double seconds, const SettlingOptions& options);

/// The background with what is old enough in it; nothing where nothing is. What was taken over has
/// age 0 in `settling` then.
std::optional<Background> settled(const Background& background, Settling& settling,
                                  const SettlingOptions& options);

}  // namespace plaza::color
