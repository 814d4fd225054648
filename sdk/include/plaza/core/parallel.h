#pragma once

#include <cstddef>
#include <functional>

#include "plaza/core/export.h"

namespace plaza {

/// Calls `body(i)` for i in [0, count), concurrently where the run has threads to spare, and
/// returns when all are done. Bodies must not depend on each other's order. When several throw, the
/// exception of the lowest index is rethrown, so that the outcome does not depend on timing.
PLAZA_API void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body);

}  // namespace plaza
