#include "modalities/color/color.h"

namespace plaza {

Declaration<ColorModality::Options> ColorModality::declare() {
  const char* const griesser = "Griesser et al. 2005";
  Parameters<Options> p;
  declare_shrink(p, &Options::shrink);
  p.value("darkness", &Options::darkness)
      .unit("grey levels")
      .at_least(0)
      .at_most(2000)
      .meaning(
          "constant appended to the colours of a window: 0 is blind to dark clothes, large "
          "values see shadows")
      .source(griesser);
  p.value("least_noise", &Options::least_noise)
      .unit("grey levels")
      .above(0)
      .at_most(255)
      .meaning("standard deviation of a pixel's channel that is assumed at least");
  p.value("threshold", &Options::threshold)
      .at_least(0)
      .at_most(500)
      .meaning(
          "strength of change from which a pixel is foreground when half of its surroundings "
          "are; noise alone gives 1 on the average")
      .source(griesser);
  p.value("neighbourhood", &Options::neighbourhood)
      .at_least(0)
      .at_most(50)
      .meaning("how much each of 8 foreground neighbours lowers the threshold")
      .source(griesser);
  p.value("previous", &Options::previous)
      .at_least(0)
      .at_most(20)
      .meaning(
          "how much each foreground pixel of the 3 x 3 window in the previous frame's mask "
          "lowers the threshold")
      .source(griesser);
  p.value("iterations", &Options::iterations)
      .at_least(1)
      .at_most(100)
      .meaning("most rounds in which the labels are solved")
      .source(griesser);
  p.value("most_foreground", &Options::most_foreground)
      .above(0)
      .at_most(1)
      .meaning(
          "share of foreground above which a view's background is taken for invalid (light or "
          "camera changed) and the view can't tell");
  p.value("gap", &Options::gap)
      .at_least(0)
      .at_most(1)
      .meaning("distance of the ring from the silhouette, as a share of the silhouette's height");
  p.value("ring", &Options::ring)
      .at_least(0)
      .at_most(1)
      .meaning(
          "width of the ring around a silhouette, as a share of the silhouette's height; at "
          "least one pixel");
  p.value("occupancy_sigma", &Options::occupancy_sigma)
      .above(0)
      .at_most(10)
      .meaning("standard deviation of a person's occupancy from 1");
  p.value("least_visible", &Options::least_visible)
      .at_least(0)
      .at_most(1)
      .meaning(
          "share of a silhouette that must be in the image, unhidden and unexplained, for the "
          "view to tell");
  p.value("parts", &Options::parts)
      .meaning(
          "the body's parts from the ground upwards, each of which something that nobody described "
          "may hide on its own, as [upper end as a share of the body's height, probability to be "
          "hidden]; none: the body is seen whole or cut by what is known")
      .source("thesis 7.2; legs, torso and head of 4.4.1 end at 0.486, 0.829 and 1");
  p.value("least_height_m", &Options::least_height_m)
      .unit("m")
      .at_least(0)
      .at_most(5)
      .meaning(
          "connected pieces of foreground that would be lower than this, if they stood on the "
          "ground where they end, are dropped; 0: none")
      .source("thesis 7.2, shape analysis");
  p.value("least_column_m", &Options::least_column_m)
      .unit("m")
      .at_least(0)
      .at_most(5)
      .meaning(
          "so are upright runs of its pixels, such as shadows and reflections that lie on the "
          "ground; 0: none")
      .source("thesis 7.2, shape analysis");
  p.value("most_hole", &Options::most_hole)
      .at_least(0)
      .at_most(1)
      .meaning(
          "holes in pieces at least half as high as a body are filled when they are at most this "
          "share of a body's box; 0: none")
      .source("thesis 7.2, shape analysis");
  p.value("most_shadow_m", &Options::most_shadow_m)
      .unit("m")
      .at_least(0)
      .at_most(5)
      .meaning(
          "how far up from its lower end an upright run of foreground is dropped while it may be "
          "the ground in shadow, as high as that if it stood there; 0: nothing")
      .source("thesis 7.2, shape analysis; Horprasert et al. 1999");
  p.choice("background", &Options::background, {"people-free", "median"})
      .meaning(
          "frames that the background is learned from: all, as medians over time, or only "
          "those that the source marks as free of people");
  p.value("background_every", &Options::background_every)
      .unit("frames")
      .at_least(1)
      .meaning("learn from every n-th of them");
  p.value("background_first", &Options::background_first)
      .unit("frames")
      .at_least(1)
      .meaning("learn only from frames before this one; not set: from the whole recording");
  p.value("background_samples", &Options::background_samples)
      .unit("frames")
      .at_least(1)
      .at_most(4096)
      .meaning("most frames kept in memory while learning; of more, an even selection");
  p.value("follow_light", &Options::follow_light)
      .meaning(
          "whether every image is put into the background's light first: that of the whole view, "
          "which may change at once, and shadows or lamps that change it here and there, slowly");
  p.value("light_rate", &Options::light_rate)
      .unit("1/s")
      .at_least(0)
      .at_most(50)
      .meaning(
          "with \"follow_light\": by how much the logarithm of a pixel's value may follow the "
          "light at its place alone; larger values take slow people for shadows, 0 follows the "
          "light of "
          "the whole view only");
  p.value("settle_s", &Options::settle_s)
      .unit("s")
      .at_least(1)
      .at_most(3600)
      .meaning(
          "after which time foreground that keeps its place and colour is background: moved "
          "furniture and the place that it left, but also who stands still as long; unset: never");
  p.choice("device", &Options::device, {"cpu", "opencl"})
      .meaning(
          "what segments and counts in silhouettes: one core with its vector instructions, or "
          "OpenCV's OpenCL device; likelihoods of the same mask are equal bit by bit");
  Declaration<Options> d("color", "Foreground by colour, and how it fills silhouettes.");
  return d.source("thesis 5.4.1; Griesser et al. 2005")
      .input<FrameSet>("images of all views")
      .output<EvidenceSet>("foreground, counted along rows, with its Lab image")
      .output<ForegroundMask>("foreground of all views; empty where the view can't tell")
      .memory()
      .parameters(std::move(p));
}

}  // namespace plaza
