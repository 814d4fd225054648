#include "brute_force.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <utility>

namespace plaza::testing_support {
namespace {

constexpr double kTolerance = 1e-12;
using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;
using Weight = std::function<double(std::size_t, std::size_t)>;

/// Of all sets of pairs, that of the largest sum; pairs of weight 0 are left out.
Pairs best_pairs(std::size_t rows, std::size_t columns, const Weight& weight) {
  Pairs best, current;
  double best_sum = 0;
  std::vector<bool> taken(columns, false);
  const std::function<void(std::size_t, double)> go = [&](std::size_t row, double sum) {
    if (row == rows) {
      if (sum > best_sum) {
        best_sum = sum;
        best = current;
      }
      return;
    }
    go(row + 1, sum);
    for (std::size_t column = 0; column < columns; ++column) {
      const double w = weight(row, column);
      if (taken[column] || w <= 0) continue;
      taken[column] = true;
      current.emplace_back(row, column);
      go(row + 1, sum + w);
      current.pop_back();
      taken[column] = false;
    }
  };
  go(0, 0.0);
  return best;
}

double value(const FrameOf& frame, std::size_t i, std::size_t j) {
  return frame.values(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
}

std::vector<std::int64_t> everyone(const std::vector<FrameOf>& frames, Ids FrameOf::*who) {
  std::set<std::int64_t> ids;
  for (const FrameOf& frame : frames) ids.insert((frame.*who).begin(), (frame.*who).end());
  return {ids.begin(), ids.end()};
}

}  // namespace

SlowClear slow_clear(const std::vector<FrameOf>& frames, double threshold) {
  SlowClear s;
  std::map<std::int64_t, std::int64_t> last, previous;
  std::map<std::int64_t, std::string>
      story;  // per true person: m matched, l lost in a processed frame, e empty
  for (const FrameOf& frame : frames) {
    if (frame.truth.empty() || frame.result.empty()) {
      s.fp += static_cast<std::int64_t>(frame.result.size());
      s.fn += static_cast<std::int64_t>(frame.truth.size());
      for (const auto id : frame.truth) story[id] += 'e';
      continue;
    }
    const Pairs pairs =
        best_pairs(frame.truth.size(), frame.result.size(), [&](std::size_t i, std::size_t j) {
          const double similarity = value(frame, i, j);
          if (similarity < threshold - kTolerance) return 0.0;
          const auto link = previous.find(frame.truth[i]);
          return (link != previous.end() && link->second == frame.result[j] ? 1000 : 0) +
                 similarity;
        });
    std::map<std::int64_t, std::int64_t> now;
    for (const auto& [i, j] : pairs) {
      now[frame.truth[i]] = frame.result[j];
      const auto before = last.find(frame.truth[i]);
      if (before != last.end() && before->second != frame.result[j]) ++s.switches;
      last[frame.truth[i]] = frame.result[j];
      s.similarity_sum += value(frame, i, j);
    }
    for (const auto& [id, history] : story) {
      if (std::find(frame.truth.begin(), frame.truth.end(), id) == frame.truth.end())
        story[id] += 'a';
    }
    for (const auto id : frame.truth) story[id] += now.contains(id) ? 'm' : 'l';
    s.tp += static_cast<std::int64_t>(pairs.size());
    s.fn += static_cast<std::int64_t>(frame.truth.size() - pairs.size());
    s.fp += static_cast<std::int64_t>(frame.result.size() - pairs.size());
    previous = now;
  }
  for (const auto& [id, history] : story) {
    int present = 0, matched = 0, runs = 0;
    bool linked = false;
    for (const char c : history) {
      present += c != 'a';
      matched += c == 'm';
      if (c == 'e') continue;  // not a processed frame
      runs += c == 'm' && !linked;
      linked = c == 'm';
    }
    if (runs > 0) s.fragments += runs - 1;
    if (10 * matched > 8 * present) {
      ++s.mostly_tracked;
    } else if (10 * matched >= 2 * present) {
      ++s.partly_tracked;
    } else {
      ++s.mostly_lost;
    }
  }
  return s;
}

std::int64_t slow_idtp(const std::vector<FrameOf>& frames, double threshold) {
  const auto truth = everyone(frames, &FrameOf::truth);
  const auto result = everyone(frames, &FrameOf::result);
  const auto shared = [&](std::size_t a, std::size_t b) {
    double count = 0;
    for (const FrameOf& frame : frames) {
      for (std::size_t i = 0; i < frame.truth.size(); ++i) {
        for (std::size_t j = 0; j < frame.result.size(); ++j) {
          count += frame.truth[i] == truth[a] && frame.result[j] == result[b] &&
                   value(frame, i, j) >= threshold;
        }
      }
    }
    return count;
  };
  double sum = 0;
  for (const auto& [a, b] : best_pairs(truth.size(), result.size(), shared)) sum += shared(a, b);
  return static_cast<std::int64_t>(sum);
}

SlowHota slow_hota(const std::vector<FrameOf>& frames, double alpha) {
  std::map<std::pair<std::int64_t, std::int64_t>, double> potential, matched;
  std::map<std::int64_t, double> truth_frames, result_frames;
  for (const FrameOf& frame : frames) {
    for (const auto id : frame.truth) ++truth_frames[id];
    for (const auto id : frame.result) ++result_frames[id];
    for (std::size_t i = 0; i < frame.truth.size(); ++i) {
      for (std::size_t j = 0; j < frame.result.size(); ++j) {
        const double all = frame.values.row(static_cast<Eigen::Index>(i)).sum() +
                           frame.values.col(static_cast<Eigen::Index>(j)).sum() -
                           value(frame, i, j);
        if (all > 0) potential[{frame.truth[i], frame.result[j]}] += value(frame, i, j) / all;
      }
    }
  }
  double tp = 0, fn = 0, fp = 0, similarity = 0;
  for (const FrameOf& frame : frames) {
    const Pairs pairs =
        best_pairs(frame.truth.size(), frame.result.size(), [&](std::size_t i, std::size_t j) {
          const double common = potential[{frame.truth[i], frame.result[j]}];
          return common / (truth_frames[frame.truth[i]] + result_frames[frame.result[j]] - common) *
                 value(frame, i, j);
        });
    double found = 0;
    for (const auto& [i, j] : pairs) {
      if (value(frame, i, j) < alpha - kTolerance) continue;
      ++found;
      similarity += value(frame, i, j);
      ++matched[{frame.truth[i], frame.result[j]}];
    }
    tp += found;
    fn += static_cast<double>(frame.truth.size()) - found;
    fp += static_cast<double>(frame.result.size()) - found;
  }
  SlowHota s;
  s.det_a = tp + fn + fp > 0 ? tp / (tp + fn + fp) : 0;
  s.loc_a = tp > 0 ? similarity / tp : 1;
  // Association accuracy match by match, as the paper writes it.
  for (const auto& [pair, count] : matched) {
    for (int k = 0; k < static_cast<int>(count); ++k) {
      const double tpa = count;
      const double fna = truth_frames[pair.first] - count;
      const double fpa = result_frames[pair.second] - count;
      s.ass_a += tpa / (tpa + fna + fpa) / tp;
    }
  }
  return s;
}

}  // namespace plaza::testing_support
