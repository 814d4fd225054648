#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "framework/config/config_value.h"
#include "plaza/component/parameter.h"

namespace plaza {

/// What a parameter takes: "real in m, > 0", "one of \"new\", \"keep\"", "list of 2 to 4 integers".
std::string expectation(const ParameterSpec& spec);

/// The limits alone: "> 0, <= 1"; empty when there are none that anyone would meet.
std::string range_text(const ParameterSpec& spec);

/// The path that a text value stands for: relative to the file it was written in, or to the working
/// folder when it comes from --set. Throws UserError as resolve_path() does.
std::filesystem::path resolve_config_path(const ConfigValue& value,
                                          const std::filesystem::path& pipeline_file);

/// Checks a value of a plain parameter and returns it in its final form: reals as doubles, integers
/// as integers, paths resolved (those of defaults from the folder of `default_base`). Origins of
/// the value and everything in it are added under `pointer`. Faults go to `diagnostics`; what is
/// returned then is of no use.
nlohmann::json check_value(const ConfigValue& value, const ParameterSpec& spec,
                           const std::filesystem::path& default_base, const std::string& pointer,
                           Origins& origins, DiagnosticSink& diagnostics);

}  // namespace plaza
