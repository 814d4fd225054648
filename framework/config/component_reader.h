#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "framework/config/config_value.h"
#include "framework/plugin/registry.h"

namespace plaza {

/// One record of an input list, checked but not yet wired.
struct InputRecordDraft {
  std::string parameter;
  std::string port;
  std::string from;
  Origin origin;  ///< of "from"
  nlohmann::json fields;
};

/// A node on its way from text to ResolvedNode.
struct NodeDraft {
  const ConfigValue* value = nullptr;
  ResolvedNode node;  ///< node.entry is null where the component is not known
  std::vector<InputRecordDraft> records;
};

/// True for the kinds that stand in a pipeline's "nodes"; the others are parts of components.
bool is_node_kind(std::string_view kind);

/// Checks components against their declarations: known names, every parameter with its type, range,
/// choice, default, nested parts at any depth. Faults go to the sink.
class ComponentReader {
 public:
  ComponentReader(const Registry& registry, std::filesystem::path pipeline_file,
                  DiagnosticSink& diagnostics)
      : registry_(registry), pipeline_file_(std::move(pipeline_file)), diagnostics_(diagnostics) {}

  /// All nodes, in their order; names unique.
  std::vector<NodeDraft> read_nodes(const ConfigValue& nodes);

 private:
  /// What is being read: a node (`kind` empty, `draft` set) or a part of that kind.
  struct Role {
    std::string_view kind;
    NodeDraft* draft = nullptr;
    bool only = false;  ///< the only part of its parameter, which names it
  };
  void read_component(const ConfigValue& value, const Role& role, const std::string& parent_path,
                      ResolvedPart& part);
  const ComponentEntry* find_entry(const ConfigValue& value, const Role& role);
  void read_name(const ConfigValue& value, ResolvedPart& part);
  void read_parameters(const ConfigValue& value, const Role& role, ResolvedPart& part);
  void read_parameter(const ConfigValue& value, const ParameterSpec& spec, const Role& role,
                      ResolvedPart& part);
  void read_default(const ParameterSpec& spec, const Role& role, ResolvedPart& part);
  void read_part(const ConfigValue& value, const ParameterSpec& spec, ResolvedPart& part);
  void read_part_list(const ConfigValue& value, const ParameterSpec& spec, ResolvedPart& part);
  void read_input_list(const ConfigValue& value, const ParameterSpec& spec, const Role& role,
                       ResolvedPart& part);
  void read_record(const ConfigValue& record, const ParameterSpec& spec, const std::string& pointer,
                   NodeDraft& draft, ResolvedPart& part);
  bool check_count(const ConfigValue& value, const ParameterSpec& spec);
  void refuse_twins(const std::vector<const ConfigValue*>& values,
                    const std::vector<std::string>& names, std::string_view what);
  void fail(const Origin& origin, std::string message);

  const Registry& registry_;
  std::filesystem::path pipeline_file_;
  DiagnosticSink& diagnostics_;
  FilePosition fallback_;  ///< place of the innermost written component, for faults in its defaults
};

}  // namespace plaza
