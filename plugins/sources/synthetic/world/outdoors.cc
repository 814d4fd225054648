// Scenarios outdoors: people pass through, and some stay for a while.

#include <cmath>
#include <numbers>

#include "plugins/sources/synthetic/world/common_orders.h"
#include "plugins/sources/synthetic/world/scenarios.h"

namespace plaza::synthetic {
namespace {

using Eigen::Vector2d;

/// People come through one gate and, sooner or later, leave through another. There are never more
/// than `most`, and once it has begun seldom less than half of them.
class Passage : public Scenario {
 public:
  struct Habits {
    std::size_t most = 4;
    std::size_t at_first = 3;
    double runners = 0.0;    // share of people
    double sojourn = 0.3;    // probability of doing one more thing before leaving
    double meeting = 0.1;    // probability that this is meeting someone
    double between_s = 3.0;  // mean time between arrivals
  };

  explicit Passage(const Habits& habits) : habits_(habits) {}

  void begin(Director& director) override {
    spread(director, static_cast<int>(habits_.at_first), ClothingStyle::kAny);
    for (std::size_t who = 0; who < director.people(); ++who) {
      runs_.push_back(director.random().chance(habits_.runners));
    }
    director.later(director.now_s() + 0.5, [&] { arrive(director); });
  }

  void idle(Director& director, std::size_t who) override {
    Random& random = director.random();
    const bool runs = runs_[who];
    if (director.walker(who).confined && random.chance(habits_.sojourn)) {
      if (!runs && random.chance(habits_.meeting) && meet_someone(director, who, 3.0, 7.0)) {
        return;
      }
      if (runs) {
        roam(director, who, 2.8, 3.6, 1.0);
      } else if (random.chance(0.5)) {
        cross(director, who, 1.0, 1.5, 1.5);
      } else {
        roam(director, who, 0.9, 1.4, 3.0);
      }
      return;
    }
    director.leave(who, random.index(director.stage().doors.size()),
                   runs ? random.uniform(2.8, 3.8) : random.uniform(1.1, 1.6));
  }

 private:
  void arrive(Director& director) {
    Random& random = director.random();
    if (director.count_claiming() < habits_.most) {
      const std::size_t who = director.engage(ClothingStyle::kAny);
      runs_.push_back(random.chance(habits_.runners));
      director.enter(who, random.index(director.stage().doors.size()),
                     runs_[who] ? random.uniform(2.8, 3.8) : random.uniform(1.1, 1.6));
    }
    director.later(director.now_s() + habits_.between_s * random.uniform(0.5, 1.5),
                   [&] { arrive(director); });
  }

  Habits habits_;
  std::vector<bool> runs_;
};

}  // namespace

/// Thesis table 3.1, "EPFL - Campus", with runners among the walkers.
std::unique_ptr<Scenario> make_campus(int /*people*/) {
  Passage::Habits habits;
  habits.most = 4;
  habits.at_first = 3;
  habits.runners = 0.3;
  habits.sojourn = 0.45;
  habits.meeting = 0.15;
  habits.between_s = 2.5;
  return std::make_unique<Passage>(habits);
}

/// Thesis table 3.1, "EPFL - Terrace": up to nine people, most of whom stay.
std::unique_ptr<Scenario> make_terrace(int /*people*/) {
  Passage::Habits habits;
  habits.most = 9;
  habits.at_first = 6;
  habits.runners = 0.0;
  habits.sojourn = 0.85;
  habits.meeting = 0.3;
  habits.between_s = 1.6;
  return std::make_unique<Passage>(habits);
}

}  // namespace plaza::synthetic
