#include "plugins/detectors/common/box_ground.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "plaza/core/error.h"

namespace plaza {
namespace {

double square(double x) { return x * x; }

Eigen::Vector3d above(const Eigen::Vector2d& ground, double z_m) {
  return {ground.x(), ground.y(), z_m};
}

/// Rows of the projection of the point `z_m` above `ground`, and its derivatives; by differences,
/// since a camera gives no derivative of project().
struct HeadRow {
  double row_px = 0;
  Eigen::RowVector2d by_ground;  ///< px per m
  double by_height = 0;          ///< px per m
};

std::optional<HeadRow> head_row(const Camera& camera, const Eigen::Vector2d& ground, double z_m) {
  constexpr double kStep_m = 0.01;
  const auto at = [&](double dx, double dy, double dz) {
    return camera.project(above(ground + Eigen::Vector2d(dx, dy), z_m + dz));
  };
  const auto centre = at(0, 0, 0);
  const auto x0 = at(-kStep_m, 0, 0), x1 = at(kStep_m, 0, 0);
  const auto y0 = at(0, -kStep_m, 0), y1 = at(0, kStep_m, 0);
  const auto z0 = at(0, 0, -kStep_m), z1 = at(0, 0, kStep_m);
  if (!centre || !x0 || !x1 || !y0 || !y1 || !z0 || !z1) return std::nullopt;
  HeadRow out;
  out.row_px = centre->y();
  out.by_ground << (x1->y() - x0->y()) / (2 * kStep_m), (y1->y() - y0->y()) / (2 * kStep_m);
  out.by_height = (z1->y() - z0->y()) / (2 * kStep_m);
  return out;
}

/// A box's edges as measurements of a body: what is cut by the image border measures nothing.
struct Measured {
  double centre_x_px = 0;
  double foot_y_px = 0;
  double head_y_px = 0;
  double centre_sigma_px = 0;
  double foot_sigma_px = 0;
  double head_sigma_px = 0;
  bool feet = true;
  bool head = true;
};

}  // namespace

BoxGround::BoxGround(const BoxGroundOptions& options, std::shared_ptr<const Scene> scene)
    : options_(options), scene_(std::move(scene)), curve_(options.probability) {
  if (options_.min_height_ratio >= options_.max_height_ratio) {
    throw UserError(fault_at("/min_height_ratio", "must be below max_height_ratio"));
  }
  const GroundArea area = grown(scene_->area, options_.margin_m);
  if ((area.min_m.array() > area.max_m.array()).any()) {
    throw UserError(fault_at("/margin_m", "leaves nothing of the scene's area"));
  }
}

std::optional<Standing> BoxGround::from_plane(const Camera& camera, const Eigen::Vector2d& pixel,
                                              double sigma_x_px, double sigma_y_px, double z_m,
                                              double sigma_z_m) const {
  const auto ground = camera.to_plane(pixel, z_m);
  const auto jacobian = camera.plane_jacobian(pixel, z_m);
  if (!ground || !jacobian) return std::nullopt;
  const Eigen::Vector2d pixel_variance(square(sigma_x_px), square(sigma_y_px));
  Standing out;
  out.position_m = *ground;
  out.covariance_m2 = *jacobian * pixel_variance.asDiagonal() * jacobian->transpose() +
                      square(options_.ground_sigma_m) * Eigen::Matrix2d::Identity();
  if (sigma_z_m > 0) {
    // a plane higher by dz is met nearer by dz times the viewing ray's slope
    const Eigen::Vector3d eye = camera.centre();
    const Eigen::Vector2d slope = (*ground - eye.head<2>()) / (eye.z() - z_m);
    out.covariance_m2 += square(sigma_z_m) * slope * slope.transpose();
  }
  if (!out.position_m.allFinite() || !out.covariance_m2.allFinite() ||
      !(out.covariance_m2.determinant() > 0)) {
    return std::nullopt;
  }
  return out;
}

std::optional<Standing> BoxGround::locate(std::size_t camera_index, const Box& box) const {
  const Camera& camera = scene_->cameras.at(camera_index);
  const Body& body = scene_->body;
  const auto sigma = [&](double share) {
    return std::hypot(share * box.height, options_.pixel_sigma_px);
  };
  Measured m;
  m.centre_x_px = box.left + 0.5 * box.width;
  m.foot_y_px = box.bottom() - options_.foot_offset * box.height - options_.foot_offset_px;
  m.head_y_px = box.top + options_.head_offset * box.height;
  m.centre_sigma_px = sigma(options_.centre_sigma);
  m.foot_sigma_px = sigma(options_.foot_sigma);
  m.head_sigma_px = sigma(options_.head_sigma);
  m.head = box.top > options_.border_px;
  m.feet = box.bottom() < camera.height() - options_.border_px;
  const bool cut_left = box.left <= options_.border_px;
  const bool cut_right = box.right() >= camera.width() - options_.border_px;
  if (cut_left || cut_right) {
    // the visible edge and the body's width tell more of the middle than half of a cut box
    const double height = m.head && m.feet ? box.height : std::max(box.height, 2 * box.width);
    const double width = std::max(box.width, height * 2 * body.radius_m / body.height_m);
    if (cut_left && !cut_right) m.centre_x_px = box.right() - 0.5 * width;
    if (cut_right && !cut_left) m.centre_x_px = box.left + 0.5 * width;
    m.centre_sigma_px = std::hypot(m.centre_sigma_px, 0.25 * width);
  }
  const auto from_head = [&] {
    auto standing = from_plane(camera, {m.centre_x_px, m.head_y_px}, m.centre_sigma_px,
                               m.head_sigma_px, body.height_m, options_.body_height_sigma_m);
    if (standing) standing->feet = false;
    return standing;
  };
  if (!m.feet) {
    if (m.head) return from_head();
    return std::nullopt;  // cut above and below: it may be anywhere along the view
  }
  auto standing = from_plane(camera, {m.centre_x_px, m.foot_y_px}, m.centre_sigma_px,
                             m.foot_sigma_px, 0.0, 0.0);
  if (!standing || !m.head) return standing;

  const auto head = head_row(camera, standing->position_m, body.height_m);
  if (!head) return standing;
  const double innovation = m.head_y_px - head->row_px;  // > 0: the box is too short
  const double noise =
      square(m.head_sigma_px) + square(head->by_height * options_.body_height_sigma_m);
  const Eigen::Vector2d cross = standing->covariance_m2 * head->by_ground.transpose();
  const double variance = head->by_ground.dot(cross) + noise;
  if (std::abs(innovation) > options_.height_gate * std::sqrt(variance)) {
    // Too tall: two people in one box, or arms; the feet still stand where they stand. Too short:
    // the feet are hidden behind somebody, and what looks like them is higher up in the image.
    if (innovation > 0) {
      if (auto hidden = from_head()) return hidden;
    }
    return standing;
  }
  if (options_.use_head) {
    standing->position_m += cross * (innovation / variance);
    standing->covariance_m2 -= cross * cross.transpose() / variance;
  }
  return standing;
}

bool BoxGround::plausible(const Camera& camera, const Box& box, const Standing& standing) const {
  const auto feet = camera.project(above(standing.position_m, 0));
  const auto head = camera.project(above(standing.position_m, scene_->body.height_m));
  if (!feet || !head) return false;
  const double top = std::max(head->y(), 0.0);
  const double bottom = std::min(feet->y(), static_cast<double>(camera.height()));
  const double seen = bottom - top;
  if (!(seen > 0)) return false;
  const double inside =
      std::min(box.bottom(), static_cast<double>(camera.height())) - std::max(box.top, 0.0);
  const double ratio = inside / seen;
  return ratio >= options_.min_height_ratio && ratio <= options_.max_height_ratio;
}

std::vector<Observation> BoxGround::observe(std::size_t camera,
                                            std::span<const ImageDetection> detections) const {
  // What no person can look like must not suppress what one can, so plausibility comes first; the
  // area comes last, because somebody outside of it may well hide a weaker echo inside.
  std::vector<ImageDetection> candidates;
  for (const ImageDetection& d : detections) {
    if (d.score < options_.min_score || !(d.box.width > 0) || !(d.box.height > 0)) continue;
    const auto standing = locate(camera, d.box);
    if (!standing || !plausible(scene_->cameras[camera], d.box, *standing)) continue;
    candidates.push_back(d);
  }
  const GroundArea area = grown(scene_->area, options_.margin_m);
  std::vector<Observation> observations;
  for (const std::size_t i : suppress_overlapping(candidates, options_.nms_overlap)) {
    const Box box = voted(candidates[i].box, candidates);
    const auto standing = locate(camera, box);
    if (!standing || !area.contains(standing->position_m)) continue;
    Observation o;
    o.position_m = standing->position_m;
    o.covariance_m2 = standing->covariance_m2;
    o.probability = curve_(candidates[i].score);
    o.score = candidates[i].score;
    o.boxes.push_back({.camera = camera, .box = box, .score = candidates[i].score});
    observations.push_back(std::move(o));
  }
  return observations;
}

Box BoxGround::voted(const Box& box, std::span<const ImageDetection> candidates) const {
  if (options_.vote_overlap >= 1) return box;
  double weight = 0;
  Box sum{};
  for (const ImageDetection& d : candidates) {
    if (intersection_over_union(box, d.box) < options_.vote_overlap) continue;
    const double w = curve_(d.score);
    weight += w;
    sum.left += w * d.box.left;
    sum.top += w * d.box.top;
    sum.width += w * d.box.width;
    sum.height += w * d.box.height;
  }
  return {.left = sum.left / weight,
          .top = sum.top / weight,
          .width = sum.width / weight,
          .height = sum.height / weight};
}

std::vector<std::size_t> suppress_overlapping(std::span<const ImageDetection> detections,
                                              double max_overlap) {
  std::vector<std::size_t> order(detections.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return detections[a].score > detections[b].score;
  });
  std::vector<std::size_t> kept;
  for (const std::size_t i : order) {
    const bool repeated = std::any_of(kept.begin(), kept.end(), [&](std::size_t k) {
      return intersection_over_union(detections[i].box, detections[k].box) > max_overlap;
    });
    if (!repeated) kept.push_back(i);
  }
  return kept;
}

}  // namespace plaza
