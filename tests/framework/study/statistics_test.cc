// Figures about figures, against values worked out elsewhere.
#include "framework/study/report/statistics.h"

#include <gtest/gtest.h>

namespace plaza {
namespace {

TEST(StatisticsTest, QuantilesAreThoseOfNumpy) {
  const std::vector<double> values = {3, 1, 4, 1, 5, 9, 2, 6};  // numpy.quantile(values, p)
  EXPECT_DOUBLE_EQ(quantile(values, 0.25), 1.75);
  EXPECT_DOUBLE_EQ(quantile(values, 0.5), 3.5);
  EXPECT_DOUBLE_EQ(quantile(values, 0.9), 6.9);
  EXPECT_DOUBLE_EQ(quantile(values, 1), 9);
  EXPECT_DOUBLE_EQ(quantile({7}, 0.3), 7);
}

TEST(StatisticsTest, SpreadOfNothingIsNothing) {
  EXPECT_FALSE(spread_of({}));
  const auto spread = spread_of({2, 8, 4});
  ASSERT_TRUE(spread);
  EXPECT_EQ(spread->median, 4);
  EXPECT_EQ(spread->low, 3);
  EXPECT_EQ(spread->high, 6);
  EXPECT_EQ(spread->least, 2);
  EXPECT_EQ(spread->most, 8);
}

TEST(StatisticsTest, BootstrapNearsTheStandardErrorOfTheMean) {
  // 40 values of mean 0 and standard deviation 1.0127: the normal interval is +-1.96 * 0.1581
  std::vector<double> values;
  for (int i = 0; i < 20; ++i) values.insert(values.end(), {-1.0, 1.0});
  const auto estimate = bootstrap_mean(values, 1);
  ASSERT_TRUE(estimate && estimate->low && estimate->high);
  EXPECT_DOUBLE_EQ(estimate->mean, 0);
  EXPECT_NEAR(*estimate->low, -0.31, 0.05);
  EXPECT_NEAR(*estimate->high, 0.31, 0.05);
  EXPECT_FALSE(estimate->distinct());
}

TEST(StatisticsTest, BootstrapIsTheSameForTheSameSeed) {
  const std::vector<double> values = {0.3, 0.1, 0.2, 0.25, 0.4};
  const auto one = bootstrap_mean(values, 5), two = bootstrap_mean(values, 5);
  EXPECT_EQ(one->low, two->low);
  EXPECT_EQ(one->high, two->high);
  EXPECT_TRUE(one->distinct());
  EXPECT_GT(*one->low, 0.1);
  EXPECT_LT(*one->high, 0.4);
}

TEST(StatisticsTest, FewPairsHaveNoInterval) {
  EXPECT_FALSE(bootstrap_mean({}, 1));
  const auto two = bootstrap_mean({1, 2}, 1);
  EXPECT_DOUBLE_EQ(two->mean, 1.5);
  EXPECT_FALSE(two->low);
  EXPECT_FALSE(two->distinct());
}

}  // namespace
}  // namespace plaza
