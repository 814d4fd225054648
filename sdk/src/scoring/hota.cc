#include "plaza/scoring/hota.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "plaza/math/assignment.h"
#include "rounding.h"

namespace plaza {
namespace {

constexpr double kNoMatch = 1e-10;  // what the localisation of no match is divided by: gives 1

std::size_t at(Eigen::Index index) { return static_cast<std::size_t>(index); }

/// Adds up in the reference's order (eight interleaved sums, halves beyond 128): rounding decides
/// between trajectories that agree equally well.
double pairwise_sum(const double* values, std::size_t count, std::size_t stride) {
  constexpr std::size_t kLanes = 8;
  constexpr std::size_t kBlock = 128;
  if (count < kLanes) {
    double sum = 0;
    for (std::size_t i = 0; i < count; ++i) sum += values[i * stride];
    return sum;
  }
  if (count <= kBlock) {
    std::array<double, kLanes> lanes{};
    for (std::size_t k = 0; k < kLanes; ++k) lanes[k] = values[k * stride];
    std::size_t i = kLanes;
    for (; i < count - count % kLanes; i += kLanes) {
      for (std::size_t k = 0; k < kLanes; ++k) lanes[k] += values[(i + k) * stride];
    }
    double sum = ((lanes[0] + lanes[1]) + (lanes[2] + lanes[3])) +
                 ((lanes[4] + lanes[5]) + (lanes[6] + lanes[7]));
    for (; i < count; ++i) sum += values[i * stride];
    return sum;
  }
  const std::size_t half = count / 2 - count / 2 % kLanes;
  return pairwise_sum(values, half, stride) +
         pairwise_sum(values + half * stride, count - half, stride);
}

/// similarity / (row sum + column sum - similarity): how exclusively the two belong together.
Eigen::MatrixXd soft_matches(const Eigen::MatrixXd& similarity) {
  if (similarity.size() == 0) return similarity;  // has no data to point into
  const auto rows = at(similarity.rows());
  std::vector<double> row_sums(rows);
  for (Eigen::Index i = 0; i < similarity.rows(); ++i) {
    row_sums[at(i)] = pairwise_sum(similarity.data() + i, at(similarity.cols()), rows);
  }
  Eigen::MatrixXd soft = Eigen::MatrixXd::Zero(similarity.rows(), similarity.cols());
  for (Eigen::Index j = 0; j < similarity.cols(); ++j) {
    double column_sum = 0;
    if (similarity.cols() == 1) {
      column_sum = pairwise_sum(similarity.data(), rows, 1);
    } else {
      for (Eigen::Index i = 0; i < similarity.rows(); ++i) column_sum += similarity(i, j);
    }
    for (Eigen::Index i = 0; i < similarity.rows(); ++i) {
      const double united = column_sum + row_sums[at(i)] - similarity(i, j);
      if (united > kEpsilon) soft(i, j) = similarity(i, j) / united;
    }
  }
  return soft;
}

class HotaAccumulator {
 public:
  explicit HotaAccumulator(const PairedSequence& sequence)
      : truth_count_(Eigen::VectorXd::Zero(sequence.truth_identities)),
        result_count_(Eigen::VectorXd::Zero(sequence.result_identities)) {
    alignment_ = Eigen::MatrixXd::Zero(sequence.truth_identities, sequence.result_identities);
    for (Eigen::MatrixXd& matches : matches_) matches = alignment_;
    for (std::size_t a = 0; a < HotaScores::kThresholds; ++a) {
      scores_.alpha[a] = 0.05 + static_cast<double>(a) * 0.05;
    }
    for (const PairedFrame& frame : sequence.frames) count(frame);
    for (Eigen::Index j = 0; j < alignment_.cols(); ++j) {
      for (Eigen::Index i = 0; i < alignment_.rows(); ++i) {
        alignment_(i, j) /= truth_count_(i) + result_count_(j) - alignment_(i, j);
      }
    }
  }

  void match(const PairedFrame& frame) {
    std::array<std::int64_t, HotaScores::kThresholds> matches{};
    if (!frame.truth.empty() && !frame.result.empty()) {
      Eigen::MatrixXd score(frame.values.rows(), frame.values.cols());
      for (Eigen::Index j = 0; j < score.cols(); ++j) {
        for (Eigen::Index i = 0; i < score.rows(); ++i) {
          score(i, j) = alignment_(frame.truth[at(i)], frame.result[at(j)]) * frame.values(i, j);
        }
      }
      const std::vector<int> assigned = assign_maximum_weight(score);
      std::array<double, HotaScores::kThresholds> sums{};
      for (std::size_t i = 0; i < assigned.size(); ++i) {
        if (assigned[i] < 0) continue;
        const int result = frame.result[static_cast<std::size_t>(assigned[i])];
        const double similarity = frame.values(static_cast<Eigen::Index>(i), assigned[i]);
        for (std::size_t a = 0; a < HotaScores::kThresholds; ++a) {
          if (!(similarity >= scores_.alpha[a] - kEpsilon)) break;
          ++matches[a];
          sums[a] += similarity;
          matches_[a](frame.truth[i], result) += 1;
        }
      }
      for (std::size_t a = 0; a < HotaScores::kThresholds; ++a) scores_.loc_a[a] += sums[a];
    }
    for (std::size_t a = 0; a < HotaScores::kThresholds; ++a) {
      scores_.tp[a] += matches[a];
      scores_.fn[a] += static_cast<std::int64_t>(frame.truth.size()) - matches[a];
      scores_.fp[a] += static_cast<std::int64_t>(frame.result.size()) - matches[a];
    }
  }

  HotaScores finish() {
    for (std::size_t a = 0; a < HotaScores::kThresholds; ++a) finish(a);
    return scores_;
  }

 private:
  void count(const PairedFrame& frame) {
    const Eigen::MatrixXd soft = soft_matches(frame.values);
    for (Eigen::Index j = 0; j < soft.cols(); ++j) {
      for (Eigen::Index i = 0; i < soft.rows(); ++i) {
        alignment_(frame.truth[at(i)], frame.result[at(j)]) += soft(i, j);
      }
    }
    for (const int truth : frame.truth) truth_count_(truth) += 1;
    for (const int result : frame.result) result_count_(result) += 1;
  }

  void finish(std::size_t a) {
    double accuracy = 0, recall = 0, precision = 0;
    const Eigen::MatrixXd& matches = matches_[a];
    for (Eigen::Index i = 0; i < matches.rows(); ++i) {
      for (Eigen::Index j = 0; j < matches.cols(); ++j) {
        const double n = matches(i, j);
        if (n == 0) continue;
        accuracy += n * (n / std::max(1.0, truth_count_(i) + result_count_(j) - n));
        recall += n * (n / std::max(1.0, truth_count_(i)));
        precision += n * (n / std::max(1.0, result_count_(j)));
      }
    }
    const auto tp = static_cast<double>(scores_.tp[a]);
    const auto fn = static_cast<double>(scores_.fn[a]);
    const auto fp = static_cast<double>(scores_.fp[a]);
    scores_.ass_a[a] = accuracy / std::max(1.0, tp);
    scores_.ass_re[a] = recall / std::max(1.0, tp);
    scores_.ass_pr[a] = precision / std::max(1.0, tp);
    scores_.loc_a[a] = std::max(kNoMatch, scores_.loc_a[a]) / std::max(kNoMatch, tp);
    scores_.det_re[a] = tp / std::max(1.0, tp + fn);
    scores_.det_pr[a] = tp / std::max(1.0, tp + fp);
    scores_.det_a[a] = tp / std::max(1.0, tp + fn + fp);
    scores_.hota[a] = std::sqrt(scores_.det_a[a] * scores_.ass_a[a]);
    scores_.owta[a] = std::sqrt(scores_.det_re[a] * scores_.ass_a[a]);
  }

  Eigen::MatrixXd alignment_;  // Jaccard index of the trajectories, before unique matching
  Eigen::VectorXd truth_count_;
  Eigen::VectorXd result_count_;
  std::array<Eigen::MatrixXd, HotaScores::kThresholds> matches_;
  HotaScores scores_;
};

}  // namespace

double HotaScores::mean(const Array& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

HotaScores score_hota(const PairedSequence& similarity) {
  HotaAccumulator accumulator(similarity);
  for (const PairedFrame& frame : similarity.frames) accumulator.match(frame);
  return accumulator.finish();
}

}  // namespace plaza
