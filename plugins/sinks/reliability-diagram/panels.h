#pragma once

#include <opencv2/core/mat.hpp>
#include <span>

#include "plaza/scoring/reliability.h"

namespace plaza::reliability_diagram {

/// Three charts side by side, 480 px wide each: stated probability against the share of right ones,
/// score against the same with the fitted curve, and the share of positions inside ellipses of a
/// stated share. A chart without data says so.
cv::Mat draw_reliability(const Judgement& judgement, std::span<const ReliabilityBin> bins,
                         std::span<const CurvePoint> curve);

}  // namespace plaza::reliability_diagram
