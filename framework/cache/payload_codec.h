#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "framework/cache/feature_codec.h"
#include "plaza/data/payload.h"

namespace plaza {

/// True for payloads that can be turned into bytes and back, bit for bit: Frames and ForegroundMask
/// (lossless images), Detections, GroundTruth, Observations, GroundLikelihood, Tracklets, Tracks.
/// Evidence can't: what is in it is its modality's own business.
bool can_keep(std::string_view port);

/// The payload as bytes; nothing where something in it can't be kept: features that observations or
/// tracklets carry and that `loaders` can't read back.
std::optional<std::string> encode_payload(const Payload& payload, const FeatureLoaders& loaders);

/// The payload again. Throws DamagedEntry, naming `file`, for bytes that are none.
PayloadPtr decode_payload(std::string_view port, std::string_view bytes,
                          const FeatureLoaders& loaders, const std::string& file);

}  // namespace plaza
