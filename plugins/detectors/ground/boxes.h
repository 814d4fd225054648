#pragma once

#include "plaza/component/declaration.h"
#include "plugins/detectors/common/box_ground.h"

namespace plaza {

/// Ground observations from given image boxes: one per box, where its feet stand.
class BoxesDetector final : public Detector {
 public:
  struct Options : BoxGroundOptions {};
  static Declaration<Options> declare();
  BoxesDetector(const Options& options, const BuildContext& context);

 private:
  Observations do_detect(const NodeIo& io) const override;

  std::shared_ptr<const Scene> scene_;
  BoxGround ground_;
};

}  // namespace plaza
