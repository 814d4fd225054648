#include "framework/config/schema.h"

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "framework/config/component_reader.h"
#include "framework/config/value_check.h"

namespace plaza {
namespace {

using nlohmann::json;

json reference(const std::string& definition) { return {{"$ref", "#/definitions/" + definition}}; }

/// Meaning, unit, range and source in one text, which is what editors show.
std::string description(const ParameterSpec& spec) {
  std::string text = spec.meaning;
  const auto add = [&text](const std::string& more) {
    if (!text.empty()) text += "; ";
    text += more;
  };
  if (!spec.unit.empty()) add("in " + spec.unit);
  const std::string range = range_text(spec);
  if (!range.empty()) add(range);
  if (spec.required) add("required");
  if (!spec.source.empty()) add("source: " + spec.source);
  return text;
}

void add_limits(const ParameterSpec& spec, json& schema) {
  if (spec.minimum) schema[spec.minimum_exclusive ? "exclusiveMinimum" : "minimum"] = *spec.minimum;
  if (spec.maximum) schema[spec.maximum_exclusive ? "exclusiveMaximum" : "maximum"] = *spec.maximum;
}

json value_schema(const ParameterSpec& spec);

json record_schema(const ParameterSpec& spec) {
  json properties = {
      {"from", {{"type", "string"}, {"description", "a node above that gives " + spec.port}}}};
  json required = json::array({"from"});
  for (const ParameterSpec& field : spec.element) {
    properties[field.name] = value_schema(field);
    if (field.required) required.push_back(field.name);
  }
  return {{"type", "object"},
          {"properties", std::move(properties)},
          {"required", std::move(required)},
          {"additionalProperties", false}};
}

void add_structure(const ParameterSpec& spec, json& schema) {
  switch (spec.type) {
    case ParameterType::kBoolean:
      schema["type"] = "boolean";
      break;
    case ParameterType::kInteger:
      schema["type"] = "integer";
      add_limits(spec, schema);
      break;
    case ParameterType::kReal:
      schema["type"] = "number";
      add_limits(spec, schema);
      break;
    case ParameterType::kText:
    case ParameterType::kPath:
      schema["type"] = "string";
      break;
    case ParameterType::kChoice:
      schema["enum"] = spec.choices;
      break;
    case ParameterType::kList:
      schema["type"] = "array";
      schema["items"] = value_schema(spec.element.at(0));
      break;
    case ParameterType::kMap:
      schema["type"] = "object";
      schema["additionalProperties"] = value_schema(spec.element.at(0));
      break;
    case ParameterType::kPart:
      schema["allOf"] = json::array({reference("part." + spec.part_kind)});
      break;
    case ParameterType::kPartList:
      schema["type"] = "array";
      schema["items"] = reference("part." + spec.part_kind);
      break;
    case ParameterType::kInputList:
      schema["type"] = "array";
      schema["items"] = record_schema(spec);
      break;
  }
  const bool by_name = spec.type == ParameterType::kMap;
  if (spec.min_items > 0) schema[by_name ? "minProperties" : "minItems"] = spec.min_items;
  if (spec.max_items) schema[by_name ? "maxProperties" : "maxItems"] = *spec.max_items;
}

json value_schema(const ParameterSpec& spec) {
  json schema = json::object();
  if (std::string text = description(spec); !text.empty()) schema["description"] = std::move(text);
  const bool nullable = !spec.name.empty() && !spec.required && spec.default_value.is_null();
  if (!nullable) {
    add_structure(spec, schema);
    if (!spec.required && !spec.default_value.is_null()) schema["default"] = spec.default_value;
    return schema;
  }
  json given = json::object();
  add_structure(spec, given);
  schema["anyOf"] = json::array({std::move(given), {{"type", "null"}}});
  schema["default"] = nullptr;
  return schema;
}

json name_schema() {
  return {{"type", "string"},
          {"pattern", "^[a-z][a-z0-9-]*$"},
          {"description", "name, unique among its neighbours; by default that of the component"}};
}

json from_schema(const ComponentDeclaration& d) {
  json by_type = {
      {"type", "object"}, {"properties", json::object()}, {"additionalProperties", false}};
  std::string reads;
  for (const PortSpec& port : d.inputs) {
    reads += (reads.empty() ? "" : ", ") + port.type;
    by_type["properties"][port.type] = {{"type", {"string", "null"}},
                                        {"description", port.meaning}};
  }
  return {{"description", "node or nodes above to read from instead of the nearest; reads " +
                              (reads.empty() ? "nothing" : reads)},
          {"anyOf",
           {{{"type", "string"}},
            {{"type", "array"}, {"items", {{"type", "string"}}}},
            std::move(by_type),
            {{"type", "null"}}}}};
}

/// The object of one component. Nothing is required here: pipelines that extend others leave things
/// out.
json component_schema(const ComponentDeclaration& d) {
  json properties = {{"use", {{"const", d.name}, {"description", d.summary}}},
                     {"name", name_schema()}};
  const json place = {{"type", "string"},
                      {"description", "only with \"extends\": the place of a new element"}};
  properties["after"] = place;
  properties["before"] = place;
  if (is_node_kind(d.kind)) properties["from"] = from_schema(d);
  for (const ParameterSpec& spec : d.parameters) properties[spec.name] = value_schema(spec);
  std::string text = d.summary;
  if (!d.source.empty()) text += " Source: " + d.source;
  return {{"type", "object"},
          {"description", std::move(text)},
          {"properties", std::move(properties)},
          {"additionalProperties", false}};
}

/// One of several components, told apart by "use".
json choice_schema(const std::vector<const ComponentEntry*>& entries, const std::string& what) {
  json names = json::array();
  json summaries = json::array();
  json branches = json::array();
  for (const ComponentEntry* entry : entries) {
    const ComponentDeclaration& d = entry->declaration;
    names.push_back(d.name);
    summaries.push_back(d.summary);
    branches.push_back(
        {{"if", {{"properties", {{"use", {{"const", d.name}}}}}, {"required", {"use"}}}},
         {"then", reference("component." + d.name)}});
  }
  names.push_back(nullptr);
  summaries.push_back("only with \"extends\": removes the element");
  json schema = {{"type", "object"},
                 {"properties",
                  {{"use",
                    {{"description", "the " + what},
                     {"enum", std::move(names)},
                     {"enumDescriptions", std::move(summaries)}}},
                   {"name", name_schema()}}}};
  if (!branches.empty()) schema["allOf"] = std::move(branches);
  return schema;
}

/// What a pipeline of its own must say beside: "use" everywhere, and every required parameter.
json complete_node_schema(const std::vector<const ComponentEntry*>& entries) {
  json branches = json::array();
  for (const ComponentEntry* entry : entries) {
    json required = json::array();
    for (const ParameterSpec& spec : entry->declaration.parameters) {
      if (spec.required) required.push_back(spec.name);
    }
    if (required.empty()) continue;
    branches.push_back(
        {{"if",
          {{"properties", {{"use", {{"const", entry->declaration.name}}}}}, {"required", {"use"}}}},
         {"then", {{"required", std::move(required)}}}});
  }
  json schema = {{"required", {"use"}}, {"properties", {{"use", {{"type", "string"}}}}}};
  if (!branches.empty()) schema["allOf"] = std::move(branches);
  return schema;
}

}  // namespace

json pipeline_schema(const Registry& registry) {
  json definitions = json::object();
  std::vector<const ComponentEntry*> nodes;
  std::set<std::string> part_kinds;
  for (const ComponentEntry* entry : registry.all()) {
    const ComponentDeclaration& d = entry->declaration;
    definitions["component." + d.name] = component_schema(d);
    if (is_node_kind(d.kind)) nodes.push_back(entry);
    for (const ParameterSpec& spec : d.parameters) {
      if (!spec.part_kind.empty()) part_kinds.insert(spec.part_kind);
    }
  }
  for (const std::string& kind : part_kinds) {
    definitions["part." + kind] = choice_schema(registry.all(kind), kind);
  }
  definitions["node"] = choice_schema(nodes, "component of this node");
  definitions["complete-node"] = complete_node_schema(nodes);

  json properties = {
      {"$schema", {{"type", "string"}, {"description", "where this schema is, for editors"}}},
      {"plaza", {{"const", 1}, {"description", "version of the pipeline language"}}},
      {"name", {{"type", "string"}, {"description", "title; by default the file's name"}}},
      {"description", {{"type", "string"}, {"description", "what the pipeline is for"}}},
      {"scene",
       {{"type", "string"}, {"description", "path of the scene file: cameras, ground area"}}},
      {"seed",
       {{"type", "integer"},
        {"minimum", 0},
        {"default", 0},
        {"description", "seed of all randomness"}}},
      {"extends",
       {{"type", "string"}, {"description", "path of a pipeline that this one changes"}}},
      {"nodes",
       {{"type", "array"},
        {"description",
         "components from source to sink; each reads from the nearest above that fits"},
        {"items", reference("node")}}},
      {"origins",
       {{"type", "object"}, {"description", "of the values, in resolved.json; has no effect"}}}};
  const json complete = {
      {"required", {"plaza", "scene", "nodes"}},
      {"properties", {{"nodes", {{"minItems", 1}, {"items", reference("complete-node")}}}}}};
  return {{"$schema", "http://json-schema.org/draft-07/schema#"},
          {"title", "Plaza pipeline"},
          {"type", "object"},
          {"properties", std::move(properties)},
          {"additionalProperties", false},
          {"if", {{"required", {"extends"}}}},
          {"then", json::object()},
          {"else", complete},
          {"definitions", std::move(definitions)}};
}

}  // namespace plaza
