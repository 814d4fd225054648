#include "framework/cache/payload_codec.h"

#include <opencv2/imgcodecs.hpp>

#include "framework/cache/bytes.h"
#include "plaza/data/detections.h"
#include "plaza/data/evidence.h"
#include "plaza/data/frames.h"
#include "plaza/data/ground_likelihood.h"
#include "plaza/data/ground_truth.h"
#include "plaza/data/observation.h"
#include "plaza/data/track.h"

namespace plaza {
namespace {

/// Something can't be kept.
struct Unkept {};

// ---- pieces

void put(ByteWriter& out, const Eigen::Vector2d& v) {
  out.real(v.x());
  out.real(v.y());
}

Eigen::Vector2d vector_of(ByteReader& in) {
  const double x = in.real();
  return {x, in.real()};
}

void put(ByteWriter& out, const Box& box) {
  out.real(box.left);
  out.real(box.top);
  out.real(box.width);
  out.real(box.height);
}

Box box_of(ByteReader& in) {
  Box box;
  box.left = in.real();
  box.top = in.real();
  box.width = in.real();
  box.height = in.real();
  return box;
}

/// PNG with little effort: as small as more effort makes it within a few percent where there is
/// noise, and several times as fast.
void put(ByteWriter& out, const std::vector<cv::Mat>& views) {
  out.word(views.size());
  for (const cv::Mat& view : views) {
    out.flag(!view.empty());
    if (view.empty()) continue;
    if (view.depth() != CV_8U || (view.channels() != 1 && view.channels() != 3)) throw Unkept{};
    std::vector<unsigned char> png;
    cv::imencode(".png", view, png, {cv::IMWRITE_PNG_COMPRESSION, 1});
    out.text({reinterpret_cast<const char*>(png.data()), png.size()});
  }
}

std::vector<cv::Mat> views_of(ByteReader& in) {
  std::vector<cv::Mat> views(in.count(1));
  for (cv::Mat& view : views) {
    if (!in.flag()) continue;
    const std::string_view png = in.text();
    const std::vector<unsigned char> bytes(png.begin(), png.end());
    view = cv::imdecode(bytes, cv::IMREAD_UNCHANGED);
    if (view.empty()) in.fail("holds a picture that is none");
  }
  return views;
}

void put(ByteWriter& out, const std::vector<ViewBox>& boxes) {
  out.word(boxes.size());
  for (const ViewBox& view : boxes) {
    out.word(view.camera);
    put(out, view.box);
    out.real(view.score);
  }
}

std::vector<ViewBox> boxes_of(ByteReader& in) {
  std::vector<ViewBox> boxes(in.count(48));
  for (ViewBox& view : boxes) {
    view.camera = in.word();
    view.box = box_of(in);
    view.score = in.real();
  }
  return boxes;
}

void put(ByteWriter& out, const TrackPoint& point) {
  out.integer(point.id);
  out.integer(point.frame);
  put(out, point.position_m);
  out.optional(point.heading_rad);
  out.real(point.score);
  out.flag(point.observed);
  out.flag(point.final);
  put(out, point.boxes);
}

TrackPoint point_of(ByteReader& in) {
  TrackPoint point;
  point.id = in.integer();
  point.frame = in.integer();
  point.position_m = vector_of(in);
  point.heading_rad = in.optional();
  point.score = in.real();
  point.observed = in.flag();
  point.final = in.flag();
  point.boxes = boxes_of(in);
  return point;
}

void put(ByteWriter& out, const std::vector<TrackPoint>& points) {
  out.word(points.size());
  for (const TrackPoint& point : points) put(out, point);
}

std::vector<TrackPoint> points_of(ByteReader& in) {
  std::vector<TrackPoint> points(in.count(43));
  for (TrackPoint& point : points) point = point_of(in);
  return points;
}

void put(ByteWriter& out, const GroundGrid& grid) {
  put(out, grid.origin_m);
  put(out, grid.step_m);
  out.integer(grid.columns);
  out.integer(grid.rows);
}

GroundGrid grid_of(ByteReader& in) {
  GroundGrid grid;
  grid.origin_m = vector_of(in);
  grid.step_m = vector_of(in);
  grid.columns = static_cast<int>(in.integer());
  grid.rows = static_cast<int>(in.integer());
  return grid;
}

void put(ByteWriter& out, const std::vector<double>& values) {
  out.word(values.size());
  for (const double value : values) out.real(value);
}

std::vector<double> values_of(ByteReader& in) {
  std::vector<double> values(in.count(8));
  for (double& value : values) value = in.real();
  return values;
}

// ---- payloads

void put(ByteWriter& out, const FrameSet& frames) {
  out.integer(frames.frame);
  out.integer(frames.time_ns);
  put(out, frames.views);
}

void get(ByteReader& in, FrameSet& frames) {
  frames.frame = in.integer();
  frames.time_ns = in.integer();
  frames.views = views_of(in);
}

void put(ByteWriter& out, const ForegroundMask& mask) { put(out, mask.views); }
void get(ByteReader& in, ForegroundMask& mask) { mask.views = views_of(in); }

void put(ByteWriter& out, const Detections& detections) {
  out.word(detections.views.size());
  for (const auto& view : detections.views) {
    out.word(view.size());
    for (const ImageDetection& detection : view) {
      put(out, detection.box);
      out.real(detection.score);
    }
  }
}

void get(ByteReader& in, Detections& detections) {
  detections.views.resize(in.count(8));
  for (auto& view : detections.views) {
    view.resize(in.count(40));
    for (ImageDetection& detection : view) {
      detection.box = box_of(in);
      detection.score = in.real();
    }
  }
}

void put(ByteWriter& out, const GroundTruth& truth) {
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

void get(ByteReader& in, GroundTruth& truth) {
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

void put(ByteWriter& out, const Observations& observations) {
  out.word(observations.items.size());
  for (const Observation& o : observations.items) {
    if (!o.features.empty()) throw Unkept{};
    put(out, o.position_m);
    for (const double value : o.covariance_m2.reshaped()) out.real(value);
    out.real(o.probability);
    out.optional(o.heading_rad);
    put(out, o.boxes);
  }
  out.flag(observations.grid.has_value());
  if (observations.grid) put(out, *observations.grid);
}

void get(ByteReader& in, Observations& observations) {
  observations.items.resize(in.count(65));
  for (Observation& o : observations.items) {
    o.position_m = vector_of(in);
    for (double& value : o.covariance_m2.reshaped()) value = in.real();
    o.probability = in.real();
    o.heading_rad = in.optional();
    o.boxes = boxes_of(in);
  }
  if (in.flag()) observations.grid = grid_of(in);
}

void put(ByteWriter& out, const GroundLikelihood& likelihood) {
  put(out, likelihood.grid);
  put(out, likelihood.joint);
  out.word(likelihood.views.size());
  for (const auto& view : likelihood.views) put(out, view);
}

void get(ByteReader& in, GroundLikelihood& likelihood) {
  likelihood.grid = grid_of(in);
  likelihood.joint = values_of(in);
  likelihood.views.resize(in.count(8));
  for (auto& view : likelihood.views) view = values_of(in);
}

void put(ByteWriter& out, const Tracks& tracks) { put(out, tracks.points); }
void get(ByteReader& in, Tracks& tracks) { tracks.points = points_of(in); }

void put(ByteWriter& out, const Tracklets& tracklets) {
  out.word(tracklets.items.size());
  for (const Tracklet& tracklet : tracklets.items) {
    if (!tracklet.features.empty()) throw Unkept{};
    out.integer(tracklet.id);
    put(out, tracklet.points);
  }
}

void get(ByteReader& in, Tracklets& tracklets) {
  tracklets.items.resize(in.count(16));
  for (Tracklet& tracklet : tracklets.items) {
    tracklet.id = in.integer();
    tracklet.points = points_of(in);
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

std::optional<std::string> encode_payload(const Payload& payload) {
  ByteWriter out;
  try {
    const bool known = with_type(payload.port(), [&]<class T>(const std::shared_ptr<T>&) {
      put(out, static_cast<const T&>(payload));
    });
    if (!known) return std::nullopt;
  } catch (const Unkept&) {
    return std::nullopt;
  }
  return out.take();
}

PayloadPtr decode_payload(std::string_view port, std::string_view bytes, const std::string& file) {
  ByteReader in(bytes, file);
  PayloadPtr decoded;
  const bool known = with_type(port, [&]<class T>(std::shared_ptr<T> payload) {
    get(in, *payload);
    decoded = std::move(payload);
  });
  if (!known) in.fail("is of an unknown type");
  in.expect_end();
  return decoded;
}

}  // namespace plaza
