#include "plugins/associators/gnn/gnn.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "plaza/math/assignment.h"

namespace plaza {
namespace {

GroundArea grown(const GroundArea& area, double margin_m) {
  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(margin_m);
  return {.min_m = area.min_m - margin, .max_m = area.max_m + margin};
}

}  // namespace

Declaration<Gnn::Options> Gnn::declare() {
  Parameters<Options> p;
  p.value("gate_m", &Options::gate_m)
      .unit("m")
      .above(0)
      .meaning("radius of the validation gate around a target's predicted position")
      .source("thesis (6.1)");
  p.value("gate_sigma", &Options::gate_sigma)
      .at_least(0)
      .meaning("further gate: largest Mahalanobis distance; 0: none");
  p.value("confirm", &Options::confirm)
      .at_least(1)
      .meaning("counter at which a target is taken to be a person and gets its identity")
      .source("thesis 6.3, Algorithm 2");
  p.value("max_count", &Options::max_count)
      .at_least(1)
      .meaning("MaxC, where the counter stops: so many frames a target lives without detection")
      .source("thesis 6.3, Algorithm 2");
  p.value("min_start_probability", &Options::min_start_probability)
      .at_least(0)
      .at_most(1)
      .meaning("less probable observations continue targets but start none");
  p.value("coast_s", &Options::coast_s)
      .unit("s")
      .at_least(0)
      .meaning(
          "how long after its last observation a target that is not seen again is still put out; "
          "between two observations it always is");
  p.value("smoothing_s", &Options::smoothing_s)
      .unit("s")
      .at_least(0)
      .meaning(
          "positions are smoothed with what is observed so long before and after; the delay of "
          "final positions; 0: the motion model's filtered positions");
  p.value("heading_speed_mps", &Options::heading_speed_mps)
      .unit("m/s")
      .above(0)
      .meaning("people who walk faster face where they go; slower ones as observed, if at all");
  p.choice("reentry", &Options::reentry, {"new", "keep"})
      .meaning("identity of a person who comes back after leaving the area longer than reentry_s")
      .source("thesis 3.3.1");
  p.value("reentry_s", &Options::reentry_s)
      .unit("s")
      .at_least(0)
      .meaning("a shorter stay outside the area never changes the identity");
  p.value("memory_s", &Options::memory_s)
      .unit("s")
      .at_least(0)
      .meaning("with reentry 'keep': how long a person who left is remembered");
  p.value("reentry_border_m", &Options::reentry_border_m)
      .unit("m")
      .at_least(0)
      .meaning("people leave and come back this near to the area's border, or outside");
  p.value("reentry_reach_m", &Options::reentry_reach_m)
      .unit("m")
      .at_least(0)
      .meaning("how far from where they left people come back, however short they were away");
  p.value("reentry_speed_mps", &Options::reentry_speed_mps)
      .unit("m/s")
      .at_least(0)
      .meaning("how fast that reach grows while they are away");
  p.value("margin_m", &Options::margin_m)
      .unit("m")
      .meaning(
          "people are followed wherever observations are, and put out up to here outside the area");
  p.part("motion", "motion", "constant-velocity").meaning("predicts where targets go");
  Declaration<Options> d("gnn", "Tracks people by global nearest neighbour association.");
  return d.source("thesis 6.3, (6.1), Algorithm 2")
      .input<Observations>("people of this frame")
      .output<Tracks>("confirmed people, final after the smoothing window")
      .output<Tracklets>("each person's path, when it has ended")
      .parameters(std::move(p));
}

Gnn::Gnn(const Options& options, const BuildContext& context)
    : options_(options),
      scene_(context.scene),
      motion_(context.part<MotionModel>("motion")),
      reentry_(options.reentry == Identity::kKeep ? std::max(options.memory_s, options.reentry_s)
                                                  : options.reentry_s,
               options.reentry_reach_m, options.reentry_speed_mps) {
  if (options_.max_count < options_.confirm) {
    throw UserError(fault_at(
        "/max_count", "must be at least 'confirm': a counter that stops below it confirms nobody"));
  }
}

void Gnn::predict(std::int64_t frame, double time_s) {
  for (Target& target : targets_) {
    target.state = motion_->predict(target.state, time_s - last_time_s_);
    TargetSample sample;
    sample.id = target.id;
    sample.frame = frame;
    sample.time_s = time_s;
    sample.position_m = motion_->position(target.state);
    sample.velocity_mps = motion_->velocity(target.state);
    // nothing new was learned: what speaks for the target is what did at its last observation
    sample.score = target.samples[target.last_observed].score;
    target.samples.push_back(std::move(sample));
  }
}

std::vector<int> Gnn::assign(const std::vector<Observation>& observations) const {
  const auto rows = static_cast<Eigen::Index>(targets_.size());
  const auto columns = static_cast<Eigen::Index>(observations.size());
  Eigen::MatrixXd distance =
      Eigen::MatrixXd::Constant(rows, columns, std::numeric_limits<double>::infinity());
  for (Eigen::Index i = 0; i < rows; ++i) {
    const Target& target = targets_[static_cast<std::size_t>(i)];
    const Eigen::Vector2d predicted = motion_->position(target.state);
    const Eigen::Matrix2d covariance = motion_->position_covariance(target.state);
    for (Eigen::Index j = 0; j < columns; ++j) {
      const Observation& o = observations[static_cast<std::size_t>(j)];
      const Eigen::Vector2d difference = o.position_m - predicted;
      if (difference.norm() > options_.gate_m) continue;
      if (options_.gate_sigma > 0) {
        const Eigen::Matrix2d innovation = covariance + o.covariance_m2;
        const double squared = difference.dot(innovation.inverse() * difference);
        if (squared > options_.gate_sigma * options_.gate_sigma) continue;
      }
      distance(i, j) = difference.norm();
    }
  }
  return assign_minimum_cost(distance);
}

void Gnn::observe(Target& target, const Observation& observation) {
  target.state = motion_->correct(target.state, observation.position_m, observation.covariance_m2);
  target.counter = std::min(target.counter + 1, options_.max_count);
  TargetSample& sample = target.samples.back();
  sample.position_m = motion_->position(target.state);
  sample.velocity_mps = motion_->velocity(target.state);
  sample.observed = true;
  sample.measured_m = observation.position_m;
  sample.weight = 2 / observation.covariance_m2.trace();
  sample.score = observation.probability;
  sample.heading_rad = observation.heading_rad;
  sample.boxes = observation.boxes;
  target.last_observed = target.samples.size() - 1;
}

void Gnn::create(const Observation& observation, std::int64_t frame, double time_s) {
  Target target;
  target.state = motion_->start(observation.position_m, observation.covariance_m2);
  target.counter = 0;  // observe() counts this observation, which makes it 1
  TargetSample sample;
  sample.frame = frame;
  sample.time_s = time_s;
  target.samples.push_back(std::move(sample));
  target.last_inside_s = time_s;
  MotionState start = target.state;
  observe(target, observation);
  target.state = std::move(start);  // the same observation must not count twice
  target.samples.back().position_m = motion_->position(target.state);
  target.samples.back().velocity_mps = motion_->velocity(target.state);
  targets_.push_back(std::move(target));
}

bool Gnn::at_border(const Eigen::Vector2d& position_m) const {
  return !grown(scene_->area, -options_.reentry_border_m).contains(position_m);
}

void Gnn::confirm_targets() {
  std::vector<Target*> confirmed;
  std::vector<Target*> from_border;
  std::vector<Arrival> arrivals;
  for (Target& target : targets_) {
    if (target.confirmed() || target.counter < options_.confirm) continue;
    confirmed.push_back(&target);
    const TargetSample& first = target.samples.front();
    if (!at_border(first.measured_m)) continue;
    from_border.push_back(&target);
    arrivals.push_back(
        {.first_frame = first.frame, .time_s = first.time_s, .position_m = first.measured_m});
  }
  const std::vector<TrackId> known = reentry_.recognise(arrivals);
  for (std::size_t i = 0; i < from_border.size(); ++i) from_border[i]->id = known[i];
  for (Target* target : confirmed) {
    if (!target->confirmed()) target->id = next_id_++;
    for (TargetSample& sample : target->samples) sample.id = target->id;
  }
}

/// A target may be followed all the time that it is outside; who it is when it comes back is
/// another matter.
void Gnn::renew_identity(Target& target) {
  TargetSample& sample = target.samples.back();
  if (!scene_->area.contains(sample.position_m)) return;
  const double away_s = sample.time_s - target.last_inside_s;
  const bool left = target.samples.size() > 1 &&
                    !scene_->area.contains(target.samples[target.samples.size() - 2].position_m);
  target.last_inside_s = sample.time_s;
  if (left && target.confirmed() && options_.reentry == Identity::kNew &&
      away_s > options_.reentry_s) {
    target.id = next_id_++;
    sample.id = target.id;
  }
}

TrackPoint Gnn::point(const Target& target, std::size_t index) const {
  const TargetSample& sample = target.samples[index];
  const SmoothedPoint place = smoothed(target.samples, index, options_.smoothing_s);
  TrackPoint out;
  out.id = sample.id;
  out.frame = sample.frame;
  out.position_m = place.position_m;
  out.heading_rad = sample.heading_rad;
  if (place.velocity_mps.norm() > options_.heading_speed_mps) {
    out.heading_rad = std::atan2(place.velocity_mps.y(), place.velocity_mps.x());
  }
  out.score = sample.score;
  out.observed = sample.observed;
  out.boxes = sample.boxes;
  return out;
}

void Gnn::finish(Target& target, std::size_t end, AssociatorOutput& output) const {
  const GroundArea area = grown(scene_->area, options_.margin_m);
  for (; target.final_count < end; ++target.final_count) {
    TrackPoint out = point(target, target.final_count);
    if (!area.contains(out.position_m)) continue;
    out.final = true;
    output.points.push_back(std::move(out));
  }
}

void Gnn::finish_due(Target& target, double now_s, AssociatorOutput& output) const {
  // half a nanosecond: times are whole nanoseconds, read back through a double
  const double due_s = now_s - options_.smoothing_s + 5e-10;
  std::size_t end = target.final_count;
  while (end <= target.last_observed && target.samples[end].time_s <= due_s) ++end;
  finish(target, end, output);
}

void Gnn::put_open(const Target& target, AssociatorOutput& output) const {
  const std::size_t last = target.samples.size() - 1;
  if (last < target.final_count) return;
  TrackPoint out = point(target, last);
  if (grown(scene_->area, options_.margin_m).contains(out.position_m)) {
    output.points.push_back(std::move(out));
  }
}

void Gnn::terminate(Target& target, AssociatorOutput& output) {
  if (!target.confirmed()) return;
  const TargetSample& last = target.samples[target.last_observed];
  std::size_t end = target.last_observed + 1;
  while (end < target.samples.size() &&
         target.samples[end].time_s <= last.time_s + options_.coast_s + 5e-10) {
    ++end;
  }
  finish(target, end, output);
  if (at_border(last.position_m)) {
    reentry_.leave({.id = target.id,
                    .last_frame = target.samples[end - 1].frame,
                    .time_s = last.time_s,
                    .position_m = last.position_m});
  }
  const GroundArea area = grown(scene_->area, options_.margin_m);
  for (std::size_t i = 0; i < end; ++i) {
    TrackPoint p = point(target, i);
    if (!area.contains(p.position_m)) continue;
    p.final = true;
    if (output.tracklets.empty() || output.tracklets.back().id != p.id) {
      output.tracklets.push_back({.id = p.id, .points = {}, .features = {}});
    }
    output.tracklets.back().points.push_back(std::move(p));
  }
}

AssociatorOutput Gnn::do_push(const AssociatorInput& input) {
  static const std::vector<Observation> kNone;
  const std::vector<Observation>& observations =
      input.observations ? input.observations->items : kNone;
  const double time_s = static_cast<double>(input.time_ns) * 1e-9;
  AssociatorOutput output;

  predict(input.frame, time_s);
  const std::vector<int> observation_of_target = assign(observations);
  std::vector<bool> used(observations.size(), false);
  for (std::size_t i = 0; i < targets_.size(); ++i) {
    Target& target = targets_[i];
    if (observation_of_target[i] >= 0) {
      const auto j = static_cast<std::size_t>(observation_of_target[i]);
      used[j] = true;
      observe(target, observations[j]);
    } else {
      --target.counter;
    }
    renew_identity(target);
  }
  for (Target& target : targets_) {
    if (target.counter == 0) terminate(target, output);
  }
  std::erase_if(targets_, [](const Target& target) { return target.counter == 0; });
  for (std::size_t j = 0; j < observations.size(); ++j) {
    if (!used[j] && observations[j].probability >= options_.min_start_probability) {
      create(observations[j], input.frame, time_s);
    }
  }
  confirm_targets();
  reentry_.forget(time_s);
  for (Target& target : targets_) {
    if (!target.confirmed()) continue;
    finish_due(target, time_s, output);
    put_open(target, output);
  }
  last_time_s_ = time_s;
  return output;
}

AssociatorOutput Gnn::do_flush_tracks() {
  AssociatorOutput output;
  for (Target& target : targets_) terminate(target, output);
  targets_.clear();
  return output;
}

}  // namespace plaza
