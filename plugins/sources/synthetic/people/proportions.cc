#include "plugins/sources/synthetic/people/proportions.h"

#include <algorithm>

#include "plugins/sources/synthetic/people/random.h"

namespace plaza::synthetic {

Proportions draw_proportions(std::uint64_t seed) {
  Random random(mix(seed, 0x70726f70));
  // two overlapping groups, as men and women are
  const bool tall_group = random.chance(0.5);
  Proportions p;
  p.stature_m = std::clamp((tall_group ? 1.79 : 1.66) + 0.065 * random.normal(), 1.55, 1.95);
  const double h = p.stature_m;
  const auto share = [&](double mean, double deviation) {
    return h * mean * (1.0 + deviation * random.normal());
  };
  p.ankle_m = share(0.043, 0.03);
  p.shin_m = share(0.244, 0.02);
  p.thigh_m = share(0.243, 0.02);
  p.pelvis_m = share(0.070, 0.03);
  p.abdomen_m = share(0.097, 0.03);
  p.neck_m = share(0.042, 0.05);
  p.head_m = share(0.128, 0.02);
  // the rest of the stature, 0.133 of it on average
  p.chest_m =
      h - (p.ankle_m + p.shin_m + p.thigh_m + p.pelvis_m + p.abdomen_m + p.neck_m + p.head_m);
  p.upper_arm_m = share(0.172, 0.02);
  p.forearm_m = share(0.146, 0.02);
  p.hand_m = share(0.105, 0.02);
  p.foot_m = share(0.150, 0.03);
  p.hip_width_m = share(tall_group ? 0.099 : 0.106, 0.04);
  p.shoulder_width_m = share(tall_group ? 0.222 : 0.205, 0.04);
  p.girth = std::clamp(1.0 + 0.11 * random.normal(), 0.82, 1.28);
  return p;
}

}  // namespace plaza::synthetic
