#include "plaza/scoring/paired_sequence.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "sequences.h"

namespace plaza {
namespace {

using ::testing::ElementsAre;
using testing_support::Ids;
using testing_support::sequence_of;

TEST(PairedSequence, NumbersIdentitiesByRisingOnes) {
  const PairedSequence s = sequence_of({{{40, -7}, {9}, Eigen::MatrixXd::Zero(2, 1)},
                                        {{}, {1000000000000, 9}, Eigen::MatrixXd(0, 2)},
                                        {{3}, {}, Eigen::MatrixXd(1, 0)}});
  EXPECT_EQ(s.truth_identities, 3);
  EXPECT_EQ(s.result_identities, 2);
  EXPECT_EQ(s.truth_count, 3);
  EXPECT_EQ(s.result_count, 3);
  ASSERT_EQ(s.frames.size(), 3U);
  EXPECT_THAT(s.frames[0].truth, ElementsAre(2, 0)) << "the order within a frame is kept";
  EXPECT_THAT(s.frames[1].result, ElementsAre(1, 0));
  EXPECT_THAT(s.frames[2].truth, ElementsAre(1));
}

TEST(PairedSequence, RefusesWhatCanNotBe) {
  PairedSequenceBuilder builder;
  EXPECT_THROW(builder.add(1, Ids{1}, Ids{1}, Eigen::MatrixXd(2, 1)), std::invalid_argument);
  EXPECT_THROW(builder.add(1, Ids{1, 1}, Ids{1}, Eigen::MatrixXd(2, 1)), std::invalid_argument);
  EXPECT_THROW(builder.add(1, Ids{1}, Ids{2, 2}, Eigen::MatrixXd(1, 2)), std::invalid_argument);
  builder.add(1, Ids{1}, Ids{1}, Eigen::MatrixXd::Ones(1, 1));
  EXPECT_THROW(builder.add(1, Ids{1}, Ids{1}, Eigen::MatrixXd::Ones(1, 1)), std::invalid_argument);
  EXPECT_EQ(builder.build().frames.size(), 1U) << "what was refused left nothing behind";
}

TEST(PairedSequence, SimilarityFallsWithDistance) {
  Eigen::MatrixXd d(1, 4);
  d << 0, 1, 2, std::numeric_limits<double>::infinity();
  const PairedSequence s = similarity_from_distance(sequence_of({{{1}, {1, 2, 3, 4}, d}}), 2.0);
  EXPECT_EQ(s.frames[0].values, (Eigen::MatrixXd(1, 4) << 1, 0.5, 0, 0).finished());
  EXPECT_THROW(similarity_from_distance(s, 0), std::invalid_argument);
}

}  // namespace
}  // namespace plaza
