#include "plaza/scoring/reliability.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "plaza/scoring/people.h"

namespace plaza {
namespace {

constexpr double kCertain = 1e-6;

double share_of(const IsotonicBlock& block) {
  return static_cast<double>(block.right) / static_cast<double>(block.count);
}

IsotonicBlock pooled(const IsotonicBlock& a, const IsotonicBlock& b) {
  IsotonicBlock block;
  block.low = a.low;
  block.high = b.high;
  block.count = a.count + b.count;
  block.right = a.right + b.right;
  block.mean_score =
      (a.mean_score * static_cast<double>(a.count) + b.mean_score * static_cast<double>(b.count)) /
      static_cast<double>(block.count);
  return block;
}

/// right / count of the first is not below that of the second; exact.
bool violates(const IsotonicBlock& a, const IsotonicBlock& b) {
  return a.right * b.count >= b.right * a.count;
}

/// Log-likelihood of a block's observations under its own share.
double block_log_likelihood(const IsotonicBlock& block) {
  const double p = share_of(block);
  double sum = 0;
  if (block.right > 0) sum += static_cast<double>(block.right) * std::log(p);
  const std::int64_t wrong = block.count - block.right;
  if (wrong > 0) sum += static_cast<double>(wrong) * std::log1p(-p);
  return sum;
}

double never_certain(const IsotonicBlock& block) {
  return (static_cast<double>(block.right) + 0.5) / (static_cast<double>(block.count) + 1);
}

void pool_at(std::vector<IsotonicBlock>& blocks, std::size_t i) {
  blocks[i] = pooled(blocks[i], blocks[i + 1]);
  blocks.erase(blocks.begin() + static_cast<std::ptrdiff_t>(i) + 1);
}

double to_digits(double value, int digits) {
  const double scale = std::pow(10.0, digits);
  return std::round(value * scale) / scale;
}

}  // namespace

void Judgement::add(const Scene& scene, const GroundTruth& truth, const Observations& results,
                    double overlap) {
  if (!truth.annotated) return;
  std::vector<ResultPerson> boxes;
  for (const Observation& o : results.items) {
    ResultPerson& person = boxes.emplace_back();
    person.id = static_cast<std::int64_t>(boxes.size());
    person.boxes = boxes_in_views(scene, o.position_m, o.boxes);
  }
  const PeopleMatch match = match_people(truth, boxes, overlap);
  people += std::count(match.counts.begin(), match.counts.end(), true);
  for (std::size_t j = 0; j < results.items.size(); ++j) {
    const Observation& o = results.items[j];
    const int index = match.person_of[j];
    const TruePerson* const person =
        index < 0 ? nullptr : &truth.people[static_cast<std::size_t>(index)];
    if (person != nullptr && !match.counts[static_cast<std::size_t>(index)]) continue;
    JudgedObservation& judged = observations.emplace_back();
    judged.score = o.score;
    judged.probability = o.probability;
    judged.right = person != nullptr;
    if (person == nullptr || !person->position_m) continue;
    normalised_errors.push_back(
        normalised_error(*person->position_m - o.position_m, o.covariance_m2));
  }
}

std::vector<ReliabilityBin> reliability_bins(std::span<const JudgedObservation> judged, int bins) {
  if (bins < 1) throw std::invalid_argument("a reliability diagram needs a bin");
  std::vector<ReliabilityBin> out(static_cast<std::size_t>(bins));
  for (int i = 0; i < bins; ++i) {
    out[static_cast<std::size_t>(i)].low = static_cast<double>(i) / bins;
    out[static_cast<std::size_t>(i)].high = static_cast<double>(i + 1) / bins;
  }
  for (const JudgedObservation& j : judged) {
    const int index = std::clamp(static_cast<int>(j.probability * bins), 0, bins - 1);
    ReliabilityBin& bin = out[static_cast<std::size_t>(index)];
    ++bin.count;
    bin.mean_probability += j.probability;
    bin.right_share += j.right ? 1 : 0;
  }
  for (ReliabilityBin& bin : out) {
    if (bin.count == 0) continue;
    bin.mean_probability /= static_cast<double>(bin.count);
    bin.right_share /= static_cast<double>(bin.count);
  }
  return out;
}

std::optional<double> brier_score(std::span<const JudgedObservation> judged) {
  if (judged.empty()) return std::nullopt;
  double sum = 0;
  for (const JudgedObservation& j : judged) {
    const double difference = j.probability - (j.right ? 1 : 0);
    sum += difference * difference;
  }
  return sum / static_cast<double>(judged.size());
}

std::optional<double> log_loss(std::span<const JudgedObservation> judged) {
  if (judged.empty()) return std::nullopt;
  double sum = 0;
  for (const JudgedObservation& j : judged) {
    const double p = std::clamp(j.probability, kCertain, 1 - kCertain);
    sum -= std::log(j.right ? p : 1 - p);
  }
  return sum / static_cast<double>(judged.size());
}

std::optional<double> calibration_error(std::span<const ReliabilityBin> bins) {
  std::int64_t count = 0;
  double sum = 0;
  for (const ReliabilityBin& bin : bins) {
    count += bin.count;
    sum += static_cast<double>(bin.count) * std::abs(bin.mean_probability - bin.right_share);
  }
  if (count == 0) return std::nullopt;
  return sum / static_cast<double>(count);
}

std::vector<IsotonicBlock> isotonic_blocks(std::span<const JudgedObservation> judged) {
  std::vector<JudgedObservation> sorted(judged.begin(), judged.end());
  std::stable_sort(
      sorted.begin(), sorted.end(),
      [](const JudgedObservation& a, const JudgedObservation& b) { return a.score < b.score; });
  std::vector<IsotonicBlock> blocks;
  for (std::size_t i = 0; i < sorted.size();) {
    IsotonicBlock block;
    block.low = block.high = block.mean_score = sorted[i].score;
    for (; i < sorted.size() && sorted[i].score == block.low; ++i) {
      ++block.count;
      block.right += sorted[i].right ? 1 : 0;
    }
    while (!blocks.empty() && violates(blocks.back(), block)) {
      block = pooled(blocks.back(), block);
      blocks.pop_back();
    }
    blocks.push_back(block);
  }
  return blocks;
}

std::vector<CurvePoint> calibration_curve(std::span<const JudgedObservation> judged, int points,
                                          int digits) {
  if (points < 2) throw std::invalid_argument("a calibration curve needs room for two points");
  std::vector<IsotonicBlock> blocks = isotonic_blocks(judged);
  const auto cost_of_pooling = [&blocks](std::size_t i) {
    return block_log_likelihood(blocks[i]) + block_log_likelihood(blocks[i + 1]) -
           block_log_likelihood(pooled(blocks[i], blocks[i + 1]));
  };
  while (blocks.size() > static_cast<std::size_t>(points)) {
    std::size_t cheapest = 0;
    for (std::size_t i = 1; i + 1 < blocks.size(); ++i) {
      if (cost_of_pooling(i) < cost_of_pooling(cheapest)) cheapest = i;
    }
    pool_at(blocks, cheapest);
  }
  // few observations are drawn to 1/2, past their neighbours perhaps; and rounding may join scores
  for (std::size_t i = 0; i + 1 < blocks.size();) {
    const bool falls = never_certain(blocks[i]) > never_certain(blocks[i + 1]);
    const bool joins =
        !(to_digits(blocks[i].mean_score, digits) < to_digits(blocks[i + 1].mean_score, digits));
    if (falls || joins) {
      pool_at(blocks, i);
      i = i > 0 ? i - 1 : 0;
    } else {
      ++i;
    }
  }
  std::vector<CurvePoint> curve;
  const double least = std::pow(10.0, -digits);
  for (const IsotonicBlock& block : blocks) {
    CurvePoint point;
    point.score = to_digits(block.mean_score, digits);
    point.probability = std::clamp(to_digits(never_certain(block), digits), least, 1 - least);
    curve.push_back(point);
  }
  return curve;
}

double curve_value(std::span<const CurvePoint> curve, double score) {
  if (curve.empty()) throw std::invalid_argument("a curve needs a point");
  const auto above =
      std::upper_bound(curve.begin(), curve.end(), score,
                       [](double s, const CurvePoint& point) { return s < point.score; });
  if (above == curve.begin()) return curve.front().probability;
  if (above == curve.end()) return curve.back().probability;
  const CurvePoint &a = *(above - 1), &b = *above;
  return std::lerp(a.probability, b.probability, (score - a.score) / (b.score - a.score));
}

double normalised_error(const Eigen::Vector2d& error_m, const Eigen::Matrix2d& covariance_m2) {
  return error_m.dot(covariance_m2.inverse() * error_m);
}

std::optional<Consistency> consistency_of(std::span<const double> normalised_errors) {
  if (normalised_errors.empty()) return std::nullopt;
  constexpr double kHalf = 2 * std::numbers::ln2, kNinety = 2 * std::numbers::ln10;
  std::vector<double> sorted(normalised_errors.begin(), normalised_errors.end());
  std::sort(sorted.begin(), sorted.end());
  const auto count = static_cast<double>(sorted.size());
  const auto share_up_to = [&](double limit) {
    return static_cast<double>(std::upper_bound(sorted.begin(), sorted.end(), limit) -
                               sorted.begin()) /
           count;
  };
  double sum = 0;
  for (const double e : sorted) sum += e;
  const std::size_t half = sorted.size() / 2;
  const double median =
      sorted.size() % 2 == 1 ? sorted[half] : (sorted[half - 1] + sorted[half]) / 2;
  return Consistency{.inside_50 = share_up_to(kHalf),
                     .inside_90 = share_up_to(kNinety),
                     .mean = sum / count / 2,
                     .median_ratio = median / kHalf};
}

}  // namespace plaza
