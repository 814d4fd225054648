// Features: describers that give them wrongly, and terms that compare loaded ones otherwise.
#include <cmath>
#include <string>

#include "tests/contract/suite/misbehaving.h"

namespace plaza::contract {
namespace {

/// Where somebody stood, in whole millimetres; spoils on request how it is kept.
struct Place final : FeatureOf<Place> {
  static constexpr std::string_view kFeature = "place";
  static inline std::string fault;

  explicit Place(std::string t) : text(std::move(t)) {}
  static std::shared_ptr<const Place> load(std::string_view bytes) {
    if (fault == "forgets") return std::make_shared<Place>("0;");
    if (fault == "nothing") return nullptr;
    if (fault == "refuses") throw UserError("no");
    if (bytes.empty() || bytes.back() != ';' || bytes.find(';') + 1 != bytes.size()) {
      if (fault == "repairs") return std::make_shared<Place>("0;");
      if (fault == "foreign") throw std::out_of_range("there is no end");
      throw UserError("these bytes are no place");
    }
    auto place = std::make_shared<Place>(std::string(bytes));
    place->loaded = true;
    return place;
  }
  std::optional<std::string> do_save() const override {
    if (fault == "unsaved") return std::nullopt;
    if (fault == "saving") throw std::out_of_range("there is nothing");
    return text;
  }
  std::string text;
  bool loaded = false;
};

struct Stray final : FeatureOf<Stray> {
  static constexpr std::string_view kFeature = "stray";
};

class WhereAbouts final : public Describer {
 public:
  using Options = Fault;
  static Declaration<Options> declare() {
    Declaration<Options> d("where-abouts", "Remembers places");
    d.input<Observations>("people").output<Observations>("the same, with places");
    d.feature<Place>("where they stand").parameters(fault_parameter());
    return d;
  }
  WhereAbouts(const Options& options, const BuildContext&) : fault_(options.fault) {
    Place::fault = fault_;
  }

 protected:
  void do_describe(const NodeIo&, Observations& observations) override {
    for (Observation& o : observations.items) {
      const long mm = std::lround(1000 * o.position_m.x());
      o.features.set(std::make_shared<Place>(std::to_string(mm) + ";"));
      if (fault_ == "random") {
        o.features.set(std::make_shared<Place>(std::to_string(++calls_) + ";"));
      }
      if (fault_ == "stray") o.features.set(std::make_shared<Stray>());
    }
  }

 private:
  std::string fault_;
  static inline int calls_ = 0;
};

TEST(FeatureContractTest, EachBrokenPromiseIsCaught) {
  expect_caught<WhereAbouts>({
      {"stray", "gives features \"stray\" that it does not declare"},
      {"unsaved", "features \"place\" have one of save() and load() without the other"},
      {"saving", "save() of a feature \"place\" threw: there is nothing"},
      {"refuses", "load() of a saved feature \"place\" threw: no"},
      {"nothing", "load() of features \"place\" gives none of them"},
      {"forgets", "a feature \"place\" that was loaded saves other bytes"},
      {"repairs", "load() takes damaged bytes of a feature \"place\" for whole"},
      {"foreign", "load() of damaged bytes of a feature \"place\" must throw plaza::Error"},
      {"random", "the same input gives another output"},
  });
}

/// Compares places.
class SamePlace final : public AffinityTerm {
 public:
  using Options = Fault;
  static Declaration<Options> declare() {
    return Declaration<Options>("same-place", "Compares places").parameters(fault_parameter());
  }
  SamePlace(const Options& options, const BuildContext&) : fault_(options.fault) {}

 protected:
  void do_evaluate(const AffinityEnd& from, std::span<const AffinityEnd> to,
                   std::span<double> out) const override {
    const auto* const a = from.observation->features.get<Place>();
    for (std::size_t i = 0; i < to.size(); ++i) {
      const auto* const b = to[i].observation->features.get<Place>();
      out[i] = a != nullptr && b != nullptr && a->text != b->text ? -1 : 0;
      if (fault_ == "loaded" && a != nullptr && a->loaded) out[i] -= 1;
      if (fault_ == "missing" && (a == nullptr || b == nullptr)) out[i] = -3;
    }
  }

 private:
  std::string fault_;
};

Trial with_describer(const std::string& fault) {
  Trial trial;
  trial.values = {{"fault", fault}};
  trial.describers = {{{"use", "where-abouts"}}};
  trial.finder = [](const std::string& name) -> std::optional<Subject> {
    if (name != "where-abouts") return std::nullopt;
    return subject_of<WhereAbouts>();
  };
  return trial;
}

TEST(FeatureContractTest, TermsCompareWhatWasLoadedAsWhatWasSaved) {
  const Subject term = subject_of<SamePlace>();
  EXPECT_THAT(violations(term, with_describer("")), testing::IsEmpty());
  EXPECT_THAT(violations(term, with_describer("loaded")),
              testing::ElementsAre("features that were saved and loaded have another affinity"));
  EXPECT_THAT(violations(term, with_describer("missing")),
              testing::ElementsAre("the term is not 0 though its cue is missing"));
}

}  // namespace
}  // namespace plaza::contract
