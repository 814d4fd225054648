#include "framework/config/config_value.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "plaza/core/error.h"

namespace plaza {
namespace {

using nlohmann::json;

ConfigValue convert(const JsonDocument& document, const json& value, const std::string& pointer) {
  ConfigValue out;
  out.origin = {document.position(pointer), pointer};
  out.type = value.type();
  if (value.is_object()) {
    for (const auto& [key, member] : value.items()) {
      const std::string below = pointer + "/" + pointer_token(key);
      out.members.push_back(
          {key, {document.key_position(below), below}, convert(document, member, below)});
    }
    std::sort(out.members.begin(), out.members.end(),
              [](const ConfigMember& a, const ConfigMember& b) {
                const FilePosition& p = a.key_origin.where;
                const FilePosition& q = b.key_origin.where;
                return std::tie(p.line, p.column) < std::tie(q.line, q.column);
              });
  } else if (value.is_array()) {
    for (std::size_t i = 0; i < value.size(); ++i) {
      out.items.push_back(convert(document, value[i], pointer + "/" + std::to_string(i)));
    }
  } else {
    out.plain = value;
  }
  return out;
}

}  // namespace

std::string to_string(const Origin& origin) {
  const FilePosition& where = origin.where;
  if (where.file.empty()) return "default";
  if (where.line == 0) return where.file;
  return where.file + ":" + std::to_string(where.line) + ":" + std::to_string(where.column);
}

ConfigValue to_config_value(const JsonDocument& document) {
  return convert(document, document.root, "");
}

ConfigValue to_config_value(const json& value, const Origin& origin) {
  ConfigValue out;
  out.origin = origin;
  out.type = value.type();
  const auto below = [&origin](const std::string& token) {
    return Origin{origin.where, origin.pointer + "/" + pointer_token(token)};
  };
  if (value.is_object()) {
    for (const auto& [key, member] : value.items()) {
      out.members.push_back({key, below(key), to_config_value(member, below(key))});
    }
  } else if (value.is_array()) {
    for (std::size_t i = 0; i < value.size(); ++i) {
      out.items.push_back(to_config_value(value[i], below(std::to_string(i))));
    }
  } else {
    out.plain = value;
  }
  return out;
}

const ConfigValue* ConfigValue::find(std::string_view key) const {
  for (const ConfigMember& member : members) {
    if (member.key == key) return &member.value;
  }
  return nullptr;
}

ConfigValue* ConfigValue::find(std::string_view key) {
  return const_cast<ConfigValue*>(std::as_const(*this).find(key));
}

const std::string* ConfigValue::find_text(std::string_view key) const {
  const ConfigValue* value = find(key);
  return value != nullptr && value->is_text() ? &value->text() : nullptr;
}

void ConfigValue::set(std::string_view key, const Origin& key_origin, ConfigValue value) {
  for (ConfigMember& member : members) {
    if (member.key != key) continue;
    member.key_origin = key_origin;
    member.value = std::move(value);
    return;
  }
  members.push_back({std::string(key), key_origin, std::move(value)});
}

void ConfigValue::erase(std::string_view key) {
  std::erase_if(members, [key](const ConfigMember& member) { return member.key == key; });
}

json ConfigValue::to_json() const {
  if (is_object()) {
    json out = json::object();
    for (const ConfigMember& member : members) out[member.key] = member.value.to_json();
    return out;
  }
  if (is_array()) {
    json out = json::array();
    for (const ConfigValue& item : items) out.push_back(item.to_json());
    return out;
  }
  return plain;
}

bool is_command_line(const Origin& origin) { return origin.where.file.starts_with("--set "); }

std::string config_name(const ConfigValue& component) {
  if (const std::string* name = component.find_text("name")) return *name;
  if (const std::string* use = component.find_text("use")) return *use;
  return {};
}

bool is_component_list(const ConfigValue& value) {
  if (!value.is_array() || value.items.empty()) return false;
  bool named = false;
  for (const ConfigValue& item : value.items) {
    if (!item.is_object()) return false;
    named = named || item.find("use") != nullptr || item.find("name") != nullptr;
  }
  return named;
}

std::string type_name(const ConfigValue& value) {
  switch (value.type) {
    case json::value_t::null:
      return "null";
    case json::value_t::boolean:
      return value.plain.get<bool>() ? "true" : "false";
    case json::value_t::string:
      return "text";
    case json::value_t::object:
      return "an object";
    case json::value_t::array:
      return "a list";
    default:
      return value.plain.dump();  // a number says more than "number"
  }
}

UserError user_error(const Origin& origin, std::string message) {
  Diagnostic diagnostic;
  diagnostic.where = origin.where;
  diagnostic.pointer = origin.pointer;
  diagnostic.message = std::move(message);
  return UserError(std::move(diagnostic));
}

void DiagnosticSink::add(const Origin& origin, std::string message) {
  diagnostics_.push_back({origin.where, origin.pointer, std::move(message)});
}

Diagnostics DiagnosticSink::take(const std::vector<std::string>& files) {
  const auto rank = [&files](const Diagnostic& d) {
    return std::find(files.begin(), files.end(), d.where.file) - files.begin();
  };
  std::stable_sort(diagnostics_.begin(), diagnostics_.end(),
                   [&rank](const Diagnostic& a, const Diagnostic& b) {
                     return std::make_tuple(rank(a), a.where.line, a.where.column) <
                            std::make_tuple(rank(b), b.where.line, b.where.column);
                   });
  diagnostics_.erase(std::unique(diagnostics_.begin(), diagnostics_.end()), diagnostics_.end());
  return std::exchange(diagnostics_, {});
}

}  // namespace plaza
