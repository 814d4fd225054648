#include "framework/scene/fields.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "framework/config/text.h"

namespace plaza {
namespace {

using nlohmann::json;

bool append_numbers(const json& value, std::vector<double>& out) {
  if (value.is_number()) {
    out.push_back(value.get<double>());
    return std::isfinite(out.back());
  }
  if (!value.is_array()) return false;
  return std::all_of(value.begin(), value.end(),
                     [&](const json& item) { return append_numbers(item, out); });
}

}  // namespace

std::optional<std::vector<double>> flat_numbers(const json& value) {
  std::vector<double> out;
  if (!append_numbers(value, out)) return std::nullopt;
  return out;
}

std::string in_quotes(std::string_view text) {
  return std::string(1, '"').append(text).append(1, '"');
}

std::string short_number(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.6g", value);
  return buffer;
}

Fields::Fields(const JsonDocument& document, std::string pointer, Diagnostics& faults)
    : document_(document), pointer_(std::move(pointer)), faults_(faults) {
  const json::json_pointer at(pointer_);
  if (!document.root.contains(at) && !pointer_.empty()) return;  // reported as missing
  const json& value = document.root.at(at);
  if (value.is_object()) {
    object_ = &value;
  } else {
    fault("must be an object, { ... }");
  }
}

bool Fields::has(std::string_view key) const {
  return object_ != nullptr && object_->contains(std::string(key));
}

const json* Fields::find(std::string_view key) {
  known_.emplace_back(key);
  if (object_ == nullptr) return nullptr;
  const auto found = object_->find(std::string(key));
  return found == object_->end() ? nullptr : &*found;
}

const json* Fields::need(std::string_view key) {
  const json* value = find(key);
  if (value == nullptr && object_ != nullptr) fault(in_quotes(key) + " is missing");
  return value;
}

std::optional<double> Fields::number(std::string_view key) {
  const json* value = need(key);
  if (value == nullptr) return std::nullopt;
  if (!value->is_number() || !std::isfinite(value->get<double>())) {
    fault(key, "must be a number");
    return std::nullopt;
  }
  return value->get<double>();
}

std::optional<double> Fields::number(std::string_view key, double fallback) {
  if (find(key) == nullptr) return fallback;
  return number(key);
}

std::optional<double> Fields::positive(std::string_view key) {
  const auto value = number(key);
  if (value && !(*value > 0)) {
    fault(key, "must be greater than 0, not " + short_number(*value));
    return std::nullopt;
  }
  return value;
}

std::optional<int> Fields::index(std::string_view key) {
  const json* value = need(key);
  if (value == nullptr) return std::nullopt;
  if (!value->is_number_integer() || value->get<double>() < 0 || value->get<double>() > 1e6) {
    fault(key, "must be a whole number from 0");
    return std::nullopt;
  }
  return value->get<int>();
}

std::optional<std::string> Fields::text(std::string_view key) {
  const json* value = need(key);
  if (value == nullptr) return std::nullopt;
  if (!value->is_string() || value->get_ref<const std::string&>().empty()) {
    fault(key, "must be a text that is not empty");
    return std::nullopt;
  }
  return value->get<std::string>();
}

std::optional<std::string> Fields::text(std::string_view key, const std::string& fallback) {
  if (find(key) == nullptr) return fallback;
  return text(key);
}

std::optional<std::string> Fields::choice(std::string_view key,
                                          const std::vector<std::string>& choices,
                                          const std::string& fallback) {
  if (!fallback.empty() && find(key) == nullptr) return fallback;
  const auto value = text(key);
  if (!value || std::find(choices.begin(), choices.end(), *value) != choices.end()) return value;
  std::string list;
  for (const std::string& c : choices) {
    if (!list.empty()) list += ", ";
    list += in_quotes(c);
  }
  fault(key, in_quotes(*value) + " is none of " + list + did_you_mean(*value, choices));
  return std::nullopt;
}

std::optional<std::vector<double>> Fields::numbers(std::string_view key, std::size_t count) {
  const json* value = need(key);
  if (value == nullptr) return std::nullopt;
  auto out = value->is_array() ? flat_numbers(*value) : std::nullopt;
  if (!out || out->size() != count) {
    fault(key, "must be an array of " + std::to_string(count) + " numbers" +
                   (out ? ", not " + std::to_string(out->size()) : ""));
    return std::nullopt;
  }
  return out;
}

std::optional<Eigen::Vector2d> Fields::pair(std::string_view key) {
  const auto values = numbers(key, 2);
  if (!values) return std::nullopt;
  return Eigen::Vector2d((*values)[0], (*values)[1]);
}

std::optional<Eigen::Vector2i> Fields::image_size(std::string_view key) {
  const auto size = pair(key);
  if (!size) return std::nullopt;
  const bool whole = size->array().round().isApprox(size->array(), 0);
  if (!whole || !((size->array() >= 1).all() && (size->array() <= 100'000).all())) {
    fault(key, "must be [width, height] in whole pixels, both from 1 to 100000");
    return std::nullopt;
  }
  return size->cast<int>();
}

std::optional<Eigen::Matrix3d> Fields::matrix3(std::string_view key) {
  const auto values = numbers(key, 9);
  if (!values) return std::nullopt;
  return Eigen::Matrix3d(
      Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(values->data()));
}

Fields Fields::object(std::string_view key) {
  need(key);
  return {document_, pointer_of(key), faults_};
}

std::string Fields::pointer_of(std::string_view key) const {
  return pointer_ + "/" + pointer_token(key);
}

void Fields::fault(std::string message) {
  faults_.push_back({document_.position(pointer_), pointer_, std::move(message)});
}

void Fields::fault(std::string_view key, std::string message) {
  if (!has(key)) return fault(std::move(message));
  const std::string at = pointer_of(key);
  faults_.push_back({document_.position(at), at, std::move(message)});
}

void Fields::refuse_unknown() {
  if (object_ == nullptr) return;
  for (const auto& item : object_->items()) {
    const std::string& key = item.key();
    if (std::find(known_.begin(), known_.end(), key) != known_.end()) continue;
    const std::string at = pointer_of(key);
    std::string hint = did_you_mean(key, known_);
    if (hint.empty()) {  // a name without its unit is often too short for that
      const auto longer = std::find_if(known_.begin(), known_.end(), [&](const std::string& name) {
        return name.starts_with(key + "_");
      });
      if (longer != known_.end()) hint = "; did you mean " + in_quotes(*longer) + "?";
    }
    faults_.push_back({document_.key_position(at), at, "unknown key" + hint});
  }
}

}  // namespace plaza
