#pragma once

#include <string>

#include "framework/execution/plan.h"
#include "plaza/geometry/scene.h"

namespace plaza {

/// The complete text of everything that what node `index` learns depends on: its configuration and
/// that of every node above it (with parts, plugin libraries and files), the source's content, the
/// scene, the seed, the SDK's version, and the learner's extra_key().
std::string learning_key(const ExecutionPlan& plan, std::size_t index,
                         const ResolvedPipeline& pipeline, const Scene& scene);

}  // namespace plaza
