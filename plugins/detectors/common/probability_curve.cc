#include "plugins/detectors/common/probability_curve.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "plaza/core/error.h"

namespace plaza {
namespace {

[[noreturn]] void refuse(std::size_t index, const std::string& message) {
  throw UserError(fault_at("/probability/" + std::to_string(index), message));
}

}  // namespace

ProbabilityCurve::ProbabilityCurve(std::span<const std::vector<double>> points) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].size() != 2) refuse(i, "a point is [score, probability]: two numbers");
    const double score = points[i][0];
    const double probability = points[i][1];
    if (!std::isfinite(score)) refuse(i, "the score must be a finite number");
    if (!(probability > 0 && probability < 1)) {
      refuse(i, "the probability must be above 0 and below 1: no score makes certain");
    }
    if (i > 0 && !(score > scores_.back())) refuse(i, "scores must rise from point to point");
    if (i > 0 && probability < probabilities_.back()) {
      refuse(i, "probabilities must not fall while scores rise");
    }
    scores_.push_back(score);
    probabilities_.push_back(probability);
  }
  if (scores_.empty()) {
    throw UserError(fault_at("/probability", "needs at least one [score, probability] point"));
  }
}

double ProbabilityCurve::operator()(double score) const {
  const auto above = std::upper_bound(scores_.begin(), scores_.end(), score);
  if (above == scores_.begin()) return probabilities_.front();
  if (above == scores_.end()) return probabilities_.back();
  const auto i = static_cast<std::size_t>(above - scores_.begin());
  const double t = (score - scores_[i - 1]) / (scores_[i] - scores_[i - 1]);
  return std::lerp(probabilities_[i - 1], probabilities_[i], t);
}

}  // namespace plaza
