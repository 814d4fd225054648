#pragma once

#include <map>
#include <string>
#include <vector>

#include "framework/execution/plan.h"
#include "framework/results/branches.h"
#include "plaza/component/evaluator.h"

namespace plaza {

/// The figures of all evaluators of a branch. When two of them give a section of the same name, the
/// later one's is called "<section>@<node>". A figure that its component does not declare is an
/// InternalError.
Evaluation evaluate_branch(const Branch& branch, const ExecutionPlan& plan);

}  // namespace plaza
