#include "plaza/scoring/mot_challenge.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "plaza/core/error.h"

namespace plaza {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

MotFile file_of(const std::string& name, const std::string& text) {
  return {name, parse_mot_rows(text, name)};
}

TEST(BoxOverlaps, AreContinuous) {
  const Box a{0, 0, 10, 10}, half{0, 0, 10, 5}, away{10, 0, 10, 10}, flat{0, 0, 10, 0};
  EXPECT_EQ(box_overlaps({&a, 1}, {&half, 1})(0, 0), 0.5);
  EXPECT_EQ(box_overlaps({&a, 1}, {&a, 1})(0, 0), 1);
  EXPECT_EQ(box_overlaps({&a, 1}, {&away, 1})(0, 0), 0) << "touching is not overlapping";
  EXPECT_EQ(box_overlaps({&a, 1}, {&flat, 1})(0, 0), 0);
  EXPECT_EQ(box_overlaps({&flat, 1}, {&flat, 1})(0, 0), 0);
}

TEST(MotRules, HaveNames) {
  EXPECT_EQ(mot_rules_from("MOT15"), MotRules::kMot15);
  EXPECT_EQ(mot_rules_from("MOT16"), MotRules::kMot16);
  EXPECT_EQ(mot_rules_from("MOT17"), MotRules::kMot17);
  EXPECT_EQ(mot_rules_from("MOT20"), MotRules::kMot20);
  EXPECT_FALSE(mot_rules_from("mot17"));
}

struct Kept {
  std::int64_t truth = 0;
  std::int64_t result = 0;
  bool operator==(const Kept&) const = default;
};

Kept kept(const std::string& truth, const std::string& result, MotRules rules) {
  const PairedSequence s = pair_mot_rows(file_of("gt.txt", truth), file_of("r.txt", result), rules);
  return {s.truth_count, s.result_count};
}

TEST(MotRules, ForgiveBoxesOnDistractors) {
  for (const int forgiven : {2, 7, 8, 12}) {
    const std::string truth = "1,1,0,0,10,10,1," + std::to_string(forgiven) + ",1\n";
    EXPECT_EQ(kept(truth, "1,1,0,0,10,10,1\n", MotRules::kMot17), (Kept{0, 0})) << forgiven;
    EXPECT_EQ(kept(truth, "1,1,0,0,10,10,1\n", MotRules::kMot15), (Kept{1, 1})) << forgiven;
    EXPECT_EQ(kept(truth, "1,1,0,6,10,10,1\n", MotRules::kMot17), (Kept{0, 1})) << "not on it";
  }
  for (const int other : {3, 4, 5, 9, 10, 11, 13}) {
    EXPECT_EQ(kept("1,1,0,0,10,10,1," + std::to_string(other) + ",1\n", "1,1,0,0,10,10,1\n",
                   MotRules::kMot20),
              (Kept{0, 1}))
        << other;
  }
  EXPECT_EQ(kept("1,1,0,0,10,10,1,6,1\n", "1,1,0,0,10,10,1\n", MotRules::kMot17), (Kept{0, 1}));
  EXPECT_EQ(kept("1,1,0,0,10,10,1,6,1\n", "1,1,0,0,10,10,1\n", MotRules::kMot20), (Kept{0, 0}));
}

TEST(MotRules, PedestriansComeBeforeDistractorsWhereTheyFitBetter) {
  // The box lies on both; the one assignment over all rows gives it to the better one.
  const std::string truth = "1,1,0,0,10,10,1,1,1\n1,2,0,1,10,10,1,8,1\n";
  EXPECT_EQ(kept(truth, "1,1,0,0,10,10,1\n", MotRules::kMot17), (Kept{1, 1}));
  EXPECT_EQ(kept(truth, "1,1,0,1,10,10,1\n", MotRules::kMot17), (Kept{1, 0}));
}

TEST(MotRules, ConfidenceIsCutToAnInteger) {
  EXPECT_EQ(kept("1,1,0,0,10,10,0.9\n", "1,1,0,0,10,10,1\n", MotRules::kMot15), (Kept{0, 1}));
  EXPECT_EQ(kept("1,1,0,0,10,10,-0.9\n", "1,1,0,0,10,10,1\n", MotRules::kMot15), (Kept{0, 1}));
  EXPECT_EQ(kept("1,1,0,0,10,10,-1\n", "1,1,0,0,10,10,0\n", MotRules::kMot15), (Kept{1, 1}))
      << "-1 is not 0, and a result's confidence does not matter";
  EXPECT_EQ(kept("1,1,0,0,10,10,0,1,1\n", "1,1,0,0,10,10,1\n", MotRules::kMot17), (Kept{0, 1}))
      << "an ignored pedestrian forgives nothing";
}

TEST(MotRules, NeedClasses) {
  try {
    pair_mot_rows(file_of("gt.txt", "1,1,0,0,10,10,1\n"), file_of("r.txt", "1,1,0,0,10,10,1\n"),
                  MotRules::kMot17);
    FAIL() << "no error";
  } catch (const UserError& error) {
    EXPECT_THAT(error.what(), HasSubstr("gt.txt:1: the row has no class"));
    EXPECT_THAT(error.what(), HasSubstr("MOT15"));
  }
  try {
    pair_mot_rows(file_of("gt.txt", "1,1,0,0,10,10,1,14,1\n"),
                  file_of("r.txt", "1,1,0,0,10,10,1,2,1\n"), MotRules::kMot17);
    FAIL() << "no error";
  } catch (const UserError& error) {
    EXPECT_THAT(error.what(), HasSubstr("gt.txt:1: class 14 is none of MOTChallenge's, 1 to 13"));
    EXPECT_THAT(error.what(),
                HasSubstr("r.txt:1: class 2 in a result; only pedestrians (1) are evaluated"));
  }
}

TEST(GroundRowsPairing, LooksAtFramesOfTheTruth) {
  const auto truth = parse_ground_rows("5,1,0,0\n7,1,3,4\n", "gt");
  const auto result = parse_ground_rows("5,1,0,1\n6,1,0,0\n7,1,0,0\n", "r");
  const PairedSequence s = pair_ground_rows(truth, result);
  ASSERT_EQ(s.frames.size(), 2U);
  EXPECT_EQ(s.result_count, 2);
  EXPECT_EQ(s.frames[0].values(0, 0), 1);
  EXPECT_EQ(s.frames[1].values(0, 0), 5);
  EXPECT_TRUE(std::isinf(pair_ground_rows(truth, result, true, 4.9).frames[1].values(0, 0)));
  EXPECT_EQ(pair_ground_rows(truth, result, true, 5).frames[1].values(0, 0), 5) << "inclusive";
}

TEST(GroundRowsPairing, WithoutIdentities) {
  const auto rows = parse_ground_rows("1,0,0\n1,1,1\n2,0,0\n", "gt");
  const PairedSequence s = pair_ground_rows(rows, rows, /*has_identities=*/false);
  EXPECT_EQ(s.truth_count, 3);
  EXPECT_EQ(s.truth_identities, 2);
}

}  // namespace
}  // namespace plaza
