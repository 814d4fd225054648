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

/// A value for one place of a pipeline, written in another file (a study).
struct Setting {
  std::string pointer;  ///< as in `--set`
  Origin origin;        ///< where the pointer was written
  ConfigValue value;
};

/// Applies one. Other than with `--set`, a component or a list of components is merged over what is
/// there by the rules of `extends`, so the value may be a fragment of it; "/nodes/NAME" is a
/// target, too. Faults name the place in the value's own file.
void apply_setting(ConfigValue& root, const Setting& setting, const Registry& registry,
                   DiagnosticSink& diagnostics);

}  // namespace plaza
