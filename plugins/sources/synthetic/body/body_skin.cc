// Which segments a point of the body's surface follows.
#include <algorithm>

#include "plugins/sources/synthetic/body/body_shape.h"
#include "plugins/sources/synthetic/people/skeleton.h"

namespace plaza::synthetic {
namespace {

/// The four that weigh most, made to add up to 1.
SkinWeights strongest(std::array<float, kSegmentCount> w) {
  SkinWeights out;
  float sum = 0;
  for (std::size_t k = 0; k < out.weight.size(); ++k) {
    const auto most = std::max_element(w.begin(), w.end());
    out.segment[k] = static_cast<std::uint8_t>(most - w.begin());
    out.weight[k] = *most;
    sum += *most;
    *most = 0;
  }
  for (float& weight : out.weight) weight /= sum;
  return out;
}

}  // namespace

SkinWeights BodyShape::weights(const Vec3& p) const {
  std::array<float, kSegmentCount> w{};
  const auto add = [&](Segment s, float weight) { w[static_cast<std::size_t>(s)] += weight; };
  const SideSegments& near_arm = kSides[p.y() > 0 ? 0 : 1];
  const Vec3 m = mirrored(p);
  const float d_arm = arm(m);
  const ArmPlace place = arm_place(p);
  float on_arm =
      smoothstep(-0.03f, 0.05f, torso(p) - d_arm) * smoothstep(-0.05f, 0.05f, place.along);
  if (p.z() > at_.neck + 0.02f || p.z() < at_.hip - 0.25f) on_arm = 0;
  if (look_.bag_kind != Bag::kNone && on_bag(p)) {
    on_arm = 0;
    add(look_.bag_kind == Bag::kBackpack ? Segment::kChest : Segment::kPelvis, 1.0f);
  } else {
    // the trunk, from below
    const float body = 1 - on_arm;
    const float to_legs = smoothstep(at_.hip + 0.06f, at_.hip - 0.10f, p.z());
    const float abdomen = smoothstep(at_.waist - 0.06f, at_.waist + 0.06f, p.z());
    const float chest = smoothstep(at_.chest - 0.07f, at_.chest + 0.07f, p.z());
    const float neck = smoothstep(at_.neck - 0.03f, at_.neck + 0.03f, p.z());
    const float head = smoothstep(at_.head - 0.03f, at_.head + 0.02f, p.z());
    add(Segment::kPelvis, body * (1 - abdomen) * (1 - to_legs));
    add(Segment::kAbdomen, body * abdomen * (1 - chest));
    add(Segment::kChest, body * chest * (1 - neck));
    add(Segment::kNeck, body * neck * (1 - head));
    add(Segment::kHead, body * neck * head);
    if (to_legs > 0) {
      const bool cloth = skirted_ && skirt(p) < leg(m) - 0.004f;
      const float seam = cloth ? 0.14f : 0.03f;
      const float left_share = smoothstep(-seam, seam, p.y());
      const float stiff = cloth ? 0.35f : 0.0f;  // cloth follows the legs less than trousers do
      add(Segment::kPelvis, body * to_legs * stiff);
      const float shin = cloth ? 0 : smoothstep(at_.knee + 0.06f, at_.knee - 0.06f, p.z());
      const float foot = cloth ? 0 : smoothstep(at_.ankle + 0.03f, at_.ankle - 0.02f, p.z());
      for (std::size_t side = 0; side < 2; ++side) {
        const float share =
            body * to_legs * (1 - stiff) * (side == 0 ? left_share : 1 - left_share);
        add(kSides[side].thigh, share * (1 - shin));
        add(kSides[side].shin, share * shin * (1 - foot));
        add(kSides[side].foot, share * shin * foot);
      }
    }
    const float fore = smoothstep(at_.upper_arm - 0.05f, at_.upper_arm + 0.05f, place.along);
    const float hand = smoothstep(at_.wrist - 0.025f, at_.wrist + 0.025f, place.along);
    const float near = smoothstep(-0.06f, 0.10f, place.along);
    add(Segment::kChest, on_arm * (1 - near));
    add(near_arm.upper_arm, on_arm * near * (1 - fore));
    add(near_arm.forearm, on_arm * near * fore * (1 - hand));
    add(near_arm.hand, on_arm * near * fore * hand);
  }
  return strongest(w);
}

}  // namespace plaza::synthetic
