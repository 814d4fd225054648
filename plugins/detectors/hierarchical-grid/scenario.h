#pragma once

#include <optional>
#include <span>
#include <vector>

#include "plugins/detectors/hierarchical-grid/joint_search.h"
#include "plugins/detectors/hierarchical-grid/own_likelihood.h"

namespace plaza {

/// One frame's people while they are inferred.
class JointSearch::Scenario {
 public:
  Scenario(const JointSearch& search, const AllEvidence& evidence, const SearchResult& first);

  void accept();

  /// Whoever stands there, as the next one.
  void accept_at(CellIndex cell);

  /// Whether anybody moved or went.
  bool judge_again(bool may_change);

  /// What is left when everybody has moved.
  void take_away_again();

  /// Accepts, places and judges until nothing changes or all rounds are over. False when it was
  /// given up, as who was left out is back again with no more people than before.
  bool settle();

  std::size_t size() const { return people_.size(); }

  /// Where those stand who score less than `doubt_score`, the weakest first, `doubt_people` at
  /// most.
  std::vector<CellIndex> weakest() const;

  /// Where the next one could be accepted, best first, `doubt_starts` at most and none near
  /// another.
  std::vector<CellIndex> starts() const;

  /// Takes out who stands there. Nobody is accepted at that place any more, nor far away from it.
  void leave_out(CellIndex cell);

  /// Of all people together: what they score above what each of them has to, so that more and
  /// weaker people aren't worth more just for being more.
  double worth() const;

  std::vector<FoundPerson> people() &&;

 private:
  struct Entry {
    FoundPerson person;
    double presence = 1;  ///< probability
    bool stale = true;    ///< somebody near has changed since this one was judged
  };

  struct LeftOut {
    CellIndex cell = 0;
    std::size_t people = 0;  ///< how many there were before
  };

  /// Whether somebody has moved to where somebody was left out, and nobody else was found: what
  /// follows is what was before.
  bool back_again() const;

  bool blocked(CellIndex cell, std::size_t by_others_than) const;

  /// Whether people are looked for there: anywhere, until somebody is left out.
  bool considered(CellIndex cell) const;

  /// Whether somebody else could be accepted there.
  bool acceptable(CellIndex cell) const;

  std::optional<CellIndex> best_cell() const;

  /// Judges cells again by what is left, in views where that has changed; in all views where they
  /// were never judged. Those that score less already wait until everybody is taken away again.
  void refresh(ViewCells cells, std::optional<double> least_score);

  /// Whoever could share evidence with somebody who came, moved or went there is to be judged
  /// again.
  void disturb(CellIndex cell);

  void changed(CellIndex cell);

  std::vector<PlacedBody> likely_others(std::size_t k) const;

  /// Unknown scores are those of people whom the others hide wholly: nothing speaks for them.
  double presence_at(double score) const;

  /// The score of a placed body over the presence of those uncertain others who touch it, each
  /// present by their own probability; NaN where it is unknown whoever is present.
  double expected_score(std::size_t k);

  /// Judges one by what all others leave; false when the best place doesn't score enough.
  bool place(std::size_t k, bool may_move);

  /// The summit next to a body, uphill, at most options.reach_m away.
  CellIndex climb(const PlacedBody& start, std::size_t k);

  const JointSearch& s_;
  const GroundGrid& grid_;
  std::span<const double> baselines_;
  const Remainder whole_;
  Remainder rest_;               ///< what nobody accounts for
  LevelLikelihood now_;          ///< by the rest
  std::vector<double> surface_;  ///< now_, smoothed
  OwnLikelihood own_;            ///< of who is being placed, by what the others leave
  std::vector<Entry> people_;
  std::optional<LeftOut> left_out_;       ///< nobody is accepted at this place, nor far from it
  std::vector<char> watched_;             ///< [cell]: whether it is judged again
  std::vector<std::vector<char>> moved_;  ///< [camera][cell]: whether it is to be judged again
};

}  // namespace plaza
