// Key functions: one copy of each payload's and feature's type information, in the SDK library.
#include "plaza/data/detections.h"
#include "plaza/data/evidence.h"
#include "plaza/data/feature.h"
#include "plaza/data/frames.h"
#include "plaza/data/ground_likelihood.h"
#include "plaza/data/ground_truth.h"
#include "plaza/data/observation.h"
#include "plaza/data/track.h"

namespace plaza {

Payload::~Payload() = default;
Feature::~Feature() = default;
std::optional<std::string> Feature::do_save() const { return std::nullopt; }
Evidence::~Evidence() = default;
std::vector<Picture> Evidence::pictures() const { return {}; }
FrameSet::~FrameSet() = default;
Detections::~Detections() = default;
Observations::~Observations() = default;
Tracks::~Tracks() = default;
Tracklets::~Tracklets() = default;
GroundTruth::~GroundTruth() = default;
GroundLikelihood::~GroundLikelihood() = default;
EvidenceSet::~EvidenceSet() = default;
ForegroundMask::~ForegroundMask() = default;

void FeatureSet::set(std::shared_ptr<const Feature> feature) {
  for (auto& existing : features_) {
    if (existing->name() == feature->name()) {
      existing = std::move(feature);
      return;
    }
  }
  features_.push_back(std::move(feature));
}

const Feature* FeatureSet::find(std::string_view name) const {
  for (const auto& feature : features_) {
    if (feature->name() == name) return feature.get();
  }
  return nullptr;
}

}  // namespace plaza
