#include "plugins/detectors/hierarchical-grid/view_trust.h"

#include <algorithm>

namespace plaza {

double ViewTrust::of(const Silhouette& silhouette, const Eigen::Vector2i& image_size) const {
  const Box& box = silhouette.box;
  double trust = visible_share ? silhouette.inside_share : 1;
  if (box.height < sharp_px) trust *= box.height / sharp_px;
  const Eigen::Vector2d half = image_size.cast<double>() / 2;
  const Eigen::Vector2d middle(box.left + box.width / 2, box.top + box.height / 2);
  const double corners = std::min((middle - half).squaredNorm() / half.squaredNorm(), 1.0);
  return trust * (1 - edge_loss * corners);
}

double ViewTrust::of_hidden(const Box& silhouette, std::span<const Box> others) const {
  double visible = 1;
  for (const Box& other : others) {
    const double width =
        std::min(silhouette.right(), other.right()) - std::max(silhouette.left, other.left);
    const double height =
        std::min(silhouette.bottom(), other.bottom()) - std::max(silhouette.top, other.top);
    // as if they hid it independently: boxes are loose, and two seldom cover the same part
    if (width > 0 && height > 0) {
      visible *= 1 - width * height / (silhouette.width * silhouette.height);
    }
  }
  return 1 - hidden_loss * (1 - visible);
}

}  // namespace plaza
