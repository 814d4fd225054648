#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "modalities/edges/scan_lines.h"

/// The oriented distance transform in the two forms of the thesis: the yardsticks of the fast one.
/// `edges`: 8-bit, not 0 where there is an edge. The result has the image's size and holds the
/// number of steps along the direction's line to the nearest edge on it, 255 where there is none
/// within the gate; times Direction::step_px it is DT of (4.2) in pixels.
namespace plaza::edges {

inline constexpr unsigned char kNoEdge = 255;

/// Two scans per line: one finds its edges, the other writes distances (thesis 4.3.3).
cv::Mat1b transform_by_scanning(const cv::Mat1b& edges, const Direction& direction);

/// Outward from the edges by exploring units (thesis 4.3.4, Algorithm 1).
///
/// Algorithm 1 stops a unit where 0 < DT < infinity, so that it walks over further edges and writes
/// its count over their 0. Here a unit stops at every pixel that is not farther than its count.
cv::Mat1b transform_by_exploring(const cv::Mat1b& edges, const Direction& direction);

}  // namespace plaza::edges
