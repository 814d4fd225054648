#pragma once

#include <Eigen/Core>
#include <span>

#include "plaza/geometry/silhouette.h"

namespace plaza {

/// How much a view counts that sees a place badly. Everything that is left out of an image, hidden,
/// small or blurred makes a silhouette's log-likelihood, which is a mean over its pixels, less sure
/// without making it smaller.
struct ViewTrust {
  bool visible_share = false;  ///< whether a view counts by the share of the silhouette it can see
  double sharp_px = 0;         ///< a body less high than that counts proportionally less
  double edge_loss = 0;        ///< share lost in the image's corners, growing with distance squared

  double hidden_loss = 0;  ///< share lost where others wholly hide the silhouette's box
  double empty_views = 0;  ///< views that count as having seen an empty place

  /// In [0, 1], of a silhouette in an image of that size, pixels.
  double of(const Silhouette& silhouette, const Eigen::Vector2i& image_size) const;
  /// In [0, 1], of a silhouette with that box in a view in which others are accounted for.
  double of_hidden(const Box& silhouette, std::span<const Box> others) const;
};

}  // namespace plaza
