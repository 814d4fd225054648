#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "plaza/core/export.h"
#include "plaza/data/ground_truth.h"
#include "plaza/data/observation.h"
#include "plaza/geometry/scene.h"

// Whether a detector means what it says: probabilities and position uncertainties against truth.

namespace plaza {

/// An observation that the truth has judged.
struct JudgedObservation {
  double score = 0;        ///< Observation::score
  double probability = 0;  ///< Observation::probability
  bool right = false;      ///< a true person was matched with it
};

/// What the truth says of a run's observations.
struct PLAZA_API Judgement {
  std::vector<JudgedObservation> observations;
  std::vector<double> normalised_errors;  ///< normalised_error() of matched ones, positions known
  std::int64_t people = 0;                ///< true ones who count, over all frames

  /// Adds one frame, matched as match_people() does. Results that belong to people who don't count
  /// are not judged; frames that nobody annotated are left out.
  void add(const Scene& scene, const GroundTruth& truth, const Observations& results,
           double overlap);
};

/// Observations of about the same probability, and how many of them were right.
struct ReliabilityBin {
  double low = 0, high = 0;  ///< of probabilities; [low, high), the last one includes 1
  std::int64_t count = 0;
  double mean_probability = 0;  ///< of its observations; 0 without any
  double right_share = 0;       ///< of its observations; 0 without any
};

/// `bins` (at least 1) equal intervals of [0, 1].
PLAZA_API std::vector<ReliabilityBin> reliability_bins(std::span<const JudgedObservation> judged,
                                                       int bins);

/// Mean squared difference of probability and truth (G. Brier, 1950); nothing without observations.
PLAZA_API std::optional<double> brier_score(std::span<const JudgedObservation> judged);

/// Mean over the observations of -log of the probability given to what was true (nats);
/// probabilities are kept 1e-6 away from 0 and 1. Nothing without observations.
PLAZA_API std::optional<double> log_loss(std::span<const JudgedObservation> judged);

/// Expected calibration error (M. Naeini et al., AAAI 2015): mean over the observations of the
/// difference of their bin's mean probability and its share of right ones; nothing without any.
PLAZA_API std::optional<double> calibration_error(std::span<const ReliabilityBin> bins);

/// A stretch of scores with one share of right observations.
struct IsotonicBlock {
  double low = 0, high = 0;  ///< least and largest score in it
  double mean_score = 0;
  std::int64_t count = 0;
  std::int64_t right = 0;
};

/// The non-decreasing function of the score with the least squared error to the truth: pool
/// adjacent violators (M. Ayer et al., 1955; B. Zadrozny, C. Elkan, KDD 2002). By rising score; the
/// shares right / count rise strictly. Equal scores are in one block.
PLAZA_API std::vector<IsotonicBlock> isotonic_blocks(std::span<const JudgedObservation> judged);

/// A point of the curve that a detector's parameter "probability" takes.
struct CurvePoint {
  double score = 0;
  double probability = 0;  ///< inside (0, 1)
};

/// A calibration curve of at most `points` (at least 2) points, by strictly rising scores and not
/// falling probabilities, to be joined by lines and flat beyond: of the isotonic blocks those are
/// pooled first whose pooling costs the least log-likelihood; each gives a point at its mean score.
/// The probability is (right + 1/2) / (count + 1), which is never certain. Both have `digits`
/// digits behind the point. Empty without observations.
PLAZA_API std::vector<CurvePoint> calibration_curve(std::span<const JudgedObservation> judged,
                                                    int points, int digits = 3);

/// Value of a curve of at least one point.
PLAZA_API double curve_value(std::span<const CurvePoint> curve, double score);

/// Squared distance of an error from zero in units of its covariance, e^T C^-1 e. Of an error that
/// has this covariance it is chi-squared with two degrees of freedom: 2 in the mean, 2 ln 2 in the
/// median. `covariance_m2` is positive definite.
PLAZA_API double normalised_error(const Eigen::Vector2d& error_m,
                                  const Eigen::Matrix2d& covariance_m2);

/// Whether errors are as large as they were said to be.
struct Consistency {
  double inside_50 = 0;     ///< share of the errors inside their 50 % ellipse
  double inside_90 = 0;     ///< and inside their 90 % ellipse
  double mean = 0;          ///< mean of the normalised errors / 2; 1 when consistent
  double median_ratio = 0;  ///< their median / (2 ln 2); 1 when consistent, whatever the outliers
};
/// Of normalised_error() values; nothing without any.
PLAZA_API std::optional<Consistency> consistency_of(std::span<const double> normalised_errors);

}  // namespace plaza
