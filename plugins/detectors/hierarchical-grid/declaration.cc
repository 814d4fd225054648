#include "plugins/detectors/hierarchical-grid/hierarchical_grid.h"

namespace plaza {
namespace {

ParameterSpec weight_field() {
  struct Fields {
    double weight = 1;
  };
  Parameters<Fields> p;
  p.value("weight", &Fields::weight)
      .above(0)
      .meaning("factor of this modality's log-likelihood in the sum");
  return p.specs().front();
}

}  // namespace

Declaration<HierarchicalGrid::Options> HierarchicalGrid::declare() {
  Parameters<Options> p;
  p.input_list("modalities", std::string(EvidenceSet::kPort), {weight_field()})
      .meaning("what is measured in images, in sum: \"from\" names a modality's node");
  p.part("shape", "shape", "cylinder").meaning("what is looked for");
  p.value("cells", &Options::cells)
      .at_least(1)
      .at_most(1024)
      .meaning("cells of the finest level along each axis of the searched area")
      .source("thesis Table 4.1");
  p.value("levels", &Options::levels)
      .at_least(1)
      .at_most(8)
      .meaning("levels of the grid; 1: every cell is evaluated")
      .source("thesis 4.3.1");
  p.value("branching", &Options::branching)
      .at_least(2)
      .at_most(8)
      .meaning("into how many cells per axis a cell of one level is split on the next")
      .source("thesis Figure 4.2");
  p.value("margin_m", &Options::margin_m)
      .unit("m")
      .at_least(0)
      .at_most(100)
      .meaning(
          "how far beyond the scene's area is searched; people found there are cut afterwards");
  p.value("min_inside", &Options::min_inside)
      .at_least(0)
      .at_most(1)
      .meaning("a view tells about a cell when so much of the silhouette's area is in its image");
  p.value("occluders", &Options::occluders)
      .meaning(
          "whether silhouettes lack what the scene's occluders hide; else hidden parts count "
          "as parts that nobody sees a person in");
  p.value("visible_share", &Options::visible_share)
      .meaning(
          "whether a view counts by the share of the silhouette that is in its image and not "
          "hidden; else all views that tell count alike");
  p.value("sharp_px", &Options::sharp_px)
      .unit("px")
      .at_least(0)
      .at_most(10000)
      .meaning(
          "views in which a body is less high than that count proportionally less; 0: far or "
          "near is all the same");
  p.value("edge_loss", &Options::edge_loss)
      .at_least(0)
      .at_most(1)
      .meaning(
          "how much less a view counts in its image's corners, where lenses are least sharp, "
          "growing with the squared distance from the middle; 0: as much as anywhere");
  p.value("hidden_loss", &Options::hidden_loss)
      .at_least(0)
      .at_most(1)
      .meaning(
          "joint inference: how much less a view counts in which people who are accounted for hide "
          "somebody wholly; in proportion to the share that they hide; 0: as much as any other");
  p.value("empty_views", &Options::empty_views)
      .at_least(0)
      .at_most(100)
      .meaning(
          "so many views count as having seen an empty place, beside those that tell: what a "
          "single view has seen is worth less than what several agree on");
  p.value("refine_above", &Options::refine_above)
      .at_least(0)
      .meaning(
          "cells are split where the likelihood exceeds the mean of their level so many "
          "times; 0: everywhere")
      .source("thesis 4.3.5");
  p.value("spread", &Options::spread)
      .at_least(0)
      .at_most(100)
      .meaning(
          "so many cells around one that is split are split too, since a summit on the border "
          "of what was evaluated is no summit; 0: the thesis's rule alone");
  p.value("smoothing_m", &Options::smoothing_m)
      .unit("m")
      .at_least(0)
      .at_most(10)
      .meaning("standard deviation of the Gaussian on the ground")
      .source("thesis (4.4), (4.5)");
  p.value("separation_m", &Options::separation_m)
      .unit("m")
      .at_least(0)
      .at_most(30)
      .meaning(
          "a maximum exceeds all cells so near to it, the eight around in any case; unset: the "
          "smoothing's gate, 3 sigma")
      .source("thesis 4.3.6: within the same neighbourhood");
  p.choice("inference", &Options::inference, {"independent", "greedy", "mean-field"})
      .meaning(
          "independent: each local maximum by itself; greedy: one after the other, whoever the "
          "evidence speaks for most first, by what the others don't account for; mean-field: the "
          "same, but each present only with the probability of the score that is expected over the "
          "presence of the others")
      .source("mean-field: Fleuret et al. 2008");
  p.value("accept_score", &Options::accept_score)
      .meaning(
          "mean-field inference: who has that score, by what the likelier ones leave, is "
          "considered; unset: half of min_score");
  p.value("watch_score", &Options::watch_score)
      .meaning(
          "joint inference: places with less score while nobody is accounted for are not judged "
          "again as people are accepted, nor those that have less left until everybody has been "
          "placed again, which saves most of the time; unset: all are");
  p.value("doubt_score", &Options::doubt_score)
      .meaning(
          "joint inference: when the weakest scores less in the end, all is tried without; if more "
          "people are found then, and all together score better, it is they who stay: two who hide "
          "each other are easily taken for one between them; unset: nobody is doubted");
  p.value("doubt_people", &Options::doubt_people)
      .at_least(1)
      .at_most(100)
      .meaning("with doubt_score: how many are tried without, one by one, the weakest first");
  p.value("doubt_starts", &Options::doubt_starts)
      .at_least(1)
      .at_most(100)
      .meaning(
          "with doubt_score: from how many places all is tried, the best first: whoever is found "
          "first decides who else is left any evidence");
  p.value("rounds", &Options::rounds)
      .at_least(0)
      .at_most(100)
      .meaning(
          "joint inference: how often everybody is placed and judged again by what all others "
          "leave");
  p.value("reach_m", &Options::reach_m)
      .unit("m")
      .at_least(0)
      .at_most(10)
      .meaning("joint inference: how far somebody moves in a round");
  p.value("occlusion_order", &Options::occlusion_order)
      .meaning(
          "joint inference: whether somebody who is judged again loses in each view only what who "
          "stands nearer to the camera accounts for, since nobody else can hide them; else what "
          "anybody else does");
  p.value("sizes", &Options::sizes)
      .at_least(0.2)
      .at_most(5)
      .meaning(
          "joint inference: sizes of bodies that are tried beside the shape model's own, "
          "relative to it; none: everybody has that");
  p.value("size_sigma", &Options::size_sigma)
      .above(0)
      .at_most(10)
      .meaning("standard deviation of people's sizes, relative to the shape model's own")
      .source("5 % of the height, as among adults");
  p.choice("maxima", &Options::maxima, {"local", "all"})
      .meaning(
          "local: an observation at each local maximum; all: at each evaluated cell, for "
          "trackers that work on cells")
      .source("thesis 4.3.6, 6.4");
  p.value("min_score", &Options::min_score)
      .meaning(
          "lowest score: smoothed log-likelihood over that of an empty place, mean of the "
          "views that tell");
  p.value("most", &Options::most).at_least(1).meaning("so many of the best observations stay");
  p.value("max_sigma_m", &Options::max_sigma_m)
      .unit("m")
      .above(0)
      .meaning("largest standard deviation that is read from the likelihood's curvature");
  p.value("covariance_scale", &Options::covariance_scale)
      .above(0)
      .at_most(1000)
      .meaning(
          "factor on the covariance of positions: the curvature takes modalities for as informed "
          "as "
          "they say, which is more or less than they are; what the evaluator reliability calls "
          "variance ratio, measured with 1, is what it should be");
  p.value("probability", &Options::probability)
      .meaning("calibration of scores: [score, probability] points, linear between, flat beyond");
  Declaration<Options> d("hierarchical-grid",
                         "Finds people by comparing silhouettes on a ground grid, coarse to fine.");
  return d.source("thesis chapter 4")
      .output<Observations>("people on the ground, with a box in every view that told")
      .output<GroundLikelihood>("the finest level's log-likelihoods, before smoothing")
      .parameters(std::move(p));
}

}  // namespace plaza
