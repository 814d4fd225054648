#include "framework/plugin/loader.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include "plaza/core/error.h"
#include "plaza/version.h"
#include "tests/framework/plugin/fixture_paths.h"

namespace plaza {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;
namespace fs = std::filesystem;

std::vector<std::string> names(const Registry& registry) {
  std::vector<std::string> out;
  for (const ComponentEntry* entry : registry.all()) out.push_back(entry->declaration.name);
  return out;
}

/// Loads one fixture that must be refused; its reason.
std::string refusal_of(const fs::path& folder) {
  Registry registry;
  load_plugins({folder}, registry);
  EXPECT_THAT(names(registry), IsEmpty());
  if (registry.refused().size() != 1) return "(not one refused library)";
  EXPECT_EQ(registry.refused()[0].library.parent_path(), fs::canonical(folder));
  return registry.refused()[0].reason;
}
std::string refusal_of_fixture(const std::string& name) { return refusal_of(fixture_folder(name)); }
std::string refusal_of_content(const std::string& content) {
  const TemporaryFolder folder;
  folder.write("plaza_x.so", content);
  return refusal_of(folder.path());
}

TEST(LoaderTest, TellsWhatABuildLeftOutAndTheRemedy) {
  const TemporaryFolder folder;
  folder.write("plaza_ray_tracer.left-out", "Rays 3 was not found; install it and build again\n");
  Registry registry;
  load_plugins({folder.path()}, registry);
  ASSERT_EQ(registry.refused().size(), 1u);
  EXPECT_THAT(registry.explain_missing("ray-tracer", "source"),
              AllOf(StartsWith("\"ray-tracer\" would come from " + folder.path().string() +
                               "/plaza_ray_tracer.so"),
                    EndsWith("it was left out of this build: Rays 3 was not found; install it and "
                             "build again")));
}

TEST(LoaderTest, ANoteCountsOnlyWhileThePluginIsMissing) {
  const TemporaryFolder folder;
  folder.write("plaza_x.left-out", "no rays\n");
  folder.write("plaza_x.so", "text");
  Registry registry;
  load_plugins({folder.path()}, registry);
  ASSERT_EQ(registry.refused().size(), 1u);
  EXPECT_THAT(registry.refused()[0].reason, HasSubstr("is not an ELF shared library"));
}

TEST(LoaderTest, LoadsWhatAPluginRegisters) {
  Registry registry;
  load_plugins({fixture_folder("valid"), fixture_folder("second")}, registry);
  EXPECT_THAT(names(registry), ElementsAre("fixture-first", "fixture-other", "fixture-second"));
  EXPECT_THAT(registry.refused(), IsEmpty());
  EXPECT_THAT(registry.searched(), ElementsAre(fixture_folder("valid"), fixture_folder("second")));
  const ComponentEntry* entry = registry.find("fixture-first");
  ASSERT_NE(entry, nullptr);
  EXPECT_EQ(entry->library, fs::canonical(fixture_library("valid")));
  EXPECT_EQ(entry->declaration.kind, "describer");
}

TEST(LoaderTest, ObjectsOutliveTheRegistry) {
  std::shared_ptr<Component> component;
  {
    Registry registry;
    load_plugins({fixture_folder("valid")}, registry);
    component = registry.find("fixture-first")->create({{"sigma_m", 2.0}}, BuildContext());
  }
  ASSERT_NE(dynamic_cast<Describer*>(component.get()), nullptr);  // one type information for all
  EXPECT_THAT(component->check(), IsEmpty());
  component.reset();
}

TEST(LoaderTest, OlderSdkIsNamed) {
  EXPECT_EQ(refusal_of_fixture("old-version"),
            "built against the older SDK 0.0.9, this is SDK " PLAZA_VERSION
            "; rebuild the plugin against SDK " PLAZA_VERSION);
}
TEST(LoaderTest, NewerSdkIsNamedEvenWhereItsSymbolsAreMissing) {
  EXPECT_THAT(refusal_of_fixture("new-version"),
              AllOf(StartsWith("built against the newer SDK 9.9.0, this is SDK " PLAZA_VERSION),
                    EndsWith("or update plaza to 9.9.0")));
}
TEST(LoaderTest, AnotherAlignmentIsNamed) {
  EXPECT_THAT(
      refusal_of_fixture("wrong-alignment"),
      HasSubstr("built with Eigen alignment (EIGEN_MAX_ALIGN_BYTES) 32, wanted 16; rebuild the "
                "plugin with the value that Plaza::sdk sets"));
}
TEST(LoaderTest, UndefinedSymbolKeepsTheLoadersText) {
  EXPECT_THAT(refusal_of_fixture("undefined-symbol"),
              AllOf(StartsWith("can't be loaded: "), HasSubstr("undefined symbol"),
                    HasSubstr("sdk_function_of_another_version")));
}
TEST(LoaderTest, LibraryWithoutEntryIsToldHowToMakeOne) {
  EXPECT_EQ(refusal_of_fixture("no-entry"),
            "has no entry: the symbol plaza_plugin_descriptor is missing; define it with "
            "PLAZA_PLUGIN(registrar) { ... } of plaza/plugin.h");
}
TEST(LoaderTest, EntryThatRegistersNothing) {
  EXPECT_THAT(refusal_of_fixture("no-component"), StartsWith("registers no component"));
}
TEST(LoaderTest, ThrowingEntryGivesItsWordsAndNoComponent) {
  EXPECT_EQ(refusal_of_fixture("throwing"),
            "failed to register its components: the licence server is on holiday");
  EXPECT_EQ(refusal_of_fixture("throwing-number"),
            "failed to register its components: threw something that is no std::exception");
}
TEST(LoaderTest, HeadOfTheDescriptorIsChecked) {
  EXPECT_EQ(
      refusal_of_fixture("wrong-layout"),
      "its descriptor has layout 999, wanted 2; rebuild the plugin against SDK " PLAZA_VERSION);
  EXPECT_THAT(refusal_of_fixture("wrong-size"), StartsWith("its descriptor has 24 bytes, wanted "));
  EXPECT_THAT(refusal_of_fixture("wrong-magic"), HasSubstr("no descriptor of a Plaza plugin"));
}
TEST(LoaderTest, InvalidAndRepeatedNamesWithinALibrary) {
  EXPECT_THAT(refusal_of_fixture("invalid-name"), HasSubstr("invalid name \"Fixture Loud\""));
  EXPECT_THAT(refusal_of_fixture("twice"),
              HasSubstr("component \"fixture-same\" is provided twice"));
}

TEST(LoaderTest, DuplicateNamesBothLibrariesAndAddsNothing) {
  Registry registry;
  load_plugins({fixture_folder("valid"), fixture_folder("duplicate")}, registry);
  EXPECT_THAT(names(registry), ElementsAre("fixture-first", "fixture-other"));
  ASSERT_EQ(registry.refused().size(), 1U);
  const RefusedPlugin& refused = registry.refused()[0];
  EXPECT_THAT(refused.reason,
              AllOf(HasSubstr("\"fixture-first\" is provided twice"),
                    HasSubstr(fs::canonical(fixture_library("valid")).string()),
                    HasSubstr(fs::canonical(fixture_library("duplicate")).string())));
  EXPECT_THAT(refused.provides, ElementsAre("fixture-fresh", "fixture-first"));
  EXPECT_THAT(registry.explain_missing("fixture-fresh", "describer"),
              AllOf(HasSubstr(fs::canonical(fixture_library("duplicate")).string()),
                    HasSubstr("which was refused: ")));
}

TEST(LoaderTest, FilesThatAreNoLibraries) {
  EXPECT_EQ(refusal_of_content(""), "is an empty file; build or copy it again");
  EXPECT_EQ(refusal_of_content("#!/bin/sh\n"),
            "is not an ELF shared library; build or copy it again");
  EXPECT_THAT(refusal_of_content("\x7f"), StartsWith("is not an ELF shared library"));
  // a copy that was cut off
  EXPECT_THAT(refusal_of_content("\x7f"
                                 "ELF and then nothing"),
              StartsWith("can't be loaded: "));
}

TEST(LoaderTest, FolderAndBrokenLinkNamedLikeALibrary) {
  const TemporaryFolder a, b;
  a.folder("plaza_x.so");
  EXPECT_EQ(refusal_of(a.path()), "is a folder, not a library");
  fs::create_symlink("nowhere.so", b.path() / "plaza_x.so");
  EXPECT_THAT(refusal_of(b.path()), StartsWith("can't be read: "));
}

TEST(LoaderTest, UnreadableFile) {
  if (geteuid() == 0) GTEST_SKIP() << "root reads everything";
  const TemporaryFolder folder;
  fs::permissions(folder.write("plaza_x.so", "x"), fs::perms::none);
  EXPECT_EQ(refusal_of(folder.path()), "can't be read: Permission denied");
}

TEST(LoaderTest, OnlyFilesNamedLikePluginsAreLookedAt) {
  const TemporaryFolder folder;
  for (const char* name : {"libplaza_x.so", "plaza_x.so.1", "plaza_x.txt", "x.so", "plaza.so"}) {
    folder.write(name, "no library");
  }
  EXPECT_THAT(find_plugins({folder.path()}), IsEmpty());
}

TEST(LoaderTest, OrderDoesNotDependOnTheFileSystem) {
  const TemporaryFolder folder;
  for (const char* name : {"plaza_c.so", "plaza_a.so", "plaza_b.so"}) folder.write(name, "");
  Registry registry;
  load_plugins({folder.path()}, registry);
  std::vector<std::string> order;
  for (const RefusedPlugin& r : registry.refused()) order.push_back(r.library.filename());
  EXPECT_THAT(order, ElementsAre("plaza_a.so", "plaza_b.so", "plaza_c.so"));
}

TEST(LoaderTest, LinksAreTheSameLibrary) {
  const TemporaryFolder folder;
  fs::create_symlink(fixture_library("valid"), folder.path() / "plaza_link.so");
  fs::create_symlink(fixture_folder("valid"), folder.path() / "linked");
  Registry registry;
  load_plugins({fixture_folder("valid"), folder.path(), folder.path() / "linked"}, registry);
  EXPECT_THAT(names(registry), ElementsAre("fixture-first", "fixture-other"));
  EXPECT_THAT(registry.refused(), IsEmpty());
}

TEST(LoaderTest, ARefusedLibraryIsReportedOnce) {
  const TemporaryFolder folder;
  folder.write("plaza_x.so", "");
  fs::create_symlink(folder.path() / "plaza_x.so", folder.path() / "plaza_y.so");
  Registry registry;
  load_plugins({folder.path()}, registry);
  EXPECT_EQ(registry.refused().size(), 1U);
}

TEST(LoaderTest, TheFirstOfTwoCopiesIsUsed) {
  const TemporaryFolder folder;
  fs::copy_file(fixture_library("valid"), folder.path() / "plaza_valid.so");
  Registry registry;
  load_plugins({folder.path(), fixture_folder("valid")}, registry);
  EXPECT_EQ(registry.find("fixture-first")->library, folder.path() / "plaza_valid.so");
  ASSERT_EQ(registry.refused().size(), 1U);
  EXPECT_EQ(
      registry.refused()[0].reason,
      "is hidden by " + (folder.path() / "plaza_valid.so").string() + ", which was found first");
}

TEST(LoaderTest, ARefusedLibraryLeavesTheOthersInUse) {
  const TemporaryFolder folder;
  folder.write("plaza_a.so", "");
  fs::create_symlink(fixture_library("second"), folder.path() / "plaza_b.so");
  Registry registry;
  load_plugins({folder.path(), fixture_folder("throwing"), fixture_folder("valid")}, registry);
  EXPECT_THAT(names(registry), ElementsAre("fixture-first", "fixture-other", "fixture-second"));
  EXPECT_EQ(registry.refused().size(), 2U);
}

TEST(LoaderTest, PresumesNamesOfLibrariesThatCantBeAsked) {
  EXPECT_THAT(presumed_components("/x/plaza_min_cost_flow.so"), ElementsAre("min-cost-flow"));
  EXPECT_THAT(presumed_components("/x/other.so"), ElementsAre("other"));
}

}  // namespace
}  // namespace plaza
