#pragma once

#include <string>
#include <vector>

#include "framework/config/config_value.h"
#include "framework/plugin/registry.h"

namespace plaza {

/// Applies `--set` options in their order. An option is a JSON pointer, "=", and a value: JSON, or
/// else text. Nodes and nested parts are named by name or index, records of input lists by what
/// they read ("from") or index. A target that does not exist goes to `diagnostics` with the nearest
/// that does; whether a value is right is checked later, with the rest. Parts that a component
/// makes by default can be reached, too.
void apply_sets(ConfigValue& root, const std::vector<std::string>& sets, const Registry& registry,
                DiagnosticSink& diagnostics);

}  // namespace plaza
