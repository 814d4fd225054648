#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "framework/execution/plan.h"
#include "framework/results/branches.h"

namespace plaza {

/// Who has to work so that a run gives what is asked of it.
struct Demand {
  std::vector<bool> works;                ///< by node
  std::vector<std::vector<bool>> wanted;  ///< by node and output: somebody who works reads it
};

/// Asked for are the figures of all evaluators, the tracks and observations of all branches, and,
/// where `draw` is set, what sinks and renderers make. A node works when it gives something of that
/// or something that is read by a node that works, and that is not `kept`.
Demand demand_of(const ExecutionPlan& plan, const std::vector<Branch>& branches, bool draw,
                 const std::function<bool(std::size_t node, std::size_t output)>& kept);

}  // namespace plaza
