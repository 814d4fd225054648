#pragma once

#include <string>

#include "plaza/contract/world.h"

namespace plaza::contract {

/// Text that is equal exactly when two payloads are equal bit for bit, as far as the SDK knows
/// their type: evidence is opaque, only its presence counts; of features their names, and what they
/// save.
std::string digest(const Payload& payload);
std::string digest(const PayloadPtr& payload);  ///< "-" when null

/// What a describer must leave alone: everything but headings and features.
std::string digest_of_the_undescribed(const Observations& observations);

std::string digest(const TrackPoint& point);

}  // namespace plaza::contract
