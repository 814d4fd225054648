#pragma once

#include <string>

#include "framework/config/pipeline.h"

namespace plaza {

/// The pipeline as a graph for graphviz: nodes with their parts in a box, an edge for every wired
/// input, labelled with the type that travels along it.
std::string graph_dot(const ResolvedPipeline& pipeline);

/// The same as a table for people: one row per node, what it uses and what it reads from whom.
std::string wiring_table(const ResolvedPipeline& pipeline);

}  // namespace plaza
