#include "modalities/edges/edges.h"

namespace plaza::edges {

Declaration<Edges::Options> Edges::declare() {
  Parameters<Options> p;
  declare_shrink(p, &Options::shrink);
  p.choice("method", &Options::method, {"canny", "sobel"})
      .meaning(
          "what counts as an edge: Canny's thinned and connected ones, or every pixel with a "
          "gradient above \"high_threshold\"")
      .source("thesis 4.3.2");
  p.value("low_threshold", &Options::low_threshold)
      .above(0)
      .meaning("gradient (3 x 3 Sobel, unscaled) above which Canny follows an edge");
  p.value("high_threshold", &Options::high_threshold)
      .above(0)
      .meaning("gradient above which an edge begins; at least \"low_threshold\"");
  p.value("blur_px", &Options::blur_px)
      .unit("px")
      .at_least(0)
      .at_most(20)
      .meaning("sigma of a Gaussian that smooths the image before; 0: none");
  p.choice("background", &Options::background, {"people-free", "median", "none"})
      .meaning(
          "what the background's edges are learned from: the union of the edges of frames that "
          "the source marks as people-free, the median of frames with people, or nothing, then "
          "nothing is subtracted")
      .source("people-free: thesis 4.3.2");
  p.value("background_first", &Options::background_first)
      .at_least(1)
      .meaning("learn only from so many first frames; unset: from all");
  p.value("background_every", &Options::background_every)
      .at_least(1)
      .meaning("learn from every n-th of them");
  p.value("background_tolerance_px", &Options::background_tolerance_px)
      .unit("px")
      .at_least(0)
      .at_most(50)
      .meaning("how near an edge must be to one of the background to be taken for it")
      .source("thesis 4.3.2: \"a few pixels\"");
  p.value("background_sensitivity", &Options::background_sensitivity)
      .above(0)
      .at_most(1)
      .meaning(
          "factor on both thresholds for the median's edges, since edges near a threshold come "
          "and go");
  p.value("orientation_threshold", &Options::orientation_threshold)
      .above(0)
      .at_most(1)
      .meaning(
          "an edge near one of the background is removed when the cosine between their "
          "gradients is above this (Th_s)")
      .source("thesis (4.1)");
  p.value("min_contour_px", &Options::min_contour_px)
      .unit("px")
      .at_least(1)
      .meaning(
          "least pixels of a connected piece of foreground edges; smaller ones are dropped before "
          "linking, 1: none");
  p.value("least_piece_m", &Options::least_piece_m)
      .unit("m")
      .at_least(0)
      .at_most(5)
      .meaning(
          "so are pieces that would be shorter than this, both in height and width, if they were "
          "of a body that stands where they end; 0: none")
      .source("thesis 7.2, shape analysis");
  p.value("longest_line_m", &Options::longest_line_m)
      .unit("m")
      .at_least(0)
      .at_most(100)
      .meaning(
          "straight lines of foreground edges that would be longer than this there, borders of "
          "shadows and of things that were moved, are dropped before linking; 0: none")
      .source("thesis 7.2, shape analysis");
  p.value("link_px", &Options::link_px)
      .unit("px")
      .at_least(0)
      .meaning("by how many removed pixels a contour may grow at each end point; 0: no linking")
      .source("thesis 4.3.2, Figure 4.5");
  p.value("link_end_points", &Options::link_end_points)
      .at_least(1)
      .meaning("linking ends when fewer end points than this have moved in a round (Th_ep)")
      .source("thesis 4.3.2");
  p.value("directions", &Options::directions)
      .at_least(1)
      .at_most(180)
      .meaning("number of directions of the distance transform, evenly over half a turn")
      .source("thesis 4.3.3");
  p.value("sigma_px", &Options::sigma_px)
      .unit("px")
      .above(0)
      .at_most(80)
      .meaning(
          "standard deviation of an edge's distance from the contour (R); the validation gate "
          "is three of it")
      .source("thesis (4.3)");
  p.value("min_visible", &Options::min_visible)
      .at_least(0)
      .at_most(1)
      .meaning("least share of a silhouette inside the image; with less the view can't tell");
  p.value("min_points", &Options::min_points)
      .at_least(1)
      .meaning("least number of contour points inside the image; with fewer the view can't tell");
  p.choice("explains", &Options::explains, {"contour", "silhouette", "region"})
      .meaning(
          "what an accepted person accounts for: edges within the gate of its contour, along the "
          "normals (contour), and those inside (silhouette), after which the rest is transformed "
          "anew; or, much faster, no edge, but what other contours have inside the silhouette "
          "and within the gate around it counts nowhere, neither for nor against them (region)");
  p.choice("device", &Options::device, {"cpu", "opencl"})
      .meaning(
          "what compares silhouettes in numbers with an image: one core with its vector "
          "instructions, or OpenCV's OpenCL device, with results equal bit by bit; few "
          "silhouettes, "
          "and those judged again after explain(), stay on the core");
  return Declaration<Options>(
             "edges", "Foreground edges against silhouettes, by an oriented distance transform.")
      .source("thesis 4.3.2-4.3.5, (4.1)-(4.3), Algorithm 1")
      .input<FrameSet>("images of all views")
      .output<EvidenceSet>("foreground edges and their distance transform")
      .parameters(std::move(p));
}

}  // namespace plaza::edges
