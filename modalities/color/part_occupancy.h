#pragma once

#include <optional>
#include <span>

#include "modalities/color/occupancy.h"
#include "modalities/common/body_parts.h"

namespace plaza::color {

/// How a body's parts are judged.
struct PartJudgement {
  PartMixture mixture;
  double least_visible = 0;  ///< of a part, for it to count, and of the body, for the view to tell
  double scale = 0;          ///< log-likelihood of an occupancy o is scale * (1 - o)^2
};

/// Log-likelihood of a body in parts: PartMixture over what is in sight, each case judged by the
/// occupancy of its parts together, their pieces of the ring included. Parts of which too little is
/// left (static occluders, explained people, the image's border) count nowhere. Nothing where too
/// little of the whole body is left. `counts` are those of the body's pieces.
std::optional<double> log_likelihood_in_parts(const SpanTemplates& templates, std::size_t body,
                                              std::span<const TemplateCounts> counts,
                                              const PartJudgement& judgement);

}  // namespace plaza::color
