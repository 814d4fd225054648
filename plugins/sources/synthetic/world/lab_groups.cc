// Scenarios of groups: standing together, and coming and going.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "plugins/sources/synthetic/world/common_orders.h"
#include "plugins/sources/synthetic/world/scenarios.h"

namespace plaza::synthetic {
namespace {

using Eigen::Vector2d;

/// Thesis table 3.1, "Lab 4 Targets - Interaction": four people stand together for long, in one
/// circle or in pairs, and move slowly between.
class FourInteraction final : public Scenario {
 public:
  void begin(Director& director) override {
    const Rectangle floor = director.floor();
    Random& random = director.random();
    const double first = random.uniform(0, 2 * std::numbers::pi);
    for (int i = 0; i < 4; ++i) {
      const std::size_t who = director.engage(ClothingStyle::kAny);
      const double angle = first + std::numbers::pi / 2 * (i + random.uniform(-0.2, 0.2));
      const Vector2d place =
          director.free_near(floor.center() + 1.25 * Vector2d(std::cos(angle), std::sin(angle)));
      director.appear(who, place, angle + std::numbers::pi);
    }
    form(director);
  }

  void idle(Director& director, std::size_t who) override {
    // who is done first stands until the others are
    for (std::size_t other = 0; other < 4; ++other) {
      if (other != who && director.is_meeting(other)) {
        director.stand(who, 0.4);
        return;
      }
    }
    form(director);
  }

 private:
  void form(Director& director) {
    Random& random = director.random();
    std::vector<std::size_t> order = {0, 1, 2, 3};
    for (std::size_t i = 3; i > 0; --i) {
      std::swap(order[i], order[random.index(i + 1)]);
    }
    const Rectangle floor = director.floor();
    const Vector2d middle =
        floor.center() + Vector2d(random.uniform(-0.6, 0.6), random.uniform(-0.45, 0.2));
    all_ = !all_ && random.chance(0.7);
    const bool all = all_;
    const double tilt = random.uniform(0, 2 * std::numbers::pi);
    for (std::size_t pair = 0; pair < (all ? 1U : 2U); ++pair) {
      Meeting meeting;
      meeting.approach_mps = random.uniform(0.45, 0.8);
      if (all) {
        // as they stand around the middle, so that nobody has to pass through the others
        meeting.who = {0, 1, 2, 3};
        const auto angle = [&](std::size_t who) {
          const Vector2d from = director.walker(who).position - middle;
          return std::atan2(from.y(), from.x());
        };
        std::sort(meeting.who.begin(), meeting.who.end(),
                  [&](std::size_t a, std::size_t b) { return angle(a) < angle(b); });
        meeting.angle_rad = angle(meeting.who[0]);
        meeting.center_m = middle;
        meeting.phases = {{Phase::Kind::kTalk, random.uniform(4.0, 7.0)},
                          {Phase::Kind::kRest, random.uniform(2.0, 4.0)}};
      } else {
        meeting.who = {order[2 * pair], order[2 * pair + 1]};
        const Vector2d aside(std::cos(tilt), 0.8 * std::sin(tilt));
        meeting.center_m = director.free_near(middle + (pair == 0 ? 0.75 : -0.75) * aside);
        const Vector2d from =
            director.walker(meeting.who[0]).position - director.walker(meeting.who[1]).position;
        meeting.angle_rad = std::atan2(from.y(), from.x());
        meeting.circle_rad = random.uniform(-0.6, 0.6);
        meeting.phases = greeting(random, random.uniform(5.0, 9.0));
        meeting.phases.push_back({Phase::Kind::kRest, random.uniform(1.0, 3.0)});
      }
      director.meet(std::move(meeting));
    }
  }

  bool all_ = false;
};

/// Thesis table 3.1, "Lab 6 Targets": the area is never without a few people, six at most, and
/// nine identities come by within the first 20 s.
class SixTargets final : public Scenario {
 public:
  void begin(Director& director) override {
    spread(director, 4, ClothingStyle::kAny);
    schedule(director);
  }

  void idle(Director& director, std::size_t who) override {
    Random& random = director.random();
    const double choice = random.unit();
    if (choice < 0.35 && meet_someone(director, who, 2.0, 4.0)) {
      return;
    }
    if (choice < 0.7) {
      cross(director, who, 0.9, 1.4, 0.5);
    } else {
      roam(director, who, 0.8, 1.3, 1.8);
    }
  }

 private:
  void schedule(Director& director) {
    // at first two arrive; then someone leaves every few seconds, and someone else comes
    director.later(-1.2, [&] { arrive(director); });
    director.later(0.6, [&] { arrive(director); });
    director.later(1.6, [&] { depart(director); });
  }

  void arrive(Director& director) {
    if (director.count_claiming() >= 6) {
      director.later(director.now_s() + 0.3, [&] { arrive(director); });
      return;
    }
    // someone who was here before comes back now and then
    std::size_t who = director.people();
    if (director.now_s() > 20 && director.random().chance(0.7)) {
      for (std::size_t other = 0; other < director.people(); ++other) {
        if (!director.is_present(other)) {
          who = other;
          break;
        }
      }
    }
    if (who == director.people()) {
      who = director.engage(ClothingStyle::kAny);
    }
    next_door_ = (next_door_ + 1) % director.stage().doors.size();
    director.enter(who, next_door_, director.random().uniform(1.1, 1.4));
  }

  void depart(Director& director) {
    // who has been here longest and has nothing to finish
    for (std::size_t n = 0; n < director.people(); ++n) {
      const std::size_t who = (longest_ + n) % director.people();
      if (director.is_present(who) && !director.is_meeting(who) && !director.is_leaving(who) &&
          director.walker(who).confined) {
        longest_ = who + 1;
        director.drop_orders(who);
        director.leave(who, director.random().index(director.stage().doors.size()),
                       director.random().uniform(1.1, 1.4));
        director.later(director.now_s() + 0.5, [&] { arrive(director); });
        director.later(director.now_s() + director.random().uniform(3.1, 3.7),
                       [&] { depart(director); });
        return;
      }
    }
    director.later(director.now_s() + 0.3, [&] { depart(director); });
  }

  std::size_t next_door_ = 0;
  std::size_t longest_ = 0;
};

/// Any number of people in the area: they walk about, cross, stand and meet.
class CrowdScenario final : public Scenario {
 public:
  explicit CrowdScenario(int people) : people_(people) {}
  void begin(Director& director) override { spread(director, people_, ClothingStyle::kAny); }
  void idle(Director& director, std::size_t who) override {
    Random& random = director.random();
    const double choice = random.unit();
    if (choice < 0.2 && meet_someone(director, who, 2.0, 4.0)) {
      return;
    }
    if (choice < 0.5) {
      cross(director, who, 0.9, 1.4, 0.8);
    } else {
      roam(director, who, 0.8, 1.3, 2.5);
    }
  }

 private:
  int people_;
};

}  // namespace

std::unique_ptr<Scenario> make_interaction(int /*people*/) {
  return std::make_unique<FourInteraction>();
}
std::unique_ptr<Scenario> make_six_targets(int /*people*/) {
  return std::make_unique<SixTargets>();
}
std::unique_ptr<Scenario> make_crowd(int people) { return std::make_unique<CrowdScenario>(people); }

}  // namespace plaza::synthetic
