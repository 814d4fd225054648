#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "framework/plugin/registry.h"

namespace plaza {

/// Everything a declaration says, for people: summary, ports, parameters, metrics, library.
std::string component_text(const ComponentEntry& entry);

/// The same for programs.
nlohmann::json component_json(const ComponentEntry& entry);

/// "integer", "list of reals", "one of: new, keep", "part (motion)".
std::string parameter_type_text(const ParameterSpec& spec);

}  // namespace plaza
