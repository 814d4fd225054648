#pragma once

#include <cstdint>
#include <exception>
#include <optional>
#include <string>
#include <utility>

#include "plaza/core/error.h"

namespace plaza {

/// Rethrows the exception being handled as Plaza's own, with component and frame. Called in a catch
/// block.
[[noreturn]] void rethrow_with_context(const std::string& component,
                                       std::optional<std::int64_t> frame);

/// The one guard around every plugin call: what comes out is an Error that knows where it happened.
/// A plugin's own exception types end here, so none outlives the call it came from.
template <class Call>
decltype(auto) guarded(const std::string& component, std::optional<std::int64_t> frame,
                       Call&& call) {
  try {
    return std::forward<Call>(call)();
  } catch (...) {
    rethrow_with_context(component, frame);
  }
}

/// The message of an exception, with its place where that is known: "node 'detector', frame 12:
/// ...".
std::string describe(const std::exception_ptr& error);

}  // namespace plaza
