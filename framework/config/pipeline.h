#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "framework/plugin/registry.h"
#include "plaza/core/diagnostic.h"
#include "plaza/geometry/scene.h"

namespace plaza {

struct ConfigValue;
class DiagnosticSink;

/// Where a value of the configuration was written, and its JSON pointer in that file. The `file` of
/// a value given on the command line is "--set /nodes/edges/sigma_px=2.5", that of a default is
/// empty.
struct Origin {
  FilePosition where;
  std::string pointer;
};

/// "pipelines/pets-s2l1.json:12:7", "--set /nodes/edges/sigma_px=2.5" or "default".
std::string to_string(const Origin& origin);

/// JSON pointer below the component ("/sigma_px", "/files/view1") -> origin.
using Origins = std::map<std::string, Origin, std::less<>>;

/// A nested component, ready to be made.
struct ResolvedPart {
  std::string name;
  const ComponentEntry* entry = nullptr;
  nlohmann::json values;  ///< every plain parameter, defaults filled in, paths replaced
  Origins
      origins;  ///< of "/use", "/name" and every plain value, elements of lists and maps included
  std::map<std::string, std::vector<ResolvedPart>> parts;  ///< by parameter
  FilePosition where;
  std::string pointer;  ///< in the file of `where`: "/nodes/7/affinities/0"
  std::string path;     ///< by names: "/nodes/tracks/affinities/location"
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
  std::string description;     ///< empty when there is none
  std::filesystem::path file;  ///< as given
  std::filesystem::path scene_file;
  std::uint64_t seed = 0;
  std::vector<ResolvedNode> nodes;
  Origins origins;  ///< of "/name", "/scene", "/seed", "/description"

  /// The contents of resolved.json: the complete configuration and, in "origins", the origin of
  /// every value by JSON pointer. It is a pipeline itself (paths absolute, wiring spelled out):
  /// running it gives the same.
  nlohmann::json resolved_json() const;
};

struct PipelineRequest {
  std::filesystem::path file;
  std::vector<std::string> sets;  ///< "/nodes/edges/sigma_px=2.5"
  /// What else is to be changed once all files are merged and before anything is checked.
  std::function<void(ConfigValue& root, DiagnosticSink& diagnostics)> edit = nullptr;
};

/// Reads, merges, checks and wires a pipeline. Every fault that can be found without making
/// components is reported in one UserError, in the order of their places.
ResolvedPipeline read_pipeline(const PipelineRequest& request, const Registry& registry);

/// The same from text; `request.file` names it in messages and is the start of relative paths.
ResolvedPipeline read_pipeline_text(std::string_view text, const PipelineRequest& request,
                                    const Registry& registry);

/// A pipeline and the scene that it plays in.
struct PipelineInScene {
  ResolvedPipeline pipeline;
  std::shared_ptr<const Scene> scene;
};

/// Reads both. The scene is read however much is wrong with the pipeline, as long as that says
/// which; what is wrong with either is reported in one UserError, the pipeline's faults first.
PipelineInScene read_pipeline_in_scene(const PipelineRequest& request, const Registry& registry);

/// A pipeline's components, made and wired, in node order.
struct Assembly {
  std::shared_ptr<const Scene> scene;
  std::vector<std::shared_ptr<Component>> nodes;  ///< each is a Node
};

/// Makes all components (parts before their owners, nodes in order) and calls check() on each,
/// parts included. All faults of all components in one UserError, each with file, line, column and
/// pointer. What a plugin throws that is no plaza::Error becomes an InternalError naming the
/// component.
Assembly assemble(const ResolvedPipeline& pipeline, std::shared_ptr<const Scene> scene,
                  const std::filesystem::path& output_folder);

/// The seed of one component: a 64-bit mix (splitmix64) of the pipeline's seed and the FNV-1a hash
/// of the component's path by names. It depends on nothing else: adding a node leaves the others'
/// seeds alone.
std::uint64_t component_seed(std::uint64_t pipeline_seed, std::string_view path);

/// `$PLAZA_DATA/...` replaced; relative paths start at the folder of `file`; empty stays empty. The
/// result is lexically normal. $PLAZA_DATA is the environment's, else ../shared/data where that is
/// a folder, else the same relative to one of the folders above `file`, else ../shared/data. Throws
/// UserError for any other
/// `$NAME` at the start.
std::filesystem::path resolve_path(const std::string& text, const std::filesystem::path& file);

}  // namespace plaza
