#include "framework/config/component_reader.h"

#include <algorithm>
#include <utility>

#include "framework/config/text.h"
#include "framework/config/value_check.h"
#include "plaza/core/error.h"

namespace plaza {
namespace {

bool is_name(std::string_view text) {
  const auto is_letter = [](char c) { return c >= 'a' && c <= 'z'; };
  if (text.empty() || !is_letter(text.front())) return false;
  return std::all_of(text.begin(), text.end(),
                     [&](char c) { return is_letter(c) || (c >= '0' && c <= '9') || c == '-'; });
}

/// "detector" -> the names of all detectors, for people who left out "use".
std::vector<std::string> names_of_kind(const Registry& registry, std::string_view kind) {
  std::vector<std::string> names;
  for (const ComponentEntry* entry : registry.all(kind)) {
    if (!kind.empty() || is_node_kind(entry->declaration.kind))
      names.push_back(entry->declaration.name);
  }
  return names;
}

/// Which parameters of which components take a part of this kind: "\"shape\" of
/// \"hierarchical-grid\"".
std::string owners_of(const Registry& registry, std::string_view kind) {
  std::string text;
  for (const ComponentEntry* entry : registry.all()) {
    for (const ParameterSpec& spec : entry->declaration.parameters) {
      if (spec.part_kind != kind) continue;
      if (!text.empty()) text += ", ";
      text += quote(spec.name) + " of " + quote(entry->declaration.name);
    }
  }
  return text;
}

}  // namespace

bool is_node_kind(std::string_view kind) {
  return kind != "shape" && kind != "appearance" && kind != "motion" && kind != "affinity";
}

void ComponentReader::fail(const Origin& origin, std::string message) {
  diagnostics_.add(
      {origin.where.file.empty() ? fallback_ : origin.where, origin.pointer, std::move(message)});
}

std::vector<NodeDraft> ComponentReader::read_nodes(const ConfigValue& nodes) {
  std::vector<NodeDraft> drafts(nodes.items.size());
  std::vector<const ConfigValue*> values;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < drafts.size(); ++i) {
    drafts[i].value = &nodes.items[i];
    read_component(nodes.items[i], {{}, &drafts[i], false}, "/nodes", drafts[i].node);
    values.push_back(drafts[i].value);
    names.push_back(drafts[i].node.name);
  }
  refuse_twins(values, names, "node");
  return drafts;
}

void ComponentReader::refuse_twins(const std::vector<const ConfigValue*>& values,
                                   const std::vector<std::string>& names, std::string_view what) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i].empty()) continue;
    const auto first =
        static_cast<std::size_t>(std::find(names.begin(), names.end(), names[i]) - names.begin());
    if (first == i) continue;
    const ConfigValue* own_name = values[i]->find("name");
    const ConfigValue* place = own_name != nullptr ? own_name : values[i]->find("use");
    std::string message = "there is already a ";
    message += what;
    message += " " + quote(names[i]) + " (" + values[first]->origin.pointer + "); ";
    message += own_name != nullptr ? "names are unique" : "give this one a \"name\" of its own";
    fail(place->origin, message);
  }
}

const ComponentEntry* ComponentReader::find_entry(const ConfigValue& value, const Role& role) {
  const std::string what = role.kind.empty() ? "component" : std::string(role.kind);
  const ConfigValue* use = value.find("use");
  if (use == nullptr) {
    const std::vector<std::string> names = names_of_kind(registry_, role.kind);
    fail(value.origin, "missing \"use\", the name of " + a_or_an(what) +
                           (names.empty() ? "" : "; there are " + quote_all(names)));
    return nullptr;
  }
  if (!use->is_text()) {
    fail(use->origin, "expected the name of " + a_or_an(what) + ", got " + type_name(*use));
    return nullptr;
  }
  const ComponentEntry* entry = registry_.find(use->text());
  if (entry == nullptr || (!role.kind.empty() && entry->declaration.kind != role.kind)) {
    fail(use->origin, registry_.explain_missing(use->text(), role.kind));
    return nullptr;
  }
  if (role.kind.empty() && !is_node_kind(entry->declaration.kind)) {
    const std::string& kind = entry->declaration.kind;
    const std::string owners = owners_of(registry_, kind);
    fail(use->origin, quote(use->text()) + " is " + a_or_an(kind) +
                          ", a part of other components, not a node" +
                          (owners.empty() ? "" : "; it belongs into " + owners));
    return nullptr;
  }
  return entry;
}

void ComponentReader::read_name(const ConfigValue& value, ResolvedPart& part) {
  const ConfigValue* name = value.find("name");
  if (name == nullptr) {
    part.name = config_name(value);
    if (const ConfigValue* use = value.find("use")) part.origins["/name"] = use->origin;
    return;
  }
  part.origins["/name"] = name->origin;
  if (!name->is_text() || !is_name(name->text())) {
    fail(
        name->origin,
        "expected a name of lower-case letters, digits and hyphens, beginning with a letter, got " +
            (name->is_text() ? quote(name->text()) : type_name(*name)));
  }
  if (name->is_text()) part.name = name->text();
}

void ComponentReader::read_component(const ConfigValue& value, const Role& role,
                                     const std::string& parent_path, ResolvedPart& part) {
  const FilePosition outer_fallback = fallback_;
  if (!value.origin.where.file.empty()) fallback_ = value.origin.where;
  part.where = fallback_;
  part.pointer = value.origin.pointer;
  part.values = nlohmann::json::object();
  if (!value.is_object()) {
    fail(value.origin,
         "expected { \"use\": " + a_or_an(role.kind.empty() ? "component" : role.kind) +
             ", ... }, got " + type_name(value));
  } else {
    read_name(value, part);
    part.path = role.only ? parent_path : parent_path + "/" + part.name;
    part.entry = find_entry(value, role);
    if (const ConfigValue* use = value.find("use")) part.origins["/use"] = use->origin;
    if (part.entry != nullptr) read_parameters(value, role, part);
  }
  fallback_ = outer_fallback;
}

void ComponentReader::read_parameters(const ConfigValue& value, const Role& role,
                                      ResolvedPart& part) {
  const ComponentDeclaration& declaration = part.entry->declaration;
  std::vector<std::string> known;
  for (const ParameterSpec& spec : declaration.parameters) known.push_back(spec.name);
  std::vector<std::string> accepted = known;
  accepted.insert(accepted.end(), {"use", "name"});
  if (role.draft != nullptr) accepted.emplace_back("from");

  for (const ConfigMember& member : value.members) {
    if (std::find(accepted.begin(), accepted.end(), member.key) != accepted.end()) continue;
    std::string hint = did_you_mean(member.key, accepted);
    if (hint.empty()) {
      hint =
          known.empty() ? "; it has no parameters" : "; see `plaza show " + declaration.name + "`";
    }
    if (member.key == "from" && role.draft == nullptr) hint = "; only nodes read from others";
    fail(member.key_origin, "unknown parameter of " + quote(declaration.name) + hint);
  }
  for (const ParameterSpec& spec : declaration.parameters) {
    if (const ConfigValue* given = value.find(spec.name)) {
      read_parameter(*given, spec, role, part);
    } else if (spec.required) {
      fail(value.origin, "missing parameter " + quote(spec.name) + " of " +
                             quote(declaration.name) + ": " + expectation(spec) +
                             (spec.meaning.empty() ? "" : " (" + spec.meaning + ")"));
    } else {
      read_default(spec, role, part);
    }
  }
}

void ComponentReader::read_default(const ParameterSpec& spec, const Role& role,
                                   ResolvedPart& part) {
  Origin origin;
  origin.pointer = part.pointer + "/" + pointer_token(spec.name);
  const ConfigValue value = to_config_value(spec.default_value, origin);
  if (spec.type == ParameterType::kPart || spec.type == ParameterType::kPartList ||
      spec.type == ParameterType::kInputList) {
    read_parameter(value, spec, role, part);
    return;
  }
  // a default that its own declaration refuses is the plugin's fault, not the user's
  DiagnosticSink faults;
  part.values[spec.name] = check_value(value, spec, pipeline_file_, "/" + pointer_token(spec.name),
                                       part.origins, faults);
  if (!faults.empty()) {
    throw InternalError("component " + quote(part.entry->declaration.name) +
                        " declares a default for " + quote(spec.name) +
                        " that it does not accept: " + spec.default_value.dump());
  }
}

void ComponentReader::read_parameter(const ConfigValue& value, const ParameterSpec& spec,
                                     const Role& role, ResolvedPart& part) {
  switch (spec.type) {
    case ParameterType::kPart:
      return read_part(value, spec, part);
    case ParameterType::kPartList:
      return read_part_list(value, spec, part);
    case ParameterType::kInputList:
      return read_input_list(value, spec, role, part);
    default:
      part.values[spec.name] = check_value(
          value, spec, pipeline_file_, "/" + pointer_token(spec.name), part.origins, diagnostics_);
  }
}

void ComponentReader::read_part(const ConfigValue& value, const ParameterSpec& spec,
                                ResolvedPart& part) {
  if (!value.is_object()) {
    fail(value.origin, "expected " + expectation(spec) + ", got " + type_name(value));
    return;
  }
  ResolvedPart& nested = part.parts[spec.name].emplace_back();
  read_component(value, {spec.part_kind, nullptr, true}, part.path + "/" + spec.name, nested);
}

bool ComponentReader::check_count(const ConfigValue& value, const ParameterSpec& spec) {
  if (!value.is_array()) {
    fail(value.origin, "expected " + expectation(spec) + ", got " + type_name(value));
    return false;
  }
  const std::size_t count = value.items.size();
  if (count < spec.min_items || (spec.max_items && count > *spec.max_items)) {
    std::string wanted = std::to_string(spec.min_items);
    if (!spec.max_items) {
      wanted += " or more";
    } else if (*spec.max_items != spec.min_items) {
      wanted += " to " + std::to_string(*spec.max_items);
    }
    fail(value.origin, "expected " + wanted + " elements, got " + std::to_string(count) +
                           "; takes a " + expectation(spec));
  }
  return true;
}

void ComponentReader::read_part_list(const ConfigValue& value, const ParameterSpec& spec,
                                     ResolvedPart& part) {
  std::vector<ResolvedPart>& nested = part.parts[spec.name];
  if (!check_count(value, spec)) return;
  std::vector<const ConfigValue*> values;
  std::vector<std::string> names;
  for (const ConfigValue& item : value.items) {
    read_component(item, {spec.part_kind, nullptr, false}, part.path + "/" + spec.name,
                   nested.emplace_back());
    values.push_back(&item);
    names.push_back(nested.back().name);
  }
  refuse_twins(values, names, "part");
}

void ComponentReader::read_input_list(const ConfigValue& value, const ParameterSpec& spec,
                                      const Role& role, ResolvedPart& part) {
  if (role.draft == nullptr) {
    throw InternalError("component " + quote(part.entry->declaration.name) +
                        " is used as a part but declares the inputs " + quote(spec.name) +
                        "; only nodes have inputs");
  }
  role.draft->node.input_lists[spec.name];
  if (!check_count(value, spec)) return;
  for (std::size_t i = 0; i < value.items.size(); ++i) {
    const ConfigValue& record = value.items[i];
    if (!record.is_object()) {
      fail(record.origin, "expected { \"from\": a node that gives " + spec.port + ", ... }, got " +
                              type_name(record));
      continue;
    }
    read_record(record, spec, "/" + pointer_token(spec.name) + "/" + std::to_string(i), *role.draft,
                part);
  }
}

void ComponentReader::read_record(const ConfigValue& record, const ParameterSpec& spec,
                                  const std::string& pointer, NodeDraft& draft,
                                  ResolvedPart& part) {
  InputRecordDraft out{spec.name, spec.port, {}, record.origin, nlohmann::json::object()};
  std::vector<std::string> accepted = {"from"};
  for (const ParameterSpec& field : spec.element) accepted.push_back(field.name);
  for (const ConfigMember& member : record.members) {
    if (std::find(accepted.begin(), accepted.end(), member.key) != accepted.end()) continue;
    const std::string hint = did_you_mean(member.key, accepted);
    fail(member.key_origin, "unknown key in " + quote(spec.name) + " of " +
                                quote(part.entry->declaration.name) +
                                (hint.empty() ? "; it takes " + quote_all(accepted) : hint));
  }
  if (const ConfigValue* from = record.find("from"); from == nullptr) {
    fail(record.origin, "missing \"from\", the name of a node that gives " + spec.port);
  } else if (!from->is_text()) {
    fail(from->origin,
         "expected the name of a node that gives " + spec.port + ", got " + type_name(*from));
  } else {
    out.from = from->text();
    out.origin = from->origin;
    part.origins[pointer + "/from"] = from->origin;
  }
  for (const ParameterSpec& field : spec.element) {
    const std::string below = pointer + "/" + pointer_token(field.name);
    if (const ConfigValue* given = record.find(field.name)) {
      out.fields[field.name] =
          check_value(*given, field, pipeline_file_, below, part.origins, diagnostics_);
    } else if (field.required) {
      fail(record.origin, "missing " + quote(field.name) + ": " + expectation(field));
    } else {
      Origin origin;
      origin.pointer = part.pointer + below;
      out.fields[field.name] = check_value(to_config_value(field.default_value, origin), field,
                                           pipeline_file_, below, part.origins, diagnostics_);
    }
  }
  draft.records.push_back(std::move(out));
}

}  // namespace plaza
