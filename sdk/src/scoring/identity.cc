#include "plaza/scoring/identity.h"

#include <algorithm>
#include <cmath>

#include "plaza/math/assignment.h"

namespace plaza {
namespace {

template <class Counts>
IdentityScores score(const PairedSequence& sequence, const Counts& counts) {
  Eigen::MatrixXd shared =
      Eigen::MatrixXd::Zero(sequence.truth_identities, sequence.result_identities);
  for (const PairedFrame& frame : sequence.frames) {
    for (std::size_t j = 0; j < frame.result.size(); ++j) {
      for (std::size_t i = 0; i < frame.truth.size(); ++i) {
        if (counts(frame.values(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)))) {
          shared(frame.truth[i], frame.result[j]) += 1;
        }
      }
    }
  }
  // The published form minimises misses plus false alarms over trajectories and dummies. A
  // trajectory paired with n shared frames spares 2 n of them, so the most shared frames are the
  // same optimum.
  const std::vector<int> assigned = assign_maximum_weight(shared);
  double idtp = 0;
  for (std::size_t i = 0; i < assigned.size(); ++i) {
    if (assigned[i] >= 0) idtp += shared(static_cast<Eigen::Index>(i), assigned[i]);
  }
  IdentityScores scores;
  scores.idtp = static_cast<std::int64_t>(idtp);
  scores.idfn = sequence.truth_count - scores.idtp;
  scores.idfp = sequence.result_count - scores.idtp;
  return scores;
}

double ratio_of_count(std::int64_t numerator, double denominator) {
  return static_cast<double>(numerator) / std::max(1.0, denominator);
}

}  // namespace

double IdentityScores::idf1() const {
  return ratio_of_count(idtp, static_cast<double>(idtp) + 0.5 * static_cast<double>(idfp) +
                                  0.5 * static_cast<double>(idfn));
}
double IdentityScores::idp() const {
  return ratio_of_count(idtp, static_cast<double>(idtp + idfp));
}
double IdentityScores::idr() const {
  return ratio_of_count(idtp, static_cast<double>(idtp + idfn));
}

IdentityScores score_identity(const PairedSequence& similarity, double threshold) {
  return score(similarity, [=](double s) { return s >= threshold; });
}

IdentityScores score_identity_of_distance(const PairedSequence& distance) {
  return score(distance, [](double d) { return std::isfinite(d); });
}

}  // namespace plaza
