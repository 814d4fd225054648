#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "framework/config/config_value.h"

namespace plaza {

/// A pipeline with everything it extends merged in.
struct MergedConfig {
  ConfigValue root;
  std::vector<std::string>
      files;  ///< as in messages: the one asked for first, then what it extends
};

/// Reads `text` (the contents of `file`) and the files it extends, and merges each over the one it
/// extends: nodes and nested parts are matched by name, objects merge key by key, another "use"
/// drops the old component's parameters, "use": null removes, "after"/"before" place, all else is
/// replaced. Faults that would keep the rest from being checked (syntax, missing files, cycles) are
/// thrown; others go to `diagnostics`.
MergedConfig read_merged(std::string_view text, const std::filesystem::path& file,
                         DiagnosticSink& diagnostics);

/// Puts `change` over `base`, the rule for one node or part.
void merge_component(ConfigValue& base, ConfigValue change);

/// Puts `change` over `base`, whatever the two are, by the same rules; faults go to `diagnostics`.
void merge_config(ConfigValue& base, ConfigValue change, DiagnosticSink& diagnostics);

}  // namespace plaza
