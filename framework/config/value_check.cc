#include "framework/config/value_check.h"

#include <cmath>
#include <cstdint>
#include <utility>

#include "framework/config/text.h"
#include "plaza/core/error.h"

namespace plaza {
namespace {

using nlohmann::json;

constexpr double kLargestInteger = 9007199254740992.0;  // 2^53: what JSON numbers hold exactly
constexpr double kNaturalLimit = 2147483647.0;  // limits of the C++ type, not of the parameter

std::string number_text(double value) {
  return json(value == std::floor(value) && std::abs(value) < 1e15
                  ? json(static_cast<std::int64_t>(value))
                  : json(value))
      .dump();
}

/// `one` "real", `many` "reals".
std::pair<std::string, std::string> nouns(const ParameterSpec& spec) {
  switch (spec.type) {
    case ParameterType::kBoolean:
      return {"true or false", "booleans"};
    case ParameterType::kInteger:
      return {"integer", "integers"};
    case ParameterType::kReal:
      return {"real", "reals"};
    case ParameterType::kText:
      return {"text", "texts"};
    case ParameterType::kPath:
      return {"path", "paths"};
    case ParameterType::kChoice:
      return {"one of " + quote_all(spec.choices), "words out of " + quote_all(spec.choices)};
    case ParameterType::kList:
      return {"list", "lists"};
    case ParameterType::kMap:
      return {"object", "objects"};
    case ParameterType::kPart:
      return {"{ \"use\": " + a_or_an(spec.part_kind) + ", ... }", "parts"};
    case ParameterType::kPartList:
      return {"list of { \"use\": " + a_or_an(spec.part_kind) + ", ... }", "lists of parts"};
    case ParameterType::kInputList:
      return {"list of { \"from\": a node that gives " + spec.port + ", ... }", "lists of inputs"};
  }
  throw InternalError("parameter of unknown type");
}

std::string with_unit(std::string text, const std::string& unit) {
  if (!unit.empty()) text += " in " + unit;
  return text;
}

std::string with_range(std::string text, const ParameterSpec& spec) {
  const std::string range = range_text(spec);
  if (!range.empty()) text += ", " + range;
  return text;
}

std::string count_text(const ParameterSpec& spec) {
  const std::string least = std::to_string(spec.min_items);
  if (!spec.max_items) return spec.min_items == 0 ? "" : least + " or more ";
  const std::string most = std::to_string(*spec.max_items);
  if (spec.min_items == *spec.max_items) return least + " ";
  return spec.min_items == 0 ? "up to " + most + " " : least + " to " + most + " ";
}

std::string expectation_in(const ParameterSpec& spec, const std::string& unit) {
  if (spec.element.empty() || spec.type == ParameterType::kInputList) {
    return with_range(with_unit(nouns(spec).first, unit), spec);
  }
  const ParameterSpec& element = spec.element[0];
  std::string elements = nouns(element).second;
  if (!element.element.empty()) {
    elements += " (each " + expectation_in(element, unit) + ")";
  } else {
    elements = with_range(with_unit(elements, unit), element);
  }
  return spec.type == ParameterType::kMap ? "object by name of " + count_text(spec) + elements
                                          : "list of " + count_text(spec) + elements;
}

bool in_range(double value, const ParameterSpec& spec) {
  if (spec.minimum &&
      (spec.minimum_exclusive ? !(value > *spec.minimum) : !(value >= *spec.minimum))) {
    return false;
  }
  return !spec.maximum || (spec.maximum_exclusive ? value < *spec.maximum : value <= *spec.maximum);
}

class Checker {
 public:
  Checker(const std::filesystem::path& default_base, Origins& origins, DiagnosticSink& diagnostics)
      : default_base_(default_base), origins_(origins), diagnostics_(diagnostics) {}

  json check(const ConfigValue& value, const ParameterSpec& spec, const std::string& unit,
             const std::string& pointer) {
    origins_.insert_or_assign(pointer, value.origin);
    if (value.is_null()) return nullptr;  // who may be null is the caller's to say
    switch (spec.type) {
      case ParameterType::kBoolean:
        if (value.type != json::value_t::boolean) return refuse(value, spec, unit);
        return value.plain;
      case ParameterType::kInteger:
        return integer(value, spec, unit);
      case ParameterType::kReal:
        return real(value, spec, unit);
      case ParameterType::kText:
        if (!value.is_text()) return refuse(value, spec, unit);
        return value.plain;
      case ParameterType::kChoice:
        return choice(value, spec, unit);
      case ParameterType::kPath:
        return path(value, spec, unit);
      case ParameterType::kList:
        return list(value, spec, unit, pointer);
      case ParameterType::kMap:
        return map(value, spec, unit, pointer);
      default:
        throw InternalError("parameter \"" + spec.name + "\" is no plain value");
    }
  }

 private:
  json refuse(const ConfigValue& value, const ParameterSpec& spec, const std::string& unit,
              const std::string& hint = {}) {
    const std::string got = value.is_text() && spec.type == ParameterType::kChoice
                                ? quote(value.text())
                                : type_name(value);
    diagnostics_.add(value.origin,
                     "expected " + expectation_in(spec, unit) + ", got " + got + hint);
    return nullptr;
  }

  json integer(const ConfigValue& value, const ParameterSpec& spec, const std::string& unit) {
    if (!value.plain.is_number()) return refuse(value, spec, unit);
    const double number = value.plain.get<double>();
    if (number != std::floor(number) || !in_range(number, spec)) return refuse(value, spec, unit);
    if (std::abs(number) > kLargestInteger) {
      return refuse(value, spec, unit, "; beyond 2^53 integers are not exact");
    }
    return static_cast<std::int64_t>(number);
  }

  json real(const ConfigValue& value, const ParameterSpec& spec, const std::string& unit) {
    if (!value.plain.is_number()) return refuse(value, spec, unit);
    const double number = value.plain.get<double>();
    if (!in_range(number, spec)) return refuse(value, spec, unit);
    return number;
  }

  json choice(const ConfigValue& value, const ParameterSpec& spec, const std::string& unit) {
    if (!value.is_text()) return refuse(value, spec, unit);
    for (const std::string& word : spec.choices) {
      if (value.text() == word) return value.plain;
    }
    return refuse(value, spec, unit, did_you_mean(value.text(), spec.choices));
  }

  json path(const ConfigValue& value, const ParameterSpec& spec, const std::string& unit) {
    if (!value.is_text()) return refuse(value, spec, unit);
    try {
      return resolve_config_path(value, default_base_).string();
    } catch (const UserError& error) {
      diagnostics_.add(value.origin, error.what());
      return nullptr;
    }
  }

  bool check_count(const ConfigValue& value, std::size_t count, const ParameterSpec& spec,
                   const std::string& unit) {
    if (count >= spec.min_items && (!spec.max_items || count <= *spec.max_items)) return true;
    diagnostics_.add(value.origin,
                     "expected " + expectation_in(spec, unit) + ", got " + std::to_string(count));
    return false;
  }

  json list(const ConfigValue& value, const ParameterSpec& spec, const std::string& unit,
            const std::string& pointer) {
    if (!value.is_array()) return refuse(value, spec, unit);
    check_count(value, value.items.size(), spec, unit);
    json out = json::array();
    for (std::size_t i = 0; i < value.items.size(); ++i) {
      out.push_back(element(value.items[i], spec, unit, pointer + "/" + std::to_string(i)));
    }
    return out;
  }

  json map(const ConfigValue& value, const ParameterSpec& spec, const std::string& unit,
           const std::string& pointer) {
    if (!value.is_object()) return refuse(value, spec, unit);
    check_count(value, value.members.size(), spec, unit);
    json out = json::object();
    for (const ConfigMember& member : value.members) {
      out[member.key] =
          element(member.value, spec, unit, pointer + "/" + pointer_token(member.key));
    }
    return out;
  }

  json element(const ConfigValue& value, const ParameterSpec& spec, const std::string& unit,
               const std::string& pointer) {
    const ParameterSpec& element_spec = spec.element.at(0);
    if (value.is_null()) return refuse(value, element_spec, unit);
    return check(value, element_spec, element_spec.unit.empty() ? unit : element_spec.unit,
                 pointer);
  }

  const std::filesystem::path& default_base_;
  Origins& origins_;
  DiagnosticSink& diagnostics_;
};

}  // namespace

std::string range_text(const ParameterSpec& spec) {
  std::string text;
  if (spec.minimum && *spec.minimum > -kNaturalLimit) {
    text = (spec.minimum_exclusive ? "> " : ">= ") + number_text(*spec.minimum);
  }
  if (spec.maximum && *spec.maximum < kNaturalLimit) {
    if (!text.empty()) text += ", ";
    text += (spec.maximum_exclusive ? "< " : "<= ") + number_text(*spec.maximum);
  }
  return text;
}

std::string expectation(const ParameterSpec& spec) { return expectation_in(spec, spec.unit); }

std::filesystem::path resolve_config_path(const ConfigValue& value,
                                          const std::filesystem::path& pipeline_file) {
  const std::string& file = value.origin.where.file;
  const std::string& text = value.text();
  if (file.empty()) return resolve_path(text, pipeline_file);
  if (!is_command_line(value.origin)) return resolve_path(text, file);
  // what is typed in a shell means the shell's folder; the data is the pipeline's
  return resolve_path(text, text.starts_with('$') ? pipeline_file : std::filesystem::path());
}

json check_value(const ConfigValue& value, const ParameterSpec& spec,
                 const std::filesystem::path& default_base, const std::string& pointer,
                 Origins& origins, DiagnosticSink& diagnostics) {
  if (value.is_null() && (spec.required || !spec.default_value.is_null())) {
    diagnostics.add(value.origin, "expected " + expectation(spec) + ", got null");
    return nullptr;
  }
  return Checker(default_base, origins, diagnostics).check(value, spec, spec.unit, pointer);
}

}  // namespace plaza
