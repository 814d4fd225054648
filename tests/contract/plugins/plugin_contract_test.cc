// Every component that the build tree's plugins provide goes through the contract of its kind.
#include <gtest/gtest.h>

#include <cctype>
#include <iostream>

#include "framework/plugin/loader.h"
#include "plaza/contract/gtest.h"
#include "tests/contract/plugins/trials.h"
#include "tests/support/temporary_folder.h"

namespace plaza::contract {
namespace {

namespace fs = std::filesystem;

const Registry& registry() {
  static const Registry kRegistry = [] {
    Registry r;
    load_plugins({fs::path(PLAZA_BINARY_DIR) / "lib" / "plaza" / "plugins"}, r);
    return r;
  }();
  return kRegistry;
}

Subject subject_of_entry(const ComponentEntry& entry) {
  return {entry.declaration, [&entry](const nlohmann::json& values, const BuildContext& context) {
            return entry.create(values, context);
          }};
}

std::optional<Subject> find_subject(const std::string& name) {
  const ComponentEntry* entry = registry().find(name);
  if (entry == nullptr) return std::nullopt;
  return subject_of_entry(*entry);
}

std::vector<std::string> all_names() {
  std::vector<std::string> names;
  for (const ComponentEntry* entry : registry().all()) names.push_back(entry->declaration.name);
  return names;
}

TEST(PluginContractTest, NoPluginOfThisTreeIsRefused) {
  for (const RefusedPlugin& r : registry().refused()) {
    if (r.reason.find("left out of this build") != std::string::npos) {
      std::cout << "not looked at: " << r.library << ": " << r.reason << '\n';
      continue;
    }
    ADD_FAILURE() << r.library << ": " << r.reason;
  }
  EXPECT_FALSE(registry().all().empty());
}

class ComponentContractTest : public testing::TestWithParam<std::string> {};

TEST_P(ComponentContractTest, IsKept) {
  const test::TemporaryFolder files;
  const std::vector<Trial> trials = trials_of(GetParam(), files.path());
  ASSERT_FALSE(trials.empty()) << "no trial for component \"" << GetParam()
                               << "\": add one to the table in tests/contract/plugins/trials.cc";
  for (Trial trial : trials) {
    // a trial may bring doubles for what stands around the component
    trial.finder = [own = trial.finder](const std::string& name) -> std::optional<Subject> {
      std::optional<Subject> subject = own ? own(name) : std::nullopt;
      return subject ? subject : find_subject(name);
    };
    expect_kept(*find_subject(GetParam()), trial);
  }
}

INSTANTIATE_TEST_SUITE_P(Plugins, ComponentContractTest, testing::ValuesIn(all_names()),
                         [](const testing::TestParamInfo<std::string>& info) {
                           std::string name = info.param;
                           for (char& c : name) {
                             if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
                           }
                           return name;
                         });
// a build without plugins is told by the test above
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(ComponentContractTest);

}  // namespace
}  // namespace plaza::contract
