#include "framework/study/study_fields.h"

#include <algorithm>
#include <utility>

#include "framework/config/pipeline.h"
#include "framework/config/text.h"
#include "framework/config/value_check.h"
#include "plaza/core/error.h"

namespace plaza {

const std::vector<std::string>& StudyFields::change_keys() {
  static const std::vector<std::string> kKeys = {"pipeline", "scene", "frames", "set", "nodes"};
  return kKeys;
}

void StudyFields::know(const ConfigValue& object, const std::vector<std::string>& keys,
                       const std::string& what) {
  for (const ConfigMember& member : object.members) {
    if (std::find(keys.begin(), keys.end(), member.key) != keys.end()) continue;
    const std::string hint = did_you_mean(member.key, keys);
    fail(member.key_origin,
         "unknown key of " + a_or_an(what) + (hint.empty() ? "; it has " + quote_all(keys) : hint));
  }
}

std::string StudyFields::text(const ConfigValue& object, const std::string& key) {
  const ConfigValue* value = object.find(key);
  if (value == nullptr) return {};
  if (!value->is_text()) {
    fail(value->origin, "expected text, got " + type_name(*value));
    return {};
  }
  return value->text();
}

bool StudyFields::is_filled_list(const ConfigValue& value, const std::string& what) {
  if (value.is_array() && !value.items.empty()) return true;
  fail(value.origin, "expected a list of " + what + ", at least one, got " +
                         (value.is_array() ? "an empty list" : type_name(value)));
  return false;
}

std::vector<std::string> StudyFields::words(const ConfigValue& value, const std::string& what) {
  std::vector<std::string> words;
  if (value.is_text()) return {value.text()};
  if (!is_filled_list(value, what)) return words;
  for (const ConfigValue& item : value.items) {
    if (item.is_text()) {
      words.push_back(item.text());
    } else {
      fail(item.origin, "expected text, got " + type_name(item));
    }
  }
  return words;
}

std::optional<std::filesystem::path> StudyFields::path(const ConfigValue& value) {
  if (!value.is_text() || value.text().empty()) {
    fail(value.origin, "expected the path of a file, got " +
                           (value.is_text() ? std::string("an empty text") : type_name(value)));
    return std::nullopt;
  }
  try {
    const std::filesystem::path path = resolve_config_path(value, file_);
    std::error_code error;
    if (std::filesystem::is_regular_file(path, error)) return path;
    fail(value.origin, "there is no file " + path.string());
  } catch (const UserError& error) {
    fail(value.origin, error.what());
  }
  return std::nullopt;
}

std::optional<FrameRange> StudyFields::frames(const ConfigValue& value) {
  const auto range = value.is_text() ? parse_frame_range(value.text()) : std::nullopt;
  if (!range) {
    fail(value.origin,
         "expected \"A:B\" with 0 <= A < B, frames from A (the first is 0) to before B; either may "
         "be left out; got " +
             (value.is_text() ? quote(value.text()) : type_name(value)));
  }
  return range;
}

std::vector<std::uint64_t> StudyFields::seeds(const ConfigValue& value) {
  std::vector<std::uint64_t> seeds;
  if (!is_filled_list(value, "seeds")) return seeds;
  for (const ConfigValue& item : value.items) {
    if (!item.plain.is_number_unsigned()) {
      fail(item.origin, "expected a whole number from 0, got " + type_name(item));
    } else if (const auto seed = item.plain.get<std::uint64_t>();
               std::find(seeds.begin(), seeds.end(), seed) != seeds.end()) {
      fail(item.origin, "seed " + std::to_string(seed) + " is there already");
    } else {
      seeds.push_back(seed);
    }
  }
  return seeds;
}

bool StudyFields::pointer(const ConfigValue& value) {
  if (value.is_text() && value.text().starts_with('/')) return true;
  fail(value.origin, "expected the place of a value, such as \"/nodes/tracks/gate_m\", got " +
                         (value.is_text() ? quote(value.text()) : type_name(value)));
  return false;
}

Change StudyFields::change(const ConfigValue& object) {
  Change change;
  if (const ConfigValue* value = object.find("pipeline")) change.pipeline = path(*value);
  if (const ConfigValue* value = object.find("frames")) change.frames = frames(*value);
  if (const ConfigValue* value = object.find("scene"); value != nullptr && path(*value)) {
    change.settings.push_back({"/scene", value->origin, *value});
  }
  if (const ConfigValue* value = object.find("nodes")) {
    if (is_filled_list(*value, "nodes, as in a pipeline that extends another")) {
      change.settings.push_back({"/nodes", value->origin, *value});
    }
  }
  if (const ConfigValue* value = object.find("set")) {
    if (!value->is_object()) {
      fail(value->origin, "expected an object { \"/nodes/NODE/PARAMETER\": VALUE, ... }, got " +
                              type_name(*value));
      return change;
    }
    for (const ConfigMember& member : value->members) {
      change.settings.push_back({member.key, member.key_origin, member.value});
    }
  }
  return change;
}

std::string label_of(const ConfigValue& value) {
  if (value.is_object()) {
    std::string label = config_name(value);
    if (!label.empty()) return label;
    for (const ConfigMember& member : value.members) {
      label += (label.empty() ? "" : "+") + member.key + "=" + label_of(member.value);
    }
    return label;
  }
  if (value.is_array()) {
    std::string label;
    for (const ConfigValue& item : value.items) {
      const std::string word = label_of(item);
      if (word.empty()) return {};
      label += (label.empty() ? "" : "+") + word;
    }
    return value.items.empty() ? "none" : label;
  }
  return value.is_text() ? value.text() : value.plain.dump();
}

}  // namespace plaza
