#pragma once

#include <Eigen/Geometry>
#include <vector>

namespace plaza::synthetic {

struct MovingBody;

/// A ball: centre and radius.
using Ball = Eigen::Vector4f;

Ball ball_of(const Eigen::AlignedBox3f& box);

/// What holds a body during one exposure, more and more tightly.
struct BodyBounds {
  Ball whole;
  std::vector<Ball> segments;
  std::vector<Eigen::AlignedBox3f> patches;  ///< of its surface, 0.2 m or so wide
};

BodyBounds bounds_of(const MovingBody& body);

}  // namespace plaza::synthetic
