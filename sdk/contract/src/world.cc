#include "plaza/contract/world.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>

#include "plaza/geometry/angle.h"

namespace plaza::contract {
namespace {

constexpr int kWidth = 160, kHeight = 120;

/// The distributions of <random> differ between libraries; these do not.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double uniform() { return static_cast<double>(engine_() >> 11) * 0x1.0p-53; }
  bool chance(double probability) { return uniform() < probability; }
  double normal() {  // Box and Muller, 1958
    return std::sqrt(-2 * std::log(1 - uniform())) * std::cos(2 * std::numbers::pi * uniform());
  }

 private:
  std::mt19937_64 engine_;
};

/// 3.5 m up, looking at the middle of the ground.
Camera camera_at(const std::string& name, double bearing_rad) {
  const Eigen::Vector3d centre(12 * std::cos(bearing_rad), 12 * std::sin(bearing_rad), 3.5);
  const Eigen::Vector3d z = (Eigen::Vector3d(0, 0, 0.9) - centre).normalized();
  const Eigen::Vector3d x = z.cross(Eigen::Vector3d::UnitZ()).normalized();
  CameraFromWorld pose;
  pose.rotation << x.transpose(), z.cross(x).transpose(), z.transpose();
  pose.translation = -pose.rotation * centre;
  PinholeIntrinsics intrinsics;
  intrinsics.fx_px = intrinsics.fy_px = 150;
  intrinsics.cx_px = (kWidth - 1) / 2.0;
  intrinsics.cy_px = (kHeight - 1) / 2.0;
  return Camera::pinhole(name, {kWidth, kHeight}, intrinsics, pose);
}

struct Walker {
  TrackId id;
  Eigen::Vector2d start_m, velocity_m_per_s;
  std::int64_t from, to;  // frames in which the person is there: [from, to)
};

cv::Rect pixels_inside(const Box& box) {
  const int left = static_cast<int>(std::clamp(std::floor(box.left), 0.0, double{kWidth}));
  const int top = static_cast<int>(std::clamp(std::floor(box.top), 0.0, double{kHeight}));
  const int right = static_cast<int>(std::clamp(std::ceil(box.right()), 0.0, double{kWidth}));
  const int bottom = static_cast<int>(std::clamp(std::ceil(box.bottom()), 0.0, double{kHeight}));
  return {left, top, right - left, bottom - top};
}

cv::Mat background(std::size_t camera, Random& random) {
  cv::Mat image(kHeight, kWidth, CV_8UC3);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const auto grey = static_cast<uchar>(90 + y / 2 + static_cast<int>(8 * random.uniform()));
      image.at<cv::Vec3b>(y, x) = {grey, static_cast<uchar>(grey + 10 * camera), grey};
    }
  }
  return image;
}

Observation observation_at(const Eigen::Vector2d& position_m, double probability) {
  Observation o;
  o.position_m = position_m;
  o.covariance_m2 << 0.04, 0.005, 0.005, 0.03;
  o.probability = probability;
  return o;
}

}  // namespace

World::World(std::uint64_t seed, std::int64_t frames) : frames_(static_cast<std::size_t>(frames)) {
  Scene scene;
  scene.name = "contract";
  scene.area = {{-5, -5}, {5, 5}};
  scene.frame_rate_hz = 10;
  for (int i = 0; i < 3; ++i) {
    scene.cameras.push_back(
        camera_at("view" + std::to_string(i + 1), i * 2 * std::numbers::pi / 3 + 0.4));
  }
  scene_ = std::make_shared<const Scene>(scene);

  const std::vector<Walker> walkers = {{1, {-4, -3}, {1.2, 0.1}, 0, frames},
                                       {2, {3.5, 2}, {-1.0, -0.2}, 0, frames - frames / 4},
                                       {3, {0, 4}, {0.1, -1.1}, frames / 4, frames},
                                       {4, {2, -3.5}, {0, 0}, 0, frames}};
  const std::vector<cv::Scalar> colours = {
      {40, 40, 200}, {200, 60, 40}, {30, 180, 40}, {20, 200, 220}};
  Random random(seed);
  std::vector<cv::Mat> backgrounds;
  for (std::size_t c = 0; c < scene.cameras.size(); ++c)
    backgrounds.push_back(background(c, random));
  std::map<TrackId, Tracklet> open_tracklets;

  for (std::int64_t frame = 0; frame < frames; ++frame) {
    Moment& m = frames_[static_cast<std::size_t>(frame)];
    m.frames->frame = frame;
    m.frames->time_ns = scene.time_of_frame(frame);
    m.people_free->frame = frame;
    m.people_free->time_ns = m.frames->time_ns;
    m.people_free->views = backgrounds;
    m.detections->views.resize(scene.cameras.size());
    m.evidence->views.resize(scene.cameras.size());
    for (std::size_t c = 0; c < scene.cameras.size(); ++c) {
      const bool no_image = frame % 7 == static_cast<std::int64_t>(c) + 2 || frame == frames / 2;
      m.frames->views.push_back(no_image ? cv::Mat() : backgrounds[c].clone());
      m.foreground->views.push_back(no_image ? cv::Mat()
                                             : cv::Mat::zeros(kHeight, kWidth, CV_8UC1));
    }
    const bool blind = frame == frames / 2 || frame == frames / 2 + 1;  // nobody is seen at all
    for (std::size_t w = 0; w < walkers.size(); ++w) {
      const Walker& walker = walkers[w];
      if (frame < walker.from || frame >= walker.to) continue;
      const double seconds = static_cast<double>(frame - walker.from) / scene.frame_rate_hz;
      const Eigen::Vector2d position = walker.start_m + seconds * walker.velocity_m_per_s;
      const double heading =
          walker.velocity_m_per_s.norm() > 0
              ? std::atan2(walker.velocity_m_per_s.y(), walker.velocity_m_per_s.x())
              : 0.5;
      TruePerson person{
          .id = walker.id, .position_m = position, .heading_rad = heading, .views = {}};
      const Eigen::Vector2d error(0.1 * random.normal(), 0.1 * random.normal());
      Observation seen = observation_at(position + error, 0.6 + 0.39 * random.uniform());
      seen.heading_rad = wrap_angle(heading + 0.2 * random.normal());
      Observation exact = observation_at(position, 0.99);
      exact.heading_rad = heading;
      for (std::size_t c = 0; c < scene.cameras.size(); ++c) {
        const std::optional<Box> box = body_box(scene.cameras[c], position, scene.body);
        if (!box) continue;
        person.views.push_back({c, *box, 1.0});
        exact.boxes.push_back({c, *box, 1.0});
        if (m.frames->views[c].empty() || random.chance(0.15)) continue;
        const cv::Rect rect = pixels_inside(*box);
        m.frames->views[c](rect).setTo(colours[w]);
        m.foreground->views[c](rect).setTo(255);
        Box noisy = *box;
        noisy.left += random.normal();
        noisy.top += random.normal();
        if (blind) continue;
        m.detections->views[c].push_back({noisy, 0.5 + random.uniform()});
        seen.boxes.push_back({c, noisy, 0.9});
      }
      m.true_tracks->points.push_back({.id = walker.id,
                                       .frame = frame,
                                       .position_m = position,
                                       .heading_rad = heading,
                                       .score = 1,
                                       .observed = true,
                                       .final = true,
                                       .boxes = exact.boxes});
      m.true_observations->items.push_back(exact);
      if (!blind && !random.chance(0.1)) m.observations->items.push_back(std::move(seen));
      m.ground_truth->people.push_back(std::move(person));
      // pieces of eight frames
      Tracklet& tracklet = open_tracklets[walker.id];
      tracklet.id = 100 * (frame / 8 + 1) + walker.id;
      tracklet.points.push_back(m.true_tracks->points.back());
      tracklet.points.back().id = tracklet.id;
      if (frame % 8 == 7 || frame + 1 == walker.to) {
        for (TrackPoint& point : tracklet.points) point.id = tracklet.id;
        m.tracklets->items.push_back(std::move(tracklet));
        open_tracklets.erase(walker.id);
      }
    }
    if (!blind && random.chance(0.3)) {  // a false alarm
      m.observations->items.push_back(
          observation_at({8 * random.uniform() - 4, 8 * random.uniform() - 4}, 0.3));
      m.detections->views[0].push_back({{20 + 60 * random.uniform(), 30, 14, 40}, 0.2});
    }
  }
}

PayloadPtr World::payload(std::string_view port, std::int64_t frame) const {
  const auto it = provided_.find(port);
  if (it != provided_.end()) return it->second.at(static_cast<std::size_t>(frame));
  const Moment& m = at(frame);
  if (port == FrameSet::kPort) return m.frames;
  if (port == Detections::kPort) return m.detections;
  if (port == Observations::kPort) return m.observations;
  if (port == GroundTruth::kPort) return m.ground_truth;
  if (port == Tracks::kPort) return m.true_tracks;
  if (port == Tracklets::kPort) return m.tracklets;
  if (port == ForegroundMask::kPort) return m.foreground;
  if (port == EvidenceSet::kPort) return m.evidence;
  return nullptr;
}

void World::provide(std::string port, std::vector<PayloadPtr> by_frame) {
  by_frame.resize(frames_.size());
  provided_[std::move(port)] = std::move(by_frame);
}

}  // namespace plaza::contract
