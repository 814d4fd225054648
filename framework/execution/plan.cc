#include "framework/execution/plan.h"

#include <algorithm>

#include "plaza/component/renderer.h"
#include "plaza/core/error.h"
#include "plaza/data/frames.h"

namespace plaza {
namespace {

std::optional<std::size_t> find_port(const std::vector<PortSpec>& ports, std::string_view type) {
  for (std::size_t i = 0; i < ports.size(); ++i) {
    if (ports[i].type == type) return i;
  }
  return std::nullopt;
}

/// How many nodes with memory lie one behind the other above each node: a node's level is the first
/// moment at which all of its inputs are there.
std::vector<int> levels_of(const ExecutionPlan& plan) {
  std::vector<int> level(plan.nodes.size(), 0);
  for (std::size_t i = 0; i < plan.nodes.size(); ++i) {
    for (const Wire& wire : plan.nodes[i].resolved->inputs) {
      if (wire.node < 0) continue;
      const auto above = static_cast<std::size_t>(wire.node);
      const bool wait = plan.nodes[above].memory && plan.nodes[above].source == nullptr;
      level[i] = std::max(level[i], level[above] + (wait ? 1 : 0));
    }
  }
  return level;
}

std::vector<ExecutionPlan::Group> group_nodes(const ExecutionPlan& plan) {
  const std::vector<int> level = levels_of(plan);
  const int last = level.empty() ? -1 : *std::max_element(level.begin(), level.end());
  std::vector<ExecutionPlan::Group> groups;
  for (int l = 0; l <= last; ++l) {
    ExecutionPlan::Group without_memory;
    std::vector<ExecutionPlan::Group> with_memory;
    for (std::size_t i = 0; i < plan.nodes.size(); ++i) {
      const PlannedNode& node = plan.nodes[i];
      const bool idle =
          node.source != nullptr || dynamic_cast<Renderer*>(node.node.get()) != nullptr;
      if (level[i] != l || idle) continue;
      if (node.memory) {
        with_memory.push_back({.memory = true, .nodes = {i}});
      } else {
        without_memory.nodes.push_back(i);
      }
    }
    if (!without_memory.nodes.empty()) groups.push_back(std::move(without_memory));
    groups.insert(groups.end(), with_memory.begin(), with_memory.end());
  }
  return groups;
}

}  // namespace

std::optional<std::size_t> input_of_type(const ComponentDeclaration& declaration,
                                         std::string_view port) {
  return find_port(declaration.inputs, port);
}

std::optional<std::size_t> output_of_type(const ComponentDeclaration& declaration,
                                          std::string_view port) {
  return find_port(declaration.outputs, port);
}

ExecutionPlan make_plan(const ResolvedPipeline& pipeline, const Assembly& assembly) {
  if (assembly.nodes.size() != pipeline.nodes.size()) {
    throw InternalError("the assembly has another number of nodes than its pipeline");
  }
  ExecutionPlan plan;
  std::optional<std::size_t> clock;
  for (std::size_t i = 0; i < pipeline.nodes.size(); ++i) {
    const ResolvedNode& resolved = pipeline.nodes[i];
    PlannedNode node;
    node.name = resolved.name;
    node.resolved = &resolved;
    node.node = std::dynamic_pointer_cast<Node>(assembly.nodes[i]);
    if (!node.node) throw InternalError("'" + resolved.name + "' is not a node");
    node.source = dynamic_cast<Source*>(node.node.get());
    node.memory = resolved.entry->declaration.memory;
    for (std::size_t o = 0; o < resolved.entry->declaration.outputs.size(); ++o) {
      node.outputs.push_back(static_cast<int>(plan.slot_count++));
    }
    for (const Wire& wire : resolved.inputs) {
      node.inputs.push_back(wire.node < 0 ? -1
                                          : plan.nodes.at(static_cast<std::size_t>(wire.node))
                                                .outputs.at(static_cast<std::size_t>(wire.output)));
    }
    if (node.source != nullptr && !clock) clock = i;
    plan.nodes.push_back(std::move(node));
  }
  if (!clock) {
    throw UserError(pipeline.file.string() +
                    ": /nodes: no source; a pipeline begins with a node that " +
                    "gives frames (plaza list source)");
  }
  plan.clock = *clock;
  const PlannedNode& source = plan.nodes[plan.clock];
  if (const auto output = output_of_type(source.resolved->entry->declaration, FrameSet::kPort)) {
    plan.frames_slot = source.outputs[*output];
  }
  plan.groups = group_nodes(plan);
  return plan;
}

}  // namespace plaza
