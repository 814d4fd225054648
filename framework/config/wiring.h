#pragma once

#include <vector>

#include "framework/config/component_reader.h"

namespace plaza {

/// Fills the nodes' inputs: each declared input from the nearest node above that gives its type,
/// unless "from" names another; then the records of input lists. Of several sources only the first
/// gives Frames. The first node must be a source; ground truth goes to evaluators, sinks and
/// renderers alone. Errors that only follow from a node whose component is not known are left out.
void wire_nodes(std::vector<NodeDraft>& drafts, const Registry& registry,
                DiagnosticSink& diagnostics);

}  // namespace plaza
