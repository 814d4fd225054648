#include "plaza/data/feature.h"

#include <gtest/gtest.h>

#include <memory>

namespace plaza {
namespace {

struct Colour final : FeatureOf<Colour> {
  static constexpr std::string_view kFeature = "colour";
  explicit Colour(int v) : value(v) {}
  int value;
};
struct Heading final : FeatureOf<Heading> {
  static constexpr std::string_view kFeature = "heading";
};

TEST(FeatureSetTest, FindsByTypeAndKnowsWhatIsMissing) {
  FeatureSet features;
  EXPECT_TRUE(features.empty());
  EXPECT_EQ(features.get<Colour>(), nullptr);
  features.set(std::make_shared<Colour>(3));
  ASSERT_NE(features.get<Colour>(), nullptr);
  EXPECT_EQ(features.get<Colour>()->value, 3);
  EXPECT_EQ(features.get<Colour>()->name(), "colour");
  EXPECT_EQ(features.get<Heading>(), nullptr);
}

TEST(FeatureSetTest, SettingAgainReplaces) {
  FeatureSet features;
  features.set(std::make_shared<Colour>(3));
  features.set(std::make_shared<Heading>());
  features.set(std::make_shared<Colour>(4));
  EXPECT_EQ(features.size(), 2u);
  EXPECT_EQ(features.get<Colour>()->value, 4);
  EXPECT_NE(features.get<Heading>(), nullptr);
}

TEST(FeatureSetTest, CopiesShareFeaturesButNotTheSet) {
  FeatureSet features;
  features.set(std::make_shared<Colour>(3));
  FeatureSet copy = features;
  EXPECT_EQ(copy.get<Colour>(), features.get<Colour>());
  copy.set(std::make_shared<Colour>(4));
  EXPECT_EQ(features.get<Colour>()->value, 3);
}

}  // namespace
}  // namespace plaza
