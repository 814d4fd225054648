#include "modalities/color/living_background.h"

#include <stdexcept>
#include <utility>

namespace plaza::color {

Segmented segment_living(const cv::Mat& image, const Modality::Past& past,
                         const std::shared_ptr<const Ground>& learned, double seconds,
                         const LivingOptions& options, const MakeGround& make) {
  Segmented out;
  out.ground = learned;
  if (!options.lives()) {
    out.segmentation = learned->segmenter->segment(image, past.foreground);
    return out;
  }
  auto now = std::make_shared<LivingMemory>();
  const auto* const before = dynamic_cast<const LivingMemory*>(past.memory.get());
  if (past.memory != nullptr && before == nullptr) {
    throw std::invalid_argument("the memory of another modality");
  }
  if (before != nullptr) out.ground = before->ground;
  const cv::Mat& background = out.ground->background->image;
  cv::Mat seen = image;
  if (options.follow_light) {
    if (before != nullptr) now->light = before->light;
    now->light.all = light_of_all(image, background, past.foreground, now->light.all);
    seen = relight(image, background, now->light);
  }
  out.segmentation = out.ground->segmenter->segment(seen, past.foreground);
  if (options.follow_light) {
    now->light.here = light_of_cells(image, background, out.segmentation.mask, now->light, seconds,
                                     options.light);
  }
  now->ground = out.ground;
  if (options.settling) {
    now->settling = settle(before != nullptr ? before->settling : Settling(), seen,
                           out.segmentation.mask, seconds, *options.settling);
    auto changed = settled(*out.ground->background, now->settling, *options.settling);
    if (changed) now->ground = make(std::move(*changed));
  }
  out.memory = std::move(now);
  return out;
}

}  // namespace plaza::color
