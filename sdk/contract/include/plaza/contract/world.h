#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "plaza/data/detections.h"
#include "plaza/data/evidence.h"
#include "plaza/data/frames.h"
#include "plaza/data/ground_truth.h"
#include "plaza/data/observation.h"
#include "plaza/data/track.h"
#include "plaza/geometry/scene.h"

namespace plaza::contract {

/// A small synthetic world that components are tried in: three cameras around a square of 10 m x 10
/// m, four people walking through it. Everything follows from `seed`.
///
/// Awkward on purpose: views without an image, frames in which nobody is seen, missed people, false
/// alarms, people who enter late and leave early.
class World {
 public:
  explicit World(std::uint64_t seed = 1, std::int64_t frames = 40);

  const std::shared_ptr<const Scene>& scene() const { return scene_; }
  std::int64_t frame_count() const { return static_cast<std::int64_t>(frames_.size()); }

  /// What arrives at an input of this type in a frame; null for a type that the world does not
  /// know.
  PayloadPtr payload(std::string_view port, std::int64_t frame) const;
  /// Replaces what arrives, for components that read payload types of their own.
  void provide(std::string port, std::vector<PayloadPtr> by_frame);

  const FrameSet& frames(std::int64_t frame) const { return *at(frame).frames; }
  /// The same moment with nobody there; all views have an image.
  const FrameSet& people_free(std::int64_t frame) const { return *at(frame).people_free; }
  const Detections& detections(std::int64_t frame) const { return *at(frame).detections; }
  const Observations& observations(std::int64_t frame) const { return *at(frame).observations; }
  const GroundTruth& ground_truth(std::int64_t frame) const { return *at(frame).ground_truth; }
  /// The truth as an associator would give it, final.
  const Tracks& true_tracks(std::int64_t frame) const { return *at(frame).true_tracks; }
  /// The truth as a detector would give it.
  const Observations& true_observations(std::int64_t frame) const {
    return *at(frame).true_observations;
  }

 private:
  struct Moment {
    std::shared_ptr<FrameSet> frames = std::make_shared<FrameSet>();
    std::shared_ptr<FrameSet> people_free = std::make_shared<FrameSet>();
    std::shared_ptr<Detections> detections = std::make_shared<Detections>();
    std::shared_ptr<Observations> observations = std::make_shared<Observations>();
    std::shared_ptr<Observations> true_observations = std::make_shared<Observations>();
    std::shared_ptr<GroundTruth> ground_truth = std::make_shared<GroundTruth>();
    std::shared_ptr<Tracks> true_tracks = std::make_shared<Tracks>();
    std::shared_ptr<Tracklets> tracklets = std::make_shared<Tracklets>();
    std::shared_ptr<ForegroundMask> foreground = std::make_shared<ForegroundMask>();
    std::shared_ptr<EvidenceSet> evidence = std::make_shared<EvidenceSet>();
  };
  const Moment& at(std::int64_t frame) const { return frames_.at(static_cast<std::size_t>(frame)); }

  std::shared_ptr<const Scene> scene_;
  std::vector<Moment> frames_;
  std::map<std::string, std::vector<PayloadPtr>, std::less<>> provided_;
};

}  // namespace plaza::contract
