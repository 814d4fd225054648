#pragma once

#include <cstddef>
#include <deque>
#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "plaza/core/export.h"

namespace plaza {

/// What a JSON value of a parameter may be.
enum class ParameterType {
  kBoolean,
  kInteger,
  kReal,
  kText,
  kChoice,  ///< one of ParameterSpec::choices
  kPath,  ///< a file or folder: "$PLAZA_DATA/..." is replaced, relative ones start at the JSON file
  kList,  ///< array of element[0]
  kMap,   ///< object: free key (a camera's name) -> element[0]
  kPart,  ///< one nested component of kind part_kind: { "use": ..., ... }
  kPartList,   ///< array of nested components of kind part_kind, each with a unique name
  kInputList,  ///< array of { "from": NODE, fields of `element` }: further inputs of type `port`
};

PLAZA_API std::string_view to_string(ParameterType type);

/// Everything there is to know about one parameter: parsing, JSON Schema, `plaza show`, reference
/// pages,
/// --set, study axes and resolved.json are made from it.
struct ParameterSpec {
  std::string name;
  ParameterType type = ParameterType::kText;
  nlohmann::json default_value;  ///< null when there is none
  bool required = false;         ///< no default; without `required`, null means "not set"
  std::string unit;              ///< "m", "px", "s", "Hz", "deg"; empty for pure numbers and words
  std::string meaning;           ///< one sentence
  std::string source;            ///< equation, page or paper; empty where it is our own
  std::optional<double> minimum, maximum;
  bool minimum_exclusive = false, maximum_exclusive = false;
  std::vector<std::string> choices;
  std::vector<ParameterSpec>
      element;  ///< [0] of lists and maps; the fields of an input list's records
  std::size_t min_items = 0;
  std::optional<std::size_t> max_items;
  std::string part_kind;  ///< for parts: "shape", "affinity", "motion", ...
  std::string port;       ///< for input lists: "Evidence", ...
};

/// Fluent completion of one spec: `.unit("m").above(0).meaning("...")`.
class PLAZA_API ParameterBuilder {
 public:
  explicit ParameterBuilder(ParameterSpec& spec) : spec_(&spec) {}
  ParameterBuilder& unit(std::string text);
  ParameterBuilder& meaning(std::string text);
  ParameterBuilder& source(std::string text);
  ParameterBuilder& required();
  ParameterBuilder& at_least(double limit);
  ParameterBuilder& above(double limit);
  ParameterBuilder& at_most(double limit);
  ParameterBuilder& below(double limit);
  ParameterBuilder& items(std::size_t at_least, std::optional<std::size_t> at_most = std::nullopt);

 private:
  ParameterSpec& limits() const;  ///< the element of a list or map, else the spec itself
  ParameterSpec* spec_;
};

namespace detail {
template <class T>
struct ParameterTraits;  // maps a C++ member type to its spec and back from JSON
PLAZA_API ParameterSpec scalar_spec(ParameterType type);

template <>
struct ParameterTraits<bool> {
  static ParameterSpec spec() { return scalar_spec(ParameterType::kBoolean); }
  static bool read(const nlohmann::json& v) { return v.get<bool>(); }
  static nlohmann::json write(bool v) { return v; }
};
template <class T>
requires(std::is_integral_v<T> && !std::is_same_v<T, bool>) struct ParameterTraits<T> {
  static ParameterSpec spec() {
    ParameterSpec s = scalar_spec(ParameterType::kInteger);
    // doubles hold these limits exactly up to 2^53, which is what JSON numbers promise
    s.minimum = std::is_signed_v<T> && sizeof(T) == 8
                    ? -9007199254740992.0
                    : static_cast<double>(std::numeric_limits<T>::min());
    s.maximum =
        sizeof(T) == 8 ? 9007199254740992.0 : static_cast<double>(std::numeric_limits<T>::max());
    return s;
  }
  static T read(const nlohmann::json& v) { return v.get<T>(); }
  static nlohmann::json write(T v) { return v; }
};
template <>
struct ParameterTraits<double> {
  static ParameterSpec spec() { return scalar_spec(ParameterType::kReal); }
  static double read(const nlohmann::json& v) { return v.get<double>(); }
  static nlohmann::json write(double v) { return v; }
};
template <>
struct ParameterTraits<std::string> {
  static ParameterSpec spec() { return scalar_spec(ParameterType::kText); }
  static std::string read(const nlohmann::json& v) { return v.get<std::string>(); }
  static nlohmann::json write(const std::string& v) { return v; }
};
template <>
struct ParameterTraits<std::filesystem::path> {
  static ParameterSpec spec() { return scalar_spec(ParameterType::kPath); }
  static std::filesystem::path read(const nlohmann::json& v) { return v.get<std::string>(); }
  static nlohmann::json write(const std::filesystem::path& v) { return v.string(); }
};
template <class T>
struct ParameterTraits<std::optional<T>> {
  static ParameterSpec spec() { return ParameterTraits<T>::spec(); }
  static std::optional<T> read(const nlohmann::json& v) {
    if (v.is_null()) return std::nullopt;
    return ParameterTraits<T>::read(v);
  }
  static nlohmann::json write(const std::optional<T>& v) {
    return v ? ParameterTraits<T>::write(*v) : nlohmann::json();
  }
};
template <class T>
struct ParameterTraits<std::vector<T>> {
  static ParameterSpec spec() {
    ParameterSpec s = scalar_spec(ParameterType::kList);
    s.element.push_back(ParameterTraits<T>::spec());
    return s;
  }
  static std::vector<T> read(const nlohmann::json& v) {
    std::vector<T> out;
    for (const auto& e : v) out.push_back(ParameterTraits<T>::read(e));
    return out;
  }
  static nlohmann::json write(const std::vector<T>& v) {
    nlohmann::json out = nlohmann::json::array();
    for (const T& e : v) out.push_back(ParameterTraits<T>::write(e));
    return out;
  }
};
template <class T>
struct ParameterTraits<std::map<std::string, T>> {
  static ParameterSpec spec() {
    ParameterSpec s = scalar_spec(ParameterType::kMap);
    s.element.push_back(ParameterTraits<T>::spec());
    return s;
  }
  static std::map<std::string, T> read(const nlohmann::json& v) {
    std::map<std::string, T> out;
    for (const auto& [key, e] : v.items()) out.emplace(key, ParameterTraits<T>::read(e));
    return out;
  }
  static nlohmann::json write(const std::map<std::string, T>& v) {
    nlohmann::json out = nlohmann::json::object();
    for (const auto& [key, e] : v) out[key] = ParameterTraits<T>::write(e);
    return out;
  }
};
}  // namespace detail

/// The parameters of a component with options struct `Options`. Name, type, default (the member's
/// initialiser), unit, range, meaning and source stand here and nowhere else.
///
///   Parameters<Options> p;
///   p.value("gate_m", &Options::gate_m).unit("m").above(0).meaning("radius of the validation
///   gate")
///       .source("thesis (6.1)");
template <class Options>
class Parameters {
 public:
  /// A plain value; its type follows from the member: bool, an integer, double, std::string,
  /// std::filesystem::path, std::optional (null: not set), std::vector, std::map by name.
  template <class T>
  ParameterBuilder value(std::string name, T Options::*member) {
    ParameterSpec spec = detail::ParameterTraits<T>::spec();
    spec.name = std::move(name);
    spec.default_value = detail::ParameterTraits<T>::write(Options{}.*member);
    setters_.push_back([key = spec.name, member](Options& o, const nlohmann::json& values) {
      if (const auto it = values.find(key); it != values.end()) {
        o.*member = detail::ParameterTraits<T>::read(*it);
      }
    });
    return add(std::move(spec));
  }
  /// An enum, spelled as one of `names` (enumerators 0, 1, 2, ... in this order).
  template <class E>
  requires(std::is_enum_v<E>) ParameterBuilder
      choice(std::string name, E Options::*member, std::vector<std::string> names) {
    ParameterSpec spec = detail::scalar_spec(ParameterType::kChoice);
    spec.name = std::move(name);
    spec.default_value = names.at(static_cast<std::size_t>(Options{}.*member));
    spec.choices = names;
    setters_.push_back([key = spec.name, member, names](Options& o, const nlohmann::json& values) {
      const auto it = values.find(key);
      if (it == values.end()) return;
      for (std::size_t i = 0; i < names.size(); ++i) {
        if (it->get<std::string>() == names[i]) o.*member = static_cast<E>(i);
      }
    });
    return add(std::move(spec));
  }
  /// One nested component; `default_use` empty: required. Fetch it with BuildContext::part(name).
  ParameterBuilder part(std::string name, std::string kind, const std::string& default_use) {
    ParameterSpec spec = detail::scalar_spec(ParameterType::kPart);
    spec.name = std::move(name);
    spec.part_kind = std::move(kind);
    spec.required = default_use.empty();
    if (!default_use.empty()) spec.default_value = {{"use", default_use}};
    return add(std::move(spec));
  }
  /// Any number of nested components. Fetch them with BuildContext::parts(name).
  ParameterBuilder part_list(std::string name, std::string kind) {
    ParameterSpec spec = detail::scalar_spec(ParameterType::kPartList);
    spec.name = std::move(name);
    spec.part_kind = std::move(kind);
    spec.default_value = nlohmann::json::array();
    return add(std::move(spec));
  }
  /// Further inputs of type `port`, each a record { "from": NODE, fields }. Fetch with
  /// BuildContext::inputs(name).
  ParameterBuilder input_list(std::string name, std::string port,
                              std::vector<ParameterSpec> fields) {
    ParameterSpec spec = detail::scalar_spec(ParameterType::kInputList);
    spec.name = std::move(name);
    spec.port = std::move(port);
    spec.element = std::move(fields);
    spec.default_value = nlohmann::json::array();
    return add(std::move(spec));
  }

  std::vector<ParameterSpec> specs() const { return {specs_.begin(), specs_.end()}; }
  /// Options from validated values (an object by parameter name; what is absent keeps its default).
  Options read(const nlohmann::json& values) const {
    Options options;
    for (const auto& set : setters_) set(options, values);
    return options;
  }

 private:
  ParameterBuilder add(ParameterSpec spec) {
    specs_.push_back(std::move(spec));
    return ParameterBuilder(specs_.back());
  }
  std::deque<ParameterSpec> specs_;  // deque: builders keep references while more are added
  std::vector<std::function<void(Options&, const nlohmann::json&)>> setters_;
};

}  // namespace plaza
