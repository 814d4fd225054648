#include "framework/config/text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace plaza {
namespace {

using testing::Eq;
using testing::Optional;

const std::vector<std::string> kNames = {"sigma_px", "sigma_m", "directions", "weight", "fps"};

TEST(Nearest, FindsSlipsOfTheKeyboard) {
  EXPECT_THAT(nearest("sigma_pxx", kNames), Optional(Eq("sigma_px")));
  EXPECT_THAT(nearest("direction", kNames), Optional(Eq("directions")));
  EXPECT_THAT(nearest("wieght", kNames), Optional(Eq("weight")));
  EXPECT_THAT(nearest("wight", kNames), Optional(Eq("weight")));
}

TEST(Nearest, CountsSwappedNeighboursOnce) {
  EXPECT_THAT(nearest("fsp", {"fps", "fap"}), Optional(Eq("fps")));
}

TEST(Nearest, ForgivesCaseAndSeparators) {
  EXPECT_THAT(nearest("Sigma-PX", kNames), Optional(Eq("sigma_px")));
  EXPECT_THAT(nearest("hierarchical_grid", {"hierarchical-grid"}),
              Optional(Eq("hierarchical-grid")));
}

TEST(Nearest, FindsAPartOfAName) {
  EXPECT_THAT(nearest("sigma", {"weight", "sigma_px"}), Optional(Eq("sigma_px")));
  EXPECT_THAT(nearest("grid", {"gnn", "hierarchical-grid"}), Optional(Eq("hierarchical-grid")));
}

TEST(Nearest, IsSilentWhenNothingIsNear) {
  EXPECT_EQ(nearest("colour_space", kNames), std::nullopt);
  EXPECT_EQ(nearest("x", {"y"}), std::nullopt);
  EXPECT_EQ(nearest("ab", {"cd"}), std::nullopt);
  EXPECT_EQ(nearest("", kNames), std::nullopt);
  EXPECT_EQ(nearest("weight", {}), std::nullopt);
  EXPECT_EQ(nearest(std::string(100000, 'a'), {std::string(100000, 'b')}), std::nullopt);
}

TEST(Nearest, TiesGoToTheFirst) {
  EXPECT_THAT(nearest("cat", {"bat", "hat"}), Optional(Eq("bat")));
  EXPECT_THAT(nearest("cat", {"hat", "bat"}), Optional(Eq("hat")));
}

TEST(Nearest, PrefersTheNearerOverTheFirst) {
  EXPECT_THAT(nearest("sigma_mm", kNames), Optional(Eq("sigma_m")));
}

TEST(DidYouMean, IsAClauseOrNothing) {
  EXPECT_EQ(did_you_mean("sigma_pxx", kNames), "; did you mean \"sigma_px\"?");
  EXPECT_EQ(did_you_mean("zebra", kNames), "");
}

}  // namespace
}  // namespace plaza
