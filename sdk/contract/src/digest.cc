#include "digest.h"

#include <bit>
#include <cstdint>

#include "plaza/data/ground_likelihood.h"

namespace plaza::contract {
namespace {

class Writer {
 public:
  Writer& operator<<(double value) { return *this << std::bit_cast<std::uint64_t>(value); }
  Writer& operator<<(std::uint64_t value) {
    text_ += std::to_string(value);
    text_ += ' ';
    return *this;
  }
  Writer& operator<<(std::int64_t value) { return *this << static_cast<std::uint64_t>(value); }
  Writer& operator<<(std::string_view word) {
    text_.append(word).append(" ");
    return *this;
  }
  Writer& operator<<(const Box& b) { return *this << b.left << b.top << b.width << b.height; }
  Writer& operator<<(const std::optional<double>& value) {
    return value ? *this << *value : *this << std::string_view("none");
  }
  Writer& operator<<(const Eigen::Vector2d& v) { return *this << v.x() << v.y(); }
  Writer& operator<<(const std::vector<ViewBox>& boxes) {
    for (const ViewBox& b : boxes) *this << std::uint64_t{b.camera} << b.box << b.score;
    return *this << std::string_view(";");
  }
  Writer& operator<<(const cv::Mat& image) {
    std::uint64_t hash = 14695981039346656037ULL;  // FNV-1a
    for (int y = 0; y < image.rows; ++y) {
      const auto* row = image.ptr<std::uint8_t>(y);
      const std::size_t bytes = static_cast<std::size_t>(image.cols) * image.elemSize();
      for (std::size_t i = 0; i < bytes; ++i) hash = (hash ^ row[i]) * 1099511628211ULL;
    }
    return *this << std::int64_t{image.rows} << std::int64_t{image.cols}
                 << std::int64_t{image.type()} << hash;
  }
  Writer& operator<<(const FeatureSet& features) {
    for (const auto& feature : features.all()) {
      const auto bytes = feature->save();
      *this << feature->name() << std::uint64_t{bytes ? bytes->size() + 1 : 0}
            << std::string_view(bytes ? *bytes : std::string());
    }
    return *this << std::string_view(";");
  }
  Writer& observation(const Observation& o, bool described) {
    *this << o.position_m << o.covariance_m2(0, 0) << o.covariance_m2(0, 1) << o.covariance_m2(1, 0)
          << o.covariance_m2(1, 1) << o.probability << o.score << o.boxes;
    if (described) *this << o.heading_rad << o.features;
    return *this;
  }
  Writer& point(const TrackPoint& p) {
    return *this << p.id << p.frame << p.position_m << p.heading_rad << p.score
                 << std::uint64_t{p.observed} << std::uint64_t{p.final} << p.boxes;
  }
  Writer& observations(const Observations& all, bool described) {
    for (const Observation& o : all.items) observation(o, described);
    if (all.grid) grid(*all.grid);
    return *this;
  }
  Writer& grid(const GroundGrid& g) {
    return *this << g.origin_m << g.step_m << std::int64_t{g.columns} << std::int64_t{g.rows};
  }
  std::string take() { return std::move(text_); }

 private:
  std::string text_;
};

}  // namespace

std::string digest(const TrackPoint& point) { return Writer().point(point).take(); }

std::string digest_of_the_undescribed(const Observations& observations) {
  return Writer().observations(observations, false).take();
}

std::string digest(const PayloadPtr& payload) { return payload ? digest(*payload) : "-"; }

std::string digest(const Payload& payload) {
  Writer w;
  w << payload.port();
  if (const auto* frames = dynamic_cast<const FrameSet*>(&payload)) {
    w << frames->frame << frames->time_ns;
    for (const cv::Mat& view : frames->views) w << view;
  } else if (const auto* detections = dynamic_cast<const Detections*>(&payload)) {
    for (const auto& view : detections->views) {
      for (const ImageDetection& d : view) w << d.box << d.score;
      w << std::string_view("|");
    }
  } else if (const auto* observations = dynamic_cast<const Observations*>(&payload)) {
    w.observations(*observations, true);
  } else if (const auto* tracks = dynamic_cast<const Tracks*>(&payload)) {
    for (const TrackPoint& p : tracks->points) w.point(p);
  } else if (const auto* tracklets = dynamic_cast<const Tracklets*>(&payload)) {
    for (const Tracklet& t : tracklets->items) {
      w << t.id << t.features;
      for (const TrackPoint& p : t.points) w.point(p);
    }
  } else if (const auto* truth = dynamic_cast<const GroundTruth*>(&payload)) {
    w << std::uint64_t{truth->annotated};
    for (const TruePerson& p : truth->people) {
      w << p.id << p.heading_rad;
      if (p.position_m) w << *p.position_m;
      for (const TrueView& v : p.views) w << std::uint64_t{v.camera} << v.box << v.visibility;
      w << std::string_view("|");
    }
  } else if (const auto* masks = dynamic_cast<const ForegroundMask*>(&payload)) {
    for (const cv::Mat& view : masks->views) w << view;
  } else if (const auto* likelihood = dynamic_cast<const GroundLikelihood*>(&payload)) {
    w.grid(likelihood->grid);
    for (const double v : likelihood->joint) w << v;
    for (const std::vector<double>& view : likelihood->views) {
      w << std::string_view("|");
      for (const double v : view) w << v;
    }
  } else if (const auto* evidence = dynamic_cast<const EvidenceSet*>(&payload)) {
    for (const EvidencePtr& view : evidence->views) w << std::uint64_t{view != nullptr};
  }
  return w.take();
}

}  // namespace plaza::contract
