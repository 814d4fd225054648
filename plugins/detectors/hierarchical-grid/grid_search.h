#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "plaza/component/modality.h"
#include "plugins/detectors/hierarchical-grid/template_hierarchy.h"
#include "plugins/detectors/hierarchical-grid/view_trust.h"

namespace plaza {

/// The log-likelihood of what nothing could tell about.
inline constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// A modality with its weight in the sum of log-likelihoods.
struct Witness {
  std::shared_ptr<const Modality> modality;
  double weight = 1;
};

/// Likelihoods of one level's cells in one frame.
struct LevelLikelihood {
  /// [cell]: sum over the views and modalities that can tell, views times their trust; inherited
  /// from the parent where the cell itself was not evaluated; NaN where nothing can tell.
  std::vector<double> joint;
  std::vector<double> trust;               ///< [cell]: sum over the views that told; 0: none did
  std::vector<double> per_view;            ///< [cell]: joint over trust
  std::vector<char> evaluated;             ///< [cell]: 1 where the values are the cell's own
  std::vector<std::vector<double>> views;  ///< [camera][cell]: the cell's own; NaN elsewhere
  /// [camera][cell]: how much that view counts, where `views` is known.
  std::vector<std::vector<float>> view_trust;
};

/// Cells of a level that are looked at in each view: [camera].
using ViewCells = std::vector<std::vector<CellIndex>>;

/// Evidence of one frame: [witness][camera]; null where the view has none.
using AllEvidence = std::vector<std::vector<EvidencePtr>>;

/// Somebody on the finest level.
struct PlacedBody {
  CellIndex cell = 0;
  std::size_t size = 0;  ///< index of GridSearch::sizes()
};

/// What is left of a frame's evidence when some people are accounted for.
struct Remainder {
  AllEvidence evidence;
  std::vector<std::vector<Box>> hidden;  ///< [camera]: around whoever is accounted for there
};

struct SearchResult {
  std::vector<LevelLikelihood> levels;  ///< coarse to fine
  std::vector<double> baselines;        ///< [witness * cameras + camera]
  std::size_t evaluated = 0;            ///< cells, over all levels
  std::size_t exhaustive = 0;           ///< cells of the finest level that any view sees
};

/// The coarse-to-fine search of thesis 4.3.5.
///
/// A cell's joint log-likelihood is the sum over cameras and modalities (a product of likelihoods)
/// of weight * (log-likelihood - baseline). The baseline of a modality in a view is the median over
/// the coarsest cells that it can tell about in this frame, that is, what an empty place has. It
/// changes nothing between cells that the same views see, so with one view, or where all views see
/// all cells, this is the thesis's product. It makes the rest comparable: a view that can't tell
/// adds 0, what an empty place would have added, so that a cell gains nothing by being seen less.
///
/// The rule that decides where to go on compares per_view, the geometric mean of the views'
/// likelihoods, with its mean over the level. With one view that is the rule as it stands; with
/// several, means of products are means of the one best person, who would hide all the others.
class GridSearch {
 public:
  /// Samples every modality's templates, once for all frames. `refine_above`: cells of the next
  /// level are evaluated where the parent's likelihood exceeds the mean of its level so many times,
  /// or that of a parent at most `spread` cells beside it; 0: everywhere. Grid and hierarchy must
  /// outlive the search.
  GridSearch(const StateGrid& grid, const TemplateHierarchy& hierarchy, const ShapeModel& model,
             std::vector<Witness> witnesses, std::span<const Camera> cameras,
             const ViewTrust& trust, double refine_above, int spread);

  /// What a place is judged by: the smoothed log-likelihood over that of an empty place, per view
  /// that told, each counted by its trust. Sums grow with the views that look at a place whether
  /// they agree or not. NaN where none told. Thread-safe, as is all of the following.
  double score_of(CellIndex cell, double smoothed, const LevelLikelihood& level) const;
  SearchResult search(const AllEvidence& evidence) const;

  /// Layers of the finest level: bodies of the model's own size first.
  std::span<const TemplateLayer> sizes() const {
    return hierarchy_->layers().subspan(grid_->levels() - 1);
  }
  /// Evaluates cells of the finest level against other evidence, with bodies of sizes()[size], and
  /// writes their values, and nothing but theirs, to `finest`: of each view those of its own cells;
  /// what the other views have said of these cells before stays and counts.
  void judge(const Remainder& rest, std::span<const double> baselines, std::size_t size,
             const ViewCells& cells, LevelLikelihood& finest) const;
  /// Sums up anew what `finest` holds of these cells view by view.
  void join(std::span<const CellIndex> cells, LevelLikelihood& level) const;
  /// All of a frame's evidence.
  Remainder nobody(const AllEvidence& evidence) const {
    return {evidence, std::vector<std::vector<Box>>(cameras_)};
  }
  /// What these people leave of it.
  Remainder explain(Remainder rest, std::span<const PlacedBody> people) const;
  /// What these people leave of it to somebody in `cell`: in each view without those of them alone
  /// who could share evidence with that one there; with `nearer_only`, without those alone who also
  /// stand nearer to the camera, and could therefore hide that one.
  Remainder explain_to(CellIndex cell, Remainder rest, std::span<const PlacedBody> people,
                       bool nearer_only) const;
  /// Cells of the finest level whose people could share evidence with somebody in `cell`: their
  /// silhouettes' boxes, grown by an eighth of their heights, meet in that view.
  ViewCells touching(CellIndex cell) const;
  /// Whether they could in any view.
  bool touch(CellIndex a, CellIndex b) const;

 private:
  using Values = std::vector<double>;
  /// Matches each view's cells: [witness * cameras + camera][index in the view's list], NaN where
  /// unknown.
  std::vector<Values> evaluate(std::size_t layer, const ViewCells& wanted,
                               const AllEvidence& evidence) const;
  /// Writes to `level` what these values say of each view's cells, and joins those.
  void combine(std::size_t layer, const ViewCells& wanted, std::span<const Values> values,
               std::span<const double> baselines, std::span<const std::vector<Box>> hidden,
               LevelLikelihood& level) const;
  bool touch(std::size_t camera, CellIndex a, CellIndex b) const;
  double distance_m(std::size_t camera, CellIndex cell) const;  ///< on the ground
  /// `of_camera`: [camera], who is accounted for in that view.
  Remainder explain(Remainder rest, std::span<const std::vector<PlacedBody>> of_camera) const;
  std::vector<CellIndex> wanted_cells(std::size_t level, const LevelLikelihood* parents) const;

  const StateGrid* grid_;
  const TemplateHierarchy* hierarchy_;
  std::vector<Witness> witnesses_;
  std::size_t cameras_;
  ViewTrust trust_;
  double refine_above_;
  int spread_;
  /// [layer][witness * cameras + camera]
  std::vector<std::vector<std::unique_ptr<TemplateBatch>>> batches_;
  /// [layer][camera][cell]: index of the template in the batch; kUnseen: the view doesn't see it
  std::vector<std::vector<std::vector<std::uint32_t>>> template_of_cell_;
  /// [layer][camera][cell]: of the view; only where it sees the cell
  std::vector<std::vector<std::vector<float>>> cell_trust_;
  std::vector<std::vector<CellIndex>> seen_cells_;  ///< [level]: by any camera, rising
  /// [camera][cell of the finest level]: of the silhouette; empty where it isn't seen
  std::vector<std::vector<Box>> boxes_;
  std::vector<Eigen::Vector2d> centres_m_;  ///< [camera]: where it is, on the ground
};

}  // namespace plaza
