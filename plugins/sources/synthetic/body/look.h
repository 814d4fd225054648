#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace plaza::synthetic {

/// Linear reflectance, red, green, blue.
using Rgb = Eigen::Vector3f;

enum class Top { kTShirt, kShirt, kPullover, kJacket, kCoat };
enum class Bottom { kTrousers, kJeans, kShorts, kSkirt };
enum class Hair { kShort, kCropped, kBob, kLong, kBun, kBald, kCap };
enum class Bag { kNone, kBackpack, kShoulderBag };
/// What is on the chest, and on no other side.
enum class Front { kPrint, kZip, kButtons, kOpenJacket, kPocketAndStripe };
/// What is on the back.
enum class Back { kPlain, kYoke, kPrint, kHood };
enum class Weave { kPlain, kStripes, kChecks, kSleevesOther };

/// How one person looks: made from seeds, the same ones always give the same look.
struct Look {
  std::uint64_t seed = 0;
  Rgb skin, hair, top, second, bottom, shoes, bag;
  Top top_kind = Top::kShirt;
  Bottom bottom_kind = Bottom::kTrousers;
  Hair hair_kind = Hair::kShort;
  Bag bag_kind = Bag::kNone;
  Front front = Front::kZip;
  Back back = Back::kPlain;
  Weave weave = Weave::kPlain;
  float sleeve = 1;  ///< share of the arm, shoulder to wrist, that is covered
};

/// What a look is made from. Equal clothing keys give equal clothes, whoever wears them; `person`
/// decides skin and hair.
struct LookSeeds {
  std::uint64_t person = 0;
  std::uint64_t clothing = 0;
  bool dark = false;  ///< dark and alike clothing (thesis Table 3.1, Lab 4 Targets - Crossing)
  bool bag = false;
};
Look make_look(const LookSeeds& seeds);

}  // namespace plaza::synthetic
