// Test components: what stands inside nodes, shapes, a motion model and affinity terms.
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "tests/support/test_component_groups.h"

namespace plaza::test {
namespace {

class QuietShape : public ShapeModel {
 protected:
  Silhouette do_silhouette(const Pose& /*pose*/, const Camera& /*camera*/) const override {
    return {};
  }
  Body do_body() const override { return {}; }
};

class Cylinder : public QuietShape {
 public:
  struct Options {
    std::vector<double> radii_m = {0.12, 0.25, 0.18};
  };
  static Declaration<Options> declare() {
    Parameters<Options> p;
    p.value("radii_m", &Options::radii_m)
        .unit("m")
        .items(3, 3)
        .above(0)
        .meaning("of head, torso and legs");
    return Declaration<Options>("cylinder", "Three cylinders.").parameters(std::move(p));
  }
  Cylinder(const Options& options, const BuildContext& /*context*/) {
    if (options.radii_m[0] > options.radii_m[1]) {
      throw fault("/radii_m/0", "the head is wider than the torso");
    }
  }
};

class Cuboid : public QuietShape {
 public:
  struct Options {
    double width_m = 0.5;
  };
  static Declaration<Options> declare() {
    Parameters<Options> p;
    p.value("width_m", &Options::width_m).unit("m").above(0).meaning("width");
    return Declaration<Options>("cuboid", "A box.").parameters(std::move(p));
  }
  Cuboid(const Options& /*options*/, const BuildContext& /*context*/) {}
};

class ConstantVelocity : public MotionModel {
 public:
  struct Options {
    double sigma_mps2 = 1.0;
  };
  static Declaration<Options> declare() {
    Parameters<Options> p;
    p.value("sigma_mps2", &Options::sigma_mps2)
        .unit("m/s^2")
        .above(0)
        .meaning("of the acceleration");
    return Declaration<Options>("constant-velocity", "People keep going.").parameters(std::move(p));
  }
  ConstantVelocity(const Options& /*options*/, const BuildContext& /*context*/) {}

 protected:
  MotionState do_start(const Eigen::Vector2d& /*p*/, const Eigen::Matrix2d& /*c*/) const override {
    return {};
  }
  MotionState do_predict(const MotionState& state, double /*dt_s*/) const override { return state; }
  MotionState do_correct(const MotionState& state, const Eigen::Vector2d& /*p*/,
                         const Eigen::Matrix2d& /*c*/) const override {
    return state;
  }
  Eigen::Vector2d do_position(const MotionState& /*state*/) const override { return {0, 0}; }
  Eigen::Vector2d do_velocity(const MotionState& /*state*/) const override { return {0, 0}; }
  Eigen::Matrix2d do_position_covariance(const MotionState& /*state*/) const override {
    return Eigen::Matrix2d::Identity();
  }
};

class QuietAffinity : public AffinityTerm {
 protected:
  void do_evaluate(const AffinityEnd& /*from*/, std::span<const AffinityEnd> /*to*/,
                   std::span<double> /*log_affinity*/) const override {}
};

class Location : public QuietAffinity {
 public:
  struct Options {
    double weight = 1.0;
    double sigma_m = 0.3;
  };
  static Declaration<Options> declare() {
    Parameters<Options> p;
    p.value("weight", &Options::weight).at_least(0).meaning("weight");
    p.value("sigma_m", &Options::sigma_m).unit("m").above(0).meaning("spread");
    return Declaration<Options>("location", "Near is alike.").parameters(std::move(p));
  }
  Location(const Options& /*options*/, const BuildContext& /*context*/) {}
};

class Appearance : public QuietAffinity {
 public:
  struct Options {
    double weight = 1.0;
    std::optional<std::int64_t> rank;
  };
  static Declaration<Options> declare() {
    Parameters<Options> p;
    p.value("weight", &Options::weight).at_least(0).meaning("weight");
    p.value("rank", &Options::rank).at_least(1).meaning("rank, where there is one");
    return Declaration<Options>("appearance", "Same colours are alike.").parameters(std::move(p));
  }
  Appearance(const Options& /*options*/, const BuildContext& /*context*/) {}
};

class Mixture : public QuietAffinity {
 public:
  struct Options {};
  static Declaration<Options> declare() {
    Parameters<Options> p;
    p.part_list("terms", "affinity").meaning("what is mixed");
    return Declaration<Options>("mixture", "Several affinities in one.").parameters(std::move(p));
  }
  Mixture(const Options& /*options*/, const BuildContext& /*context*/) {}
};

}  // namespace

void register_test_parts(ComponentRegistrar& registrar) {
  registrar.add<Cylinder>();
  registrar.add<Cuboid>();
  registrar.add<ConstantVelocity>();
  registrar.add<Location>();
  registrar.add<Appearance>();
  registrar.add<Mixture>();
}

}  // namespace plaza::test
