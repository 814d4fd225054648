#include <algorithm>
#include <utility>

#include "framework/config/component_reader.h"
#include "framework/config/extends.h"
#include "framework/config/pipeline.h"
#include "framework/config/set_option.h"
#include "framework/config/text.h"
#include "framework/config/value_check.h"
#include "framework/config/wiring.h"
#include "framework/scene/scene_file.h"
#include "plaza/core/error.h"

namespace plaza {
namespace {

constexpr int kLanguageVersion = 1;

const std::vector<std::string>& top_level_keys() {
  static const std::vector<std::string> kKeys = {
      "$schema", "plaza", "name", "description", "scene", "seed", "nodes", "extends", "origins"};
  return kKeys;
}

/// Everything beside the nodes.
class TopLevelReader {
 public:
  TopLevelReader(const ConfigValue& root, ResolvedPipeline& pipeline, DiagnosticSink& diagnostics)
      : root_(root), pipeline_(pipeline), diagnostics_(diagnostics) {}

  void read() {
    const std::vector<std::string>& known = top_level_keys();
    for (const ConfigMember& member : root_.members) {
      if (std::find(known.begin(), known.end(), member.key) != known.end()) continue;
      const std::string hint = did_you_mean(member.key, known);
      diagnostics_.add(
          member.key_origin,
          "unknown key of a pipeline" +
              (hint.empty() ? "; it has " + quote_all({known.begin(), known.end() - 1}) : hint));
    }
    read_version();
    if (const ConfigValue* schema = root_.find("$schema"))
      expect_text(*schema, "the place of a JSON schema");
    pipeline_.name = pipeline_.file.stem().string();
    if (const ConfigValue* name = find("name"); name != nullptr && expect_text(*name, "a title")) {
      pipeline_.name = name->text();
    }
    if (const ConfigValue* text = find("description");
        text != nullptr && expect_text(*text, "text")) {
      pipeline_.description = text->text();
    }
    read_seed();
    read_scene();
  }

 private:
  /// The member; its origin is noted, "default" where there is none.
  const ConfigValue* find(const std::string& key) {
    const ConfigValue* value = root_.find(key);
    Origin origin;
    origin.pointer = "/" + key;
    pipeline_.origins["/" + key] = value == nullptr ? origin : value->origin;
    return value;
  }

  bool expect_text(const ConfigValue& value, const std::string& what) {
    if (value.is_text()) return true;
    diagnostics_.add(value.origin, "expected " + what + ", got " + type_name(value));
    return false;
  }

  void read_version() {
    const ConfigValue* version = root_.find("plaza");
    const std::string wanted = "\"plaza\": " + std::to_string(kLanguageVersion);
    if (version == nullptr) {
      diagnostics_.add(root_.origin,
                       "missing " + wanted + ", the version of the pipeline language");
    } else if (!version->plain.is_number() || version->plain != kLanguageVersion) {
      diagnostics_.add(version->origin,
                       "expected " + std::to_string(kLanguageVersion) +
                           ", the version of the pipeline language that this Plaza reads, got " +
                           type_name(*version));
    }
  }

  void read_seed() {
    const ConfigValue* seed = find("seed");
    if (seed == nullptr) return;
    ParameterSpec spec;
    spec.type = ParameterType::kInteger;
    spec.minimum = 0;
    spec.required = true;
    Origins unused;
    const nlohmann::json value = check_value(*seed, spec, pipeline_.file, "", unused, diagnostics_);
    if (value.is_number()) pipeline_.seed = value.get<std::uint64_t>();
  }

  void read_scene() {
    const ConfigValue* scene = find("scene");
    if (scene == nullptr) {
      diagnostics_.add(root_.origin,
                       "missing \"scene\", the path of the scene file (cameras, ground area)");
      return;
    }
    if (!expect_text(*scene, "the path of a scene file")) return;
    try {
      pipeline_.scene_file = resolve_config_path(*scene, pipeline_.file);
    } catch (const UserError& error) {
      diagnostics_.add(scene->origin, error.what());
      return;
    }
    std::error_code error;
    if (!std::filesystem::is_regular_file(pipeline_.scene_file, error)) {
      diagnostics_.add(scene->origin, "there is no scene file " + pipeline_.scene_file.string());
      pipeline_.scene_file.clear();
    }
  }

  const ConfigValue& root_;
  ResolvedPipeline& pipeline_;
  DiagnosticSink& diagnostics_;
};

void read_nodes(const ConfigValue& root, const Registry& registry, ResolvedPipeline& pipeline,
                DiagnosticSink& diagnostics) {
  const ConfigValue* nodes = root.find("nodes");
  if (nodes == nullptr) {
    diagnostics.add(root.origin, "missing \"nodes\", the list of components from source to sink");
    return;
  }
  if (!nodes->is_array()) {
    diagnostics.add(nodes->origin, "expected a list of nodes, got " + type_name(*nodes));
    return;
  }
  if (nodes->items.empty()) {
    diagnostics.add(nodes->origin, "a pipeline needs at least one node, a source");
    return;
  }
  std::vector<NodeDraft> drafts =
      ComponentReader(registry, pipeline.file, diagnostics).read_nodes(*nodes);
  wire_nodes(drafts, registry, diagnostics);
  for (NodeDraft& draft : drafts) pipeline.nodes.push_back(std::move(draft.node));
}

/// What was understood of a pipeline, and what is wrong with it.
struct Reading {
  ResolvedPipeline pipeline;  ///< scene_file is empty when there is no such file
  Diagnostics faults;
};

Reading read_with_faults(std::string_view text, const PipelineRequest& request,
                         const Registry& registry) {
  DiagnosticSink diagnostics;
  Reading reading;
  reading.pipeline.file = request.file;
  MergedConfig config = read_merged(text, request.file, diagnostics);
  if (request.edit) request.edit(config.root, diagnostics);
  apply_sets(config.root, request.sets, registry, diagnostics);
  TopLevelReader(config.root, reading.pipeline, diagnostics).read();
  read_nodes(config.root, registry, reading.pipeline, diagnostics);
  reading.faults = diagnostics.take(config.files);
  return reading;
}

}  // namespace

ResolvedPipeline read_pipeline_text(std::string_view text, const PipelineRequest& request,
                                    const Registry& registry) {
  Reading reading = read_with_faults(text, request, registry);
  if (!reading.faults.empty()) throw UserError(std::move(reading.faults));
  return std::move(reading.pipeline);
}

ResolvedPipeline read_pipeline(const PipelineRequest& request, const Registry& registry) {
  return read_pipeline_text(read_text_file(request.file), request, registry);
}

PipelineInScene read_pipeline_in_scene(const PipelineRequest& request, const Registry& registry) {
  Reading reading = read_with_faults(read_text_file(request.file), request, registry);
  PipelineInScene both;
  if (!reading.pipeline.scene_file.empty()) {
    try {
      both.scene = read_scene(reading.pipeline.scene_file);
    } catch (const UserError& error) {
      const Diagnostics& faults = error.diagnostics();
      reading.faults.insert(reading.faults.end(), faults.begin(), faults.end());
    }
  }
  if (!reading.faults.empty()) throw UserError(std::move(reading.faults));
  both.pipeline = std::move(reading.pipeline);
  return both;
}

}  // namespace plaza
