#pragma once

#include <string>

namespace plaza::synthetic {

/// A scenario that can be asked for.
struct ScenarioInfo {
  std::string name;
  std::string challenge;    ///< what makes it hard, after the thesis's table 3.1
  bool indoor = true;       ///< plays in a room by default
  int people = 0;           ///< at most in the area at once
  bool any_number = false;  ///< can be asked for with another number of people
};

}  // namespace plaza::synthetic
