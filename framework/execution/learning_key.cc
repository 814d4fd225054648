#include "framework/execution/learning_key.h"

#include <nlohmann/json.hpp>
#include <set>

#include "framework/cache/component_key.h"
#include "framework/execution/guard.h"
#include "plaza/component/learner.h"
#include "plaza/version.h"

namespace plaza {

using nlohmann::json;

std::string learning_key(const ExecutionPlan& plan, std::size_t index,
                         const ResolvedPipeline& pipeline, const Scene& scene) {
  std::set<std::size_t> nodes = nodes_above(plan, index);
  nodes.insert(plan.clock);  // the learner sees its frames whether or not it reads them later
  json key = {{"plaza", PLAZA_VERSION},
              {"seed", pipeline.seed},
              {"scene", scene_fingerprint(scene)},
              {"learner", plan.nodes[index].name}};
  LibraryIdentities libraries;
  for (const std::size_t i : nodes) key["nodes"].push_back(node_key(plan, i, libraries));
  key["extra"] = guarded(plan.nodes[index].name, std::nullopt,
                         [&] { return plan.nodes[index].node->learner()->extra_key(); });
  // content_key() and extra_key() may hold any bytes
  return key.dump(-1, ' ', true, json::error_handler_t::replace);
}

}  // namespace plaza
