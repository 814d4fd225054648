#pragma once

#include <nlohmann/json.hpp>

#include "plaza/component/parameter.h"

namespace plaza {

/// A parameter's value with its paths as they are found from anywhere: resolved.json is read again
/// from another folder, and keys of caches must not depend on the working folder.
nlohmann::json with_absolute_paths(const nlohmann::json& value, const ParameterSpec& spec);

}  // namespace plaza
