#pragma once

#include <string>
#include <vector>

#include "framework/cache/component_key.h"
#include "framework/config/frame_range.h"

namespace plaza {

/// What the outputs of nodes depend on, as complete text: caches compare all of it, since hashes
/// may collide and keys may not.
struct StreamKeys {
  std::vector<std::string> nodes;  ///< by node: of everything that it gives in these frames
  std::string whole;               ///< of everything that the pipeline gives
};

/// A node's key holds: the version and code of the SDK, the scene, the seed, the range of frames,
/// and node_key() of the node and all nodes above it; of a node that has something to learn, also
/// what that depends on.
StreamKeys stream_keys(const ExecutionPlan& plan, const ResolvedPipeline& pipeline,
                       const Scene& scene, const FrameRange& frames, LibraryIdentities& libraries);

}  // namespace plaza
