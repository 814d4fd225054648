#include "plugins/sources/synthetic/render/body_bounds.h"

#include "plugins/sources/synthetic/render/rays.h"

namespace plaza::synthetic {

Ball ball_of(const Eigen::AlignedBox3f& box) {
  const Eigen::Vector3f c = box.center();
  return {c.x(), c.y(), c.z(), 0.5f * box.diagonal().norm()};
}

BodyBounds bounds_of(const MovingBody& body) {
  BodyBounds out;
  const BodyMesh& mesh = *body.mesh;
  out.patches.resize(mesh.patch_segments().size());
  for (std::size_t v = 0; v < body.open.size(); ++v) {
    Eigen::AlignedBox3f& patch = out.patches[mesh.patches()[v]];
    patch.extend(body.open[v]);
    patch.extend(body.close[v]);
  }
  std::array<Eigen::AlignedBox3f, kSegmentCount> segments;
  Eigen::AlignedBox3f whole;
  for (std::size_t i = 0; i < out.patches.size(); ++i) {
    // triangles reach from one patch's vertices to the next one's
    out.patches[i].min() -= Eigen::Vector3f::Constant(0.03f);
    out.patches[i].max() += Eigen::Vector3f::Constant(0.03f);
    segments[mesh.patch_segments()[i]].extend(out.patches[i]);
    whole.extend(out.patches[i]);
  }
  for (const auto& box : segments) {
    if (!box.isEmpty()) out.segments.push_back(ball_of(box));
  }
  out.whole = ball_of(whole);
  return out;
}

}  // namespace plaza::synthetic
