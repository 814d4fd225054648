#include "framework/cache/payload_codec.h"

#include "framework/cache/bytes.h"
#include "framework/cache/codec_pieces.h"
#include "plaza/data/detections.h"
#include "plaza/data/evidence.h"
#include "plaza/data/frames.h"
#include "plaza/data/ground_likelihood.h"
#include "plaza/data/ground_truth.h"
#include "plaza/data/observation.h"
#include "plaza/data/track.h"

namespace plaza {
namespace {

using codec::put, codec::Unkept, codec::vector_of, codec::box_of, codec::boxes_of, codec::points_of,
    codec::grid_of, codec::values_of, codec::views_of;

void put(ByteWriter& out, const FrameSet& frames, const FeatureLoaders&) {
  out.integer(frames.frame);
  out.integer(frames.time_ns);
  put(out, frames.views);
}

void get(ByteReader& in, FrameSet& frames, const FeatureLoaders&) {
  frames.frame = in.integer();
  frames.time_ns = in.integer();
  frames.views = views_of(in);
}

void put(ByteWriter& out, const ForegroundMask& mask, const FeatureLoaders&) {
  put(out, mask.views);
}
void get(ByteReader& in, ForegroundMask& mask, const FeatureLoaders&) { mask.views = views_of(in); }

void put(ByteWriter& out, const Detections& detections, const FeatureLoaders&) {
  out.word(detections.views.size());
  for (const auto& view : detections.views) {
    out.word(view.size());
    for (const ImageDetection& detection : view) {
      put(out, detection.box);
      out.real(detection.score);
    }
  }
}

void get(ByteReader& in, Detections& detections, const FeatureLoaders&) {
  detections.views.resize(in.count(8));
  for (auto& view : detections.views) {
    view.resize(in.count(40));
    for (ImageDetection& detection : view) {
      detection.box = box_of(in);
      detection.score = in.real();
    }
  }
}

void put(ByteWriter& out, const GroundTruth& truth, const FeatureLoaders&) {
  out.flag(truth.annotated);
  out.word(truth.people.size());
  for (const TruePerson& person : truth.people) {
    out.integer(person.id);
    out.flag(person.position_m.has_value());
    if (person.position_m) put(out, *person.position_m);
    out.optional(person.heading_rad);
    out.word(person.views.size());
    for (const TrueView& view : person.views) {
      out.word(view.camera);
      put(out, view.box);
      out.real(view.visibility);
    }
  }
}

void get(ByteReader& in, GroundTruth& truth, const FeatureLoaders&) {
  truth.annotated = in.flag();
  truth.people.resize(in.count(18));
  for (TruePerson& person : truth.people) {
    person.id = in.integer();
    if (in.flag()) person.position_m = vector_of(in);
    person.heading_rad = in.optional();
    person.views.resize(in.count(48));
    for (TrueView& view : person.views) {
      view.camera = in.word();
      view.box = box_of(in);
      view.visibility = in.real();
    }
  }
}

void put(ByteWriter& out, const Observations& observations, const FeatureLoaders& loaders) {
  out.word(observations.items.size());
  for (const Observation& o : observations.items) {
    put(out, o.position_m);
    for (const double value : o.covariance_m2.reshaped()) out.real(value);
    out.real(o.probability);
    out.real(o.score);
    out.optional(o.heading_rad);
    put(out, o.boxes);
    if (!put_features(out, o.features, loaders)) throw Unkept{};
  }
  out.flag(observations.grid.has_value());
  if (observations.grid) put(out, *observations.grid);
}

void get(ByteReader& in, Observations& observations, const FeatureLoaders& loaders) {
  observations.items.resize(in.count(81));
  for (Observation& o : observations.items) {
    o.position_m = vector_of(in);
    for (double& value : o.covariance_m2.reshaped()) value = in.real();
    o.probability = in.real();
    o.score = in.real();
    o.heading_rad = in.optional();
    o.boxes = boxes_of(in);
    o.features = features_of(in, loaders);
  }
  if (in.flag()) observations.grid = grid_of(in);
}

void put(ByteWriter& out, const GroundLikelihood& likelihood, const FeatureLoaders&) {
  put(out, likelihood.grid);
  put(out, likelihood.joint);
  out.word(likelihood.views.size());
  for (const auto& view : likelihood.views) put(out, view);
}

void get(ByteReader& in, GroundLikelihood& likelihood, const FeatureLoaders&) {
  likelihood.grid = grid_of(in);
  likelihood.joint = values_of(in);
  likelihood.views.resize(in.count(8));
  for (auto& view : likelihood.views) view = values_of(in);
}

void put(ByteWriter& out, const Tracks& tracks, const FeatureLoaders&) { put(out, tracks.points); }
void get(ByteReader& in, Tracks& tracks, const FeatureLoaders&) { tracks.points = points_of(in); }

void put(ByteWriter& out, const Tracklets& tracklets, const FeatureLoaders& loaders) {
  out.word(tracklets.items.size());
  for (const Tracklet& tracklet : tracklets.items) {
    out.integer(tracklet.id);
    put(out, tracklet.points);
    if (!put_features(out, tracklet.features, loaders)) throw Unkept{};
  }
}

void get(ByteReader& in, Tracklets& tracklets, const FeatureLoaders& loaders) {
  tracklets.items.resize(in.count(24));
  for (Tracklet& tracklet : tracklets.items) {
    tracklet.id = in.integer();
    tracklet.points = points_of(in);
    tracklet.features = features_of(in, loaders);
  }
}

/// Calls `use` with an empty payload of the port's type; false where none can be kept.
template <class Use>
bool with_type(std::string_view port, const Use& use) {
  const auto is = [&]<class T>(std::shared_ptr<T> payload) {
    if (port != T::kPort) return false;
    use(std::move(payload));
    return true;
  };
  return is(std::make_shared<FrameSet>()) || is(std::make_shared<ForegroundMask>()) ||
         is(std::make_shared<Detections>()) || is(std::make_shared<GroundTruth>()) ||
         is(std::make_shared<Observations>()) || is(std::make_shared<GroundLikelihood>()) ||
         is(std::make_shared<Tracks>()) || is(std::make_shared<Tracklets>());
}

}  // namespace

bool can_keep(std::string_view port) {
  return with_type(port, [](const auto&) {});
}

std::optional<std::string> encode_payload(const Payload& payload, const FeatureLoaders& loaders) {
  ByteWriter out;
  try {
    const bool known = with_type(payload.port(), [&]<class T>(const std::shared_ptr<T>&) {
      put(out, static_cast<const T&>(payload), loaders);
    });
    if (!known) return std::nullopt;
  } catch (const Unkept&) {
    return std::nullopt;
  }
  return out.take();
}

PayloadPtr decode_payload(std::string_view port, std::string_view bytes,
                          const FeatureLoaders& loaders, const std::string& file) {
  ByteReader in(bytes, file);
  PayloadPtr decoded;
  const bool known = with_type(port, [&]<class T>(std::shared_ptr<T> payload) {
    get(in, *payload, loaders);
    decoded = std::move(payload);
  });
  if (!known) in.fail("is of an unknown type");
  in.expect_end();
  return decoded;
}

}  // namespace plaza
