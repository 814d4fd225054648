#pragma once

#include <cstdint>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "framework/execution/frame_reader.h"
#include "framework/execution/model_cache.h"
#include "framework/execution/plan.h"
#include "framework/execution/progress.h"

namespace plaza {

/// A node that has something to learn, and where that is kept.
struct LearningTask {
  std::size_t node = 0;
  Learner* learner = nullptr;
  std::string key;
};

/// The learners of a pipeline, in node order.
std::vector<LearningTask> learning_tasks(const ExecutionPlan& plan,
                                         const ResolvedPipeline& pipeline, const Scene& scene);

struct Recall {
  std::vector<LearningTask> missing;  ///< have to be learned
  std::optional<std::size_t>
      refused_node;  ///< would not take what the cache held: needs a fresh object
};

/// Loads what the cache holds. Entries of nodes in `distrusted` are not looked at.
Recall recall_models(const std::vector<LearningTask>& tasks, const ExecutionPlan& plan,
                     const ModelCache& cache, const std::set<std::size_t>& distrusted);

/// One pass over the source for all tasks, each seeing the frames it asked for, in order; then
/// finish(). Ends early, with `false`, when a stop is requested.
bool learn_models(const std::vector<LearningTask>& tasks, const ExecutionPlan& plan,
                  FrameReader& reader, int threads, Progress& progress);

/// Puts what was learned into the cache. A cache that can't be written is a note, not an error.
std::vector<std::string> store_models(const std::vector<LearningTask>& tasks,
                                      const ExecutionPlan& plan, const ModelCache& cache);

}  // namespace plaza
