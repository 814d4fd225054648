#include "framework/results/branches.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/execution_fixture.h"

namespace plaza {
namespace {

using nlohmann::json;

class BranchesTest : public test::RunFixture {
 protected:
  std::vector<Branch> branches(const json& nodes) { return find_branches(read(nodes)); }

  const json source_ = {{"use", "test-source"}, {"name", "cameras"}};
  const json detector_ = {{"use", "test-detector"}, {"name", "detector"}};
  const json describer_ = {{"use", "test-describer"}, {"name", "describer"}};
  static json named(const std::string& use, const std::string& name, const std::string& from = "") {
    json node = {{"use", use}, {"name", name}};
    if (!from.empty()) node["from"] = from;
    return node;
  }
};

TEST_F(BranchesTest, TheLastTracksAreTheMainAnswer) {
  const auto found =
      branches({source_, detector_, named("test-associator", "first"), named("test-scores", "s1"),
                describer_, named("test-associator", "last"), named("test-scores", "s2"),
                named("test-scores", "s3", "first")});
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].name, "last");
  EXPECT_EQ(found[0].tracks->node, 5);
  EXPECT_EQ(found[0].observations->node, 4);
  EXPECT_THAT(found[0].evaluators, ::testing::ElementsAre(6));
  EXPECT_EQ(found[1].name, "first");
  EXPECT_EQ(found[1].observations->node, 1);
  EXPECT_THAT(found[1].evaluators, ::testing::ElementsAre(3, 7));
}

TEST_F(BranchesTest, WithoutTracksTheLastObservationsAreTheAnswer) {
  const auto found = branches({source_, detector_, describer_});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].name, "describer");
  EXPECT_FALSE(found[0].tracks);
  EXPECT_EQ(found[0].observations->node, 2);
}

TEST_F(BranchesTest, ASourceAloneHasABranchWithNothing) {
  const auto found = branches(json::array({source_}));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_FALSE(found[0].tracks);
  EXPECT_FALSE(found[0].observations);
}

}  // namespace
}  // namespace plaza
