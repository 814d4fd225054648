#include "plugins/sources/synthetic/body/clothes.h"

#include <utility>

#include "plugins/sources/synthetic/common/texture_noise.h"
#include "plugins/sources/synthetic/people/random.h"

namespace plaza::synthetic {
namespace {

bool in_band(float value, float centre, float half_width) {
  return std::abs(value - centre) < half_width;
}

/// Whether a pattern of period `period` is in its first share.
bool stripe(float value, float period, float share, float phase) {
  const float t = value / period + phase;
  return t - std::floor(t) < share;
}

}  // namespace

Clothes::Clothes(BodyShape shape, const Look& look)
    : shape_(std::move(shape)),
      look_(look),
      phase_(static_cast<float>(Random(mix(look.seed, 0x9a5e)).unit())) {}

Rgb Clothes::face(const Vec3& p) const {
  const auto& at = shape_.landmarks();
  const float h = at.crown - at.head;
  const float up = (p.z() - at.head) / h;
  if (p.x() < 0.04f) return look_.skin;
  const float side = std::abs(p.y());
  if (in_band(up, 0.56f, 0.045f) && in_band(side, 0.032f, 0.016f))
    return look_.skin * 0.25f;                                                         // eyes
  if (in_band(up, 0.655f, 0.02f) && in_band(side, 0.034f, 0.021f)) return look_.hair;  // brows
  if (in_band(up, 0.23f, 0.02f) && side < 0.026f) {
    return look_.skin.cwiseProduct(Rgb(0.80f, 0.45f, 0.45f));  // lips
  }
  return look_.skin;
}

Rgb Clothes::front(const Vec3& p, const Rgb& plain) const {
  const auto& at = shape_.landmarks();
  const float y = p.y();
  switch (look_.front) {
    case Front::kPrint: {
      const float z = p.z() - (at.chest + 0.06f);
      if (std::abs(y) > 0.10f || std::abs(z) > 0.075f) return plain;
      const bool ring = in_band(std::hypot(y, z), 0.055f, 0.018f);
      return ring || in_band(z, 0.0f, 0.012f) || phase_ > 0.6f ? look_.second : plain;
    }
    case Front::kZip:
      if (std::abs(y) < 0.007f) return Rgb(0.30f, 0.30f, 0.31f);
      return std::abs(y) < 0.022f ? Rgb(plain * 0.6f) : plain;
    case Front::kButtons: {
      if (std::abs(y) > 0.020f) return plain;
      const bool button = stripe(p.z(), 0.085f, 0.2f, phase_) && std::abs(y) < 0.009f;
      return button ? Rgb(0.5f, 0.48f, 0.42f) : Rgb(plain * 0.75f);
    }
    case Front::kOpenJacket: {
      const float open = 0.035f + 0.25f * std::abs(p.z() - at.waist) * 0.4f;
      if (std::abs(y) < open) return look_.second;
      return std::abs(y) < open + 0.012f ? Rgb(plain * 0.55f) : plain;
    }
    case Front::kPocketAndStripe:
      if (in_band(p.z(), at.chest + 0.03f, 0.03f)) return look_.second;
      return in_band(y, 0.075f, 0.035f) && in_band(p.z(), at.chest + 0.11f, 0.035f)
                 ? Rgb(plain * 0.6f)
                 : plain;
  }
  return plain;
}

Rgb Clothes::back(const Vec3& p, const Rgb& plain) const {
  const auto& at = shape_.landmarks();
  switch (look_.back) {
    case Back::kPlain:
      return plain;
    case Back::kYoke:
      return p.z() > at.neck - 0.11f ? Rgb(0.5f * plain + 0.5f * look_.second) : plain;
    case Back::kPrint: {
      const float z = p.z() - (at.chest + 0.07f);
      if (std::abs(p.y()) > 0.11f || std::abs(z) > 0.10f) return plain;
      return stripe(z, 0.066f, 0.6f, 0) ? look_.second : plain;
    }
    case Back::kHood:
      return p.z() > at.neck - 0.10f ? Rgb(plain * 0.8f) : plain;
  }
  return plain;
}

Rgb Clothes::top(const Vec3& p, const BodyShape::ArmPlace& arm, bool on_sleeve) const {
  const auto& at = shape_.landmarks();
  Rgb c = look_.top;
  if (look_.weave == Weave::kSleevesOther && on_sleeve) return look_.second;
  if (look_.weave == Weave::kStripes) {
    const float along = on_sleeve ? at.shoulder.z() - arm.along : p.z();
    if (stripe(along, 0.062f, 0.42f, phase_)) c = look_.second;
  } else if (look_.weave == Weave::kChecks) {
    const float along = on_sleeve ? arm.along : p.z();
    const float across = on_sleeve ? p.x() : p.y();
    if (stripe(along, 0.07f, 0.3f, phase_)) c = 0.5f * (c + look_.second);
    if (stripe(across, 0.07f, 0.3f, phase_)) c = 0.5f * (c + look_.second);
  }
  if (on_sleeve) return c;
  if (look_.bag_kind == Bag::kBackpack && p.x() > -0.03f &&
      in_band(std::abs(p.y()), 0.105f, 0.02f) && p.z() > at.chest - 0.05f) {
    return look_.bag;  // the straps
  }
  if (look_.bag_kind == Bag::kShoulderBag) {
    const float lean = (p.z() - at.hip) / (at.neck - at.hip);
    if (in_band(p.y(), -at.torso_half_y + lean * 1.6f * at.torso_half_y, 0.02f)) return look_.bag;
  }
  return p.x() > 0 ? front(p, c) : back(p, c);
}

BodySurface Clothes::at(const Vec3& p) const {
  const auto& at = shape_.landmarks();
  BodySurface out;
  const BodyShape::ArmPlace arm = shape_.arm_place(p);
  const auto folds = [&](float depth) {
    // longer along limbs than across, as cloth falls
    const Vec3 q(14 * p.x(), 14 * p.y(), 7 * p.z());
    const auto seed = static_cast<std::uint32_t>(look_.seed);
    for (int k = 0; k < 3; ++k) {
      out.bump[k] = depth * fractal_noise(q, seed + static_cast<std::uint32_t>(k) * 977u, 3);
    }
  };
  const bool on_arm = arm.radial < 0.105f && arm.along > 0.05f && p.z() < at.neck + 0.03f &&
                      std::abs(p.y()) > at.torso_half_y * 0.8f && p.z() > at.hip - 0.25f;
  if (look_.bag_kind != Bag::kNone && shape_.on_bag(p)) {
    out.albedo = look_.bag;
    const float local = p.z() - at.bag_z;
    if (in_band(local, 0.06f, 0.006f) || in_band(local, -0.12f, 0.004f)) out.albedo *= 0.4f;
    folds(0.10f);
    out.gloss = 0.02f;
  } else if (p.z() > at.neck - 0.20f && !on_arm && shape_.on_hair(p)) {
    const bool cap = look_.hair_kind == Hair::kCap && p.z() > at.head + 0.6f * (at.crown - at.head);
    out.albedo = cap ? look_.second : look_.hair;
    const Vec3 strands(60 * p.x(), 60 * p.y(), 9 * p.z());
    const float n = value_noise(strands, 77u);
    out.albedo *= 1 + 0.25f * n;
    out.bump = Vec3::Constant(0.12f * n);
    out.gloss = cap ? 0.0f : 0.05f;
  } else if (p.z() > at.head + 0.01f) {
    out.albedo = face(p);
    out.gloss = 0.03f;
  } else if (std::hypot(p.x() + 0.012f, p.y()) < 0.11f &&
             p.z() > at.neck + 0.035f - 0.30f * std::max(0.0f, p.x() + 0.03f)) {
    out.albedo = look_.skin;
    out.gloss = 0.03f;
  } else if (on_arm && arm.along > look_.sleeve * at.wrist) {
    out.albedo = look_.skin;
    out.gloss = 0.03f;
  } else if (on_arm) {
    out.albedo = top(p, arm, true);
    folds(0.20f);
  } else if (p.z() < at.ankle + 0.025f && p.z() < at.ankle + 0.04f - 0.3f * std::min(0.0f, p.x())) {
    out.albedo = p.z() < 0.022f ? Rgb(0.25f * look_.shoes + Rgb::Constant(0.12f)) : look_.shoes;
    out.gloss = 0.05f;
  } else {
    const bool coat = look_.top_kind == Top::kCoat;
    const float hem = coat                            ? at.knee + 0.10f
                      : look_.top_kind == Top::kShirt ? at.waist - 0.01f
                                                      : at.hip + 0.015f;
    if (p.z() > hem) {
      out.albedo = top(p, arm, false);
      if (p.z() < hem + 0.02f) out.albedo *= 0.7f;
      folds(0.18f);
      return out;
    }
    const float end = look_.bottom_kind == Bottom::kShorts  ? at.knee + 0.02f
                      : look_.bottom_kind == Bottom::kSkirt ? at.knee + 0.02f
                                                            : at.ankle - 0.05f;
    if (p.z() < end) {
      out.albedo = look_.skin;
      return out;
    }
    out.albedo = look_.bottom;
    if (p.z() > hem - 0.035f && look_.top_kind == Top::kShirt) out.albedo = look_.shoes;  // a belt
    if (look_.bottom_kind == Bottom::kJeans) {
      out.albedo *= 1 + 0.35f *
                            std::max(0.0f, 1 - 9 * std::abs(p.z() - 0.5f * (at.knee + at.hip))) *
                            (p.x() > 0 ? 1.0f : 0.2f);  // worn thighs
    }
    if (p.x() < -0.03f && in_band(p.z(), at.hip - 0.03f, 0.055f) &&
        in_band(std::abs(p.y()), 0.075f, 0.045f)) {
      out.albedo *= 0.72f;  // back pockets
    }
    folds(0.20f);
  }
  return out;
}

}  // namespace plaza::synthetic
