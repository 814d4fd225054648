#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>

#include "findings.h"
#include "plaza/contract/contract.h"

namespace plaza::contract {
namespace {

bool is_word(std::string_view name, char separator) {
  if (name.empty() || name.front() < 'a' || name.front() > 'z' || name.back() == separator)
    return false;
  for (const char c : name) {
    if (!((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == separator)) return false;
  }
  return true;
}

std::string in_quotes(const std::string& word) { return '"' + word + '"'; }

bool known_kind(const std::string& kind) {
  const std::vector<std::string>& kinds = component_kinds();
  return std::find(kinds.begin(), kinds.end(), kind) != kinds.end();
}

class DeclarationCheck {
 public:
  DeclarationCheck(const ComponentDeclaration& declaration, Findings& findings)
      : d_(declaration), findings_(findings) {}

  void run() {
    findings_.require(is_word(d_.name, '-'),
                      "its name is not made of lower-case letters, digits, hyphens");
    if (!known_kind(d_.kind)) findings_.add("its kind " + in_quotes(d_.kind) + " is unknown");
    one_line(d_.summary, "its summary");
    std::set<std::string> names;
    for (const ParameterSpec& p : d_.parameters) {
      if (!names.insert(p.name).second)
        findings_.add("parameter " + in_quotes(p.name) + " stands twice");
      if (p.name == "use" || p.name == "name" || p.name == "from" || p.name == "after" ||
          p.name == "before") {
        findings_.add("parameter " + in_quotes(p.name) +
                      " has a name that pipelines use themselves");
      }
      parameter(p, "parameter " + in_quotes(p.name));
    }
    for (const PortSpec& port : d_.inputs) one_port(port, "input");
    for (const PortSpec& port : d_.outputs) one_port(port, "output");
    std::set<std::string> outputs;
    for (const PortSpec& port : d_.outputs) {
      if (!outputs.insert(port.type).second) findings_.add("output " + port.type + " stands twice");
    }
    metrics();
    features();
    ports_of_kind();
  }

 private:
  void one_line(const std::string& text, const std::string& what) {
    if (text.empty()) findings_.add(what + " is empty");
    if (text.find('\n') != std::string::npos) findings_.add(what + " has more than one line");
  }

  void one_port(const PortSpec& port, const std::string& what) {
    if (port.type.empty()) findings_.add("an " + what + " has no type");
    one_line(port.meaning, "the meaning of " + what + " " + port.type);
  }

  void parameter(const ParameterSpec& p, const std::string& what) {
    if (!is_word(p.name, '_'))
      findings_.add(what + ": its name is not made of lower-case letters, digits, _");
    one_line(p.meaning, what + ": its meaning");
    if (p.required && !p.default_value.is_null())
      findings_.add(what + ": is required and has a default");
    if (p.minimum && p.maximum && *p.minimum > *p.maximum)
      findings_.add(what + ": its range is empty");
    const bool is_part = p.type == ParameterType::kPart || p.type == ParameterType::kPartList;
    if (is_part && !known_kind(p.part_kind)) {
      findings_.add(what + ": asks for parts of the unknown kind " + in_quotes(p.part_kind));
    }
    if (p.type == ParameterType::kInputList) {
      if (p.port.empty()) findings_.add(what + ": its inputs have no type");
      for (const ParameterSpec& field : p.element)
        parameter(field, what + ", field " + in_quotes(field.name));
    }
    if (p.type == ParameterType::kChoice && p.choices.empty())
      findings_.add(what + ": has no choices");
    if (!p.default_value.is_null()) value(p, p.default_value, what);
  }

  /// The default, and the elements of a default.
  void value(const ParameterSpec& p, const nlohmann::json& v, const std::string& what) {
    const auto wrong = [&](const char* why) {
      findings_.add(what + ": its default " + v.dump() + " " + why);
    };
    switch (p.type) {
      case ParameterType::kBoolean:
        if (!v.is_boolean()) wrong("is no boolean");
        break;
      case ParameterType::kInteger:
      case ParameterType::kReal: {
        if (!v.is_number() || (p.type == ParameterType::kInteger && !v.is_number_integer())) {
          wrong("has another type");
          break;
        }
        const double x = v.get<double>();
        const bool low = p.minimum && (p.minimum_exclusive ? x <= *p.minimum : x < *p.minimum);
        const bool high = p.maximum && (p.maximum_exclusive ? x >= *p.maximum : x > *p.maximum);
        if (!std::isfinite(x) || low || high) wrong("is outside its range");
        break;
      }
      case ParameterType::kText:
      case ParameterType::kPath:
        if (!v.is_string()) wrong("is no text");
        break;
      case ParameterType::kChoice:
        if (!v.is_string() || std::find(p.choices.begin(), p.choices.end(), v.get<std::string>()) ==
                                  p.choices.end()) {
          wrong("is none of its choices");
        }
        break;
      case ParameterType::kPart:
        if (!v.is_object() || !v.contains("use")) wrong("names no component");
        break;
      case ParameterType::kList:
      case ParameterType::kMap:
      case ParameterType::kPartList:
      case ParameterType::kInputList:
        if (p.type == ParameterType::kMap ? !v.is_object() : !v.is_array()) {
          wrong("has another type");
          break;
        }
        // an empty default of a list that must not be empty means that the user has to give one
        if (!v.empty() && (v.size() < p.min_items || (p.max_items && v.size() > *p.max_items))) {
          wrong("has another number of items");
        }
        if (!p.element.empty() && p.type != ParameterType::kInputList) {
          for (const nlohmann::json& item : v) value(p.element[0], item, what);
        }
        break;
    }
  }

  void metrics() {
    std::set<std::string> names;
    for (const MetricSpec& m : d_.metrics) {
      const std::string what = "metric " + in_quotes(m.section + "." + m.name);
      if (m.section.empty() || m.name.empty()) findings_.add(what + " has no name or no section");
      one_line(m.meaning, what + ": its meaning");
      if (!names.insert(m.section + "." + m.name).second) findings_.add(what + " stands twice");
    }
    if (d_.kind == "evaluator" && d_.metrics.empty()) findings_.add("declares no metric");
    if (d_.kind != "evaluator" && !d_.metrics.empty())
      findings_.add("only evaluators declare metrics");
  }

  void features() {
    std::set<std::string> names;
    for (const FeatureSpec& f : d_.features) {
      const std::string what = "feature " + in_quotes(f.name);
      if (!is_word(f.name, '-'))
        findings_.add(what + ": its name is not made of lower-case letters, digits, hyphens");
      one_line(f.meaning, what + ": its meaning");
      if (!names.insert(f.name).second) findings_.add(what + " stands twice");
    }
    const auto carries = [](const PortSpec& port) {
      return port.type == Observations::kPort || port.type == Tracklets::kPort;
    };
    if (!d_.features.empty() && std::none_of(d_.outputs.begin(), d_.outputs.end(), carries))
      findings_.add("declares features, but gives neither Observations nor Tracklets");
  }

  void first_port(const std::vector<PortSpec>& ports, std::string_view type,
                  const std::string& what) {
    if (ports.empty() || ports[0].type != type)
      findings_.add(what + " 0 is not " + std::string(type));
  }

  void ports_of_kind() {
    const std::string& kind = d_.kind;
    const bool is_part =
        kind == "shape" || kind == "appearance" || kind == "motion" || kind == "affinity";
    const bool gives_nothing =
        is_part || kind == "evaluator" || kind == "sink" || kind == "renderer";
    if ((is_part || kind == "source") && !d_.inputs.empty())
      findings_.add("a " + kind + " has no inputs");
    if (gives_nothing && !d_.outputs.empty())
      findings_.add("a component of kind " + kind + " has no outputs");
    if (kind == "source" && d_.outputs.empty())
      findings_.add("gives nothing: it declares no output");
    if (kind == "modality") {
      first_port(d_.inputs, FrameSet::kPort, "input");
      first_port(d_.outputs, EvidenceSet::kPort, "output");
    }
    if (kind == "detector") first_port(d_.outputs, Observations::kPort, "output");
    if (kind == "describer") {
      first_port(d_.inputs, Observations::kPort, "input");
      first_port(d_.outputs, Observations::kPort, "output");
    }
    if (kind == "associator") first_port(d_.outputs, Tracks::kPort, "output");
    if (kind == "renderer") {
      first_port(d_.inputs, FrameSet::kPort, "input");
      if (d_.inputs.size() < 2 || d_.inputs[1].type != Tracks::kPort)
        findings_.add("input 1 is not Tracks");
    }
    if (kind == "modality" || kind == "detector" || kind == "describer" || kind == "associator") {
      for (const PortSpec& port : d_.inputs) {
        if (port.type == GroundTruth::kPort)
          findings_.add("a " + kind + " must not read the ground truth");
      }
    }
    if (kind == "detector" && d_.memory) {
      findings_.add("a detector has no memory between frames, but declares it");
    }
    if (kind == "modality" && d_.memory && d_.outputs.size() < 2) {
      findings_.add("a modality remembers its foreground, but declares memory without giving one");
    }
    if (kind_has_memory(kind) && !d_.memory)
      findings_.add("a component of kind " + kind + " has memory");
  }

  const ComponentDeclaration& d_;
  Findings& findings_;
};

}  // namespace

std::vector<std::string> declaration_violations(const ComponentDeclaration& declaration) {
  Findings findings;
  DeclarationCheck(declaration, findings).run();
  return findings.take();
}

}  // namespace plaza::contract
