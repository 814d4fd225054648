#include "features.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "plaza/core/error.h"
#include "plaza/data/track.h"

namespace plaza::contract {
namespace {

// features are checked one by one; one type's first ones say what the type does
constexpr int kTried = 5;
constexpr std::size_t kLongestCut = 256;

const FeatureSpec* find_spec(const std::vector<FeatureSpec>& specs, std::string_view name) {
  const auto it = std::find_if(specs.begin(), specs.end(),
                               [name](const FeatureSpec& spec) { return spec.name == name; });
  return it == specs.end() ? nullptr : &*it;
}

bool carries(const FeatureSet* features, const Feature& feature) {
  return features != nullptr &&
         std::any_of(features->all().begin(), features->all().end(),
                     [&feature](const auto& other) { return other.get() == &feature; });
}

}  // namespace

void FeatureCheck::look_at(const Payload& given, const Payload* received) {
  if (const auto* observations = dynamic_cast<const Observations*>(&given)) {
    const auto* before = dynamic_cast<const Observations*>(received);
    for (std::size_t i = 0; i < observations->items.size(); ++i) {
      const bool paired = before != nullptr && i < before->items.size();
      check(observations->items[i].features, paired ? &before->items[i].features : nullptr);
    }
  } else if (const auto* tracklets = dynamic_cast<const Tracklets*>(&given)) {
    for (const Tracklet& tracklet : tracklets->items) check(tracklet.features, nullptr);
  }
}

void FeatureCheck::check(const FeatureSet& features, const FeatureSet* received) {
  for (const auto& feature : features.all()) {
    if (!carries(received, *feature)) check(*feature);
  }
}

void FeatureCheck::check(const Feature& feature) {
  const std::string name(feature.name());
  if (++seen_[name] > kTried) return;
  const FeatureSpec* const spec = find_spec(declaration_->features, name);
  if (spec == nullptr) {
    findings_->add("gives features \"" + name + "\" that it does not declare");
    return;
  }
  std::optional<std::string> bytes;
  if (!findings_->step("save() of a feature \"" + name + "\"", [&] { bytes = feature.save(); })) {
    return;
  }
  if (bytes.has_value() != (spec->load != nullptr)) {
    findings_->add("features \"" + name + "\" have one of save() and load() without the other");
  } else if (bytes) {
    check_load(*spec, *bytes);
    check_damaged(*spec, *bytes);
  }
}

void FeatureCheck::check_load(const FeatureSpec& spec, const std::string& bytes) {
  findings_->step("load() of a saved feature \"" + spec.name + "\"", [&] {
    const auto loaded = spec.load(bytes);
    if (!loaded || loaded->name() != spec.name) {
      findings_->add("load() of features \"" + spec.name + "\" gives none of them");
    } else if (loaded->save() != bytes) {
      findings_->add("a feature \"" + spec.name + "\" that was loaded saves other bytes");
    }
  });
}

/// A disk may give back anything: load() refuses it, or makes a feature of just these bytes.
void FeatureCheck::check_damaged(const FeatureSpec& spec, std::string_view bytes) {
  std::vector<std::string> damaged = {std::string(bytes) + "x"};
  for (std::size_t cut = 0; cut < std::min(bytes.size(), kLongestCut); ++cut) {
    damaged.emplace_back(bytes.substr(0, cut));
  }
  for (const std::string& text : damaged) {
    try {
      const auto loaded = spec.load(text);
      if (!loaded || loaded->save() != text) {
        findings_->add("load() takes damaged bytes of a feature \"" + spec.name + "\" for whole");
      }
    } catch (const Error&) {
    } catch (const std::exception& error) {
      findings_->add("load() of damaged bytes of a feature \"" + spec.name +
                     "\" must throw plaza::Error, threw: " + error.what());
    }
  }
}

Described describe_world(const Stage& stage, std::int64_t frames) {
  Described described;
  for (std::int64_t frame = 0; frame < frames; ++frame) {
    described.frames.push_back(stage.world().observations(frame));
  }
  for (const nlohmann::json& describer : stage.trial().describers) {
    const std::string use = describer.at("use").get<std::string>();
    const auto subject = stage.trial().finder ? stage.trial().finder(use) : std::nullopt;
    if (!subject) throw InternalError("Trial::finder knows no \"" + use + "\", a describer");
    Trial trial = stage.trial();
    trial.values = describer;
    trial.values.erase("use");
    const Stage inner(*subject, trial, stage.output_folder());
    const auto node = inner.make_as<Describer>();
    for (std::int64_t frame = 0; frame < frames; ++frame) {
      Observations& items = described.frames[static_cast<std::size_t>(frame)];
      const Provider provider = [&](const std::string& port, std::int64_t at) -> PayloadPtr {
        if (port == Observations::kPort) return std::make_shared<Observations>(items);
        return stage.world().payload(port, at);
      };
      const auto call = inner.call(frame, provider);
      items = node->describe(call->io());
    }
    const auto& features = subject->declaration.features;
    described.features.insert(described.features.end(), features.begin(), features.end());
  }
  return described;
}

Observation with_loaded_features(const Observation& observation,
                                 const std::vector<FeatureSpec>& features) {
  Observation loaded = observation;
  for (const auto& feature : observation.features.all()) {
    const FeatureSpec* const spec = find_spec(features, feature->name());
    const auto bytes = feature->save();
    if (spec != nullptr && spec->load != nullptr && bytes) loaded.features.set(spec->load(*bytes));
  }
  return loaded;
}

}  // namespace plaza::contract
