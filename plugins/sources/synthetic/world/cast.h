#pragma once

#include <cstdint>

#include "plugins/sources/synthetic/people/person.h"

namespace plaza::synthetic {

enum class ClothingStyle {
  kAny,
  kDark,  ///< very dark, hardly telling one person from the other (thesis table 3.1)
};

/// What does not change about a person.
struct CastMember {
  Proportions proportions;
  std::uint64_t looks_seed = 0;    ///< of skin, hair, face
  std::uint64_t clothing_key = 0;  ///< of clothes and shoes: equal keys, equal clothes
  ClothingStyle style = ClothingStyle::kAny;
  bool bag = false;
};

}  // namespace plaza::synthetic
