#pragma once

#include <string>

namespace plaza {

/// `value` with a fixed number of decimals and a point, whatever the locale; never "-0.00". A value
/// that is not finite is an InternalError: files have empty fields for what is unknown.
std::string fixed_text(double value, int decimals);

}  // namespace plaza
