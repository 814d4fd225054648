#include "framework/config/component_text.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>
#include <vector>

#include "framework/config/component_reader.h"
#include "framework/config/text.h"
#include "framework/config/value_check.h"

namespace plaza {
namespace {

using nlohmann::json;

/// Rows of equal length as aligned columns; a column that is empty everywhere is left out.
std::string table(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths(rows.front().size(), 0);
  std::vector<bool> used(widths.size(), false);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    for (std::size_t c = 0; c < widths.size(); ++c) {
      widths[c] = std::max(widths[c], rows[r][c].size());
      used[c] = used[c] || (r > 0 && !rows[r][c].empty());
    }
  }
  std::string out;
  for (const std::vector<std::string>& row : rows) {
    std::string line = " ";
    for (std::size_t c = 0; c < row.size(); ++c) {
      if (!used[c]) continue;
      std::string cell = row[c];
      cell.resize(std::max(cell.size(), widths[c]), ' ');
      line += " " + cell + " ";
    }
    line.erase(line.find_last_not_of(' ') + 1);
    out += line + "\n";
  }
  return out;
}

std::string default_text(const ParameterSpec& spec) {
  if (spec.required) return "required";
  if (spec.default_value.is_null()) return "not set";
  if (spec.type == ParameterType::kPart) return spec.default_value.value("use", "");
  return spec.default_value.dump();
}

std::string_view better_text(Better better) {
  switch (better) {
    case Better::kHigher:
      return "higher is better";
    case Better::kLower:
      return "lower is better";
    case Better::kNeither:
      return "";
  }
  return "";
}

const ParameterSpec& innermost(const ParameterSpec& spec) {
  const bool nested = (spec.type == ParameterType::kList || spec.type == ParameterType::kMap) &&
                      !spec.element.empty();
  return nested ? innermost(spec.element[0]) : spec;
}

void append_parameter(const ParameterSpec& spec, const std::string& prefix,
                      std::vector<std::vector<std::string>>& rows) {
  rows.push_back({prefix + spec.name, parameter_type_text(spec), spec.unit, default_text(spec),
                  range_text(innermost(spec)), spec.meaning, spec.source});
  if (spec.type != ParameterType::kInputList) return;
  for (const ParameterSpec& field : spec.element)
    append_parameter(field, prefix + spec.name + "/", rows);
}

std::string ports_text(const std::string& heading, const std::vector<PortSpec>& ports,
                       bool inputs) {
  if (ports.empty()) return {};
  std::vector<std::vector<std::string>> rows = {{"type", "", "meaning"}};
  for (const PortSpec& port : ports) {
    rows.push_back({port.type, inputs && !port.required ? "optional" : "", port.meaning});
  }
  const std::string text = table(rows);
  return "\n" + heading + "\n" + text.substr(text.find('\n') + 1);  // two columns need no headings
}

json ports_json(const std::vector<PortSpec>& ports) {
  json out = json::array();
  for (const PortSpec& port : ports) {
    out.push_back({{"type", port.type}, {"required", port.required}, {"meaning", port.meaning}});
  }
  return out;
}

json parameter_json(const ParameterSpec& spec) {
  json out = {{"name", spec.name},         {"type", to_string(spec.type)},
              {"required", spec.required}, {"default", spec.default_value},
              {"unit", spec.unit},         {"meaning", spec.meaning},
              {"source", spec.source}};
  if (spec.minimum) out[spec.minimum_exclusive ? "above" : "at_least"] = *spec.minimum;
  if (spec.maximum) out[spec.maximum_exclusive ? "below" : "at_most"] = *spec.maximum;
  if (!spec.choices.empty()) out["choices"] = spec.choices;
  if (!spec.part_kind.empty()) out["kind"] = spec.part_kind;
  if (!spec.port.empty()) out["port"] = spec.port;
  if (spec.min_items > 0) out["min_items"] = spec.min_items;
  if (spec.max_items) out["max_items"] = *spec.max_items;
  if (!spec.element.empty()) {
    json element = json::array();
    for (const ParameterSpec& e : spec.element) element.push_back(parameter_json(e));
    out[spec.type == ParameterType::kInputList ? "fields" : "element"] =
        spec.type == ParameterType::kInputList ? element : element[0];
  }
  return out;
}

}  // namespace

std::string parameter_type_text(const ParameterSpec& spec) {
  switch (spec.type) {
    case ParameterType::kChoice: {
      std::string text;
      for (const std::string& word : spec.choices) text += (text.empty() ? "" : " | ") + word;
      return text;
    }
    case ParameterType::kPart:
    case ParameterType::kPartList:
      return spec.part_kind + std::string(spec.type == ParameterType::kPart ? " part" : " parts");
    case ParameterType::kInputList:
      return "inputs of " + spec.port;
    case ParameterType::kList: {
      const bool fixed = spec.max_items && *spec.max_items == spec.min_items;
      return "list of " + (fixed ? std::to_string(spec.min_items) + " " : std::string()) +
             parameter_type_text(spec.element.at(0));
    }
    case ParameterType::kMap:
      return parameter_type_text(spec.element.at(0)) + " by name";
    default:
      return std::string(to_string(spec.type));
  }
}

std::string component_text(const ComponentEntry& entry) {
  const ComponentDeclaration& d = entry.declaration;
  std::string out = d.name + ", " + a_or_an(d.kind) + "\n  " + d.summary + "\n";
  if (!d.source.empty()) out += "  Source: " + d.source + "\n";
  out += "  Frames: " +
         std::string(!is_node_kind(d.kind) ? "a part of other components"
                     : d.memory            ? "in order, one at a time (it has memory)"
                                           : "in any order, several at a time") +
         "\n";
  if (!entry.library.empty()) out += "  Library: " + entry.library.string() + "\n";
  out += ports_text("Inputs", d.inputs, true);
  out += ports_text("Outputs", d.outputs, false);
  if (!d.features.empty()) {
    std::vector<std::vector<std::string>> rows = {{"name", "", "meaning"}};
    for (const FeatureSpec& f : d.features) {
      rows.push_back({f.name, f.load == nullptr ? "not kept between runs" : "", f.meaning});
    }
    const std::string text = table(rows);
    out += "\nFeatures\n" + text.substr(text.find('\n') + 1);
  }
  if (!d.parameters.empty()) {
    std::vector<std::vector<std::string>> rows = {
        {"name", "type", "unit", "default", "range", "meaning", "source"}};
    for (const ParameterSpec& spec : d.parameters) append_parameter(spec, "", rows);
    out += "\nParameters\n" + table(rows);
  }
  if (!d.metrics.empty()) {
    std::vector<std::vector<std::string>> rows = {{"section", "name", "unit", "better", "meaning"}};
    for (const MetricSpec& m : d.metrics) {
      rows.push_back({m.section, m.name, m.unit, std::string(better_text(m.better)), m.meaning});
    }
    out += "\nMetrics\n" + table(rows);
  }
  return out;
}

json component_json(const ComponentEntry& entry) {
  const ComponentDeclaration& d = entry.declaration;
  json out = {{"name", d.name},
              {"kind", d.kind},
              {"summary", d.summary},
              {"source", d.source},
              {"memory", d.memory},
              {"library", entry.library.string()},
              {"inputs", ports_json(d.inputs)},
              {"outputs", ports_json(d.outputs)},
              {"parameters", json::array()},
              {"features", json::array()},
              {"metrics", json::array()}};
  for (const ParameterSpec& spec : d.parameters) out["parameters"].push_back(parameter_json(spec));
  for (const FeatureSpec& f : d.features) {
    out["features"].push_back(
        {{"name", f.name}, {"meaning", f.meaning}, {"kept", f.load != nullptr}});
  }
  for (const MetricSpec& m : d.metrics) {
    constexpr std::array<std::string_view, 3> kBetter = {"higher", "lower", "neither"};
    out["metrics"].push_back({{"section", m.section},
                              {"name", m.name},
                              {"unit", m.unit},
                              {"better", kBetter.at(static_cast<std::size_t>(m.better))},
                              {"meaning", m.meaning}});
  }
  return out;
}

}  // namespace plaza
