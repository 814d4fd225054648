#include "plaza/scoring/detection.h"

#include <numeric>
#include <stdexcept>

#include "plaza/math/assignment.h"
#include "rounding.h"

namespace plaza {
namespace {

std::optional<double> known_ratio(double numerator, double denominator) {
  if (denominator == 0) return std::nullopt;
  return numerator / denominator;
}

/// Assigns each frame's matrix of `cost(values)` and counts the pairs whose value `matches`.
template <class Cost, class Matches, class Goodness>
DetectionScores score(const PairedSequence& sequence, const Cost& cost, const Matches& matches,
                      const Goodness& goodness) {
  DetectionScores scores;
  for (const PairedFrame& frame : sequence.frames) {
    const std::vector<int> assigned = assign_minimum_cost(frame.values.unaryExpr(cost).eval());
    std::int64_t found = 0;
    double sum = 0;
    for (std::size_t i = 0; i < assigned.size(); ++i) {
      if (assigned[i] < 0) continue;
      const double value = frame.values(static_cast<Eigen::Index>(i), assigned[i]);
      if (!matches(value)) continue;
      ++found;
      sum += goodness(value);
    }
    scores.tp += found;
    scores.fn += static_cast<std::int64_t>(frame.truth.size()) - found;
    scores.fp += static_cast<std::int64_t>(frame.result.size()) - found;
    scores.goodness_sum += sum;
    if (found > 0) scores.frame_goodness.push_back(sum / static_cast<double>(found));
  }
  return scores;
}

}  // namespace

std::optional<double> DetectionScores::moda() const {
  const auto errors = known_ratio(static_cast<double>(fn + fp), static_cast<double>(tp + fn));
  if (!errors) return std::nullopt;
  return 1 - *errors;
}
std::optional<double> DetectionScores::modp() const {
  return known_ratio(goodness_sum, static_cast<double>(tp));
}
std::optional<double> DetectionScores::frame_modp() const {
  return known_ratio(std::accumulate(frame_goodness.begin(), frame_goodness.end(), 0.0),
                     static_cast<double>(frame_goodness.size()));
}
std::optional<double> DetectionScores::precision() const {
  return known_ratio(static_cast<double>(tp), static_cast<double>(tp + fp));
}
std::optional<double> DetectionScores::recall() const {
  return known_ratio(static_cast<double>(tp), static_cast<double>(tp + fn));
}
std::optional<double> DetectionScores::f1() const {
  return known_ratio(2 * static_cast<double>(tp), static_cast<double>(2 * tp + fn + fp));
}

DetectionScores score_overlap_detection(const PairedSequence& similarity, double threshold) {
  if (!(threshold > 0 && threshold <= 1))
    throw std::invalid_argument("threshold must be in (0, 1]");
  const auto matches = [=](double s) { return s >= threshold - kEpsilon; };
  return score(
      similarity, [=](double s) { return matches(s) ? -s : 0.0; }, matches,
      [](double s) { return s; });
}

DetectionScores score_distance_detection(const PairedSequence& distance, double threshold) {
  constexpr double kTooFar = 1e6;  // thresholds, the benchmark's own stand-in for "no pair"
  if (!(threshold > 0)) throw std::invalid_argument("threshold must be positive");
  return score(
      distance, [=](double d) { return d > threshold ? kTooFar * threshold : d; },
      [=](double d) { return d < threshold; }, [=](double d) { return 1 - d / threshold; });
}

}  // namespace plaza
