#include "framework/cache/stream_keys.h"

#include <dlfcn.h>

#include <utility>

#include "framework/execution/guard.h"
#include "plaza/component/learner.h"
#include "plaza/version.h"

namespace plaza {
namespace {

using nlohmann::json;

/// The library that all plugins compute with: while it is being worked on, its version stays.
std::filesystem::path sdk_library() {
  Dl_info info{};
  if (::dladdr(static_cast<const void*>(&component_kinds()), &info) == 0) return {};
  return info.dli_fname != nullptr ? info.dli_fname : "";
}

/// All nodes that node `index` depends on, itself included.
std::set<std::size_t> nodes_of_key(const ExecutionPlan& plan, std::size_t index) {
  std::set<std::size_t> nodes;
  for (const std::size_t above : nodes_above(plan, index)) {
    nodes.insert(above);
    if (plan.nodes[above].node->learner() != nullptr) nodes.insert(plan.clock);
  }
  return nodes;
}

}  // namespace

StreamKeys stream_keys(const ExecutionPlan& plan, const ResolvedPipeline& pipeline,
                       const Scene& scene, const FrameRange& frames, LibraryIdentities& libraries) {
  std::vector<json> parts;
  for (std::size_t i = 0; i < plan.nodes.size(); ++i) {
    parts.push_back(node_key(plan, i, libraries));
    if (Learner* const learner = plan.nodes[i].node->learner()) {
      parts.back()["extra"] =
          guarded(plan.nodes[i].name, std::nullopt, [&] { return learner->extra_key(); });
    }
  }
  json common = {{"plaza", PLAZA_VERSION},
                 {"sdk", libraries.of(sdk_library())},
                 {"seed", pipeline.seed},
                 {"scene", scene_fingerprint(scene)},
                 {"frames", to_string(frames)}};
  const auto text = [&common](json nodes) {
    json key = common;
    key["nodes"] = std::move(nodes);
    // content_key() and extra_key() may hold any bytes
    return key.dump(-1, ' ', true, json::error_handler_t::replace);
  };
  StreamKeys keys;
  for (std::size_t i = 0; i < plan.nodes.size(); ++i) {
    json nodes = json::array();
    for (const std::size_t n : nodes_of_key(plan, i)) nodes.push_back(parts[n]);
    keys.nodes.push_back(text(std::move(nodes)));
  }
  keys.whole = text(json(parts));
  return keys;
}

}  // namespace plaza
