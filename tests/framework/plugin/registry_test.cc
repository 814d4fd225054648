#include "framework/plugin/registry.h"

#include <gmock/gmock.h>

#include "plaza/core/error.h"

namespace plaza {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

class Counted : public Component {
 public:
  explicit Counted(int& alive) : alive_(alive) { ++alive_; }
  ~Counted() override { --alive_; }

 private:
  int& alive_;
};

ComponentEntry entry(const std::string& name, const std::string& kind,
                     const std::string& library = {}) {
  ComponentEntry e;
  e.declaration.name = name;
  e.declaration.kind = kind;
  e.library = library;
  return e;
}

Registry small_registry() {
  Registry registry;
  registry.add(entry("hog", "detector", "/p/plaza_hog.so"));
  registry.add(entry("boxes", "detector", "/p/plaza_boxes.so"));
  registry.add(entry("gnn", "associator", "/p/plaza_gnn.so"));
  return registry;
}

template <class F>
std::string user_error(F&& body) {
  try {
    body();
  } catch (const UserError& error) {
    return error.what();
  }
  return "(no UserError)";
}

TEST(RegistryTest, ListsByNameAndKind) {
  const Registry registry = small_registry();
  std::vector<std::string> names;
  for (const ComponentEntry* e : registry.all("detector")) names.push_back(e->declaration.name);
  EXPECT_THAT(names, ElementsAre("boxes", "hog"));
  EXPECT_EQ(registry.all().size(), 3U);
  EXPECT_EQ(registry.find("nothing"), nullptr);
}

TEST(RegistryTest, NamesAndKindsAreChecked) {
  for (const char* name : {"", "Hog", "hog_2", "-hog", "hog-", "2d", "a--b", "a b", "h\xc3\xb6g"}) {
    Registry registry;
    EXPECT_THAT(user_error([&] { registry.add(entry(name, "detector")); }),
                HasSubstr("invalid name"))
        << name;
  }
  for (const char* name : {"a", "hog", "hog-2", "min-cost-flow"}) {
    Registry registry;
    registry.add(entry(name, "detector"));
    EXPECT_NE(registry.find(name), nullptr);
  }
  Registry registry;
  EXPECT_THAT(user_error([&] { registry.add(entry("x", "detectors")); }),
              AllOf(HasSubstr("unknown kind \"detectors\""), HasSubstr("kinds are source, ")));
}

TEST(RegistryTest, DuplicatesNameBothLibraries) {
  Registry registry = small_registry();
  EXPECT_EQ(
      user_error([&] { registry.add(entry("hog", "source", "/q/plaza_fast.so")); }),
      "component \"hog\" is provided twice: by /p/plaza_hog.so and by /q/plaza_fast.so; remove "
      "one of the libraries or rename one of the components");
  EXPECT_THAT(user_error([&] { registry.add(entry("hog", "source")); }),
              HasSubstr("the program itself"));
}

TEST(RegistryTest, ALibraryIsAddedWholeOrNotAtAll) {
  Registry registry = small_registry();
  EXPECT_THAT(user_error([&] {
                registry.add_all({entry("new", "source"), entry("gnn", "associator")});
              }),
              HasSubstr("\"gnn\" is provided twice"));
  EXPECT_EQ(registry.find("new"), nullptr);
  registry.add_all({entry("new", "source"), entry("newer", "source")});
  EXPECT_NE(registry.find("newer"), nullptr);
}

TEST(RegistryTest, CreatedComponentsHoldTheirLibrary) {
  int alive = 0;
  ComponentEntry e = entry("counted", "sink");
  const auto library = std::make_shared<int>(1);
  e.library_handle = library;
  e.factory = [&alive](const nlohmann::json&, const BuildContext&) {
    return std::make_unique<Counted>(alive);
  };
  std::shared_ptr<Component> component = e.create({}, BuildContext());
  e = ComponentEntry();
  EXPECT_EQ(alive, 1);
  EXPECT_EQ(library.use_count(), 2);
  component.reset();
  EXPECT_EQ(alive, 0);
  EXPECT_EQ(library.use_count(), 1);
}

TEST(RegistryTest, AFactoryMustMakeSomething) {
  ComponentEntry e = entry("empty", "sink");
  e.factory = [](const nlohmann::json&, const BuildContext&) { return nullptr; };
  EXPECT_THROW(e.create({}, BuildContext()), InternalError);
}

TEST(ExplainMissingTest, NearestNameOfTheKind) {
  EXPECT_EQ(small_registry().explain_missing("hogg", "detector"),
            "unknown detector \"hogg\"; did you mean \"hog\"?");
}
TEST(ExplainMissingTest, KindThatItHasInstead) {
  EXPECT_EQ(small_registry().explain_missing("gnn", "detector"),
            "\"gnn\" is an associator, not a detector; known are boxes, hog");
}
TEST(ExplainMissingTest, NearestNameOfAnotherKind) {
  EXPECT_EQ(small_registry().explain_missing("gnnn", "detector"),
            "unknown detector \"gnnn\"; \"gnn\" is an associator; known are boxes, hog");
}
TEST(ExplainMissingTest, FarFromEverything) {
  EXPECT_EQ(small_registry().explain_missing("retinanet", "detector"),
            "unknown detector \"retinanet\"; known are boxes, hog");
}
TEST(ExplainMissingTest, LibraryThatWouldHaveProvidedIt) {
  Registry registry = small_registry();
  registry.add_refused({"/p/plaza_hog_fast.so", "is an empty file", {"hog-fast"}});
  EXPECT_EQ(
      registry.explain_missing("hog-fast", "detector"),
      "\"hog-fast\" would come from /p/plaza_hog_fast.so, which was refused: is an empty file");
  EXPECT_THAT(registry.explain_missing("retinanet", ""),
              HasSubstr("refused libraries (see `plaza plugins`): /p/plaza_hog_fast.so"));
}
TEST(ExplainMissingTest, NeverAnEmptyList) {
  Registry registry = small_registry();
  registry.add_searched("/p");
  EXPECT_EQ(registry.explain_missing("x", "sink"),
            "unknown sink \"x\"; no library that was loaded provides a sink; searched /p");
  EXPECT_THAT(Registry().explain_missing("x", ""), HasSubstr("give one with --plugin-path"));
}

}  // namespace
}  // namespace plaza
