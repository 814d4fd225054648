#include "plugins/detectors/hierarchical-grid/scenario.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace plaza {
namespace {

// mean field: presence beyond these is certain, and the most uncertain others are summed over
constexpr double kCertain = 0.02;
constexpr std::size_t kMostUncertain = 3;
constexpr double kSettled = 0.01;  ///< a smaller change of presence changes nobody else

/// Who was taken for one are near the place between them: looking farther away than this finds
/// nobody else and takes the longer.
constexpr double kDoubtReachM = 1.5;

}  // namespace

JointSearch::Scenario::Scenario(const JointSearch& search, const AllEvidence& evidence,
                                const SearchResult& first)
    : s_(search),
      grid_(search.grid_->finest()),
      baselines_(first.baselines),
      whole_(search.search_->nobody(evidence)),
      rest_(whole_),
      now_(first.levels.back()),
      surface_(smoothed(grid_, now_.joint, search.neighbours_)),
      own_(grid_, *search.search_, search.neighbours_, search.priors_, evidence, first),
      watched_(surface_.size(), 1),
      moved_(now_.views.size(), std::vector<char>(surface_.size(), 0)) {
  if (!s_.options_.watch_score) return;
  for (std::size_t i = 0; i < surface_.size(); ++i) {
    const double score = s_.search_->score_of(static_cast<CellIndex>(i), surface_[i], now_);
    if (score < *s_.options_.watch_score) watched_[i] = 0;
  }
}

void JointSearch::Scenario::accept() {
  while (people_.size() < static_cast<std::size_t>(s_.options_.most)) {
    const std::optional<CellIndex> best = best_cell();
    if (!best) break;
    accept_at(*best);
  }
}

void JointSearch::Scenario::accept_at(CellIndex cell) {
  disturb(cell);
  people_.emplace_back().person.body.cell = cell;
  people_.back().presence = presence_at(s_.search_->score_of(cell, surface_[cell], now_));
  const PlacedBody body[] = {people_.back().person.body};
  rest_ = s_.search_->explain(rest_, body);
  // taking more away seldom makes a place likelier: what was nobody's before can wait
  refresh(s_.search_->touching(cell), s_.options_.watch_score);
}

bool JointSearch::Scenario::judge_again(bool may_change) {
  bool any = false;
  for (std::size_t k = 0; k < people_.size();) {
    if (!people_[k].stale) {
      ++k;
      continue;
    }
    people_[k].stale = false;
    const PlacedBody before = people_[k].person.body;
    const double present = people_[k].presence;
    const bool stays = place(k, may_change);
    if (s_.options_.mean_field == nullptr && may_change && !stays) {
      people_.erase(people_.begin() + static_cast<std::ptrdiff_t>(k));
      changed(before.cell);
      any = true;
      continue;
    }
    const PlacedBody after = people_[k].person.body;
    const double shift = std::abs(people_[k].presence - present);
    if (after.cell != before.cell || after.size != before.size || shift > kSettled) {
      changed(before.cell);
      changed(after.cell);
      people_[k].stale = false;
      any = true;
    }
    ++k;
  }
  return any;
}

void JointSearch::Scenario::take_away_again() {
  rest_ = s_.search_->explain(whole_, likely_others(people_.size()));
  ViewCells cells(moved_.size());
  for (std::size_t camera = 0; camera < moved_.size(); ++camera) {
    for (std::size_t i = 0; i < moved_[camera].size(); ++i) {
      if (moved_[camera][i] != 0) cells[camera].push_back(static_cast<CellIndex>(i));
    }
    std::fill(moved_[camera].begin(), moved_[camera].end(), 0);
  }
  refresh(std::move(cells), std::nullopt);
}

bool JointSearch::Scenario::settle() {
  accept();
  for (int round = 0; round < s_.options_.rounds; ++round) {
    if (!judge_again(true)) break;
    if (back_again()) return false;
    take_away_again();
    accept();
  }
  judge_again(false);
  return true;
}

bool JointSearch::Scenario::back_again() const {
  if (!left_out_ || people_.size() > left_out_->people) return false;
  return std::any_of(people_.begin(), people_.end(), [&](const Entry& entry) {
    return s_.near(entry.person.body.cell, left_out_->cell);
  });
}

std::vector<CellIndex> JointSearch::Scenario::weakest() const {
  if (!s_.options_.doubt_score) return {};
  std::vector<std::pair<double, CellIndex>> doubted;
  for (const Entry& entry : people_) {
    const FoundPerson& person = entry.person;
    if (person.score < *s_.options_.doubt_score)
      doubted.emplace_back(person.score, person.body.cell);
  }
  std::sort(doubted.begin(), doubted.end());
  std::vector<CellIndex> places;
  for (const auto& [score, cell] : doubted) {
    if (places.size() < static_cast<std::size_t>(s_.options_.doubt_people)) places.push_back(cell);
  }
  return places;
}

std::vector<CellIndex> JointSearch::Scenario::starts() const {
  std::vector<CellIndex> able;
  for (std::size_t i = 0; i < surface_.size(); ++i) {
    if (acceptable(static_cast<CellIndex>(i))) able.push_back(static_cast<CellIndex>(i));
  }
  std::stable_sort(able.begin(), able.end(),
                   [&](CellIndex a, CellIndex b) { return surface_[a] > surface_[b]; });
  std::vector<CellIndex> best;
  for (const CellIndex cell : able) {
    if (best.size() == static_cast<std::size_t>(s_.options_.doubt_starts)) break;
    if (std::none_of(best.begin(), best.end(), [&](CellIndex b) { return s_.near(b, cell); })) {
      best.push_back(cell);
    }
  }
  return best;
}

void JointSearch::Scenario::leave_out(CellIndex cell) {
  left_out_ = LeftOut{cell, people_.size()};
  std::erase_if(people_, [&](const Entry& e) { return e.person.body.cell == cell; });
  changed(cell);
  take_away_again();
}

double JointSearch::Scenario::worth() const {
  double sum = 0;
  for (const Entry& entry : people_) {
    const double more = entry.person.score - s_.options_.min_score;
    if (more > 0) sum += more;  // unknown scores are worth nothing
  }
  return sum;
}

std::vector<FoundPerson> JointSearch::Scenario::people() && {
  std::vector<FoundPerson> out;
  for (Entry& entry : people_) {
    if (entry.person.score >= s_.options_.min_score) out.push_back(std::move(entry.person));
  }
  std::stable_sort(out.begin(), out.end(),
                   [](const FoundPerson& a, const FoundPerson& b) { return a.score > b.score; });
  return out;
}

bool JointSearch::Scenario::blocked(CellIndex cell, std::size_t by_others_than) const {
  for (std::size_t i = 0; i < people_.size(); ++i) {
    if (i != by_others_than && s_.near(cell, people_[i].person.body.cell)) return true;
  }
  return false;
}

bool JointSearch::Scenario::considered(CellIndex cell) const {
  return !left_out_ || (s_.position(cell) - s_.position(left_out_->cell)).norm() < kDoubtReachM;
}

bool JointSearch::Scenario::acceptable(CellIndex cell) const {
  return considered(cell) && now_.evaluated[cell] != 0 && std::isfinite(surface_[cell]) &&
         s_.search_->score_of(cell, surface_[cell], now_) >= s_.options_.accept_score &&
         !blocked(cell, people_.size()) && !(left_out_ && s_.near(left_out_->cell, cell));
}

std::optional<CellIndex> JointSearch::Scenario::best_cell() const {
  std::optional<CellIndex> best;
  for (std::size_t i = 0; i < surface_.size(); ++i) {
    const auto cell = static_cast<CellIndex>(i);
    if (best && !(surface_[i] > surface_[*best])) continue;
    if (acceptable(cell)) best = cell;
  }
  return best;
}

void JointSearch::Scenario::refresh(ViewCells cells, std::optional<double> least_score) {
  std::vector<char> looked(surface_.size(), 0), todo = looked;
  std::vector<CellIndex> never;
  for (std::size_t camera = 0; camera < cells.size(); ++camera) {
    std::vector<CellIndex>& view = cells[camera];
    std::erase_if(view, [&](CellIndex cell) {
      if (watched_[cell] == 0) return true;
      const double score = s_.search_->score_of(cell, surface_[cell], now_);
      if (considered(cell) && !(least_score && score < *least_score)) return false;
      moved_[camera][cell] = 1;  // stale until everybody is taken away again
      return true;
    });
    for (const CellIndex cell : view) {
      if (looked[cell] != 0) continue;
      looked[cell] = 1;
      if (now_.evaluated[cell] == 0) never.push_back(cell);
      for (const CellIndex other : cells_of(grid_, cell, s_.neighbours_)) todo[other] = 1;
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

void JointSearch::Scenario::disturb(CellIndex cell) {
  for (Entry& entry : people_) {
    entry.stale = entry.stale || s_.search_->touch(cell, entry.person.body.cell);
  }
}

void JointSearch::Scenario::changed(CellIndex cell) {
  disturb(cell);
  const ViewCells touching = s_.search_->touching(cell);
  for (std::size_t camera = 0; camera < touching.size(); ++camera) {
    for (const CellIndex other : touching[camera]) moved_[camera][other] = 1;
  }
}

std::vector<PlacedBody> JointSearch::Scenario::likely_others(std::size_t k) const {
  std::vector<PlacedBody> bodies;
  for (std::size_t i = 0; i < people_.size(); ++i) {
    if (i != k && people_[i].presence >= 0.5) bodies.push_back(people_[i].person.body);
  }
  return bodies;
}

double JointSearch::Scenario::presence_at(double score) const {
  if (s_.options_.mean_field == nullptr) return 1;
  return std::isfinite(score) ? (*s_.options_.mean_field)(score) : 0;
}

double JointSearch::Scenario::expected_score(std::size_t k) {
  const PlacedBody body = people_[k].person.body;
  std::vector<PlacedBody> certain;
  std::vector<std::size_t> uncertain;
  for (std::size_t i = 0; i < people_.size(); ++i) {
    const Entry& other = people_[i];
    if (i == k || !s_.search_->touch(other.person.body.cell, body.cell)) continue;
    if (other.presence > kCertain && other.presence < 1 - kCertain) {
      uncertain.push_back(i);
    } else if (other.presence >= 0.5) {
      certain.push_back(other.person.body);
    }
  }
  std::stable_sort(uncertain.begin(), uncertain.end(), [&](std::size_t a, std::size_t b) {
    return std::abs(people_[a].presence - 0.5) < std::abs(people_[b].presence - 0.5);
  });
  while (uncertain.size() > kMostUncertain) {
    const Entry& other = people_[uncertain.back()];
    if (other.presence >= 0.5) certain.push_back(other.person.body);
    uncertain.pop_back();
  }
  double sum = 0, weights = 0;
  for (std::size_t state = 0; state < (std::size_t{1} << uncertain.size()); ++state) {
    std::vector<PlacedBody> present = certain;
    double weight = 1;
    for (std::size_t i = 0; i < uncertain.size(); ++i) {
      const Entry& other = people_[uncertain[i]];
      const bool there = (state >> i & 1U) != 0;
      weight *= there ? other.presence : 1 - other.presence;
      if (there) present.push_back(other.person.body);
    }
    own_.use(s_.search_->explain(whole_, present));
    const double score = own_.score(body);
    if (!std::isfinite(score)) continue;
    sum += weight * score;
    weights += weight;
  }
  return weights > 0 ? sum / weights : kUnknown;
}

bool JointSearch::Scenario::place(std::size_t k, bool may_move) {
  FoundPerson& person = people_[k].person;
  own_.use(
      s_.search_->explain_to(person.body.cell, whole_, likely_others(k), s_.options_.nearer_only));
  if (may_move) {
    person.body.cell = climb(person.body, k);
    const PlacedBody before = person.body;
    for (std::size_t size = 0; size < s_.priors_.size(); ++size) {
      if (own_.value({before.cell, size}) > own_.value(person.body)) person.body.size = size;
    }
    if (person.body.size != before.size) person.body.cell = climb(person.body, k);
  }
  person.score = own_.score(person.body);
  person.peak = own_.peak(person.body, s_.options_.max_sigma_m);
  person.views = own_.views(person.body);
  if (s_.options_.mean_field != nullptr) {
    person.score = expected_score(k);
    people_[k].presence = presence_at(person.score);
  }
  return person.score >= s_.options_.min_score;
}

CellIndex JointSearch::Scenario::climb(const PlacedBody& start, std::size_t k) {
  PlacedBody here = start;
  const double reach_m = s_.options_.reach_m;
  while (true) {
    PlacedBody best = here;
    const std::vector<CellIndex> ring = cells_of(grid_, here.cell, s_.ring_);
    own_.look_at(ring, here.size);
    for (const CellIndex cell : ring) {
      const PlacedBody next{cell, here.size};
      if (!(own_.value(next) > own_.value(best)) || blocked(cell, k)) continue;
      if ((s_.position(cell) - s_.position(start.cell)).norm() > reach_m) continue;
      best = next;
    }
    if (best.cell == here.cell) return here.cell;
    here = best;
  }
}

}  // namespace plaza
