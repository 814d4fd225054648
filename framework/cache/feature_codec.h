#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "framework/cache/bytes.h"
#include "framework/config/pipeline.h"
#include "plaza/data/feature.h"

namespace plaza {

/// F::load() of the feature types that can be read back, by name.
using FeatureLoaders =
    std::map<std::string, std::shared_ptr<const Feature> (*)(std::string_view), std::less<>>;

/// Of everything that the components of a pipeline, parts included, declare to give.
FeatureLoaders feature_loaders(const ResolvedPipeline& pipeline);

/// Writes features; false when one of them can't be kept: nobody declares how to read it back, or
/// it does not save itself. Then `out` is of no more use.
bool put_features(ByteWriter& out, const FeatureSet& features, const FeatureLoaders& loaders);

/// Reads them. What load() refuses is damaged (DamagedEntry).
FeatureSet features_of(ByteReader& in, const FeatureLoaders& loaders);

}  // namespace plaza
