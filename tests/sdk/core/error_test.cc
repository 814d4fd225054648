#include "plaza/core/error.h"

#include <gtest/gtest.h>

namespace plaza {
namespace {

TEST(ErrorTest, InnermostContextWins) {
  UserError error("broken");
  error.add_context({"detector", 11, ""});
  error.add_context({"run", 99, "view1"});
  EXPECT_EQ(error.context(), (FaultContext{"detector", 11, "view1"}));
  EXPECT_STREQ(error.what(), "broken");
}

TEST(ErrorTest, ContextCountsFramesAsFilesDo) {
  EXPECT_EQ(to_string(FaultContext{"detector", 11, "view1"}),
            "node 'detector', frame 12, camera 'view1'");
  EXPECT_EQ(to_string(FaultContext{"", 0, ""}), "frame 1");
  EXPECT_EQ(to_string(FaultContext{"a", std::nullopt, "c"}), "node 'a', camera 'c'");
  EXPECT_EQ(to_string(FaultContext{}), "");
}

TEST(ErrorTest, UserErrorKeepsEveryDiagnostic) {
  const Diagnostics both{{{"a", 1, 2}, "/x", "one"}, {{"b", 3, 4}, "", "two"}};
  const UserError error(both);
  EXPECT_EQ(error.diagnostics(), both);
  EXPECT_STREQ(error.what(), "a:1:2: /x: one\nb:3:4: two");
  ASSERT_EQ(UserError("plain").diagnostics().size(), 1u);
  EXPECT_EQ(UserError("plain").diagnostics()[0].message, "plain");
  EXPECT_EQ(UserError(both[1]).diagnostics(), Diagnostics{both[1]});
}

TEST(ErrorTest, UserErrorWithoutADiagnosticIsAMistakeOfTheCaller) {
  EXPECT_THROW(UserError(Diagnostics{}), std::invalid_argument);
}

TEST(ErrorTest, TheTwoKindsAreToldApartAndShareABase) {
  const auto thrown = [](const auto& error) {
    try {
      throw error;
    } catch (const UserError&) {
      return 'u';
    } catch (const InternalError&) {
      return 'i';
    } catch (const Error&) {
      return 'e';
    }
  };
  EXPECT_EQ(thrown(UserError("a")), 'u');
  EXPECT_EQ(thrown(InternalError("a")), 'i');
  EXPECT_EQ(thrown(Error("a")), 'e');
}

}  // namespace
}  // namespace plaza
