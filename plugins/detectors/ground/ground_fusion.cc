#include "plugins/detectors/ground/ground_fusion.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "plugins/detectors/common/box_ground.h"
#include "plugins/detectors/ground/sight.h"

namespace plaza {
namespace {

// Probabilities of exactly 0 or 1 would be beyond all evidence.
constexpr double kCertain = 1e-9;

double logit(double probability) {
  const double p = std::clamp(probability, kCertain, 1 - kCertain);
  return std::log(p / (1 - p));
}

double logistic(double log_odds) { return 1 / (1 + std::exp(-log_odds)); }

/// Two boxes in one view are two people, however close they stand.
bool share_view(const Observation& a, const Observation& b) {
  return std::any_of(a.boxes.begin(), a.boxes.end(), [&](const ViewBox& x) {
    return std::any_of(b.boxes.begin(), b.boxes.end(),
                       [&](const ViewBox& y) { return x.camera == y.camera; });
  });
}

}  // namespace

Declaration<GroundFusion::Options> GroundFusion::declare() {
  Parameters<Options> p;
  p.value("person_density_per_m2", &Options::person_density_per_m2)
      .unit("1/m^2")
      .above(0)
      .meaning("people per square metre: the denser, the closer views must agree to be joined");
  p.value("view_sigma_m", &Options::view_sigma_m)
      .unit("m")
      .at_least(0)
      .meaning("standard deviation between views that calibration and posture cause, per axis");
  p.value("detection_probability", &Options::detection_probability)
      .at_least(0)
      .below(1)
      .meaning("how often a view detects a person whom it sees wholly");
  p.value("min_probability", &Options::min_probability)
      .at_least(0)
      .at_most(1)
      .meaning("less probable people are not given on");
  p.value("min_views", &Options::min_views)
      .at_least(1)
      .meaning("people seen in fewer views are not given on");
  p.value("min_distance_m", &Options::min_distance_m)
      .unit("m")
      .at_least(0)
      .meaning(
          "of two people nearer to each other whom no view tells apart, the more probable stays");
  p.value("margin_m", &Options::margin_m)
      .unit("m")
      .meaning("how far outside the scene's area people are kept");
  Declaration<Options> d("ground-fusion",
                         "Joins the observations of several views into one per person.");
  return d.input<Observations>("observations with the box of one view each")
      .output<Observations>("one observation per person, with the boxes of all views that saw it")
      .source("Bar-Shalom and Li, Multitarget-Multisensor Tracking, 1995, 2.3 (likelihood ratios)")
      .parameters(std::move(p));
}

GroundFusion::GroundFusion(const Options& options, const BuildContext& context)
    : options_(options), scene_(context.scene) {}

std::vector<ViewMeasurement> GroundFusion::measurements(
    const std::vector<Observation>& items) const {
  const double view_variance = options_.view_sigma_m * options_.view_sigma_m;
  std::vector<ViewMeasurement> out;
  out.reserve(items.size());
  for (const Observation& o : items) {
    if (o.boxes.size() != 1) {
      throw UserError("ground-fusion joins observations of single views, but was given one with " +
                      std::to_string(o.boxes.size()) +
                      " boxes; let it read a detector that works view by view, such as 'boxes'");
    }
    if (o.boxes[0].camera >= scene_->cameras.size()) {
      throw InternalError("observation of camera " + std::to_string(o.boxes[0].camera) +
                          " in a scene of " + std::to_string(scene_->cameras.size()));
    }
    out.push_back({.camera = o.boxes[0].camera,
                   .position_m = o.position_m,
                   .covariance_m2 = o.covariance_m2 + view_variance * Eigen::Matrix2d::Identity()});
  }
  return out;
}

Observation GroundFusion::fused(const MeasurementGroup& group,
                                const std::vector<Observation>& items) const {
  Observation person;
  person.position_m = group.position_m;
  person.covariance_m2 = group.covariance_m2;

  double log_odds = group.log_evidence;
  std::vector<bool> saw(scene_->cameras.size(), false);
  const Observation* best = &items.at(group.members.at(0));
  for (const std::size_t i : group.members) {
    const Observation& o = items[i];
    log_odds += logit(o.probability);
    saw[o.boxes[0].camera] = true;
    person.boxes.push_back(o.boxes[0]);
    if (o.probability > best->probability) best = &o;
  }
  person.heading_rad = best->heading_rad;
  person.features = best->features;

  for (std::size_t camera = 0; camera < scene_->cameras.size(); ++camera) {
    if (saw[camera]) continue;
    std::vector<Screen> screens;
    for (const Observation& o : items) {
      if (o.boxes[0].camera != camera) continue;
      screens.push_back({.box = o.boxes[0].box,
                         .distance_m = ground_distance(scene_->cameras[camera], o.position_m)});
    }
    const double share = visible_share(*scene_, camera, group.position_m, screens);
    log_odds += std::log1p(-options_.detection_probability * share);
  }
  person.probability = logistic(log_odds);
  person.score = log_odds;
  return person;
}

Observations GroundFusion::do_detect(const NodeIo& io) const {
  const Observations& seen = io.in<Observations>(0);
  const std::vector<ViewMeasurement> positions = measurements(seen.items);
  const GroundArea area = grown(scene_->area, options_.margin_m);

  std::vector<Observation> people;
  for (const MeasurementGroup& group :
       partition(positions, scene_->cameras.size(), options_.person_density_per_m2)) {
    if (std::cmp_less(group.members.size(), options_.min_views)) continue;
    if (!area.contains(group.position_m)) continue;
    Observation person = fused(group, seen.items);
    if (person.probability >= options_.min_probability) people.push_back(std::move(person));
  }
  std::stable_sort(people.begin(), people.end(), [](const Observation& a, const Observation& b) {
    return a.probability > b.probability;
  });

  Observations out;
  out.grid = seen.grid;
  for (Observation& person : people) {
    const bool repeated =
        std::any_of(out.items.begin(), out.items.end(), [&](const Observation& other) {
          return (other.position_m - person.position_m).norm() < options_.min_distance_m &&
                 !share_view(other, person);
        });
    if (!repeated) out.items.push_back(std::move(person));
  }
  return out;
}

}  // namespace plaza
