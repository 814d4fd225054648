#pragma once

#include <cstdint>

#include "plugins/sources/synthetic/people/person.h"

namespace plaza::synthetic {

/// The proportions of an adult of 1.55-1.95 m, slim to stout, drawn from `seed`. Mean lengths
/// are the shares of stature given by Drillis and Contini (1966; in Winter, Biomechanics and Motor
/// Control of Human Movement, fig. 4.1); single lengths vary by a few percent around them, and the
/// parts of the spine and the legs always add up to the stature.
Proportions draw_proportions(std::uint64_t seed);

}  // namespace plaza::synthetic
