#pragma once

#include <functional>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "modalities/color/background.h"
#include "modalities/color/light_field.h"
#include "modalities/color/segmenter.h"
#include "modalities/color/settling.h"
#include "plaza/component/modality.h"

namespace plaza::color {

/// A background with what segments images against it.
struct Ground {
  std::shared_ptr<const Background> background;
  std::unique_ptr<const Segmenter> segmenter;
};
using MakeGround = std::function<std::shared_ptr<const Ground>(Background)>;

struct LivingOptions {
  bool follow_light = false;
  LightOptions light;
  std::optional<SettlingOptions> settling;  ///< nothing: what comes to stay remains foreground

  bool lives() const { return follow_light || settling.has_value(); }
};

/// What the frames before have made of a view's background.
struct LivingMemory final : Modality::Memory {
  std::shared_ptr<const Ground> ground;
  LightField light;
  Settling settling;
};

struct Segmented {
  Segmentation segmentation;
  std::shared_ptr<const Ground> ground;  ///< against which
  Modality::MemoryPtr memory;            ///< null for a background that doesn't live
};

/// Segments an image against a background that lives: the image is first put into the background's
/// light (LightField), and what has been foreground for long becomes background (Settling). A pure
/// function. `seconds` have passed since the frame before; `make` turns a changed background into
/// a new Ground.
Segmented segment_living(const cv::Mat& image, const Modality::Past& past,
                         const std::shared_ptr<const Ground>& learned, double seconds,
                         const LivingOptions& options, const MakeGround& make);

}  // namespace plaza::color
