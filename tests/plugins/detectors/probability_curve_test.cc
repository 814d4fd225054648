#include "plugins/detectors/common/probability_curve.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "plaza/core/error.h"

namespace plaza {
namespace {

using Points = std::vector<std::vector<double>>;

TEST(ProbabilityCurve, IsLinearBetweenAndFlatBeyondItsPoints) {
  const ProbabilityCurve curve(Points{{0.5, 0.2}, {1.0, 0.8}, {2.0, 0.8}});
  EXPECT_DOUBLE_EQ(curve(-3), 0.2);
  EXPECT_DOUBLE_EQ(curve(0.5), 0.2);
  EXPECT_DOUBLE_EQ(curve(0.75), 0.5);
  EXPECT_DOUBLE_EQ(curve(1.0), 0.8);
  EXPECT_DOUBLE_EQ(curve(1.7), 0.8);
  EXPECT_DOUBLE_EQ(curve(99), 0.8);
}

TEST(ProbabilityCurve, OfOnePointIsConstant) {
  const ProbabilityCurve curve(Points{{1.0, 0.9}});
  EXPECT_DOUBLE_EQ(curve(0), 0.9);
  EXPECT_DOUBLE_EQ(curve(5), 0.9);
}

struct Fault {
  Points points;
  std::string pointer;
  std::string message;
};

class ProbabilityCurveFault : public ::testing::TestWithParam<Fault> {};

TEST_P(ProbabilityCurveFault, IsNamedWithItsPoint) {
  try {
    const ProbabilityCurve curve(GetParam().points);
    FAIL() << "accepted";
  } catch (const UserError& error) {
    ASSERT_EQ(error.diagnostics().size(), 1U);
    EXPECT_EQ(error.diagnostics()[0].pointer, GetParam().pointer);
    EXPECT_THAT(error.diagnostics()[0].message, ::testing::HasSubstr(GetParam().message));
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, ProbabilityCurveFault,
    ::testing::Values(
        Fault{{}, "/probability", "at least one"}, Fault{{{0.5}}, "/probability/0", "two numbers"},
        Fault{{{0, 0.1}, {1, 0.2, 0.3}}, "/probability/1", "two numbers"},
        Fault{{{0, 0.0}}, "/probability/0", "above 0"},
        Fault{{{0, 1.0}}, "/probability/0", "below 1"},
        Fault{{{0, 0.5}, {0, 0.6}}, "/probability/1", "scores must rise"},
        Fault{{{0, 0.5}, {1, 0.4}}, "/probability/1", "must not fall"},
        Fault{{{std::numeric_limits<double>::infinity(), 0.4}}, "/probability/0", "finite"}));

}  // namespace
}  // namespace plaza
