#pragma once

#include <span>
#include <vector>

#include "plugins/detectors/hierarchical-grid/grid_search.h"
#include "plugins/detectors/hierarchical-grid/likelihood_surface.h"

namespace plaza {

/// What places are worth to one person: by their own evidence, which is what others leave of the
/// frame's, smoothed on the ground, with the prior of the body's size. Places are judged when they
/// are asked for, and remembered until the evidence changes.
class OwnLikelihood {
 public:
  /// `priors`: [size], logarithms. `whole` is the evidence with nobody taken away, and `first` what
  /// the search found by it. Everything must outlive this.
  OwnLikelihood(const GroundGrid& grid, const GridSearch& search,
                std::span<const Neighbour> neighbours, std::span<const double> priors,
                const AllEvidence& whole, const SearchResult& first);

  /// The next one's turn.
  void use(Remainder rest);

  /// Judges what these places need and isn't known yet, all at once; which is faster than one by
  /// one, and no more.
  void look_at(std::span<const CellIndex> cells, std::size_t size);
  /// Smoothed log-likelihood with the prior; NaN: unknown.
  double value(const PlacedBody& body);
  double score(const PlacedBody& body);  ///< see score_of()
  Peak peak(const PlacedBody& body, double max_sigma_m);
  /// [camera]: log-likelihood over that of an empty place; NaN: unknown.
  std::vector<double> views(const PlacedBody& body);

 private:
  const GroundGrid* grid_;
  const GridSearch* search_;
  std::span<const Neighbour> neighbours_;
  std::span<const double> priors_;
  const AllEvidence* whole_;
  const SearchResult* first_;
  std::vector<Neighbour> ring_;  ///< a cell itself and the eight around it
  Remainder own_;
  std::vector<LevelLikelihood> known_values_;  ///< [size], where known_
  std::vector<std::vector<char>> known_;       ///< [size][cell]
  std::vector<PlacedBody> looked_at_;          ///< where known_
  std::vector<double> surface_;                ///< of the ring of one place; NaN between calls
};

}  // namespace plaza
