#pragma once

#include <map>
#include <string>
#include <vector>

#include "framework/execution/plan.h"
#include "framework/results/branches.h"
#include "plaza/component/evaluator.h"

namespace plaza {

/// The figures of all evaluators of a branch. Sections of the same name are joined when their
/// figures do not contradict each other; else the later one is called "<section>@<node>". A number
/// that its component declares neither as a metric nor as a parameter is an InternalError.
Evaluation evaluate_branch(const Branch& branch, const ExecutionPlan& plan);

}  // namespace plaza
