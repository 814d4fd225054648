#include "plugins/sources/synthetic/body/body_shape.h"

#include <numbers>

#include "plugins/sources/synthetic/people/skeleton.h"

namespace plaza::synthetic {
namespace {

constexpr double kArmSpread = 30.0 * std::numbers::pi / 180;
constexpr double kLegSpread = 6.0 * std::numbers::pi / 180;

BodyPose make_bind_pose(const Proportions& p) {
  JointRotations joints;
  joints.pelvis_m = {0, 0, p.ankle_m + (p.shin_m + p.thigh_m) * std::cos(kLegSpread)};
  for (std::size_t side = 0; side < 2; ++side) {
    const double left = side == 0 ? 1 : -1;
    const Eigen::Quaterniond arm(Eigen::AngleAxisd(left * kArmSpread, Eigen::Vector3d::UnitX()));
    const Eigen::Quaterniond leg(Eigen::AngleAxisd(left * kLegSpread, Eigen::Vector3d::UnitX()));
    joints.arms[side].upper = joints.arms[side].fore = joints.arms[side].hand = arm;
    joints.legs[side].thigh = joints.legs[side].shin = leg;
  }
  return place_segments(p, joints);
}

float thickness(Top kind) {
  switch (kind) {
    case Top::kTShirt:
      return 0.007f;
    case Top::kShirt:
      return 0.010f;
    case Top::kPullover:
      return 0.014f;
    case Top::kJacket:
      return 0.022f;
    case Top::kCoat:
      return 0.026f;
  }
  return 0;
}

}  // namespace

BodyShape::BodyShape(const Proportions& proportions, const Look& look)
    : body_(proportions),
      look_(look),
      bind_(make_bind_pose(proportions)),
      girth_(static_cast<float>(proportions.girth * proportions.stature_m / 1.75)),
      top_thickness_(thickness(look.top_kind)) {
  const auto origin = [&](Segment s) { return Vec3(bind_[s].translation().cast<float>()); };
  const auto f = [](double x) { return static_cast<float>(x); };
  knee_ = origin(Segment::kLeftShin);
  ankle_ = origin(Segment::kLeftFoot);
  foot_from_world_ = bind_[Segment::kLeftFoot].inverse().cast<float>();
  at_.shoulder = origin(Segment::kLeftUpperArm);
  const Vec3 wrist = origin(Segment::kLeftHand);
  at_.arm = (wrist - at_.shoulder).normalized();
  at_.upper_arm = f(body_.upper_arm_m);
  at_.wrist = (wrist - at_.shoulder).norm();
  at_.ankle = ankle_.z();
  at_.knee = knee_.z();
  at_.hip = origin(Segment::kPelvis).z();
  at_.waist = origin(Segment::kAbdomen).z();
  at_.chest = origin(Segment::kChest).z();
  at_.neck = origin(Segment::kNeck).z();
  at_.head = origin(Segment::kHead).z();
  at_.crown = at_.head + f(body_.head_m);

  const float t = top_thickness_;
  const float g = girth_;
  const float hips = f(body_.hip_width_m) * 0.5f;
  const float shoulders = f(body_.shoulder_width_m) * 0.5f;
  const float chest = f(body_.chest_m);
  const float belly = 0.03f * std::max(0.0f, f(body_.girth) - 0.95f) / 0.3f;
  torso_sections_ = {{
      {at_.hip - 0.09f, 0.085f * g, hips * 0.55f + 0.045f * g, -0.008f},
      {at_.hip + 0.02f, 0.108f * g + 0.6f * t, hips * 0.85f + 0.075f * g + t, -0.014f},
      {at_.waist + 0.06f, 0.098f * g + t + belly, hips * 0.75f + 0.066f * g + t,
       0.004f + belly * 0.6f},
      {at_.chest + 0.35f * chest, 0.112f * g + t, shoulders * 0.58f + 0.045f * g + t, 0.006f},
      {at_.chest + 0.72f * chest, 0.104f * g + t, shoulders * 0.80f + 0.030f * g + t, -0.004f},
      {at_.chest + 0.93f * chest, 0.078f * g + t, shoulders * 0.86f, -0.012f},
      {at_.neck + 0.035f, 0.052f * g, 0.056f * g, -0.012f},
  }};
  at_.torso_half_x = torso_sections_[3].half_x;
  at_.torso_half_y = torso_sections_[3].half_y;
  const bool coat = look_.top_kind == Top::kCoat;
  skirted_ = coat || look_.bottom_kind == Bottom::kSkirt;
  const float hem = coat ? at_.knee + 0.10f : at_.knee + 0.02f;
  const float wide = coat ? 0.035f : 0.05f;
  skirt_sections_ = {{
      {hem, 0.155f * g + wide, hips + 0.10f * g + wide, 0},
      {0.5f * (hem + at_.hip), 0.135f * g + 0.6f * wide, hips + 0.095f * g + 0.4f * wide, -0.006f},
      {at_.hip + 0.02f, 0.116f * g + 0.7f * t, hips * 0.85f + 0.083f * g + t, -0.013f},
      {at_.waist + 0.05f, 0.100f * g + t, hips * 0.75f + 0.068f * g + t, 0},
  }};
  if (look_.bag_kind == Bag::kBackpack) {
    at_.bag_x = torso_sections_[3].centre_x - torso_sections_[3].half_x - 0.065f;
    at_.bag_y = 0;
    at_.bag_z = at_.chest + 0.25f * chest;
  } else {
    at_.bag_x = -0.01f;
    at_.bag_y = -(torso_sections_[1].half_y + 0.045f);
    at_.bag_z = at_.hip + 0.02f;
  }
}

Eigen::AlignedBox3f BodyShape::bounds() const {
  const Vec3 tips = at_.shoulder + at_.arm * (at_.wrist + static_cast<float>(body_.hand_m));
  const float y = std::max(tips.y() + 0.08f, 0.45f);
  return {Vec3(-0.42f, -y, -0.04f), Vec3(0.36f, y, at_.crown + 0.08f)};
}

float BodyShape::torso(const Vec3& p) const { return loft(p, torso_sections_); }

float BodyShape::arm(const Vec3& p) const {
  const float g = girth_;
  const Vec3& s = at_.shoulder;
  const Vec3 elbow = s + at_.arm * at_.upper_arm;
  const Vec3 wrist = s + at_.arm * at_.wrist;
  float d = tapered_capsule(p, s, elbow, 0.045f * g, 0.040f * g);
  d = smooth_union(d, tapered_capsule(p, elbow, wrist, 0.041f * g, 0.027f * g), 0.02f);
  // the hand: palm towards the thigh, thumb forward
  const Vec3 q = p - wrist - at_.arm * static_cast<float>(body_.hand_m * 0.42);
  const Vec3 across = Vec3::UnitX().cross(at_.arm);
  const Vec3 local(q.x() - 0.006f, q.dot(across), q.dot(at_.arm));
  const float length = static_cast<float>(body_.hand_m);
  d = smooth_union(d, ellipsoid(local, {0.042f, 0.023f, length * 0.5f}), 0.02f);
  const float end = at_.wrist * look_.sleeve;
  const float t = top_thickness_;
  const Vec3 cuff = s + at_.arm * (end - 0.02f);
  const float taper = 0.054f - 0.018f * look_.sleeve;
  d = std::min(d, tapered_capsule(p, s, cuff, 0.047f * g + 0.6f * t, taper * g + 0.9f * t));
  return d;
}

float BodyShape::leg(const Vec3& p) const {
  const float g = girth_;
  const Vec3 hip(0, static_cast<float>(body_.hip_width_m) * 0.5f, at_.hip);
  float d = tapered_capsule(p, hip, knee_, 0.082f * g, 0.053f * g);
  const Vec3 calf = knee_ + 0.3f * (ankle_ - knee_) + Vec3(-0.014f, 0, 0);
  d = smooth_union(d, tapered_capsule(p, knee_, calf, 0.050f * g, 0.054f * g), 0.03f);
  d = smooth_union(d, tapered_capsule(p, calf, ankle_, 0.053f * g, 0.037f * g), 0.03f);
  if (look_.bottom_kind == Bottom::kTrousers || look_.bottom_kind == Bottom::kJeans) {
    const bool jeans = look_.bottom_kind == Bottom::kJeans;
    const Vec3 cuff = ankle_ + Vec3(0, 0, 0.0f);
    const float at_knee = (jeans ? 0.062f : 0.070f) * g;
    const float at_cuff = (jeans ? 0.052f : 0.066f) * g;
    d = smooth_union(d, tapered_capsule(p, hip, knee_, 0.090f * g, at_knee), 0.02f);
    const float cloth = tapered_capsule(p, knee_, cuff, at_knee, at_cuff);
    d = std::min(d, std::max(cloth, at_.ankle - 0.045f - p.z()));
  } else if (look_.bottom_kind == Bottom::kShorts) {
    const float cloth = tapered_capsule(p, hip, knee_, 0.093f * g, 0.078f * g);
    d = std::min(d, std::max(cloth, at_.knee + 0.02f - p.z()));
  }
  // the shoe: a heel and toes, flat below
  const Vec3 q = foot_from_world_ * p;
  const float sole = static_cast<float>(-body_.ankle_m);
  const float heel = static_cast<float>(kHeelShare * body_.foot_m) + 0.04f;
  const float toe = static_cast<float>(kToeShare * body_.foot_m) - 0.042f;
  float shoe =
      tapered_capsule(q, {heel, 0, sole + 0.038f}, {toe, 0.012f, sole + 0.030f}, 0.042f, 0.044f);
  shoe = smooth_union(
      shoe, tapered_capsule(q, {heel + 0.01f, 0, sole + 0.05f}, {0.0f, 0, 0.0f}, 0.040f, 0.042f),
      0.03f);
  shoe = std::max(shoe, sole - q.z());
  return smooth_union(d, shoe, 0.015f);
}

float BodyShape::skirt(const Vec3& p) const { return loft(p, skirt_sections_); }

float BodyShape::bare_head(const Vec3& p) const {
  const float h = static_cast<float>(body_.head_m);
  const Vec3 q = p - Vec3(0, 0, at_.head);
  const float s = h / 0.22f;
  float d = ellipsoid(q - Vec3(0.008f, 0, 0.55f * h), Vec3(0.096f * s, 0.074f * s, 0.45f * h));
  d = smooth_union(
      d,
      tapered_capsule(q, {0.02f, 0, 0.32f * h}, {0.062f * s, 0, 0.13f * h}, 0.055f * s, 0.030f * s),
      0.03f);
  const Vec3 nose(0.103f * s, 0, 0.44f * h);
  d = smooth_union(d, (q - nose).norm() - 0.014f, 0.02f);
  const Vec3 ear(0.0f, 0.077f * s, 0.47f * h);
  d = smooth_union(d, ellipsoid(mirrored(q) - ear, {0.02f, 0.010f, 0.03f}), 0.008f);
  const Vec3 neck_low(-0.015f, 0, at_.neck - 0.03f), neck_high(-0.005f, 0, at_.head + 0.25f * h);
  return smooth_union(d, tapered_capsule(p, neck_low, neck_high, 0.062f * girth_, 0.052f * girth_),
                      0.025f);
}

float BodyShape::hair(const Vec3& p) const {
  const float h = static_cast<float>(body_.head_m);
  const float s = h / 0.22f;
  const Vec3 q = p - Vec3(0, 0, at_.head);
  const Vec3 centre(-0.002f, 0, 0.57f * h);
  // behind and above this plane: hair; before and below: the face
  const float face = 0.80f * (q.x() - 0.052f * s) - 0.60f * (q.z() - 0.70f * h);
  const auto shell = [&](float thick) {
    return ellipsoid(q - centre, Vec3(0.096f * s + thick, 0.074f * s + thick, 0.45f * h + thick));
  };
  const auto cut = [&](float d, float lowest) {
    return std::max(std::max(d, face), lowest * h - q.z());
  };
  switch (look_.hair_kind) {
    case Hair::kBald:
      return 1.0f;
    case Hair::kCropped:
      return cut(shell(0.006f), 0.30f);
    case Hair::kShort:
      return cut(shell(0.016f), 0.24f);
    case Hair::kBob:
      return cut(shell(0.030f), -0.02f);
    case Hair::kLong: {
      const Vec3 back = p - Vec3(-0.085f * s, 0, at_.neck - 0.02f);
      const float fall = ellipsoid(back, {0.040f, 0.088f, 0.20f});
      return smooth_union(cut(shell(0.024f), 0.05f), fall, 0.04f);
    }
    case Hair::kBun: {
      const float bun = (q - Vec3(-0.118f * s, 0, 0.66f * h)).norm() - 0.038f;
      return smooth_union(cut(shell(0.010f), 0.22f), bun, 0.01f);
    }
    case Hair::kCap: {
      const float dome = std::max(shell(0.013f), 0.62f * h - q.z());
      const float visor = ellipsoid(q - Vec3(0.115f * s, 0, 0.66f * h), {0.075f, 0.070f, 0.012f});
      return std::min({dome, visor, cut(shell(0.007f), 0.26f)});
    }
  }
  return 1.0f;
}

float BodyShape::bag(const Vec3& p) const {
  const Vec3 q = p - Vec3(at_.bag_x, at_.bag_y, at_.bag_z);
  switch (look_.bag_kind) {
    case Bag::kNone:
      return 1.0f;
    case Bag::kBackpack:
      return smooth_union(rounded_box(q, {0.075f, 0.145f, 0.21f}, 0.055f),
                          rounded_box(q - Vec3(-0.08f, 0, -0.07f), {0.04f, 0.10f, 0.10f}, 0.03f),
                          0.02f);
    case Bag::kShoulderBag:
      return rounded_box(q, {0.15f, 0.055f, 0.12f}, 0.035f);
  }
  return 1.0f;
}

float BodyShape::distance(const Vec3& p) const {
  const Vec3 m = mirrored(p);
  float d = smooth_union(torso(p), leg(m), 0.05f);
  d = smooth_union(d, arm(m), 0.03f);
  if (skirted_) d = smooth_union(d, skirt(p), 0.015f);
  d = smooth_union(d, bare_head(p), 0.03f);
  d = std::min(d, hair(p));
  if (look_.back == Back::kHood) {
    const Vec3 hood = p - Vec3(-0.085f * girth_ - top_thickness_, 0, at_.neck - 0.015f);
    d = smooth_union(d, ellipsoid(hood, {0.05f, 0.11f, 0.075f}), 0.02f);
  }
  return std::min(d, bag(p));
}

bool BodyShape::on_bag(const Vec3& p) const { return bag(p) < 0.006f; }
bool BodyShape::on_hair(const Vec3& p) const { return hair(p) < 0.004f; }

BodyShape::ArmPlace BodyShape::arm_place(const Vec3& p) const {
  const Vec3 q = mirrored(p) - at_.shoulder;
  const float along = q.dot(at_.arm);
  return {.along = along, .radial = (q - along * at_.arm).norm()};
}

}  // namespace plaza::synthetic
