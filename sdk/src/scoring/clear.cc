#include "plaza/scoring/clear.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "plaza/math/assignment.h"
#include "rounding.h"

namespace plaza {
namespace {

constexpr double kContinuationBonus = 1000;
constexpr int kNobody = -1;

double ratio_to_count(double numerator, std::int64_t denominator) {
  return denominator > 0 ? numerator / static_cast<double>(denominator) : 0.0;
}

std::size_t slot(int index) { return static_cast<std::size_t>(index); }

/// What one true identity has gone through.
struct History {
  int last = kNobody;      // matched last, however long ago
  int previous = kNobody;  // matched in the previous processed frame
  std::int64_t starts = 0;
};

class ClearAccumulator {
 public:
  ClearAccumulator(const PairedSequence& sequence, double threshold)
      : threshold_(threshold), histories_(slot(sequence.truth_identities)) {
    scores_.present.resize(histories_.size());
    scores_.matched.resize(histories_.size());
  }

  void add(const PairedFrame& frame) {
    const std::size_t before = static_cast<std::size_t>(scores_.tp);
    for (const int truth : frame.truth) ++scores_.present[slot(truth)];
    if (!frame.truth.empty() && !frame.result.empty()) match(frame);
    const auto matches = scores_.tp - static_cast<std::int64_t>(before);
    scores_.fn += static_cast<std::int64_t>(frame.truth.size()) - matches;
    scores_.fp += static_cast<std::int64_t>(frame.result.size()) - matches;
  }

  ClearScores finish() {
    for (std::size_t truth = 0; truth < histories_.size(); ++truth) {
      if (histories_[truth].starts > 0) scores_.fragments += histories_[truth].starts - 1;
      const double share =
          static_cast<double>(scores_.matched[truth]) / static_cast<double>(scores_.present[truth]);
      if (share > 0.8) {
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
  void match(const PairedFrame& frame) {
    Eigen::MatrixXd score(frame.values.rows(), frame.values.cols());
    for (Eigen::Index j = 0; j < score.cols(); ++j) {
      for (Eigen::Index i = 0; i < score.rows(); ++i) {
        const double similarity = frame.values(i, j);
        const bool continues =
            histories_[slot(frame.truth[static_cast<std::size_t>(i)])].previous ==
            frame.result[static_cast<std::size_t>(j)];
        score(i, j) = similarity < threshold_ - kEpsilon
                          ? 0.0
                          : (continues ? kContinuationBonus : 0.0) + similarity;
      }
    }
    const std::vector<int> assigned = assign_maximum_weight(score);

    std::vector<int> matched(histories_.size(), kNobody);
    double sum = 0;
    std::int64_t matches = 0;
    for (std::size_t i = 0; i < assigned.size(); ++i) {
      const int j = assigned[i];
      if (j < 0 || !(score(static_cast<Eigen::Index>(i), j) > kEpsilon)) continue;
      const int truth = frame.truth[i];
      const int result = frame.result[slot(j)];
      History& history = histories_[slot(truth)];
      if (history.last != kNobody && history.last != result) ++scores_.id_switches;
      if (history.previous == kNobody) ++history.starts;
      history.last = result;
      matched[slot(truth)] = result;
      ++scores_.matched[slot(truth)];
      ++matches;
      sum += frame.values(static_cast<Eigen::Index>(i), j);
    }
    for (std::size_t truth = 0; truth < histories_.size(); ++truth) {
      histories_[truth].previous = matched[truth];
    }
    if (matches == 0) return;
    scores_.tp += matches;
    scores_.similarity_sum += sum;
    scores_.frame_similarity.push_back(sum / static_cast<double>(matches));
  }

  double threshold_;
  std::vector<History> histories_;
  ClearScores scores_;
};

}  // namespace

double ClearScores::mota() const {
  return ratio_to_count(static_cast<double>(tp - fp - id_switches), tp + fn);
}
double ClearScores::motp() const { return ratio_to_count(similarity_sum, tp); }
double ClearScores::moda() const { return ratio_to_count(static_cast<double>(tp - fp), tp + fn); }
double ClearScores::recall() const { return ratio_to_count(static_cast<double>(tp), tp + fn); }
double ClearScores::precision() const { return ratio_to_count(static_cast<double>(tp), tp + fp); }
double ClearScores::f1() const {
  return static_cast<double>(tp) /
         std::max(1.0, static_cast<double>(tp) + 0.5 * static_cast<double>(fn) +
                           0.5 * static_cast<double>(fp));
}
double ClearScores::smota() const {
  return ratio_to_count(similarity_sum - static_cast<double>(fp) - static_cast<double>(id_switches),
                        tp + fn);
}
double ClearScores::motal() const {
  const double switches = id_switches > 0 ? std::log10(static_cast<double>(id_switches)) : 0.0;
  return ratio_to_count(static_cast<double>(tp - fp) - switches, tp + fn);
}

ClearScores score_clear(const PairedSequence& similarity, double threshold) {
  if (!(threshold > 0 && threshold <= 1))
    throw std::invalid_argument("threshold must be in (0, 1]");
  if (similarity.truth_count == 0 || similarity.result_count == 0) {
    // Without one of the two there is nothing to score: TrackEval leaves every ratio at 0, MODA
    // too.
    ClearScores scores;
    scores.fn = similarity.truth_count;
    scores.fp = similarity.result_count;
    scores.mostly_lost = similarity.truth_identities;
    scores.present.resize(slot(similarity.truth_identities));
    scores.matched.resize(slot(similarity.truth_identities));
    for (const PairedFrame& frame : similarity.frames) {
      for (const int truth : frame.truth) ++scores.present[slot(truth)];
    }
    return scores;
  }
  ClearAccumulator accumulator(similarity, threshold);
  for (const PairedFrame& frame : similarity.frames) accumulator.add(frame);
  return accumulator.finish();
}

}  // namespace plaza
