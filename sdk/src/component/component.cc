#include "plaza/component/component.h"

#include "plaza/component/build_context.h"
#include "plaza/component/declaration.h"
#include "plaza/component/learner.h"
#include "plaza/component/node.h"

namespace plaza {

Component::~Component() = default;
Diagnostics Component::do_check() const { return {}; }

Node::~Node() = default;
Learner* Node::learner() { return nullptr; }
void Node::do_flush(NodeIo& /*io*/) {}

void NodeIo::out(std::size_t output, PayloadPtr payload) {
  if (output >= outputs_.size()) {
    throw InternalError("output " + std::to_string(output) + " is not declared");
  }
  PayloadPtr& slot = slots_[outputs_[output]];
  if (slot) throw InternalError("output " + std::to_string(output) + " emitted twice in one frame");
  slot = std::move(payload);
}

const PayloadPtr& NodeIo::checked(std::size_t input, std::string_view port) const {
  if (!has(input)) {
    throw InternalError("input " + std::to_string(input) + " (" + std::string(port) +
                        ") is not connected or was not emitted");
  }
  const PayloadPtr& payload = slots_[inputs_[input]];
  if (payload->port() != port) {
    throw InternalError("input " + std::to_string(input) + " is " + std::string(payload->port()) +
                        ", not " + std::string(port));
  }
  return payload;
}

const std::vector<InputReference>& BuildContext::inputs(const std::string& parameter) const {
  static const std::vector<InputReference> kNone;
  const auto it = input_lists.find(parameter);
  return it == input_lists.end() ? kNone : it->second;
}

const std::vector<NamedPart>& BuildContext::all_parts(const std::string& parameter) const {
  static const std::vector<NamedPart> kNone;
  const auto it = part_lists.find(parameter);
  return it == part_lists.end() ? kNone : it->second;
}

const NamedPart& BuildContext::only_part(const std::string& parameter) const {
  const std::vector<NamedPart>& parts = all_parts(parameter);
  if (parts.size() != 1) {
    throw InternalError("parameter '" + parameter + "' of '" + name + "' has " +
                        std::to_string(parts.size()) + " parts, expected one");
  }
  return parts[0];
}

Learner::~Learner() = default;
std::string Learner::do_extra_key() const { return {}; }
std::optional<LearningPlan> Learner::plan() const {
  const std::optional<LearningPlan> plan = do_plan();
  if (plan && (plan->every < 1 || (plan->first && *plan->first < 1))) {
    throw InternalError("learning plan: every and first must be at least 1");
  }
  return plan;
}

ComponentRegistrar::~ComponentRegistrar() = default;

const std::vector<std::string>& component_kinds() {
  static const std::vector<std::string> kKinds = {
      "source",    "modality", "shape",      "appearance", "motion", "detector",
      "describer", "affinity", "associator", "evaluator",  "sink",   "renderer"};
  return kKinds;
}

bool kind_has_memory(std::string_view kind) {
  return kind == "source" || kind == "associator" || kind == "evaluator" || kind == "sink" ||
         kind == "renderer";
}

}  // namespace plaza
