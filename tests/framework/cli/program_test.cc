// The command line as its users meet it: what is suggested, what is printed where, which status
// ends it.
#include <gmock/gmock.h>

#include "tests/support/program_in_process.h"

namespace plaza {
namespace {

using test::Outcome;
using test::run_in_process;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST(ProgramTest, HelpIsPrintedByOptionAndByCommand) {
  const Outcome option = run_in_process({"--help"});
  EXPECT_EQ(option.status, 0);
  EXPECT_THAT(option.out, AllOf(HasSubstr("Subcommands:"), HasSubstr("--plugin-path"),
                                HasSubstr("Exit status: 0 done, 2 the user's error")));
  const Outcome command = run_in_process({"help"});
  EXPECT_EQ(command.status, 0);
  EXPECT_EQ(command.out, option.out);
  EXPECT_EQ(command.errors, "");
}

TEST(ProgramTest, HelpExplainsACommand) {
  const Outcome help = run_in_process({"help", "run"});
  EXPECT_EQ(help.status, 0);
  for (const char* option :
       {"--set", "--frames", "--out", "--threads", "--quiet", "--progress", "--cache-dir"}) {
    EXPECT_THAT(help.out, HasSubstr(option));
  }
  EXPECT_EQ(run_in_process({"run", "--help"}).out, help.out);
}

TEST(ProgramTest, HelpOnAnUnknownTopicSuggests) {
  const Outcome help = run_in_process({"help", "rnu"});
  EXPECT_EQ(help.status, 2);
  EXPECT_EQ(help.errors, "plaza: unknown command \"rnu\"; did you mean \"run\"?\n");
}

TEST(ProgramTest, VersionIsOneLine) {
  const Outcome version = run_in_process({"--version"});
  EXPECT_EQ(version.status, 0);
  EXPECT_THAT(version.out, ::testing::MatchesRegex("plaza [0-9]+\\.[0-9]+\\.[0-9]+\n"));
}

TEST(ProgramTest, NoCommandIsTheUsersError) {
  const Outcome none = run_in_process({});
  EXPECT_EQ(none.status, 2);
  EXPECT_EQ(none.errors, "plaza: no command given; see: plaza help\n");
}

TEST(ProgramTest, AnUnknownCommandSuggestsTheNearest) {
  const Outcome unknown = run_in_process({"plugns"});
  EXPECT_EQ(unknown.status, 2);
  EXPECT_EQ(unknown.out, "");
  EXPECT_EQ(
      unknown.errors,
      "plaza: unknown command \"plugns\"; did you mean \"plugins\"?\nplaza: see: plaza help\n");
  EXPECT_THAT(run_in_process({"zzzzzzzz"}).errors,
              StartsWith("plaza: unknown command \"zzzzzzzz\"\n"));
}

TEST(ProgramTest, AnUnknownOptionSuggestsTheNearestOfItsCommand) {
  const Outcome unknown = run_in_process({"run", "p.json", "--thraeds", "3"});
  EXPECT_EQ(unknown.status, 2);
  EXPECT_EQ(unknown.errors,
            "plaza: unknown option \"--thraeds\" of \"plaza run\"; did you mean \"--threads\"?\n"
            "plaza: see: plaza help run\n");
  EXPECT_THAT(run_in_process({"run", "p.json", "--plugin-pth=x"}).errors,
              HasSubstr("did you mean \"--plugin-path\"?"));
  EXPECT_THAT(run_in_process({"--versio"}).errors, HasSubstr("did you mean \"--version\"?"));
}

TEST(ProgramTest, TooManyArgumentsAreNamed) {
  const Outcome many = run_in_process({"run", "a.json", "b.json"});
  EXPECT_EQ(many.status, 2);
  EXPECT_THAT(many.errors, StartsWith("plaza: unexpected argument \"b.json\" of \"plaza run\""));
}

TEST(ProgramTest, MissingArgumentsAndWrongValuesAreTheUsersErrors) {
  EXPECT_EQ(run_in_process({"run"}).status, 2);
  EXPECT_THAT(run_in_process({"run"}).errors,
              AllOf(HasSubstr("PIPELINE"), HasSubstr("plaza help run")));
  EXPECT_EQ(run_in_process({"run", "p.json", "--threads", "0"}).status, 2);
  EXPECT_EQ(run_in_process({"run", "p.json", "--threads", "two"}).status, 2);
  EXPECT_EQ(run_in_process({"run", "p.json", "--progress", "loud"}).status, 2);
}

TEST(ProgramTest, RangesOfFramesAreExplained) {
  for (const char* range : {"5", "5:5", "7:3", "a:b", "-1:3", "1:2:3", "1.5:2"}) {
    const Outcome outcome = run_in_process({"run", "p.json", std::string("--frames=") + range});
    EXPECT_EQ(outcome.status, 2) << range;
    EXPECT_THAT(outcome.errors, AllOf(StartsWith(std::string("plaza: --frames ") + range),
                                      HasSubstr("give A:B with 0 <= A < B")));
  }
}

TEST(ProgramTest, AMissingPipelineIsNamed) {
  const Outcome missing = run_in_process({"run", "nowhere/p.json"});
  EXPECT_EQ(missing.status, 2);
  EXPECT_THAT(missing.errors, AllOf(StartsWith("plaza: "), HasSubstr("nowhere/p.json")));
}

TEST(ProgramTest, ASetOptionTakesOneValueAndLeavesThePipelineAlone) {
  const Outcome outcome = run_in_process({"run", "--set", "/nodes/a/b=1", "nowhere/p.json"});
  EXPECT_THAT(outcome.errors, HasSubstr("nowhere/p.json"));
  EXPECT_THAT(outcome.errors, ::testing::Not(HasSubstr("PIPELINE")));
}

}  // namespace
}  // namespace plaza
