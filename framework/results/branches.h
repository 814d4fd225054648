#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/config/pipeline.h"

namespace plaza {

/// One answer of a pipeline: a node that gives Tracks, the observations it was made from, and the
/// evaluators that look at it.
struct Branch {
  std::string name;                     ///< of the node that gives the tracks
  std::optional<Wire> tracks;           ///< nothing: observations only
  std::optional<Wire> observations;     ///< what the tracks are made from
  std::vector<std::size_t> evaluators;  ///< node indices
};

/// The branches of a pipeline, the main one first: the last node that gives Tracks. Without any,
/// one branch of the last node that gives Observations; without these, one that has neither.
///
/// An evaluator belongs to the branch whose Tracks it reads; one that reads only Observations to
/// the branch that is made from them, the main one before others.
std::vector<Branch> find_branches(const ResolvedPipeline& pipeline);

}  // namespace plaza
