#include "framework/execution/evaluate.h"

#include <algorithm>

#include "framework/execution/guard.h"

namespace plaza {
namespace {

/// Settings (named as parameters are) and words may stand among the metrics; other numbers must be
/// declared, or no study and no report would know which way is better.
void check_declared(const ComponentDeclaration& declaration, const Evaluation& evaluation) {
  for (const auto& [section_name, values] : evaluation) {
    for (const auto& [name, value] : values.items()) {
      if (!value.is_number()) continue;
      const std::string& section =
          section_name;  // lambdas of C++20 in clang 14 capture no bindings
      const std::string& key = name;
      const bool metric =
          std::any_of(declaration.metrics.begin(), declaration.metrics.end(),
                      [&](const MetricSpec& m) { return m.section == section && m.name == key; });
      const bool setting = std::any_of(declaration.parameters.begin(), declaration.parameters.end(),
                                       [&](const ParameterSpec& p) { return p.name == key; });
      if (!metric && !setting) {
        throw InternalError("gives " + section + "." + key + ", which \"" + declaration.name +
                            "\" does not declare as a metric");
      }
    }
  }
}

/// Two evaluators may share a section (detection and tracking by one definition): as long as they
/// do not say different things under one name.
bool agree(const nlohmann::json& a, const nlohmann::json& b) {
  if (!a.is_object() || !b.is_object()) return false;
  for (const auto& [key, value] : b.items()) {
    if (const auto it = a.find(key); it != a.end() && *it != value) return false;
  }
  return true;
}

}  // namespace

Evaluation evaluate_branch(const Branch& branch, const ExecutionPlan& plan) {
  Evaluation all;
  for (const std::size_t index : branch.evaluators) {
    const PlannedNode& node = plan.nodes[index];
    guarded(node.name, std::nullopt, [&] {
      const Evaluation evaluation = dynamic_cast<Evaluator&>(*node.node).evaluate();
      check_declared(node.resolved->entry->declaration, evaluation);
      for (const auto& [section, values] : evaluation) {
        const auto known = all.find(section);
        if (known == all.end()) {
          all.emplace(section, values);
        } else if (agree(known->second, values)) {
          known->second.update(values);
        } else {
          all.emplace(section + "@" + node.name, values);
        }
      }
    });
  }
  return all;
}

}  // namespace plaza
