#include "plugins/detectors/hierarchical-grid/joint_search.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace plaza {
namespace {

/// Nothing known of any cell.
LevelLikelihood unknown_like(const LevelLikelihood& other) {
  LevelLikelihood out;
  out.joint.assign(other.joint.size(), kUnknown);
  out.per_view = out.joint;
  out.trust.assign(other.joint.size(), 0);
  out.evaluated.assign(other.evaluated.size(), 0);
  out.views.assign(other.views.size(), out.joint);
  return out;
}

}  // namespace

double score_of(CellIndex cell, double smoothed, const LevelLikelihood& level) {
  return smoothed / level.trust[cell];
}

/// One frame's people while they are inferred.
class JointSearch::Scenario {
 public:
  Scenario(const JointSearch& search, const AllEvidence& evidence, const SearchResult& first)
      : s_(search),
        grid_(search.grid_->finest()),
        evidence_(evidence),
        baselines_(first.baselines),
        rest_(evidence),
        now_(first.levels.back()),
        surface_(smoothed(grid_, now_.joint, search.neighbours_)),
        alone_(search.priors_.size(), unknown_like(now_)),
        known_(search.priors_.size(), std::vector<char>(surface_.size(), 0)),
        seen_alone_(first.levels.back()),
        moved_(now_.views.size(), std::vector<char>(surface_.size(), 0)) {}

  void accept() {
    while (people_.size() < static_cast<std::size_t>(s_.options_.most)) {
      const std::optional<CellIndex> best = best_cell();
      if (!best) break;
      disturb(*best);
      people_.emplace_back().person.body.cell = *best;
      const PlacedBody body[] = {people_.back().person.body};
      rest_ = s_.search_->explain(rest_, body);
      refresh(s_.search_->touching(*best));
    }
  }

  /// Whether anybody moved or went.
  bool judge_again(bool may_change) {
    bool any = false;
    for (std::size_t k = 0; k < people_.size();) {
      if (!people_[k].stale) {
        ++k;
        continue;
      }
      people_[k].stale = false;
      const PlacedBody before = people_[k].person.body;
      const bool stays = place(k, may_change);
      if (may_change && !stays) {
        people_.erase(people_.begin() + static_cast<std::ptrdiff_t>(k));
        changed(before.cell);
        any = true;
        continue;
      }
      const PlacedBody after = people_[k].person.body;
      if (after.cell != before.cell || after.size != before.size) {
        changed(before.cell);
        changed(after.cell);
        people_[k].stale = false;
        any = true;
      }
      ++k;
    }
    return any;
  }

  /// What is left when everybody has moved.
  void take_away_again() {
    rest_ = s_.search_->explain(evidence_, bodies_of_others(people_.size()));
    ViewCells cells(moved_.size());
    for (std::size_t camera = 0; camera < moved_.size(); ++camera) {
      for (std::size_t i = 0; i < moved_[camera].size(); ++i) {
        if (moved_[camera][i] != 0) cells[camera].push_back(static_cast<CellIndex>(i));
      }
      std::fill(moved_[camera].begin(), moved_[camera].end(), 0);
    }
    refresh(std::move(cells));
  }

  std::vector<FoundPerson> people() && {
    std::vector<FoundPerson> out;
    for (Entry& entry : people_) {
      if (entry.person.score >= s_.options_.min_score) out.push_back(std::move(entry.person));
    }
    std::stable_sort(out.begin(), out.end(),
                     [](const FoundPerson& a, const FoundPerson& b) { return a.score > b.score; });
    return out;
  }

 private:
  struct Entry {
    FoundPerson person;
    bool stale = true;  ///< somebody near has changed since this one was judged
  };

  bool blocked(CellIndex cell, std::size_t by_others_than) const {
    const int column = static_cast<int>(cell) % grid_.columns;
    const int row = static_cast<int>(cell) / grid_.columns;
    for (std::size_t i = 0; i < people_.size(); ++i) {
      if (i == by_others_than) continue;
      const int c = static_cast<int>(people_[i].person.body.cell) % grid_.columns - column;
      const int r = static_cast<int>(people_[i].person.body.cell) / grid_.columns - row;
      const bool near = std::any_of(s_.rivals_.begin(), s_.rivals_.end(), [&](const Neighbour& n) {
        return n.columns == c && n.rows == r;
      });
      if (near) return true;
    }
    return false;
  }

  std::optional<CellIndex> best_cell() const {
    std::optional<CellIndex> best;
    for (std::size_t i = 0; i < surface_.size(); ++i) {
      const auto cell = static_cast<CellIndex>(i);
      if (now_.evaluated[i] == 0 || !std::isfinite(surface_[i])) continue;
      if (best && !(surface_[i] > surface_[*best])) continue;
      if (!(score_of(cell, surface_[i], now_) >= s_.options_.min_score)) continue;
      if (blocked(cell, people_.size())) continue;
      best = cell;
    }
    return best;
  }

  /// Judges cells again by what is left, in views where that has changed; in all views where they
  /// were never judged.
  void refresh(ViewCells cells) {
    std::vector<char> looked(surface_.size(), 0), todo = looked;
    std::vector<CellIndex> never;
    for (const std::vector<CellIndex>& view : cells) {
      for (const CellIndex cell : view) {
        if (looked[cell] != 0) continue;
        looked[cell] = 1;
        if (now_.evaluated[cell] == 0) never.push_back(cell);
        for (const CellIndex other : s_.around(cell, s_.neighbours_)) todo[other] = 1;
      }
    }
    if (!never.empty()) {
      for (std::vector<CellIndex>& view : cells) {
        view.insert(view.end(), never.begin(), never.end());
        std::sort(view.begin(), view.end());
        view.erase(std::unique(view.begin(), view.end()), view.end());
      }
    }
    s_.search_->judge(rest_, baselines_, 0, cells, now_);
    for (std::size_t i = 0; i < todo.size(); ++i) {
      if (todo[i] == 0) continue;
      surface_[i] = smoothed_at(grid_, now_.joint, s_.neighbours_, static_cast<CellIndex>(i));
    }
  }

  /// Whoever could share evidence with somebody who came, moved or went there is to be judged
  /// again.
  void disturb(CellIndex cell) {
    for (Entry& entry : people_) {
      entry.stale = entry.stale || s_.search_->touch(cell, entry.person.body.cell);
    }
  }

  void changed(CellIndex cell) {
    disturb(cell);
    const ViewCells touching = s_.search_->touching(cell);
    for (std::size_t camera = 0; camera < touching.size(); ++camera) {
      for (const CellIndex other : touching[camera]) moved_[camera][other] = 1;
    }
  }

  std::vector<PlacedBody> bodies_of_others(std::size_t k) const {
    std::vector<PlacedBody> bodies;
    for (std::size_t i = 0; i < people_.size(); ++i) {
      if (i != k) bodies.push_back(people_[i].person.body);
    }
    return bodies;
  }

  /// Judges one by what all others leave; false when the best place doesn't score enough.
  bool place(std::size_t k, bool may_move) {
    FoundPerson& person = people_[k].person;
    std::vector<PlacedBody> others = bodies_of_others(k);
    std::erase_if(others, [&](const PlacedBody& other) {
      return !s_.search_->touch(other.cell, person.body.cell);
    });
    own_ = s_.search_->explain(
        evidence_, others,
        s_.options_.nearer_only ? std::optional(person.body.cell) : std::nullopt);
    if (may_move) {
      person.body.cell = climb(person.body, k);
      const PlacedBody before = person.body;
      for (std::size_t size = 0; size < s_.priors_.size(); ++size) {
        if (value({before.cell, size}) > value(person.body)) person.body.size = size;
      }
      if (person.body.size != before.size) person.body.cell = climb(person.body, k);
    }
    const double most = value(person.body);
    const LevelLikelihood& level = alone_[person.body.size];
    person.score = score_of(person.body.cell, most, level);  // NaN where nothing can tell
    const std::vector<CellIndex> ring = s_.around(person.body.cell, s_.ring_);
    look_at(ring, person.body.size);
    for (const CellIndex cell : ring) alone_surface_[cell] = value({cell, person.body.size});
    person.peak = peak_at(grid_, alone_surface_, person.body.cell, s_.options_.max_sigma_m);
    for (const CellIndex cell : ring) alone_surface_[cell] = kUnknown;
    person.views.clear();
    for (const std::vector<double>& view : level.views) {
      person.views.push_back(view[person.body.cell]);
    }
    forget();
    return person.score >= s_.options_.min_score;
  }

  /// The summit next to a body, uphill, at most options.reach_m away.
  CellIndex climb(const PlacedBody& start, std::size_t k) {
    PlacedBody here = start;
    const double reach_m = s_.options_.reach_m;
    while (true) {
      PlacedBody best = here;
      const std::vector<CellIndex> ring = s_.around(here.cell, s_.ring_);
      look_at(ring, here.size);
      for (const CellIndex cell : ring) {
        const PlacedBody next{cell, here.size};
        if (!(value(next) > value(best)) || blocked(cell, k)) continue;
        if ((s_.position(cell) - s_.position(start.cell)).norm() > reach_m) continue;
        best = next;
      }
      if (best.cell == here.cell) return here.cell;
      here = best;
    }
  }

  /// Of a place, by one's own evidence, smoothed, with the prior of the size; NaN: unknown.
  double value(const PlacedBody& body) {
    const CellIndex cell[] = {body.cell};
    look_at(cell, body.size);
    return smoothed_at(grid_, alone_[body.size].joint, s_.neighbours_, body.cell) +
           s_.priors_[body.size];
  }

  /// Judges what the values of these cells need and isn't known yet, all at once.
  void look_at(std::span<const CellIndex> cells, std::size_t size) {
    std::vector<CellIndex> missing;
    for (const CellIndex cell : cells) {
      for (const CellIndex other : s_.around(cell, s_.neighbours_)) {
        if (known_[size][other] == 0) missing.push_back(other);
        known_[size][other] = 1;
      }
    }
    if (missing.empty()) return;
    ViewCells unseen(evidence_.front().size());
    for (std::size_t camera = 0; camera < unseen.size(); ++camera) {
      const bool whole =
          std::equal(own_.begin(), own_.end(), evidence_.begin(),
                     [&](const auto& a, const auto& b) { return a[camera] == b[camera]; });
      for (const CellIndex cell : missing) {
        // where nobody else is in a view, the first search has seen all that there is
        if (whole && size == 0 && seen_alone_.evaluated[cell] != 0) {
          alone_[size].views[camera][cell] = seen_alone_.views[camera][cell];
        } else {
          unseen[camera].push_back(cell);
        }
      }
    }
    s_.search_->judge(own_, baselines_, size, unseen, alone_[size]);
    s_.search_->join(size, missing, alone_[size]);
    for (const CellIndex cell : missing) looked_at_.push_back({cell, size});
  }

  void forget() {
    for (const PlacedBody& body : looked_at_) {
      known_[body.size][body.cell] = 0;
      alone_[body.size].joint[body.cell] = kUnknown;
      for (std::vector<double>& view : alone_[body.size].views) view[body.cell] = kUnknown;
    }
    looked_at_.clear();
  }

  const JointSearch& s_;
  const GroundGrid& grid_;
  const AllEvidence& evidence_;
  std::span<const double> baselines_;
  AllEvidence rest_;                      ///< what nobody accounts for
  LevelLikelihood now_;                   ///< by the rest
  std::vector<double> surface_;           ///< now_, smoothed
  AllEvidence own_;                       ///< of who is being placed: what the others leave
  std::vector<LevelLikelihood> alone_;    ///< [size]: by own_, where known_
  std::vector<std::vector<char>> known_;  ///< [size][cell]
  std::vector<PlacedBody> looked_at_;     ///< where known_
  std::vector<double> alone_surface_ = alone_.front().joint;
  std::vector<Entry> people_;
  const LevelLikelihood& seen_alone_;     ///< by all of the evidence
  std::vector<std::vector<char>> moved_;  ///< [camera][cell]: whether a move has touched it
};

JointSearch::JointSearch(const StateGrid& grid, const GridSearch& search,
                         std::span<const Neighbour> neighbours, std::span<const Neighbour> rivals,
                         const Options& options)
    : grid_(&grid),
      search_(&search),
      neighbours_(neighbours),
      rivals_(rivals),
      ring_(cells_around(grid.finest(), 0)),
      options_(options) {
  for (const TemplateLayer& size : search.sizes()) {
    const double z = (size.scale - 1) / options.size_sigma;
    priors_.push_back(-0.5 * z * z);
  }
}

Eigen::Vector2d JointSearch::position(CellIndex cell) const {
  return grid_->position(grid_->levels() - 1, cell);
}

std::vector<CellIndex> JointSearch::around(CellIndex cell, std::span<const Neighbour> which) const {
  const GroundGrid& grid = grid_->finest();
  const int column = static_cast<int>(cell) % grid.columns;
  const int row = static_cast<int>(cell) / grid.columns;
  std::vector<CellIndex> cells;
  for (const Neighbour& n : which) {
    const int c = column + n.columns, r = row + n.rows;
    if (c < 0 || r < 0 || c >= grid.columns || r >= grid.rows) continue;
    cells.push_back(static_cast<CellIndex>(r * grid.columns + c));
  }
  return cells;
}

std::vector<FoundPerson> JointSearch::infer(const AllEvidence& evidence,
                                            const SearchResult& first) const {
  Scenario scenario(*this, evidence, first);
  scenario.accept();
  for (int round = 0; round < options_.rounds; ++round) {
    const bool moved = scenario.judge_again(true);
    if (!moved) break;
    scenario.take_away_again();
    scenario.accept();
  }
  scenario.judge_again(false);
  return std::move(scenario).people();
}

}  // namespace plaza
