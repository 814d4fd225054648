#pragma once

#include "plaza/component/node.h"
#include "plaza/data/observation.h"

namespace plaza {

/// Finds people in one frame: from images, evidence, image detections, or other observations
/// (fusion). No memory between frames. Node ports: inputs as declared; out 0 Observations.
class PLAZA_API Detector : public Node {
 public:
  ~Detector() override;
  /// Checks the result: finite positions, positive definite covariances, probabilities in [0, 1],
  /// boxes by rising camera; a violation is an InternalError naming the observation.
  Observations detect(const NodeIo& io) const;

 protected:
  virtual Observations do_detect(const NodeIo& io) const = 0;

 private:
  void do_process(NodeIo& io) final;
};

}  // namespace plaza
