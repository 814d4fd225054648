#include "framework/config/extends.h"

#include <algorithm>
#include <utility>

#include "framework/config/text.h"
#include "plaza/core/error.h"

namespace plaza {
namespace {

namespace fs = std::filesystem;

void merge_value(ConfigValue& base, ConfigValue change, DiagnosticSink* diagnostics);

std::vector<std::string> names_of(const std::vector<ConfigValue>& list) {
  std::vector<std::string> names;
  for (const ConfigValue& item : list) names.push_back(config_name(item));
  return names;
}

std::vector<ConfigValue>::iterator find_named(std::vector<ConfigValue>& list,
                                              std::string_view name) {
  return std::find_if(list.begin(), list.end(),
                      [name](const ConfigValue& item) { return config_name(item) == name; });
}

/// Takes "after"/"before" out of the change and says where in `list` the item belongs.
std::vector<ConfigValue>::iterator take_place(std::vector<ConfigValue>& list, ConfigValue& change,
                                              bool& placed, DiagnosticSink* diagnostics) {
  placed = false;
  auto place = list.end();
  for (const std::string_view word : {"after", "before"}) {
    const ConfigValue* value = change.find(word);
    if (value == nullptr) continue;
    const auto fail = [&](const std::string& message) {
      if (diagnostics != nullptr) diagnostics->add(value->origin, message);
    };
    if (placed) {
      fail("\"after\" and \"before\" exclude each other");
    } else if (!value->is_text()) {
      fail("expected a name, got " + type_name(*value));
    } else if (auto found = find_named(list, value->text()); found == list.end()) {
      fail("there is no " + quote(value->text()) + " to be placed " + std::string(word) +
           did_you_mean(value->text(), names_of(list)));
    } else {
      place = word == "after" ? found + 1 : found;
      placed = true;
    }
  }
  change.erase("after");
  change.erase("before");
  return place;
}

void remove_named(std::vector<ConfigValue>& list, const ConfigValue& change,
                  DiagnosticSink* diagnostics) {
  const std::string name = config_name(change);
  const auto found = find_named(list, name);
  if (found != list.end()) {
    list.erase(found);
  } else if (diagnostics != nullptr) {
    diagnostics->add(change.origin, name.empty()
                                        ? "\"use\": null removes by name; give the \"name\""
                                        : "there is no " + quote(name) + " to be removed" +
                                              did_you_mean(name, names_of(list)));
  }
}

/// Nodes over nodes, parts over parts.
void merge_list(std::vector<ConfigValue>& base, std::vector<ConfigValue> changes,
                DiagnosticSink* diagnostics) {
  for (ConfigValue& change : changes) {
    const ConfigValue* use = change.find("use");
    if (use != nullptr && use->is_null()) {
      remove_named(base, change, diagnostics);
      continue;
    }
    const bool has_use = use != nullptr;
    bool placed = false;
    const std::string name = config_name(change);
    auto place = take_place(base, change, placed, diagnostics);
    // an item without any name can't be matched; appended, it gets the error it deserves
    const auto found = name.empty() ? base.end() : find_named(base, name);
    if (found == base.end()) {
      if (!has_use && !name.empty() && diagnostics != nullptr) {
        const std::string hint = did_you_mean(name, names_of(base));
        diagnostics->add(change.origin, "there is no " + quote(name) + " to be changed" +
                                            (hint.empty() ? "; a new one needs a \"use\"" : hint));
      } else {
        base.insert(place, std::move(change));
      }
      continue;
    }
    merge_component(*found, std::move(change));
    if (!placed) continue;
    if (place <= found) {
      std::rotate(place, found, found + 1);
    } else {
      std::rotate(found, found + 1, place);
    }
  }
}

void merge_members(ConfigValue& base, ConfigValue change, DiagnosticSink* diagnostics) {
  for (ConfigMember& member : change.members) {
    ConfigValue* old = base.find(member.key);
    if (member.key == "from" && member.value.is_null()) {
      base.erase(member.key);  // back to the nearest node above
    } else if (old == nullptr) {
      base.set(member.key, member.key_origin, std::move(member.value));
    } else {
      merge_value(*old, std::move(member.value), diagnostics);
      base.set(member.key, member.key_origin, std::move(*old));
    }
  }
}

void merge_component(ConfigValue& base, ConfigValue change, DiagnosticSink* diagnostics) {
  const std::string* new_use = change.find_text("use");
  const std::string* old_use = base.find_text("use");
  if (new_use != nullptr && (old_use == nullptr || *new_use != *old_use)) {
    // the name stays, or others would lose what they refer to; so does the wiring
    std::string name = config_name(base);
    std::erase_if(base.members, [](const ConfigMember& member) {
      return member.key != "use" && member.key != "name" && member.key != "from";
    });
    if (base.find("name") == nullptr && !name.empty() && old_use != nullptr) {
      const Origin origin = base.find("use")->origin;
      base.set("name", origin, to_config_value(nlohmann::json(name), origin));
    }
  }
  base.origin = change.origin;
  merge_members(base, std::move(change), diagnostics);
}

void merge_value(ConfigValue& base, ConfigValue change, DiagnosticSink* diagnostics) {
  if (base.is_object() && change.is_object()) {
    if (base.find("use") != nullptr || change.find("use") != nullptr) {
      merge_component(base, std::move(change), diagnostics);
    } else {
      merge_members(base, std::move(change), diagnostics);
    }
  } else if (is_component_list(base) && is_component_list(change)) {
    merge_list(base.items, std::move(change.items), diagnostics);
  } else {
    base = std::move(change);
  }
}

/// "after", "before" and "use": null where there is nothing to be placed in or removed from.
void refuse_changes(const ConfigValue& value, DiagnosticSink& diagnostics) {
  if (!is_component_list(value)) return;
  for (const ConfigValue& item : value.items) {
    for (const char* word : {"after", "before"}) {
      if (const ConfigValue* place = item.find(word)) {
        diagnostics.add(place->origin,
                        quote(word) + " is only for pipelines that extend another one");
      }
    }
    const ConfigValue* use = item.find("use");
    if (use != nullptr && use->is_null()) {
      diagnostics.add(use->origin, "\"use\": null is only for pipelines that extend another one");
    }
    for (const ConfigMember& member : item.members) refuse_changes(member.value, diagnostics);
  }
}

void drop_changes(ConfigValue& value) {
  if (!is_component_list(value)) return;
  std::erase_if(value.items, [](const ConfigValue& item) {
    const ConfigValue* use = item.find("use");
    return use != nullptr && use->is_null();
  });
  for (ConfigValue& item : value.items) {
    item.erase("after");
    item.erase("before");
    for (ConfigMember& member : item.members) drop_changes(member.value);
  }
}

fs::path identity(const fs::path& file) {
  std::error_code error;
  fs::path canonical = fs::weakly_canonical(file, error);
  return error ? file.lexically_normal() : canonical;
}

/// Names twice in one list: in a file that extends another, they would be merged into each other.
void refuse_twins(const ConfigValue& nodes, DiagnosticSink& diagnostics) {
  for (std::size_t i = 0; i < nodes.items.size(); ++i) {
    const std::string name = config_name(nodes.items[i]);
    for (std::size_t j = 0; j < i && !name.empty(); ++j) {
      if (config_name(nodes.items[j]) != name) continue;
      diagnostics.add(nodes.items[i].origin, quote(name) + " is changed twice in this file");
      break;
    }
  }
}

}  // namespace

void merge_component(ConfigValue& base, ConfigValue change) {
  merge_component(base, std::move(change), nullptr);
}

void merge_config(ConfigValue& base, ConfigValue change, DiagnosticSink& diagnostics) {
  merge_value(base, std::move(change), &diagnostics);
}

MergedConfig read_merged(std::string_view text, const fs::path& file, DiagnosticSink& diagnostics) {
  std::vector<ConfigValue> chain;  // the one asked for first
  MergedConfig merged;
  std::vector<fs::path> seen;
  fs::path next = file;
  std::optional<Origin> wanted_by;
  while (true) {
    const bool first = chain.empty();
    if (const auto again = std::find(seen.begin(), seen.end(), identity(next));
        again != seen.end()) {
      std::string circle;
      for (auto i = static_cast<std::size_t>(again - seen.begin()); i < seen.size(); ++i) {
        circle += merged.files[i] + " -> ";
      }
      throw user_error(*wanted_by,
                       "pipelines extend each other in a circle: " + circle + next.string());
    }
    if (!first) {
      std::error_code error;
      if (!fs::is_regular_file(next, error)) {
        throw user_error(*wanted_by, "there is no file " + next.string() + " to be extended");
      }
    }
    const JsonDocument document = first ? parse_json(text, next.string()) : read_json(next);
    merged.files.push_back(document.file);
    seen.push_back(identity(next));
    ConfigValue& root = chain.emplace_back(to_config_value(document));
    if (!root.is_object()) {
      throw user_error(root.origin,
                       "a pipeline is an object { \"plaza\": 1, ... }, got " + type_name(root));
    }
    const ConfigValue* base = root.find("extends");
    if (base == nullptr) break;
    if (!base->is_text() || base->text().empty()) {
      throw user_error(base->origin, "expected the path of another pipeline, got " +
                                         (base->is_text() ? "an empty text" : type_name(*base)));
    }
    try {
      next = resolve_path(base->text(), next);
    } catch (const UserError& error) {
      throw user_error(base->origin, error.what());
    }
    wanted_by = base->origin;
  }

  merged.root = std::move(chain.back());
  chain.pop_back();
  if (ConfigValue* nodes = merged.root.find("nodes")) {
    refuse_changes(*nodes, diagnostics);
    drop_changes(*nodes);
  }
  while (!chain.empty()) {
    ConfigValue change = std::move(chain.back());
    chain.pop_back();
    change.erase("extends");
    if (const ConfigValue* nodes = change.find("nodes")) refuse_twins(*nodes, diagnostics);
    merge_value(merged.root, std::move(change), &diagnostics);
  }
  return merged;
}

}  // namespace plaza
