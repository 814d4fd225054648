#include "person_sights.h"

#include <algorithm>

#include "plaza/scoring/detection_errors.h"

namespace plaza {
namespace {

constexpr int kSampleColumns = 24, kSampleRows = 48;  // a box is sampled at so many points

using Polygon = std::vector<Eigen::Vector2d>;

bool lies_in(const Polygon& polygon, const Eigen::Vector2d& p) {
  bool in = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Eigen::Vector2d &a = polygon[i], &b = polygon[j];
    if ((a.y() > p.y()) == (b.y() > p.y())) continue;
    if (p.x() < a.x() + (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y())) in = !in;
  }
  return in;
}

bool lies_in(const Box& box, const Eigen::Vector2d& p) {
  return p.x() >= box.left && p.x() <= box.right() && p.y() >= box.top && p.y() <= box.bottom();
}

Eigen::Vector2d foot_of(const Box& box) { return {box.left + box.width / 2, box.bottom()}; }

}  // namespace

double intersection_area(const Box& a, const Box& b) {
  const double width = std::min(a.right(), b.right()) - std::max(a.left, b.left);
  const double height = std::min(a.bottom(), b.bottom()) - std::max(a.top, b.top);
  return width > 0 && height > 0 ? width * height : 0;
}

Box image_box(const Camera& camera) {
  return {-0.5, -0.5, static_cast<double>(camera.width()), static_cast<double>(camera.height())};
}

std::optional<Eigen::Vector2d> place_of(const TruePerson& person, const Scene& scene) {
  if (person.position_m) return person.position_m;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  int views = 0;
  for (const TrueView& view : person.views) {
    const auto foot = scene.cameras.at(view.camera).to_plane(foot_of(view.box));
    if (!foot) continue;
    sum += *foot;
    ++views;
  }
  if (views == 0) return std::nullopt;
  return Eigen::Vector2d(sum / views);
}

const Box* box_in(const TruePerson& person, std::size_t camera) {
  for (const TrueView& view : person.views) {
    if (view.camera == camera) return &view.box;
  }
  return nullptr;
}

double covered_share(const Box& box, std::span<const std::vector<Eigen::Vector2d>> polygons,
                     std::span<const Box> boxes) {
  int covered = 0;
  for (int row = 0; row < kSampleRows; ++row) {
    for (int column = 0; column < kSampleColumns; ++column) {
      const Eigen::Vector2d p(box.left + box.width * (column + 0.5) / kSampleColumns,
                              box.top + box.height * (row + 0.5) / kSampleRows);
      const auto holds = [&p](const auto& shape) { return lies_in(shape, p); };
      if (std::any_of(polygons.begin(), polygons.end(), holds) ||
          std::any_of(boxes.begin(), boxes.end(), holds)) {
        ++covered;
      }
    }
  }
  return static_cast<double>(covered) / (kSampleRows * kSampleColumns);
}

double ErrorSorter::border_distance_m(const Eigen::Vector2d& position_m) const {
  const GroundArea& area = scene_->area;
  const Eigen::Array2d inner =
      (position_m - area.min_m).array().min((area.max_m - position_m).array());
  return inner.minCoeff();  // outside: negative
}

Standing ErrorSorter::standing_of(const PersonSight& sight) const {
  if (sight.behind_occluder >= rules_.hidden_share) return Standing::kBehindOccluder;
  if (sight.behind_people >= rules_.hidden_share) return Standing::kBehindPeople;
  if (sight.cut >= rules_.cut_share || sight.border_m < rules_.border_m) return Standing::kAtBorder;
  if (sight.nearest_m < rules_.near_m) return Standing::kNearAnother;
  if (sight.hidden >= rules_.hidden_share) return Standing::kHidden;
  return Standing::kInSight;
}

std::vector<PersonSight> ErrorSorter::sights_of(const GroundTruth& truth) const {
  std::vector<PersonSight> sights(truth.people.size());
  for (std::size_t i = 0; i < truth.people.size(); ++i) {
    sights[i].person = i;
    sights[i].position_m = place_of(truth.people[i], *scene_);
    if (sights[i].position_m) sights[i].border_m = border_distance_m(*sights[i].position_m);
  }
  for (PersonSight& sight : sights) {
    const TruePerson& person = truth.people[sight.person];
    for (const PersonSight& other : sights) {
      if (other.person == sight.person || !sight.position_m || !other.position_m) continue;
      sight.nearest_m = std::min(sight.nearest_m, (*sight.position_m - *other.position_m).norm());
    }
    for (const TrueView& view : person.views) {
      const Camera& camera = scene_->cameras.at(view.camera);
      const Eigen::Vector2d eye = camera.centre().head<2>();
      std::vector<Box> nearer;
      for (const PersonSight& other : sights) {
        if (other.person == sight.person || !sight.position_m || !other.position_m) continue;
        const Box* const box = box_in(truth.people[other.person], view.camera);
        const bool hides = (*other.position_m - eye).norm() < (*sight.position_m - eye).norm();
        if (box != nullptr && hides) nearer.push_back(*box);
      }
      const auto share = 1 / static_cast<double>(person.views.size());
      sight.behind_occluder += share * covered_share(view.box, occluders_[view.camera], {});
      sight.behind_people += share * covered_share(view.box, {}, nearer);
      sight.hidden += share * (1 - view.visibility);
      if (view.box.area() > 0) {
        sight.cut += share * (1 - intersection_area(view.box, image_box(camera)) / view.box.area());
      }
    }
    sight.standing = standing_of(sight);
  }
  return sights;
}

}  // namespace plaza
