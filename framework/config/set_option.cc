#include "framework/config/set_option.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <utility>

#include "framework/config/extends.h"
#include "framework/config/text.h"
#include "plaza/core/error.h"

namespace plaza {
namespace {

std::optional<std::size_t> as_index(const std::string& token) {
  std::size_t index = 0;
  const char* end = token.data() + token.size();
  const auto [stop, error] = std::from_chars(token.data(), end, index);
  if (error != std::errc() || stop != end) return std::nullopt;
  return index;
}

ConfigValue parse_value(const std::string& text, const Origin& origin) {
  try {
    return to_config_value(parse_json(text, "--set").root, origin);
  } catch (const UserError&) {
    return to_config_value(nlohmann::json(text),
                           origin);  // shells make quoting hard: words are text
  }
}

/// What an element of a list answers to beside its index.
std::string address_of(const ConfigValue& item) {
  if (!item.is_object()) return {};
  std::string name = config_name(item);
  if (const std::string* from = item.find_text("from"); name.empty() && from != nullptr)
    name = *from;
  return name;
}

/// One option, walking down.
class Setter {
 public:
  Setter(const std::string& option, const Registry& registry, DiagnosticSink& diagnostics)
      : registry_(registry), diagnostics_(diagnostics) {
    origin_.where.file = "--set " + option;
    const auto equals = option.find('=');
    if (equals == std::string::npos) {
      fail("expected /nodes/NODE/PARAMETER=VALUE, there is no \"=\"");
      return;
    }
    aim(option.substr(0, equals));
    value_ = parse_value(option.substr(equals + 1), origin_);
  }
  Setter(const Setting& setting, const Registry& registry, DiagnosticSink& diagnostics)
      : registry_(registry),
        diagnostics_(diagnostics),
        origin_(setting.origin),
        value_(setting.value),
        written_(true) {
    aim(setting.pointer);
  }

  void apply(ConfigValue& root) {
    if (failed_) return;
    static const std::vector<std::string> kTargets = {"nodes", "seed", "name", "scene",
                                                      "description"};
    const std::string& first = tokens_.front();
    if (std::find(kTargets.begin(), kTargets.end(), first) == kTargets.end()) {
      return fail(quote(first) + " can't be set; " + quote_all(kTargets) + " can" +
                  did_you_mean(first, kTargets));
    }
    if (first != "nodes") {
      if (tokens_.size() > 1) return fail(quote(first) + " has nothing below it");
      return put(root, first, "");
    }
    ConfigValue* nodes = root.find("nodes");
    if (nodes == nullptr || !nodes->is_array()) return fail("the pipeline has no nodes");
    if (tokens_.size() < (written_ && value_.is_object() ? 2 : 3))
      return fail("expected /nodes/NODE/PARAMETER=VALUE");
    in_list(*nodes, 1, "/nodes", "node");
  }

 private:
  void aim(const std::string& pointer) {
    if (!pointer.starts_with('/')) {
      fail("expected /nodes/NODE/PARAMETER=VALUE, the target begins with \"/\"");
      return;
    }
    tokens_ = pointer_tokens(pointer);
  }

  void fail(const std::string& message) {
    failed_ = true;
    diagnostics_.add(origin_, message);
  }

  Origin origin_at(const std::string& pointer) const { return {origin_.where, pointer}; }

  /// The value as it stands at `pointer` of the pipeline. One that was written in a file keeps its
  /// place there; one of the command line has none.
  ConfigValue value_at(const std::string& pointer) const {
    return written_ ? value_ : to_config_value(value_.to_json(), origin_at(pointer));
  }

  /// Sets member `key` of an object at `pointer`.
  void put(ConfigValue& object, const std::string& key, const std::string& pointer) {
    const std::string below = pointer + "/" + pointer_token(key);
    ConfigValue* old = object.find(key);
    if (written_ && old != nullptr) return merge_config(*old, value_, diagnostics_);
    object.set(key, written_ ? origin_ : origin_at(below), value_at(below));
  }

  void in_list(ConfigValue& list, std::size_t depth, const std::string& pointer,
               const std::string& what) {
    const std::string& token = tokens_[depth];
    std::size_t found = list.items.size();
    std::vector<std::string> known;
    for (std::size_t i = 0; i < list.items.size(); ++i) {
      const std::string address = address_of(list.items[i]);
      if (!address.empty()) known.push_back(address);
      if (found == list.items.size() && address == token) found = i;
    }
    if (found == list.items.size()) {
      const std::optional<std::size_t> index = as_index(token);
      if (!index || *index >= list.items.size()) {
        std::string message = "there is no " + what + " " + quote(token);
        const std::string hint = did_you_mean(token, known);
        if (!hint.empty()) {
          message += hint;
        } else if (!known.empty()) {
          message += "; there are " + quote_all(known);
        } else {
          message += "; the list has " + std::to_string(list.items.size()) + " elements";
        }
        return fail(message);
      }
      found = *index;
    }
    ConfigValue& item = list.items[found];
    const std::string below = pointer + "/" + std::to_string(found);
    if (depth + 1 == tokens_.size()) {
      if (written_ && item.is_object() && value_.is_object()) {
        return merge_config(item, value_, diagnostics_);
      }
      if (item.is_object() && (item.find("use") != nullptr || item.find("from") != nullptr)) {
        return fail(quote(token) + " is " + a_or_an(what) + "; name one of its parameters");
      }
      item = value_at(below);
      return;
    }
    const ConfigValue* use = item.find("use");
    if (use != nullptr && depth + 2 == tokens_.size() && tokens_.back() == "use" &&
        value_.is_null()) {
      list.items.erase(list.items.begin() + static_cast<std::ptrdiff_t>(found));
      return;
    }
    in_object(item, depth + 1, below);
  }

  void in_object(ConfigValue& object, std::size_t depth, const std::string& pointer) {
    if (!object.is_object()) return fail(quote(tokens_[depth - 1]) + " has nothing below it");
    const std::string& key = tokens_[depth];
    const std::string below = pointer + "/" + pointer_token(key);
    if (depth + 1 == tokens_.size()) {
      const bool is_use = key == "use" && object.find("use") != nullptr;
      if (!is_use) {
        if (key == "from" && value_.is_null()) return object.erase("from");
        return put(object, key, pointer);
      }
      ConfigValue change = to_config_value(nlohmann::json::object(), object.origin);
      put(change, key, pointer);
      return merge_component(object, std::move(change));
    }
    ConfigValue* next = object.find(key);
    if (next == nullptr) next = make_default(object, key, below);
    if (next == nullptr) return;
    if (next->is_array()) {
      in_list(*next, depth + 1, below, is_component_list(*next) ? "part" : "element");
    } else {
      in_object(*next, depth + 1, below);
    }
  }

  /// Brings a default into the configuration, so that something below it can be set.
  ConfigValue* make_default(ConfigValue& object, const std::string& key,
                            const std::string& pointer) {
    const std::string* use = object.find_text("use");
    const ComponentEntry* entry = use == nullptr ? nullptr : registry_.find(*use);
    if (entry == nullptr) {
      fail("there is nothing at " + pointer);
      return nullptr;
    }
    std::vector<std::string> names;
    for (const ParameterSpec& spec : entry->declaration.parameters) {
      names.push_back(spec.name);
      if (spec.name != key) continue;
      if (!spec.default_value.is_structured()) break;
      Origin origin;
      origin.pointer = pointer;
      object.set(key, origin, to_config_value(spec.default_value, origin));
      return object.find(key);
    }
    const bool known = std::find(names.begin(), names.end(), key) != names.end();
    fail(known
             ? "parameter " + quote(key) + " of " + quote(*use) + " has nothing below it"
             : "unknown parameter " + quote(key) + " of " + quote(*use) + did_you_mean(key, names));
    return nullptr;
  }

  const Registry& registry_;
  DiagnosticSink& diagnostics_;
  Origin origin_;  ///< of faults of the option itself
  ConfigValue value_;
  bool written_ = false;  ///< in a file, and so merged as what `extends` merges
  std::vector<std::string> tokens_;
  bool failed_ = false;
};

}  // namespace

void apply_sets(ConfigValue& root, const std::vector<std::string>& sets, const Registry& registry,
                DiagnosticSink& diagnostics) {
  for (const std::string& option : sets) Setter(option, registry, diagnostics).apply(root);
}

void apply_setting(ConfigValue& root, const Setting& setting, const Registry& registry,
                   DiagnosticSink& diagnostics) {
  Setter(setting, registry, diagnostics).apply(root);
}

}  // namespace plaza
