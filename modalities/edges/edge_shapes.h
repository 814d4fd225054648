#pragma once

#include <vector>

#include "modalities/common/body_scale.h"
#include "modalities/edges/edge_image.h"
#include "modalities/edges/segmentation.h"

/// Shape analysis of foreground edges (thesis 7.2): what is too short to be of a person's contour
/// at its place, or runs straight for longer than anybody is high, is of no person.
namespace plaza::edges {

/// Takes pieces (8-neighbours) of foreground edges whose longer side would be shorter than
/// `least_m` at their lowest pixel out of the foreground and of `points`.
void drop_short_pieces(const BodyScale& scale, double least_m, LabelImage& labels,
                       std::vector<EdgePoint>& points);

/// Takes straight lines out that would be longer than `longest_m` at their lowest pixel: regions of
/// neighbouring foreground edges whose gradients agree within 22.5 degrees with the region's, and
/// which are slim. What crosses or meets such a line stays, as its gradients differ.
void drop_long_lines(const EdgeImage& image, const BodyScale& scale, double longest_m,
                     LabelImage& labels, std::vector<EdgePoint>& points);

}  // namespace plaza::edges
