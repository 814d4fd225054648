#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "framework/plugin/registry.h"
#include "plaza/core/diagnostic.h"
#include "plaza/geometry/scene.h"

namespace plaza {

/// A value's origin: "pipelines/pets-s2l1.json:12:7", "default", "--set".
using Origins = std::map<std::string, std::string>;  ///< JSON pointer below the component -> origin

/// A nested component, ready to be made.
struct ResolvedPart {
  std::string name;
  const ComponentEntry* entry = nullptr;
  nlohmann::json values;  ///< every plain parameter, defaults filled in, paths replaced
  Origins origins;
  std::map<std::string, std::vector<ResolvedPart>> parts;  ///< by parameter
  FilePosition where;
  std::string pointer;  ///< "/nodes/7/affinities/0"
};

/// One wired input: output `output` of node `node`; node -1: optional and not connected.
struct Wire {
  int node = -1;
  int output = 0;
};

struct ResolvedInputRecord {
  std::string from;
  nlohmann::json fields;
  std::size_t input = 0;  ///< index into ResolvedNode::inputs
};

struct ResolvedNode : ResolvedPart {
  std::vector<Wire> inputs;  ///< the declared ones in their order, then those of input lists
  std::map<std::string, std::vector<ResolvedInputRecord>> input_lists;  ///< by parameter
};

/// A pipeline after extends, --set, defaults, checks and wiring.
struct ResolvedPipeline {
  std::string name;            ///< its title
  std::filesystem::path file;  ///< as given
  std::filesystem::path scene_file;
  std::uint64_t seed = 0;
  std::vector<ResolvedNode> nodes;
  /// The contents of resolved.json: the complete configuration and the origin of every value.
  nlohmann::json resolved_json() const;
};

struct PipelineRequest {
  std::filesystem::path file;
  std::vector<std::string> sets;  ///< "/nodes/edges/sigma_px=2.5"
};

/// Reads, merges, checks and wires a pipeline. Every fault that can be found without making components is
/// reported in one UserError.
ResolvedPipeline read_pipeline(const PipelineRequest& request, const Registry& registry);

/// A pipeline's components, made and wired, in node order.
struct Assembly {
  std::shared_ptr<const Scene> scene;
  std::vector<std::shared_ptr<Component>> nodes;  ///< each is a Node
};

/// Makes all components and calls check() on each, parts included. All faults of all components in one
/// UserError, each with file, line, column and pointer.
Assembly assemble(const ResolvedPipeline& pipeline, std::shared_ptr<const Scene> scene,
                  const std::filesystem::path& output_folder);

/// `$PLAZA_DATA/...` replaced (environment, else ../shared/data); relative paths start at the folder of
/// `file`. The result is lexically normal.
std::filesystem::path resolve_path(const std::string& text, const std::filesystem::path& file);

}  // namespace plaza
