#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "framework/study/expand.h"
#include "plaza/component/declaration.h"

namespace plaza {

/// A job that was checked: nothing is left that could have been known before.
struct PreparedJob {
  std::string id;                      ///< its folder's name: words of the variant, and a hash
  std::string key;                     ///< complete text of everything that its result depends on
  nlohmann::json pipeline;             ///< resolved.json
  std::vector<std::string> node_keys;  ///< hashes of what its nodes compute, in node order
};

/// A study that can be run.
struct PreparedStudy {
  Study study;
  Expansion expansion;
  std::vector<PreparedJob> jobs;    ///< as expansion.jobs
  std::vector<MetricSpec> metrics;  ///< that the evaluators of all jobs declare, each once
};

/// Reads and checks all pipelines of a study as `plaza check` does, components included. All faults
/// of all variants are reported in one UserError, each once, with the variant where not all of them
/// have it.
PreparedStudy prepare_study(Study study, const Registry& registry);

}  // namespace plaza
