#include "brute_force.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "plaza/scoring/clear.h"
#include "plaza/scoring/detection.h"
#include "plaza/scoring/hota.h"
#include "plaza/scoring/identity.h"
#include "plaza/scoring/persistent_clear.h"
#include "plaza/scoring/sections.h"

namespace plaza {
namespace {

using testing_support::FrameOf;
using testing_support::Ids;
using testing_support::sequence_of;

/// A few people followed with gaps, exchanged identities, clutter and frames without anyone.
std::vector<FrameOf> random_story(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  const auto some = [&](std::int64_t first, int most, double share) {
    Ids ids;
    for (int k = 0; k < most; ++k) {
      if (unit(random) < share) ids.push_back(first + 7 * k);
    }
    std::shuffle(ids.begin(), ids.end(), random);
    return ids;
  };
  const double presence = 0.3 + 0.6 * unit(random);
  const double fidelity = unit(random);
  std::vector<FrameOf> frames;
  for (int f = 0; f < 12; ++f) {
    FrameOf frame{some(3, 4, presence), some(100, 4, presence), {}};
    if (unit(random) < 0.1) frame.truth.clear();
    if (unit(random) < 0.1) frame.result.clear();
    frame.values.resize(static_cast<Eigen::Index>(frame.truth.size()),
                        static_cast<Eigen::Index>(frame.result.size()));
    for (std::size_t i = 0; i < frame.truth.size(); ++i) {
      for (std::size_t j = 0; j < frame.result.size(); ++j) {
        const bool partners = frame.truth[i] + 97 == frame.result[j] && unit(random) < fidelity;
        const bool apart = unit(random) < 0.3;
        frame.values(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
            apart && !partners ? 0.0 : (partners ? 0.4 : 0.0) + 0.6 * unit(random);
      }
    }
    frames.push_back(frame);
  }
  return frames;
}

bool scorable(const std::vector<FrameOf>& frames) {
  const PairedSequence s = sequence_of(frames);
  return s.truth_count > 0 && s.result_count > 0;
}

class RandomStory : public ::testing::TestWithParam<unsigned> {};

TEST_P(RandomStory, ClearAgreesWithTheDefinition) {
  for (unsigned k = 0; k < 50; ++k) {
    const auto frames = random_story(GetParam() * 1000 + k);
    if (!scorable(frames)) continue;
    for (const double threshold : {0.3, 0.5, 0.8}) {
      const ClearScores fast = score_clear(sequence_of(frames), threshold);
      const auto slow = testing_support::slow_clear(frames, threshold);
      EXPECT_EQ(fast.tp, slow.tp);
      EXPECT_EQ(fast.fn, slow.fn);
      EXPECT_EQ(fast.fp, slow.fp);
      EXPECT_EQ(fast.id_switches, slow.switches);
      EXPECT_EQ(fast.fragments, slow.fragments);
      EXPECT_EQ(fast.mostly_tracked, slow.mostly_tracked);
      EXPECT_EQ(fast.partly_tracked, slow.partly_tracked);
      EXPECT_EQ(fast.mostly_lost, slow.mostly_lost);
      EXPECT_NEAR(fast.similarity_sum, slow.similarity_sum, 1e-9);
    }
  }
}

TEST_P(RandomStory, IdentityAgreesWithTheDefinition) {
  for (unsigned k = 0; k < 50; ++k) {
    const auto frames = random_story(GetParam() * 1000 + k);
    EXPECT_EQ(score_identity(sequence_of(frames), 0.5).idtp,
              testing_support::slow_idtp(frames, 0.5));
  }
}

TEST_P(RandomStory, HotaAgreesWithTheDefinition) {
  for (unsigned k = 0; k < 30; ++k) {
    const auto frames = random_story(GetParam() * 1000 + k);
    if (!scorable(frames)) continue;
    const HotaScores fast = score_hota(sequence_of(frames));
    for (const std::size_t a : {std::size_t{0}, std::size_t{9}, std::size_t{16}}) {
      const auto slow = testing_support::slow_hota(frames, fast.alpha[a]);
      EXPECT_NEAR(fast.det_a[a], slow.det_a, 1e-9);
      EXPECT_NEAR(fast.ass_a[a], slow.ass_a, 1e-9);
      EXPECT_NEAR(fast.loc_a[a], slow.loc_a, 1e-9);
      EXPECT_NEAR(fast.hota[a], std::sqrt(slow.det_a * slow.ass_a), 1e-9);
    }
  }
}

/// Rows shuffled and people renamed: without ties nothing may change.
std::vector<FrameOf> disguised(std::vector<FrameOf> frames, unsigned seed) {
  std::mt19937 random(seed);
  for (FrameOf& frame : frames) {
    std::vector<Eigen::Index> rows(frame.truth.size()), columns(frame.result.size());
    std::iota(rows.begin(), rows.end(), 0);
    std::iota(columns.begin(), columns.end(), 0);
    std::shuffle(rows.begin(), rows.end(), random);
    std::shuffle(columns.begin(), columns.end(), random);
    Ids truth, result;
    for (const auto i : rows) truth.push_back(-5 * frame.truth[static_cast<std::size_t>(i)]);
    for (const auto j : columns)
      result.push_back(1000 - 3 * frame.result[static_cast<std::size_t>(j)]);
    const Eigen::MatrixXd values = frame.values(rows, columns);
    frame = {truth, result, values};
  }
  return frames;
}

void expect_equal(const nlohmann::json& a, const nlohmann::json& b) {
  for (const auto& [key, value] : a.items()) {
    if (value.is_number()) {
      EXPECT_NEAR(value.get<double>(), b[key].get<double>(), 1e-9) << key;
    }
  }
}

TEST_P(RandomStory, NamesAndOrderDoNotMatter) {
  const auto frames = random_story(GetParam());
  const auto other = disguised(frames, GetParam());
  expect_equal(image_tracking_section(sequence_of(frames), 0.5),
               image_tracking_section(sequence_of(other), 0.5));
  expect_equal(image_detection_section(sequence_of(frames), 0.5),
               image_detection_section(sequence_of(other), 0.5));
}

TEST_P(RandomStory, FramesWithoutAnyoneDoNotMatter) {
  auto frames = random_story(GetParam());
  const nlohmann::json before = image_tracking_section(sequence_of(frames), 0.5);
  frames.insert(frames.begin() + 5, FrameOf{{}, {}, Eigen::MatrixXd(0, 0)});
  expect_equal(before, image_tracking_section(sequence_of(frames), 0.5));
}

TEST_P(RandomStory, SumsFit) {
  const PairedSequence s = sequence_of(random_story(GetParam()));
  const ClearScores clear = score_clear(s, 0.5);
  EXPECT_EQ(clear.tp + clear.fn, s.truth_count);
  EXPECT_EQ(clear.tp + clear.fp, s.result_count);
  EXPECT_EQ(clear.mostly_tracked + clear.partly_tracked + clear.mostly_lost, s.truth_identities);
  const IdentityScores identity = score_identity(s, 0.5);
  EXPECT_EQ(identity.idtp + identity.idfn, s.truth_count);
  EXPECT_EQ(identity.idtp + identity.idfp, s.result_count);
  const PersistentClearScores persistent =
      score_persistent_clear(s);  // any finite matrix is a distance, too
  EXPECT_EQ(persistent.detections() + persistent.misses, s.truth_count);
  EXPECT_EQ(persistent.detections() + persistent.false_positives, s.result_count);
  const DetectionScores detection = score_overlap_detection(s, 0.5);
  EXPECT_GE(detection.goodness_sum, clear.similarity_sum - 1e-9)
      << "no memory, so never a smaller sum";
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomStory, ::testing::Range(1U, 9U));

}  // namespace
}  // namespace plaza
