#pragma once

#include <Eigen/Core>
#include <optional>

#include "plaza/data/ground_truth.h"
#include "plaza/geometry/box.h"
#include "plaza/geometry/scene.h"

namespace plaza {

/// Of what both boxes cover, square pixels.
double intersection_area(const Box& a, const Box& b);

/// The image as a box: pixel centres are at integers.
Box image_box(const Camera& camera);

/// A true person's place on the ground: the known one, else where the lower edges of his boxes
/// stand, in the mean over the views; nothing where none of them does.
std::optional<Eigen::Vector2d> place_of(const TruePerson& person, const Scene& scene);

/// A person's box in a view; null where the truth has none.
const Box* box_in(const TruePerson& person, std::size_t camera);

}  // namespace plaza
