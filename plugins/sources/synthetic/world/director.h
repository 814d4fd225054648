#pragma once

#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <vector>

#include "plugins/sources/synthetic/people/acts.h"
#include "plugins/sources/synthetic/people/random.h"
#include "plugins/sources/synthetic/world/cast.h"
#include "plugins/sources/synthetic/world/crowd.h"
#include "plugins/sources/synthetic/world/routes.h"

namespace plaza::synthetic {

/// One part of a meeting.
struct Phase {
  enum class Kind { kTalk, kHandshake, kHug, kRest };
  Kind kind = Kind::kTalk;
  double seconds = 4;
};

/// People who come together, interact phase by phase, and part.
struct Meeting {
  std::vector<std::size_t> who;
  Eigen::Vector2d center_m = Eigen::Vector2d::Zero();
  double angle_rad = 0;   ///< from the centre to the first one
  double circle_rad = 0;  ///< by which they walk around each other while it lasts
  double approach_mps = 1.2;
  std::vector<Phase> phases;
};

/// What a person did from coming to going: the samples of its motion over the ground, and its acts.
struct Stay {
  struct StayAct {
    ActKind kind;
    double begin_s, end_s;
    std::uint64_t seed;
    std::size_t partner;  ///< a person; of handshakes and hugs
  };
  std::size_t person = 0;
  double start_s = 0;
  std::vector<Eigen::Vector2d> position_m;
  std::vector<double> heading_rad;
  std::vector<StayAct> acts;
};

class Director;

/// How listeners and people who stand about hold their arms.
ActKind resting_posture(Random& random);

/// What is to happen. A scenario gives orders to people; whoever has done all of them is asked
/// about again.
class Scenario {
 public:
  virtual ~Scenario() = default;
  /// Called once: engages the cast, lets people appear, makes appointments.
  virtual void begin(Director& director) = 0;
  /// Person `who` is present and has nothing to do.
  virtual void idle(Director& director, std::size_t who) = 0;
};

/// Makes people on a stage do what a scenario orders, moment by moment, and writes down what they
/// did.
class Director {
 public:
  Director(const Stage& stage, std::uint64_t seed, double start_s);

  // what scenarios read
  const Stage& stage() const { return stage_; }
  double now_s() const { return now_s_; }
  Random& random() { return random_; }
  std::size_t people() const { return cast_.size(); }
  const Walker& walker(std::size_t who) const { return crowd_.walkers[who]; }
  bool is_present(std::size_t who) const { return walker(who).present; }
  bool is_meeting(std::size_t who) const;
  bool is_leaving(std::size_t who) const;
  /// How many are in the area or on their way there; not those on their way out who are through.
  std::size_t count_claiming() const;
  /// The part of the area that scenarios play in: all of it, up to 7 m in each direction.
  Rectangle floor() const;
  /// A free place at least `margin_m` inside the floor, away from everyone but `except`.
  Eigen::Vector2d free_place(double margin_m, std::size_t except);
  /// The free place nearest to a wish.
  Eigen::Vector2d free_near(const Eigen::Vector2d& wish) const;

  // what scenarios order; orders of one person are done one after the other
  std::size_t engage(ClothingStyle style);
  CastMember& member(std::size_t who) { return cast_[who]; }
  /// How near a person lets others pass: the radius of its personal space while walking.
  void set_space(std::size_t who, double space_m) { crowd_.walkers[who].space_m = space_m; }
  void appear(std::size_t who, const Eigen::Vector2d& position_m, double heading_rad);
  void enter(std::size_t who, std::size_t door, double speed_mps);
  void leave(std::size_t who, std::size_t door, double speed_mps);
  void go(std::size_t who, const Eigen::Vector2d& to_m, double speed_mps, Facing facing = {});
  void stand(std::size_t who, double seconds, Facing facing = {});
  /// The people drop what else they were ordered to do.
  void meet(Meeting meeting);
  /// Something the arms do for a while from now on.
  void act(std::size_t who, ActKind kind, double seconds);
  /// Lets go of what a person was ordered to do, and of what its arms do.
  void drop_orders(std::size_t who);
  void later(double at_s, std::function<void()> what);

  void run(Scenario& scenario, double until_s);
  std::vector<CastMember> take_cast() { return std::move(cast_); }
  std::vector<Stay> take_stays();

 private:
  struct Order {
    enum class Kind { kGo, kStand, kMeet, kLeave };
    Kind kind = Kind::kGo;
    Eigen::Vector2d to_m = Eigen::Vector2d::Zero();
    double speed_mps = 1.2;
    double seconds = 0;
    Facing facing;
    std::size_t meeting = 0;
    std::size_t door = 0;
    bool exact = true;      // goes to the very place, not through it
    double begun_s = -1e9;  // long ago: not yet
  };
  struct Running {
    Meeting plan;
    int group = 0;
    double called_s = 0;
    bool begun = false;
    double begun_s = 0;
    std::size_t phase = 0;
    double phase_begun_s = 0;
    double turned_rad = 0;
    bool over = false;
  };

  void begin_order(std::size_t who, Order& order);
  bool is_done(std::size_t who, const Order& order) const;
  void advance_meeting(Running& meeting);
  void begin_phase(Running& meeting);
  void place_members(Running& meeting);
  double distance_of(const Running& meeting) const;
  void end_meeting(Running& meeting);
  void break_off_acts(std::size_t who);
  void vanish(std::size_t who);
  void record();

  Stage stage_;
  Random random_;
  double start_s_;
  double now_s_;
  std::size_t ticks_ = 0;
  Routes routes_;
  Crowd crowd_;
  std::vector<CastMember> cast_;
  std::vector<std::deque<Order>> orders_;
  std::vector<Running> meetings_;
  std::multimap<double, std::function<void()>> appointments_;
  std::vector<Stay> finished_;
  std::map<std::size_t, Stay> open_;
};

}  // namespace plaza::synthetic
