#include "plugins/sinks/reliability-diagram/panels.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "plugins/sinks/reliability-diagram/chart.h"

namespace plaza::reliability_diagram {
namespace {

using drawing::Color;
using drawing::Point;

constexpr int kPanel = 480, kHeight = 528;
constexpr double kLargestBar = 0.22;  // of the chart's height, for the most frequent stretch

const Color kStated(160, 110, 40), kFitted(40, 120, 230), kIdeal(150, 142, 136),
    kCount(228, 214, 202), kIsotonic(110, 150, 60);

std::string decimals(double value, int digits) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*f", digits, value);
  return text;
}

std::string counted(std::size_t count, const char* what) {
  return std::to_string(count) + " " + what;
}

/// The 95 % interval of a share (E. B. Wilson, 1927).
Range interval_of(double share, std::int64_t count) {
  constexpr double z = 1.96;
  const auto n = static_cast<double>(count);
  const double centre = (share + z * z / (2 * n)) / (1 + z * z / n);
  const double half =
      z / (1 + z * z / n) * std::sqrt(share * (1 - share) / n + z * z / (4 * n * n));
  return {centre - half, centre + half};
}

void draw_diagonal(Chart& chart) {
  const std::vector<Point> diagonal = {{0, 0}, {1, 1}};
  chart.line(diagonal, {kIdeal, 1, 5});
}

void draw_bins(const cv::Mat& picture, const cv::Rect& place, const Judgement& judgement,
               std::span<const ReliabilityBin> bins) {
  std::vector<std::string> remarks = {"nothing was judged"};
  if (const auto brier = brier_score(judgement.observations)) {
    remarks = {counted(judgement.observations.size(), "observations"),
               "Brier score " + decimals(*brier, 4) + ", calibration error " +
                   decimals(*calibration_error(bins), 4)};
  }
  Chart chart(
      picture, place, {0, 1}, {0, 1},
      {"Are they as probable as they say?", "stated probability", "share of right ones", remarks});
  std::int64_t most = 1;
  for (const ReliabilityBin& bin : bins) most = std::max(most, bin.count);
  for (const ReliabilityBin& bin : bins) {
    chart.bar(bin.low, bin.high,
              kLargestBar * static_cast<double>(bin.count) / static_cast<double>(most), kCount);
  }
  draw_diagonal(chart);
  std::vector<Point> means;
  for (const ReliabilityBin& bin : bins) {
    if (bin.count == 0) continue;
    means.emplace_back(bin.mean_probability, bin.right_share);
    const Range range = interval_of(bin.right_share, bin.count);
    const std::vector<Point> whisker = {{bin.mean_probability, range.low},
                                        {bin.mean_probability, range.high}};
    chart.line(whisker, {kStated, 1});
  }
  chart.line(means, {kStated, 2});
  for (const Point& p : means) chart.dot(p.x, p.y, 4, kStated);
  chart.key("bins, with 95 % intervals", kStated);
  chart.key("how many", kCount);
}

void draw_scores(const cv::Mat& picture, const cv::Rect& place, const Judgement& judgement,
                 std::span<const CurvePoint> curve) {
  std::vector<JudgedObservation> sorted = judgement.observations;
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const auto& a, const auto& b) { return a.score < b.score; });
  Range range;
  if (!sorted.empty()) range = {sorted.front().score, sorted.back().score};
  if (!(range.high > range.low)) range.high = range.low + 1;
  Chart chart(
      picture, place, range, {0, 1},
      {"What its score says",
       "score, the detector's own scale",
       "share of right ones",
       {sorted.empty() ? "nothing was judged" : counted(curve.size(), "points") + " fitted"}});
  constexpr int kStretches = 40;
  std::vector<std::int64_t> counts(kStretches, 0);
  for (const JudgedObservation& j : sorted) {
    const double t = (j.score - range.low) / (range.high - range.low);
    ++counts[static_cast<std::size_t>(
        std::clamp(static_cast<int>(t * kStretches), 0, kStretches - 1))];
  }
  const auto most = std::max<std::int64_t>(1, *std::max_element(counts.begin(), counts.end()));
  const double width = (range.high - range.low) / kStretches;
  for (int i = 0; i < kStretches; ++i) {
    chart.bar(range.low + i * width, range.low + (i + 1) * width,
              kLargestBar * static_cast<double>(counts[static_cast<std::size_t>(i)]) /
                  static_cast<double>(most),
              kCount);
  }
  std::vector<Point> stated, steps, fitted;
  for (const JudgedObservation& j : sorted) stated.emplace_back(j.score, j.probability);
  for (const IsotonicBlock& block : isotonic_blocks(sorted)) {
    const double share = static_cast<double>(block.right) / static_cast<double>(block.count);
    steps.emplace_back(block.low, share);
    steps.emplace_back(block.high, share);
  }
  if (!curve.empty()) fitted.emplace_back(range.low, curve.front().probability);
  for (const CurvePoint& p : curve) fitted.emplace_back(p.score, p.probability);
  if (!curve.empty()) fitted.emplace_back(range.high, curve.back().probability);
  chart.line(steps, {kIsotonic, 1});
  chart.line(stated, {kStated, 2});
  chart.line(fitted, {kFitted, 2});
  for (const CurvePoint& p : curve) chart.dot(p.score, p.probability, 4, kFitted);
  chart.key("stated", kStated);
  chart.key("isotonic regression", kIsotonic);
  chart.key("fitted curve", kFitted);
}

void draw_positions(const cv::Mat& picture, const cv::Rect& place, const Judgement& judgement) {
  std::vector<double> errors = judgement.normalised_errors;
  std::sort(errors.begin(), errors.end());
  std::vector<std::string> remarks = {"no position could be judged"};
  if (const auto c = consistency_of(errors)) {
    remarks = {counted(errors.size(), "positions"), "true / stated variance: mean " +
                                                        decimals(c->mean, 2) + ", median " +
                                                        decimals(c->median_ratio, 2)};
  }
  Chart chart(picture, place, {0, 1}, {0, 1},
              {"Are they as precise as they say?", "ellipse that should hold this share",
               "share of true positions inside", remarks});
  draw_diagonal(chart);
  if (errors.empty()) return;
  std::vector<Point> inside;
  for (int i = 0; i < 200; ++i) {
    const double stated = i / 200.0;
    const double limit = -2 * std::log1p(-stated);  // of a chi-square with two degrees of freedom
    const auto up_to = std::upper_bound(errors.begin(), errors.end(), limit) - errors.begin();
    inside.emplace_back(stated, static_cast<double>(up_to) / static_cast<double>(errors.size()));
  }
  chart.line(inside, {kStated, 2});
  chart.key("observed", kStated);
  chart.key("consistent", kIdeal);
}

}  // namespace

cv::Mat draw_reliability(const Judgement& judgement, std::span<const ReliabilityBin> bins,
                         std::span<const CurvePoint> curve) {
  cv::Mat picture(kHeight, 3 * kPanel, CV_8UC3, drawing::light_theme().paper);
  draw_bins(picture, {0, 0, kPanel, kHeight}, judgement, bins);
  draw_scores(picture, {kPanel, 0, kPanel, kHeight}, judgement, curve);
  draw_positions(picture, {2 * kPanel, 0, kPanel, kHeight}, judgement);
  return picture;
}

}  // namespace plaza::reliability_diagram
