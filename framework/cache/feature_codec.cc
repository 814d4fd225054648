#include "framework/cache/feature_codec.h"

#include <optional>

#include "framework/execution/guard.h"
#include "plaza/core/error.h"

namespace plaza {
namespace {

constexpr std::size_t kLeastBytes = 16;  // of a feature: two lengths

void add_loaders(const ResolvedPart& part, FeatureLoaders& loaders) {
  for (const FeatureSpec& feature : part.entry->declaration.features) {
    if (feature.load != nullptr) loaders.emplace(feature.name, feature.load);
  }
  for (const auto& [parameter, parts] : part.parts) {
    for (const ResolvedPart& nested : parts) add_loaders(nested, loaders);
  }
}

}  // namespace

FeatureLoaders feature_loaders(const ResolvedPipeline& pipeline) {
  FeatureLoaders loaders;
  for (const ResolvedNode& node : pipeline.nodes) add_loaders(node, loaders);
  return loaders;
}

bool put_features(ByteWriter& out, const FeatureSet& features, const FeatureLoaders& loaders) {
  out.word(features.size());
  for (const auto& feature : features.all()) {
    const std::string name(feature->name());
    if (!loaders.contains(name)) return false;
    const auto bytes =
        guarded("feature '" + name + "'", std::nullopt, [&] { return feature->save(); });
    if (!bytes) return false;
    out.text(name);
    out.text(*bytes);
  }
  return true;
}

FeatureSet features_of(ByteReader& in, const FeatureLoaders& loaders) {
  FeatureSet features;
  for (std::size_t i = in.count(kLeastBytes); i > 0; --i) {
    const std::string name(in.text());
    const std::string_view bytes = in.text();
    const auto loader = loaders.find(name);
    if (loader == loaders.end()) in.fail("holds features \"" + name + "\" that nobody can read");
    std::shared_ptr<const Feature> feature;
    try {
      feature =
          guarded("feature '" + name + "'", std::nullopt, [&] { return loader->second(bytes); });
    } catch (const Error& error) {
      in.fail("holds a feature \"" + name + "\" that is none: " + error.what());
    }
    if (!feature || feature->name() != name) in.fail("holds a feature that is no \"" + name + "\"");
    features.set(std::move(feature));
  }
  return features;
}

}  // namespace plaza
