// Parts that break one promise at a time: motion models, shapes, appearances, affinity terms.
#include <Eigen/LU>
#include <atomic>

#include "tests/contract/suite/misbehaving.h"

namespace plaza::contract {
namespace {

/// Constant position: the covariance grows by 0.1 m^2/s.
class Standing final : public MotionModel {
 public:
  using Options = Fault;
  static Declaration<Options> declare() {
    return Declaration<Options>("standing", "Stays where it is").parameters(fault_parameter());
  }
  Standing(const Options& options, const BuildContext&) : fault_(options.fault) {}

 protected:
  MotionState do_start(const Eigen::Vector2d& p, const Eigen::Matrix2d& c) const override {
    return {fault_ == "start" ? Eigen::Vector2d(0, 0) : p, c};
  }
  MotionState do_predict(const MotionState& s, double dt_s) const override {
    MotionState out = s;
    if (fault_ == "drift") out.mean.array() += 0.1;
    if (fault_ == "state") out.mean.array() += 1e-9 * ++calls_;
    const double growth = fault_ == "shrink" ? -0.01 : 0.1;
    out.covariance += growth * dt_s * Eigen::Matrix2d::Identity();
    if (fault_ == "skew") out.covariance(0, 1) += 0.1;
    return out;
  }
  MotionState do_correct(const MotionState& s, const Eigen::Vector2d& z,
                         const Eigen::Matrix2d& r) const override {
    if (fault_ == "deaf") return s;
    const Eigen::Matrix2d p = s.covariance;
    const Eigen::Matrix2d gain = p * (p + r).inverse();
    const double sign = fault_ == "away" ? -1 : 1;
    Eigen::Matrix2d c = (Eigen::Matrix2d::Identity() - gain) * p;
    c = (0.5 * (c + c.transpose())).eval();
    if (fault_ == "doubt") c += 0.5 * Eigen::Matrix2d::Identity();
    const Eigen::Vector2d mean = s.mean;
    return {mean + sign * gain * (z - mean), c};
  }
  Eigen::Vector2d do_position(const MotionState& s) const override { return s.mean; }
  Eigen::Vector2d do_velocity(const MotionState&) const override { return Eigen::Vector2d::Zero(); }
  Eigen::Matrix2d do_position_covariance(const MotionState& s) const override {
    return s.covariance;
  }

 private:
  std::string fault_;
  mutable std::atomic<int> calls_ = 0;
};

TEST(MotionContractTest, EachBrokenPromiseIsCaught) {
  expect_caught<Standing>({
      {"start", "start() is not where it was told to be"},
      {"drift", "predict(0) moves the position"},
      {"shrink", "uncertainty shrinks while nothing is observed"},
      {"skew", "not symmetric positive semidefinite"},
      {"deaf", "correct() does not move towards the measurement"},
      {"away", "correct() does not move towards the measurement"},
      {"doubt", "correct() makes the position less certain"},
      {"state", "predict() gives another answer the second time"},
  });
}

class Slab final : public ShapeModel {
 public:
  using Options = Fault;
  static Declaration<Options> declare() {
    return Declaration<Options>("slab", "A flat box").parameters(fault_parameter());
  }
  Slab(const Options& options, const BuildContext&) : fault_(options.fault) {}

 protected:
  Silhouette do_silhouette(const Pose& pose, const Camera& camera) const override {
    Silhouette s;
    const double scale = fault_ == "scale" ? 1 : pose.scale;
    const auto box = body_box(camera, pose.position_m, {1.75 * scale, 0.3 * scale});
    if (fault_ == "behind") s.spans.push_back({0, 0, 1});
    if (!box) return s;
    s.box = *box;
    if (fault_ == "random") s.box.left += ++calls_;
    s.inside_share = fault_ == "share" ? 1.5 : 0.5;
    const auto clamp = [](double v, int n) {
      return static_cast<int>(std::max(0.0, std::min(v, double(n))));
    };
    const int left = clamp(box->left, camera.width()), right = clamp(box->right(), camera.width());
    const int overhang = fault_ == "outside" ? camera.width() : 0;
    for (int row = clamp(box->top + 1, camera.height());
         row < clamp(box->bottom(), camera.height()); ++row) {
      if (left < right) s.spans.push_back({row, left, right + overhang});
    }
    if (fault_ == "order") std::reverse(s.spans.begin(), s.spans.end());
    const float length = fault_ == "normal" ? 2.0F : 1.0F;
    s.contour.push_back(
        {{static_cast<float>(box->left), static_cast<float>(box->top)}, {length, 0}});
    return s;
  }
  Body do_body() const override { return fault_ == "body" ? Body{0, 0} : Body{}; }

 private:
  std::string fault_;
  mutable std::atomic<int> calls_ = 0;
};

TEST(ShapeContractTest, EachBrokenPromiseIsCaught) {
  expect_caught<Slab>({
      {"scale", "a larger scale gives no taller silhouette"},
      {"behind", "a person behind the camera has a silhouette"},
      {"random", "the same pose gives another silhouette"},
      {"share", "inside_share is not in [0, 1]"},
      {"outside", "a span lies outside the image"},
      {"order", "spans are not by rising row"},
      {"normal", "a contour normal has not length 1"},
      {"body", "body() has no size"},
  });
}

class Paint final : public AppearanceModel {
 public:
  using Options = Fault;
  static Declaration<Options> declare() {
    return Declaration<Options>("paint", "One coloured point").parameters(fault_parameter());
  }
  Paint(const Options& options, const BuildContext&) : fault_(options.fault) {}

 protected:
  std::vector<SurfacePoint> do_visible_points(const Pose&, const Camera&) const override {
    SurfacePoint p{{0, 0, 1}, {1, 0, 0}, {50, 0, 0}};
    if (fault_ == "normal") p.normal *= 3;
    if (fault_ == "nan") p.lab[0] = std::numeric_limits<float>::quiet_NaN();
    if (fault_ == "random") p.position_m[0] = static_cast<float>(++calls_);
    return {p};
  }

 private:
  std::string fault_;
  mutable std::atomic<int> calls_ = 0;
};

TEST(AppearanceContractTest, EachBrokenPromiseIsCaught) {
  expect_caught<Paint>({{"normal", "a surface normal has not length 1"},
                        {"nan", "a surface point is not finite"},
                        {"random", "the same pose gives other points"}});
}

/// Compares headings.
class SameWay final : public AffinityTerm {
 public:
  using Options = Fault;
  static Declaration<Options> declare() {
    return Declaration<Options>("same-way", "Compares headings").parameters(fault_parameter());
  }
  SameWay(const Options& options, const BuildContext&) : fault_(options.fault) {}

 protected:
  void do_evaluate(const AffinityEnd& from, std::span<const AffinityEnd> to,
                   std::span<double> out) const override {
    for (std::size_t i = 0; i < to.size(); ++i) {
      const auto &a = from.observation->heading_rad, &b = to[i].observation->heading_rad;
      out[i] = a && b ? -std::abs(*a - *b) : fault_ == "missing" ? -1 : 0;
      if (fault_ == "positive") out[i] = 0.5;
      if (fault_ == "infinite" && i == 0) out[i] = -std::numeric_limits<double>::infinity();
      if (fault_ == "random") out[i] -= 1e-6 * ++calls_;
      if (fault_ == "batch") out[i] -= static_cast<double>(i);
    }
  }

 private:
  std::string fault_;
  mutable std::atomic<int> calls_ = 0;
};

TEST(AffinityContractTest, EachBrokenPromiseIsCaught) {
  expect_caught<SameWay>({
      {"missing", "the term is not 0 though its cue is missing"},
      {"positive", "log affinity is not <= 0"},
      {"infinite", "log A is not finite and <= 0"},
      {"random", "the same link has another affinity the second time"},
      {"batch", "a link's affinity depends on the other links of the batch"},
  });
}

}  // namespace
}  // namespace plaza::contract
