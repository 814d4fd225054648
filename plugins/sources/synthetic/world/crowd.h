#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "plugins/sources/synthetic/world/stage.h"

namespace plaza::synthetic {

/// Which way a walker's torso is to face.
struct Facing {
  enum class Mode {
    kMotion,  ///< the direction of motion plus `angle_rad`; where it stands, as it came
    kPoint,   ///< towards `point_m`
    kPerson,  ///< towards another walker
    kFixed,   ///< `angle_rad`, 0 along +x
    kSpin,    ///< turning at `angle_rad` per second
  };
  Mode mode = Mode::kMotion;
  double angle_rad = 0;
  Eigen::Vector2d point_m = Eigen::Vector2d::Zero();
  std::size_t person = 0;
};

/// A person as others avoid it: a disc with an intention.
struct Walker {
  bool present = false;
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();
  double heading = 0;  ///< not wrapped
  double yaw_rate = 0;

  // what it wants
  std::vector<Eigen::Vector2d> way;  ///< way points still to be passed
  double speed = 1.2;                ///< when nothing is in the way
  Facing facing;
  bool confined = true;  ///< keeps to the observed area

  // how near others may come
  double space_m = 0.30;          ///< radius of its personal space while walking
  int group = -1;                 ///< walkers of one group (>= 0) come nearer to each other:
  double group_distance_m = 0.6;  ///< as near as this
  bool settled = false;           ///< stays where it is and lets others walk around it

  // inner state of a decision
  Eigen::Vector2d wish = Eigen::Vector2d::Zero();
};

/// Walkers that avoid each other as people do. Each decides a few times per second on a velocity,
/// out of many possible ones: near to what it wants, without collisions soon, of which it takes its
/// half of the avoidance (reciprocal velocity obstacles; van den Berg et al., ICRA 2008) and
/// rather passes on the right. Accelerations, turning rates and sideways speeds stay those of
/// people. Bodies never overlap: what anticipation could not avoid is pushed apart.
class Crowd {
 public:
  static constexpr double kTickS = 0.02;
  /// Centres of two bodies come no nearer than this, unless they are in one group.
  static constexpr double kBodyDistance = 0.46;

  explicit Crowd(const Stage& stage) : stage_(&stage) {}

  std::vector<Walker> walkers;

  /// Moves everyone on by kTickS.
  void tick();

 private:
  Eigen::Vector2d wanted_velocity(const Walker& walker) const;
  void decide(std::size_t who);
  double cost(std::size_t who, const Eigen::Vector2d& velocity,
              const Eigen::Vector2d& wanted) const;
  double obstruction(const Walker& walker, const Eigen::Vector2d& point) const;
  void turn(Walker& walker) const;
  void push_apart();

  const Stage* stage_;
  std::size_t ticks_ = 0;
};

}  // namespace plaza::synthetic
