#pragma once

#include <span>
#include <vector>

namespace plaza {

/// How probable a person is, given the detector's score: piecewise linear between declared points,
/// flat beyond them. Scores of image detectors are no probabilities; this is their declared
/// calibration.
class ProbabilityCurve {
 public:
  /// `points` are (score, probability) pairs by rising score and not falling probability, each
  /// strictly between 0 and 1, at least one. Throws UserError that names the faulty point of
  /// parameter "probability".
  explicit ProbabilityCurve(std::span<const std::vector<double>> points);

  double operator()(double score) const;

 private:
  std::vector<double> scores_;
  std::vector<double> probabilities_;
};

}  // namespace plaza
