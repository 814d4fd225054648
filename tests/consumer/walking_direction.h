#pragma once

#include <plaza/plugin.h>

#include <vector>

namespace consumer {

/// Gives every observation the direction in which the nearest observation of the frame before lies
/// behind it: where people walk, they mostly look.
class WalkingDirection final : public plaza::Describer {
 public:
  struct Options {
    double reach_m = 0.5;
    double least_step_m = 0.02;
  };
  static plaza::Declaration<Options> declare();
  WalkingDirection(const Options& options, const plaza::BuildContext& context);

 protected:
  void do_describe(const plaza::NodeIo& io, plaza::Observations& observations) override;

 private:
  Options options_;
  std::vector<Eigen::Vector2d> before_m_;
};

}  // namespace consumer
