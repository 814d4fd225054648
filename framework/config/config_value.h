#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "framework/config/json_document.h"
#include "framework/config/pipeline.h"
#include "plaza/core/error.h"

namespace plaza {

struct ConfigMember;

/// A JSON value that knows where it was written: what `extends` merges, `--set` changes, and checks
/// point at. Members keep the order of the text.
struct ConfigValue {
  Origin origin;
  nlohmann::json plain;  ///< neither object nor array; unused for those
  nlohmann::json::value_t type = nlohmann::json::value_t::null;
  std::vector<ConfigMember> members;  ///< of an object
  std::vector<ConfigValue> items;     ///< of an array

  bool is_object() const { return type == nlohmann::json::value_t::object; }
  bool is_array() const { return type == nlohmann::json::value_t::array; }
  bool is_null() const { return type == nlohmann::json::value_t::null; }
  bool is_text() const { return type == nlohmann::json::value_t::string; }
  const std::string& text() const { return plain.get_ref<const std::string&>(); }

  const ConfigValue* find(std::string_view key) const;
  ConfigValue* find(std::string_view key);
  /// The member's text, or nothing when there is no such member or it is no text.
  const std::string* find_text(std::string_view key) const;
  void set(std::string_view key, const Origin& key_origin, ConfigValue value);
  void erase(std::string_view key);
  nlohmann::json to_json() const;
};

struct ConfigMember {
  std::string key;
  Origin key_origin;
  ConfigValue value;
};

/// The whole document.
ConfigValue to_config_value(const JsonDocument& document);

/// A value that was written nowhere (a default) or somewhere without a position of its own (--set).
ConfigValue to_config_value(const nlohmann::json& json, const Origin& origin);

/// True when the value was given with --set.
bool is_command_line(const Origin& origin);

/// The name that a node or part has: its "name", else its "use"; empty when it has neither.
std::string config_name(const ConfigValue& component);

/// True for an array of objects of which at least one has "use" or "name": nodes, or nested parts.
bool is_component_list(const ConfigValue& value);

/// "text", "number", "list", ... as people call them.
std::string type_name(const ConfigValue& value);

/// One fault that ends the reading at once.
UserError user_error(const Origin& origin, std::string message);

/// Collects faults and puts them in the order of their places: first the file asked for, then the
/// files it extends, then the command line.
class DiagnosticSink {
 public:
  void add(const Origin& origin, std::string message);
  void add(Diagnostic diagnostic) { diagnostics_.push_back(std::move(diagnostic)); }
  bool empty() const { return diagnostics_.empty(); }
  /// Gives everything away, each fault once, in the order of `files` and of the places in them.
  Diagnostics take(const std::vector<std::string>& files);

 private:
  Diagnostics diagnostics_;
};

}  // namespace plaza
