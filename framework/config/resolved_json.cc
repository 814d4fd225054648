#include <algorithm>
#include <utility>

#include "framework/config/json_document.h"
#include "framework/config/pipeline.h"
#include "framework/config/resolved_values.h"
#include "framework/config/text.h"
#include "plaza/core/error.h"

namespace plaza {

using nlohmann::json;

json with_absolute_paths(const json& value, const ParameterSpec& spec) {
  if (value.is_null()) return value;
  switch (spec.type) {
    case ParameterType::kPath: {
      const auto& text = value.get_ref<const std::string&>();
      if (text.empty()) return value;
      return std::filesystem::absolute(text).lexically_normal().string();
    }
    case ParameterType::kList:
    case ParameterType::kMap: {
      json out = value;
      for (json& element : out) element = with_absolute_paths(element, spec.element.at(0));
      return out;
    }
    default:
      return value;
  }
}

namespace {

class Writer {
 public:
  explicit Writer(const ResolvedPipeline& pipeline) : pipeline_(pipeline) {}

  json write() {
    json out = {
        {"plaza", 1},
        {"name", pipeline_.name},
        {"scene", std::filesystem::absolute(pipeline_.scene_file).lexically_normal().string()},
        {"seed", pipeline_.seed},
        {"nodes", json::array()}};
    if (!pipeline_.description.empty()) out["description"] = pipeline_.description;
    for (const auto& [pointer, origin] : pipeline_.origins) {
      if (out.contains(json::json_pointer(pointer))) origins_[pointer] = to_string(origin);
    }
    for (std::size_t i = 0; i < pipeline_.nodes.size(); ++i) {
      out["nodes"].push_back(node(pipeline_.nodes[i], "/nodes/" + std::to_string(i)));
    }
    out["origins"] = std::move(origins_);
    return out;
  }

 private:
  json part(const ResolvedPart& part, const std::string& pointer) {
    json out = json::object();
    out["use"] = part.entry->declaration.name;
    out["name"] = part.name;
    for (const ParameterSpec& spec : part.entry->declaration.parameters) {
      if (const auto nested = part.parts.find(spec.name); nested != part.parts.end()) {
        const std::string below = pointer + "/" + pointer_token(spec.name);
        if (spec.type == ParameterType::kPart) {
          out[spec.name] = this->part(nested->second.front(), below);
          continue;
        }
        json list = json::array();
        for (const ResolvedPart& item : nested->second) {
          list.push_back(this->part(item, below + "/" + std::to_string(list.size())));
        }
        out[spec.name] = std::move(list);
      } else if (part.values.contains(spec.name)) {
        out[spec.name] = with_absolute_paths(part.values[spec.name], spec);
      }
    }
    for (const auto& [below, origin] : part.origins) origins_[pointer + below] = to_string(origin);
    return out;
  }

  json node(const ResolvedNode& node, const std::string& pointer) {
    json out = part(node, pointer);
    const std::vector<PortSpec>& ports = node.entry->declaration.inputs;
    for (std::size_t i = 0; i < ports.size(); ++i) {
      const int producer = node.inputs[i].node;
      out["from"][ports[i].type] =
          producer < 0 ? json() : json(pipeline_.nodes[static_cast<std::size_t>(producer)].name);
    }
    for (const auto& [parameter, records] : node.input_lists) {
      const std::vector<ParameterSpec>& specs = node.entry->declaration.parameters;
      const auto spec =
          std::find_if(specs.begin(), specs.end(),
                       [&name = parameter](const ParameterSpec& s) { return s.name == name; });
      if (spec == specs.end())
        throw InternalError("input list " + quote(parameter) + " is not declared");
      json list = json::array();
      for (const ResolvedInputRecord& record : records) {
        json item = {{"from", record.from}};
        for (const ParameterSpec& field : spec->element) {
          item[field.name] = with_absolute_paths(record.fields.at(field.name), field);
        }
        list.push_back(std::move(item));
      }
      out[parameter] = std::move(list);
    }
    return out;
  }

  const ResolvedPipeline& pipeline_;
  json origins_ = json::object();
};

}  // namespace

json ResolvedPipeline::resolved_json() const { return Writer(*this).write(); }

}  // namespace plaza
