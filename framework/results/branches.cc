#include "framework/results/branches.h"

#include <algorithm>
#include <set>
#include <string_view>

#include "plaza/data/observation.h"
#include "plaza/data/track.h"

namespace plaza {
namespace {

std::optional<Wire> output_of(const ResolvedPipeline& pipeline, std::size_t node,
                              std::string_view port) {
  const auto& outputs = pipeline.nodes[node].entry->declaration.outputs;
  for (std::size_t o = 0; o < outputs.size(); ++o) {
    if (outputs[o].type == port) return Wire{static_cast<int>(node), static_cast<int>(o)};
  }
  return std::nullopt;
}

std::string_view port_of(const ResolvedPipeline& pipeline, const Wire& wire) {
  return pipeline.nodes[static_cast<std::size_t>(wire.node)]
      .entry->declaration.outputs[static_cast<std::size_t>(wire.output)]
      .type;
}

std::optional<Wire> input_of(const ResolvedPipeline& pipeline, std::size_t node,
                             std::string_view port) {
  for (const Wire& wire : pipeline.nodes[node].inputs) {
    if (wire.node >= 0 && port_of(pipeline, wire) == port) return wire;
  }
  return std::nullopt;
}

/// The observations that a node reads, or those that what it reads was made from.
std::optional<Wire> observations_below(const ResolvedPipeline& pipeline, std::size_t node) {
  if (const auto wire = input_of(pipeline, node, Observations::kPort)) return wire;
  for (const Wire& wire : pipeline.nodes[node].inputs) {
    if (wire.node < 0) continue;
    const std::string_view port = port_of(pipeline, wire);
    if (port != Tracks::kPort && port != Tracklets::kPort) continue;
    if (const auto found = observations_below(pipeline, static_cast<std::size_t>(wire.node)))
      return found;
  }
  return std::nullopt;
}

bool same(const std::optional<Wire>& a, const std::optional<Wire>& b) {
  return a && b && a->node == b->node && a->output == b->output;
}

/// Whether `node` is `above` or reads, directly or not, from it.
bool depends_on(const ResolvedPipeline& pipeline, std::size_t node, std::size_t above) {
  std::set<std::size_t> open = {node};
  while (!open.empty()) {
    const std::size_t n = *open.rbegin();  // wires lead upwards, so nothing is seen twice
    open.erase(n);
    if (n == above) return true;
    for (const Wire& wire : pipeline.nodes[n].inputs) {
      if (wire.node >= 0) open.insert(static_cast<std::size_t>(wire.node));
    }
  }
  return false;
}

std::size_t branch_of_evaluator(const ResolvedPipeline& pipeline,
                                const std::vector<Branch>& branches, std::size_t evaluator) {
  if (const auto tracks = input_of(pipeline, evaluator, Tracks::kPort)) {
    for (std::size_t b = 0; b < branches.size(); ++b) {
      if (same(branches[b].tracks, tracks)) return b;
    }
  }
  if (const auto observations = input_of(pipeline, evaluator, Observations::kPort)) {
    for (std::size_t b = 0; b < branches.size(); ++b) {
      if (same(branches[b].observations, observations)) return b;
    }
    for (std::size_t b = 0; b < branches.size(); ++b) {  // an earlier stage of them
      if (branches[b].observations &&
          depends_on(pipeline, static_cast<std::size_t>(branches[b].observations->node),
                     static_cast<std::size_t>(observations->node))) {
        return b;
      }
    }
  }
  return 0;
}

}  // namespace

std::vector<Branch> find_branches(const ResolvedPipeline& pipeline) {
  std::vector<Branch> branches;
  std::optional<Wire> last_observations;
  for (std::size_t i = 0; i < pipeline.nodes.size(); ++i) {
    if (const auto output = output_of(pipeline, i, Observations::kPort)) last_observations = output;
    if (const auto output = output_of(pipeline, i, Tracks::kPort)) {
      branches.push_back({.name = pipeline.nodes[i].name,
                          .tracks = output,
                          .observations = observations_below(pipeline, i),
                          .evaluators = {}});
    }
  }
  std::reverse(branches.begin(), branches.end());
  if (branches.empty()) {
    Branch only;
    only.observations = last_observations;
    if (last_observations) {
      only.name = pipeline.nodes[static_cast<std::size_t>(last_observations->node)].name;
    }
    branches.push_back(std::move(only));
  }
  for (std::size_t i = 0; i < pipeline.nodes.size(); ++i) {
    if (pipeline.nodes[i].entry->declaration.kind != "evaluator") continue;
    branches[branch_of_evaluator(pipeline, branches, i)].evaluators.push_back(i);
  }
  return branches;
}

}  // namespace plaza
