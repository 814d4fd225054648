#include "plugins/sources/synthetic/body/look.h"

#include <array>

#include "plugins/sources/synthetic/people/random.h"

namespace plaza::synthetic {
namespace {

// Reflectances of common cloth, linear.
constexpr std::array<std::array<float, 3>, 16> kTops = {{{0.60f, 0.60f, 0.58f},
                                                         {0.36f, 0.37f, 0.38f},
                                                         {0.11f, 0.12f, 0.13f},
                                                         {0.03f, 0.03f, 0.035f},
                                                         {0.035f, 0.05f, 0.12f},
                                                         {0.09f, 0.17f, 0.36f},
                                                         {0.30f, 0.42f, 0.58f},
                                                         {0.36f, 0.045f, 0.05f},
                                                         {0.16f, 0.03f, 0.05f},
                                                         {0.06f, 0.16f, 0.07f},
                                                         {0.13f, 0.14f, 0.07f},
                                                         {0.42f, 0.33f, 0.21f},
                                                         {0.19f, 0.11f, 0.065f},
                                                         {0.55f, 0.36f, 0.06f},
                                                         {0.46f, 0.20f, 0.23f},
                                                         {0.17f, 0.33f, 0.33f}}};
constexpr std::array<std::array<float, 3>, 8> kBottoms = {{{0.030f, 0.032f, 0.040f},
                                                           {0.045f, 0.060f, 0.110f},
                                                           {0.085f, 0.120f, 0.200f},
                                                           {0.16f, 0.20f, 0.27f},
                                                           {0.10f, 0.10f, 0.10f},
                                                           {0.24f, 0.19f, 0.13f},
                                                           {0.33f, 0.29f, 0.23f},
                                                           {0.09f, 0.065f, 0.045f}}};
constexpr std::array<std::array<float, 3>, 6> kSkins = {{{0.55f, 0.36f, 0.27f},
                                                         {0.48f, 0.30f, 0.21f},
                                                         {0.42f, 0.25f, 0.16f},
                                                         {0.30f, 0.16f, 0.095f},
                                                         {0.18f, 0.09f, 0.05f},
                                                         {0.09f, 0.045f, 0.028f}}};
constexpr std::array<std::array<float, 3>, 7> kHairs = {{{0.012f, 0.010f, 0.009f},
                                                         {0.030f, 0.018f, 0.011f},
                                                         {0.065f, 0.036f, 0.019f},
                                                         {0.12f, 0.065f, 0.03f},
                                                         {0.28f, 0.19f, 0.09f},
                                                         {0.30f, 0.29f, 0.28f},
                                                         {0.16f, 0.055f, 0.02f}}};

float between(Random& draw, float low, float high) {
  return static_cast<float>(draw.uniform(low, high));
}

template <std::size_t N>
Rgb pick(const std::array<std::array<float, 3>, N>& from, Random& draw, float vary) {
  const auto& c = from[draw.index(N)];
  Rgb out(c[0], c[1], c[2]);
  for (int i = 0; i < 3; ++i) out[i] *= between(draw, 1 - vary, 1 + vary);
  return out;
}

Rgb dark_cloth(Random& draw) {
  const float level = between(draw, 0.018f, 0.036f);
  return {level * between(draw, 0.9f, 1.05f), level * between(draw, 0.93f, 1.05f),
          level * between(draw, 0.98f, 1.35f)};
}

float luminance(const Rgb& c) { return 0.2126f * c[0] + 0.7152f * c[1] + 0.0722f * c[2]; }

/// A colour that stands off from `other`.
Rgb contrasting(const Rgb& other, Random& draw) {
  for (int attempt = 0; attempt < 8; ++attempt) {
    const Rgb c = pick(kTops, draw, 0.15f);
    const float ratio = (luminance(c) + 0.02f) / (luminance(other) + 0.02f);
    if (ratio > 2 || ratio < 0.5f) return c;
  }
  return luminance(other) > 0.15f ? Rgb(0.03f, 0.03f, 0.04f) : Rgb(0.55f, 0.55f, 0.53f);
}

}  // namespace

Look make_look(const LookSeeds& seeds) {
  Look look;
  look.seed = seeds.clothing;
  Random person(mix(seeds.person, 0x10015));
  look.skin = pick(kSkins, person, 0.08f);
  look.hair = pick(kHairs, person, 0.15f);
  look.hair_kind = static_cast<Hair>(person.index(7));

  Random draw(mix(seeds.clothing, seeds.dark ? 0xda4c : 0xc107));
  look.top_kind = static_cast<Top>(draw.index(5));
  look.bottom_kind = static_cast<Bottom>(draw.index(4));
  const bool backpack = draw.chance(0.55);
  if (seeds.bag) look.bag_kind = backpack ? Bag::kBackpack : Bag::kShoulderBag;
  look.front = static_cast<Front>(draw.index(5));
  look.back = static_cast<Back>(draw.index(4));
  look.weave = draw.chance(0.45) ? Weave::kPlain : static_cast<Weave>(draw.index(4));
  look.top = seeds.dark ? dark_cloth(draw) : pick(kTops, draw, 0.15f);
  look.second =
      seeds.dark ? Rgb(look.top * between(draw, 2.0f, 3.2f)) : contrasting(look.top, draw);
  look.bottom = seeds.dark ? dark_cloth(draw) : pick(kBottoms, draw, 0.15f);
  look.shoes = draw.chance(0.25) && !seeds.dark ? Rgb(0.45f, 0.45f, 0.43f) : dark_cloth(draw);
  look.bag = seeds.dark ? dark_cloth(draw) : pick(kBottoms, draw, 0.3f);
  if (seeds.dark) {  // long, plain, without bright pieces
    if (look.top_kind == Top::kTShirt) look.top_kind = Top::kPullover;
    if (look.bottom_kind == Bottom::kShorts) look.bottom_kind = Bottom::kTrousers;
    look.weave = Weave::kPlain;
  }
  if (look.top_kind == Top::kTShirt) look.front = Front::kPrint;
  if (look.top_kind == Top::kCoat && look.front == Front::kPrint) look.front = Front::kButtons;
  const bool jacket = look.top_kind == Top::kJacket || look.top_kind == Top::kCoat;
  if (!jacket && look.front == Front::kOpenJacket) look.front = Front::kZip;
  if (look.back == Back::kHood && !jacket && look.top_kind != Top::kPullover) {
    look.back = Back::kYoke;
  }
  // a narrow zip alone would not tell front from back at a distance
  const bool narrow = look.front == Front::kZip || look.front == Front::kButtons;
  if (narrow && look.back == Back::kPlain) look.back = Back::kYoke;
  const double length = draw.unit();
  if (look.top_kind == Top::kTShirt) look.sleeve = static_cast<float>(0.25 + 0.17 * length);
  if (look.top_kind == Top::kShirt && length < 0.3) look.sleeve = 0.6f;
  return look;
}

}  // namespace plaza::synthetic
