#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "framework/config/pipeline.h"
#include "plaza/component/node.h"
#include "plaza/component/source.h"

namespace plaza {

/// A node with everything looked up that a frame would otherwise look up again.
struct PlannedNode {
  std::string name;
  const ResolvedNode* resolved = nullptr;
  std::shared_ptr<Node> node;
  Source* source = nullptr;  ///< the same node when it is a source
  std::vector<int> inputs;   ///< slot of each input, -1: not connected
  std::vector<int> outputs;  ///< slot of each output
  bool memory = false;
  bool works = true;  ///< false: nobody needs what it would compute, so it is not called
};

/// A pipeline ready to be run: every output of every node has a slot in each frame.
struct ExecutionPlan {
  std::vector<PlannedNode> nodes;  ///< in pipeline order
  std::size_t slot_count = 0;
  std::size_t clock = 0;  ///< index of the first source
  int frames_slot = -1;   ///< of the clock's Frames; -1: it gives none

  /// Nodes to be called in every frame (not sources, not renderers) in groups. Nodes of a group
  /// without memory may work on different frames at once; one with memory is a group of its own.
  /// The order puts nodes without memory as early as their inputs allow, so that they fall into few
  /// groups; it is the same for any number of threads.
  struct Group {
    bool memory = false;
    std::vector<std::size_t> nodes;
  };
  std::vector<Group> groups;
};

/// Throws UserError when the pipeline has no source.
ExecutionPlan make_plan(const ResolvedPipeline& pipeline, const Assembly& assembly);

/// Index of the first declared input of type `port`, or nothing.
std::optional<std::size_t> input_of_type(const ComponentDeclaration& declaration,
                                         std::string_view port);
/// Index of the first declared output of type `port`, or nothing.
std::optional<std::size_t> output_of_type(const ComponentDeclaration& declaration,
                                          std::string_view port);

}  // namespace plaza
