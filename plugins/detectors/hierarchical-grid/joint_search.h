#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "plugins/detectors/common/probability_curve.h"
#include "plugins/detectors/hierarchical-grid/grid_search.h"
#include "plugins/detectors/hierarchical-grid/likelihood_surface.h"

namespace plaza {

/// Somebody in a cell of the finest level, judged by the evidence that nobody else accounts for.
struct FoundPerson {
  PlacedBody body;
  double score = 0;  ///< smoothed log-likelihood over that of an empty place, per view
  Peak peak;         ///< of the smoothed likelihood
  /// [camera]: log-likelihood over that of an empty place; NaN: unknown
  std::vector<double> views;
};

/// People inferred together: evidence that one accounts for can't feed another.
///
/// Greedily, whoever the remaining evidence speaks for most is accepted and what they account for
/// is taken away (Modality::explain), until nobody scores enough. Then everybody is judged again
/// by what all the others leave: moves to the best place within reach, or goes when that doesn't
/// score enough any more; then others may be accepted again. So for some rounds, or until nothing
/// changes.
///
/// Two who hide each other may have been taken for one between them, from where no step leads to
/// both. So those who score least in the end may be doubted: when more people than before are
/// accepted without one of them, and all together are worth more, it is those who stay. Whoever is
/// accepted first decides who else is left anything, so that is tried from several places.
///
/// In a mean field (as Fleuret et al., "Multicamera people tracking with a probabilistic occupancy
/// map", 2008), whoever is accepted is present with a probability only, which is that of the score
/// expected over the presence of all others, each by their own: so somebody wrongly accepted first
/// doesn't take away for good what others account for better.
class JointSearch {
 public:
  struct Options {
    double min_score = 0;
    double accept_score = 0;  ///< of whom is considered at all; at most min_score
    /// Places with less, by all the evidence, are nobody's, whoever is accounted for later; those
    /// with less by what is left aren't judged again before everybody has been placed again.
    std::optional<double> watch_score;
    /// Who scores less may be tried without; null: nobody is.
    std::optional<double> doubt_score;
    int doubt_people = 1;                          ///< how many, the weakest first
    int doubt_starts = 1;                          ///< from how many places, the best first
    const ProbabilityCurve* mean_field = nullptr;  ///< of presence, by score; null: greedily
    int most = 1;                                  ///< people
    int rounds = 0;                                ///< of judging again; 0: what is accepted stays
    double reach_m = 0;                            ///< how far somebody moves in a round
    double max_sigma_m = 1;
    bool nearer_only = false;  ///< whether only who is nearer to a camera hides somebody in it
    double size_sigma = 1;     ///< of a body's size relative to the model's own
  };
  /// `neighbours`: that the likelihood is smoothed over; `rivals`: cells so near to somebody are
  /// nobody else's. Everything must outlive the search.
  JointSearch(const StateGrid& grid, const GridSearch& search,
              std::span<const Neighbour> neighbours, std::span<const Neighbour> rivals,
              const Options& options);

  /// `first`: what search() gave for this evidence. Best first. Thread-safe.
  std::vector<FoundPerson> infer(const AllEvidence& evidence, const SearchResult& first) const;

 private:
  class Scenario;

  /// More people, who are worth more together, instead of one of the weakest; null: there are none.
  std::unique_ptr<Scenario> without_somebody(const Scenario& before) const;

  Eigen::Vector2d position(CellIndex cell) const;
  bool near(CellIndex a, CellIndex b) const;  ///< within the rivals' reach

  const StateGrid* grid_;
  const GridSearch* search_;
  std::span<const Neighbour> neighbours_, rivals_;
  std::vector<Neighbour> ring_;  ///< the cell itself and the eight around it
  std::vector<double> priors_;   ///< [size]: logarithm, 0 for the model's own
  Options options_;
};

}  // namespace plaza
