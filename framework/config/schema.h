#pragma once

#include <nlohmann/json.hpp>

#include "framework/plugin/registry.h"

namespace plaza {

/// JSON Schema (draft 7, which editors understand best) of pipelines that use the components of
/// `registry`. An editor that a pipeline's "$schema" leads to it completes component names and
/// parameters, and shows meanings, units, ranges and defaults. What needs more than one place of
/// the text (wiring, unique names, files) is left to `plaza check`. In pipelines with "extends"
/// nodes may leave out what they inherit.
nlohmann::json pipeline_schema(const Registry& registry);

}  // namespace plaza
