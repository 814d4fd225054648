#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/framework/plugin/fixture_paths.h"
#include "tests/support/program_in_process.h"

namespace plaza {
namespace {

using test::Outcome;
using test::run_in_process;
using testing::AllOf;
using testing::HasSubstr;

TEST(PluginsCommandTest, TableOfLibrariesComponentsAndRefusals) {
  const Outcome o = run_in_process({"plugins", "--plugin-path", fixture_folder("valid").string(),
                                    "--plugin-path", fixture_folder("throwing").string()});
  EXPECT_EQ(o.status, 0);
  EXPECT_THAT(o.out,
              AllOf(HasSubstr(fixture_library("valid").string() + "\n"), HasSubstr("fixture-first"),
                    HasSubstr("Leaves observations as they are"),
                    HasSubstr("refused:\n  " + fixture_library("throwing").string() +
                              "\n    failed to register its components: the licence server"),
                    HasSubstr("searched, in this order:\n  " + fixture_folder("valid").string())));
}

TEST(PluginsCommandTest, ACrashingPluginIsALineInTheTable) {
  const Outcome o =
      run_in_process({"plugins", "--plugin-path", fixture_folder("crashing").string()});
  EXPECT_EQ(o.status, 0);
  EXPECT_THAT(o.out,
              AllOf(HasSubstr(fixture_library("crashing").string()), HasSubstr("while loading")));
}

TEST(PluginsCommandTest, Json) {
  const Outcome o =
      run_in_process({"plugins", "--json", "--plugin-path", fixture_folder("valid").string(),
                      "--plugin-path", fixture_folder("old-version").string()});
  const nlohmann::json j = nlohmann::json::parse(o.out);
  bool found = false;
  for (const auto& library : j["libraries"]) {
    if (library["library"] != fixture_library("valid").string()) continue;
    found = true;
    EXPECT_EQ(library["components"][0]["name"], "fixture-first");
    EXPECT_EQ(library["components"][0]["kind"], "describer");
  }
  EXPECT_TRUE(found);
  EXPECT_EQ(j["refused"][0]["library"], fixture_library("old-version").string());
  EXPECT_THAT(j["refused"][0]["reason"].get<std::string>(), HasSubstr("older SDK 0.0.9"));
  EXPECT_EQ(j["searched"][0]["folder"], fixture_folder("valid").string());
}

TEST(PluginsCommandTest, ProbeSaysByItsStatusWhetherALibraryCanBeUsed) {
  Outcome o = run_in_process({"plugins", "--probe", fixture_library("valid").string()});
  EXPECT_EQ(o.status, 0);
  EXPECT_EQ(o.out, fixture_library("valid").string() +
                       ": usable: describer fixture-first, describer fixture-other\n");
  o = run_in_process({"plugins", "--probe", fixture_library("crashing").string()});
  EXPECT_EQ(o.status, 2);
  EXPECT_THAT(o.out, HasSubstr("while loading"));
  o = run_in_process({"plugins", "--json", "--probe", fixture_library("no-entry").string()});
  EXPECT_EQ(o.status, 2);
  const nlohmann::json j = nlohmann::json::parse(o.out);
  EXPECT_EQ(j["usable"], false);
  EXPECT_THAT(j["report"].get<std::string>(), HasSubstr("has no entry"));
}

TEST(PluginsCommandTest, PrintsOfAProbedLibraryDoNotSpoilTheAnswer) {
  const Outcome o =
      run_in_process({"plugins", "--json", "--probe", fixture_library("exiting").string()});
  EXPECT_EQ(nlohmann::json::parse(o.out)["report"],
            "ended the process with status 7 while loading");
}

TEST(PluginsCommandTest, AMissingFolderIsTheUsersError) {
  const Outcome o = run_in_process({"plugins", "--plugin-path", "/nowhere"});
  EXPECT_EQ(o.status, 2);
  EXPECT_THAT(o.errors, HasSubstr("/nowhere does not exist"));
}

}  // namespace
}  // namespace plaza
