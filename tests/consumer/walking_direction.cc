#include "walking_direction.h"

#include <cmath>
#include <utility>

namespace consumer {

plaza::Declaration<WalkingDirection::Options> WalkingDirection::declare() {
  plaza::Parameters<Options> p;
  p.value("reach_m", &Options::reach_m)
      .unit("m")
      .above(0)
      .meaning("longest step from frame to frame");
  p.value("least_step_m", &Options::least_step_m)
      .unit("m")
      .at_least(0)
      .meaning("shorter steps say nothing of the direction");
  plaza::Declaration<Options> d("walking-direction",
                                "Heading from the step since the frame before");
  d.input<plaza::Observations>("people").output<plaza::Observations>(
      "the same people with headings");
  d.memory().parameters(std::move(p));
  return d;
}

WalkingDirection::WalkingDirection(const Options& options, const plaza::BuildContext& /*context*/)
    : options_(options) {
  if (options.least_step_m >= options.reach_m) {
    throw plaza::UserError("least_step_m must be less than reach_m");
  }
}

void WalkingDirection::do_describe(const plaza::NodeIo& /*io*/, plaza::Observations& observations) {
  std::vector<Eigen::Vector2d> now_m;
  for (plaza::Observation& o : observations.items) {
    now_m.push_back(o.position_m);
    double nearest_m = options_.reach_m;
    for (const Eigen::Vector2d& before : before_m_) {
      const Eigen::Vector2d step = o.position_m - before;
      if (step.norm() >= nearest_m || step.norm() < options_.least_step_m) continue;
      nearest_m = step.norm();
      o.heading_rad = std::atan2(step.y(), step.x());
    }
  }
  before_m_ = std::move(now_m);
}

}  // namespace consumer
