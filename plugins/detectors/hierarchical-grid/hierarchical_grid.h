#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "plaza/component/declaration.h"
#include "plaza/component/learner.h"
#include "plugins/detectors/common/probability_curve.h"
#include "plugins/detectors/hierarchical-grid/joint_search.h"
#include "plugins/detectors/hierarchical-grid/likelihood_surface.h"

namespace plaza {

/// The detector of thesis chapter 4: a person stands at every cell of a ground grid in turn, the
/// silhouettes are compared with what modalities saw in all views, coarse to fine, and the local
/// maxima of the smoothed likelihood are people. docs/detection.md tells it with pictures.
///
/// What it learns before the stream is the template hierarchy, which needs no frames.
class HierarchicalGrid final : public Detector, private Learner {
 public:
  enum class Inference { kIndependent, kGreedy, kMeanField };
  enum class Maxima { kLocal, kAll };
  struct Options {
    int cells = 80;
    int levels = 3;
    int branching = 2;
    double margin_m = 1.5;
    double min_inside = 0.3;
    bool occluders = true;
    bool visible_share = false;
    double sharp_px = 0;
    double edge_loss = 0;
    double hidden_loss = 0;
    double empty_views = 0;
    double refine_above = 1;
    int spread = 1;
    double smoothing_m = 0.22;
    std::optional<double> separation_m;
    Inference inference = Inference::kIndependent;
    std::optional<double> accept_score;
    std::optional<double> watch_score;
    std::optional<double> doubt_score;
    int doubt_people = 2;
    int doubt_starts = 3;
    int rounds = 3;
    double reach_m = 0.5;
    bool occlusion_order = false;
    std::vector<double> sizes;
    double size_sigma = 0.05;
    Maxima maxima = Maxima::kLocal;
    double min_score = 1.5;
    int most = 100;
    double max_sigma_m = 0.5;
    double covariance_scale = 1;
    std::vector<std::vector<double>> probability = {
        {0, 0.02}, {1, 0.3}, {2, 0.7}, {3, 0.9}, {4, 0.97}};
  };
  static Declaration<Options> declare();
  HierarchicalGrid(const Options& options, const BuildContext& context);

  Learner* learner() override { return this; }

  /// The search alone, for tests and benchmarks. The templates must be there.
  SearchResult search(const NodeIo& io) const { return searched(evidence_of(io)); }
  const StateGrid& grid() const { return grid_; }

 private:
  Observations do_detect(const NodeIo& io) const override;
  Detected do_detect_all(const NodeIo& io) const override;

  std::optional<LearningPlan> do_plan() const override { return std::nullopt; }
  void do_learn(const FrameSet& /*frames*/) override {}
  void do_finish(std::int64_t seen) override;
  void do_save(std::ostream& out) const override;
  void do_load(std::istream& in) override;
  /// Silhouettes of a few cells: another version of the shape model is another hierarchy.
  std::string do_extra_key() const override;

  void sample();
  AllEvidence evidence_of(const NodeIo& io) const;
  SearchResult searched(const AllEvidence& evidence) const;
  std::vector<FoundPerson> independently(const LevelLikelihood& finest) const;
  Observation observation_of(const FoundPerson& person) const;

  Options options_;
  std::shared_ptr<const Scene> scene_;
  std::shared_ptr<const ShapeModel> shape_;
  std::vector<Witness> witnesses_;
  std::vector<std::size_t> slots_;  ///< of the witnesses' evidence
  ProbabilityCurve curve_;
  StateGrid grid_;
  std::vector<Neighbour> neighbours_;  ///< that the likelihood is smoothed over
  std::vector<Neighbour> rivals_;      ///< that a maximum must exceed
  TemplateHierarchy hierarchy_;
  std::unique_ptr<const GridSearch> search_;  ///< null until the templates are there
  std::unique_ptr<const JointSearch> joint_;  ///< null unless people are inferred together
};

}  // namespace plaza
