#include "framework/execution/demand.h"

#include <optional>

namespace plaza {

Demand demand_of(const ExecutionPlan& plan, const std::vector<Branch>& branches, bool draw,
                 const std::function<bool(std::size_t, std::size_t)>& kept) {
  Demand demand;
  demand.works.assign(plan.nodes.size(), false);
  for (const PlannedNode& node : plan.nodes) demand.wanted.emplace_back(node.outputs.size(), false);
  const auto want = [&demand](const Wire& wire) {
    if (wire.node < 0) return;
    demand.wanted[static_cast<std::size_t>(wire.node)][static_cast<std::size_t>(wire.output)] =
        true;
  };
  for (const Branch& branch : branches) {
    if (branch.tracks) want(*branch.tracks);
    if (branch.observations) want(*branch.observations);
  }
  for (std::size_t i = plan.nodes.size(); i-- > 0;) {  // wires lead upwards
    const std::string& kind = plan.nodes[i].resolved->entry->declaration.kind;
    bool works = kind == "evaluator" || (draw && (kind == "sink" || kind == "renderer"));
    for (std::size_t o = 0; o < demand.wanted[i].size() && !works; ++o) {
      works = demand.wanted[i][o] && !kept(i, o);
    }
    demand.works[i] = works;
    if (!works) continue;
    for (const Wire& wire : plan.nodes[i].resolved->inputs) want(wire);
  }
  return demand;
}

}  // namespace plaza
