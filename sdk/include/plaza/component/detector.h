#pragma once

#include <memory>

#include "plaza/component/node.h"
#include "plaza/data/ground_likelihood.h"
#include "plaza/data/observation.h"

namespace plaza {

/// Finds people in one frame: from images, evidence, image detections, or other observations
/// (fusion). No memory between frames. Node ports: inputs as declared; out 0 Observations, out 1
/// GroundLikelihood where declared.
class PLAZA_API Detector : public Node {
 public:
  ~Detector() override;
  /// Checks the result: finite positions, positive definite covariances, probabilities in [0, 1],
  /// boxes by rising camera; a violation is an InternalError naming the observation.
  Observations detect(const NodeIo& io) const;

  struct Detected {
    Observations observations;
    std::shared_ptr<const GroundLikelihood> likelihood;  ///< null where the detector has none
  };
  /// detect() with the surface that the observations were found on. Checks it too: one value per
  /// cell, NaN or finite.
  Detected detect_all(const NodeIo& io) const;

 protected:
  virtual Observations do_detect(const NodeIo& io) const = 0;
  /// For detectors that declare a second output; the others' is do_detect() alone.
  virtual Detected do_detect_all(const NodeIo& io) const;

 private:
  void do_process(NodeIo& io) final;
};

}  // namespace plaza
