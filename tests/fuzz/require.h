// How fuzzers say that a promise is broken.
#pragma once

#include <cstdlib>
#include <iostream>

namespace plaza::fuzz {

/// Stops the fuzzer, which keeps the input.
inline void require(bool condition, const char* what) {
  if (condition) return;
  std::cerr << what << '\n';
  std::abort();
}

}  // namespace plaza::fuzz
