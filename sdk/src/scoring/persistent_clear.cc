#include "plaza/scoring/persistent_clear.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "plaza/math/assignment.h"

namespace plaza {
namespace {

constexpr int kNobody = -1;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::size_t at(int index) { return static_cast<std::size_t>(index); }

std::optional<double> ratio(std::int64_t numerator, std::int64_t denominator) {
  if (denominator == 0) return std::nullopt;
  return static_cast<double>(numerator) / static_cast<double>(denominator);
}

struct TrueHistory {
  int partner = kNobody;  // the result identity matched last
  std::int64_t present = 0;
  std::int64_t matched = 0;
  bool missed_since_match = false;
};

struct ResultHistory {
  int partner = kNobody;  // of the last match that was not a mere continuation
  bool matched = false;
};

class PersistentAccumulator {
 public:
  explicit PersistentAccumulator(const PairedSequence& sequence)
      : truths_(at(sequence.truth_identities)), results_(at(sequence.result_identities)) {}

  void add(const PairedFrame& frame) {
    ++scores_.frames;
    scores_.objects += static_cast<std::int64_t>(frame.truth.size());
    scores_.predictions += static_cast<std::int64_t>(frame.result.size());
    Eigen::MatrixXd distance = frame.values;
    std::vector<bool> truth_taken(frame.truth.size(), false);
    std::vector<bool> result_taken(frame.result.size(), false);
    const auto take = [&](std::size_t i, std::size_t j) {
      truth_taken[i] = true;
      result_taken[j] = true;
      scores_.distance_sum +=
          frame.values(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
      results_[at(frame.result[j])].matched = true;
      TrueHistory& truth = truths_[at(frame.truth[i])];
      truth.partner = frame.result[j];
      if (truth.missed_since_match && truth.matched > 0) ++scores_.fragments;
      truth.missed_since_match = false;
      ++truth.matched;
    };

    continue_tracks(frame, result_taken, take);
    for (std::size_t i = 0; i < truth_taken.size(); ++i) {
      if (truth_taken[i]) distance.row(static_cast<Eigen::Index>(i)).setConstant(kInfinity);
    }
    for (std::size_t j = 0; j < result_taken.size(); ++j) {
      if (result_taken[j]) distance.col(static_cast<Eigen::Index>(j)).setConstant(kInfinity);
    }
    // Solved at full size: rows without a pair take part in the order of the solution.
    const std::vector<int> assigned = assign_minimum_cost(distance);
    for (std::size_t i = 0; i < assigned.size(); ++i) {
      if (assigned[i] < 0) continue;
      record_new_pair(frame.truth[i], frame.result[at(assigned[i])]);
      take(i, at(assigned[i]));
    }

    for (std::size_t i = 0; i < frame.truth.size(); ++i) {
      TrueHistory& truth = truths_[at(frame.truth[i])];
      ++truth.present;
      if (truth_taken[i]) continue;
      ++scores_.misses;
      truth.missed_since_match = true;
    }
    scores_.false_positives += std::count(result_taken.begin(), result_taken.end(), false);
  }

  PersistentClearScores finish() {
    scores_.unique_objects = static_cast<std::int64_t>(truths_.size());
    for (const TrueHistory& truth : truths_) {
      const double share = static_cast<double>(truth.matched) / static_cast<double>(truth.present);
      if (share >= 0.8) {
        ++scores_.mostly_tracked;
      } else if (share >= 0.2) {
        ++scores_.partly_tracked;
      } else {
        ++scores_.mostly_lost;
      }
    }
    return scores_;
  }

 private:
  template <class Take>
  void continue_tracks(const PairedFrame& frame, const std::vector<bool>& result_taken,
                       const Take& take) {
    for (std::size_t i = 0; i < frame.truth.size(); ++i) {
      const int partner = truths_[at(frame.truth[i])].partner;
      if (partner == kNobody) continue;
      const auto found = std::find(frame.result.begin(), frame.result.end(), partner);
      if (found == frame.result.end()) continue;
      const auto j = static_cast<std::size_t>(found - frame.result.begin());
      if (result_taken[j]) continue;
      if (!std::isfinite(frame.values(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j))))
        continue;
      take(i, j);
      ++scores_.matches;
    }
  }

  void record_new_pair(int truth_id, int result_id) {
    const TrueHistory& truth = truths_[at(truth_id)];
    ResultHistory& result = results_[at(result_id)];
    if (truth.partner != kNobody && truth.partner != result_id) {
      ++scores_.switches;
      if (!result.matched) ++scores_.ascends;
    } else {
      ++scores_.matches;
    }
    if (result.partner != kNobody && result.partner != truth_id) {
      ++scores_.transfers;
      if (truth.matched == 0) ++scores_.migrates;
    }
    result.partner = truth_id;
  }

  std::vector<TrueHistory> truths_;
  std::vector<ResultHistory> results_;
  PersistentClearScores scores_;
};

}  // namespace

std::optional<double> PersistentClearScores::mota() const {
  const auto errors = ratio(misses + switches + false_positives, objects);
  if (!errors) return std::nullopt;
  return 1 - *errors;
}
std::optional<double> PersistentClearScores::moda() const {
  const auto errors = ratio(misses + false_positives, objects);
  if (!errors) return std::nullopt;
  return 1 - *errors;
}
std::optional<double> PersistentClearScores::mean_distance() const {
  if (detections() == 0) return std::nullopt;
  return distance_sum / static_cast<double>(detections());
}
std::optional<double> PersistentClearScores::recall() const { return ratio(detections(), objects); }
std::optional<double> PersistentClearScores::precision() const {
  return ratio(detections(), false_positives + detections());
}

PersistentClearScores score_persistent_clear(const PairedSequence& distance) {
  PersistentAccumulator accumulator(distance);
  for (const PairedFrame& frame : distance.frames) accumulator.add(frame);
  return accumulator.finish();
}

}  // namespace plaza
