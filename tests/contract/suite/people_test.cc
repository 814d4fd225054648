// Nodes that find and follow people (detectors, describers, associators) and break one promise at a
// time.
#include <atomic>
#include <limits>
#include <string>
#include <vector>

#include "tests/contract/suite/misbehaving.h"

namespace plaza::contract {
namespace {

/// One person per detection.
class FromBoxes final : public Detector {
 public:
  using Options = Fault;
  static Declaration<Options> declare() {
    Declaration<Options> d("from-boxes", "Feet of boxes");
    d.input<Detections>("boxes").optional_input<FrameSet>("images").output<Observations>("people");
    d.output<GroundLikelihood>("two cells").parameters(fault_parameter());
    return d;
  }
  FromBoxes(const Options& options, const BuildContext& context)
      : fault_(options.fault), scene_(context.scene) {}

 protected:
  Observations do_detect(const NodeIo& io) const override {
    Observations out;
    if (fault_ == "needs-images") (void)io.in<FrameSet>(1);
    const Detections& detections = io.in<Detections>(0);
    for (std::size_t c = 0; c < detections.views.size(); ++c) {
      for (const ImageDetection& d : detections.views[c]) {
        const auto foot =
            scene_->cameras[c].to_plane({d.box.left + d.box.width / 2, d.box.bottom()});
        if (!foot) continue;
        Observation o;
        o.position_m = *foot;
        o.probability = fault_ == "probability" ? 1.5 : 0.5;
        if (fault_ == "score") o.probability = d.score / 2;
        if (fault_ == "infinite") o.score = std::numeric_limits<double>::infinity();
        if (fault_ == "covariance") o.covariance_m2(0, 1) = 3;
        if (fault_ == "memory") o.position_m.x() += 1e-3 * static_cast<double>(++calls_);
        o.boxes.push_back({fault_ == "camera" ? 17 : c, d.box, d.score});
        out.items.push_back(o);
      }
    }
    if (fault_ == "ghost") out.items.emplace_back();
    if (fault_ == "writes") const_cast<Detections&>(detections).views.at(0).clear();
    return out;
  }
  Detected do_detect_all(const NodeIo& io) const override {
    auto likelihood = std::make_shared<GroundLikelihood>();
    likelihood->grid.columns = 2;
    likelihood->grid.rows = 1;
    likelihood->joint = {-1, std::numeric_limits<double>::quiet_NaN()};
    if (fault_ == "cells") likelihood->joint.pop_back();
    if (fault_ == "certain") likelihood->joint[0] = -std::numeric_limits<double>::infinity();
    if (fault_ == "surface") likelihood.reset();
    return {do_detect(io), likelihood};
  }

 private:
  std::string fault_;
  std::shared_ptr<const Scene> scene_;
  mutable std::atomic<int> calls_ = 0;
};

TEST(DetectorContractTest, EachBrokenPromiseIsCaught) {
  expect_caught<FromBoxes>({
      {"needs-images", "detect() without the optional inputs threw"},
      {"probability", "probability is not in [0, 1]"},
      {"score", "probability is no rising function of the score"},
      {"infinite", "score is not finite"},
      {"covariance", "covariance is not symmetric positive definite"},
      {"memory", "a frame's result depends on the frames seen before it"},
      {"camera", "a box names a camera that the scene lacks"},
      {"ghost", "people are found where no view shows anything"},
      {"writes", "process() changes its input"},
      {"cells", "a ground likelihood needs one value per cell of its grid"},
      {"certain", "a ground likelihood is infinite"},
      {"surface", "the declared GroundLikelihood was not computed"},
  });
}

class Turn final : public Describer {
 public:
  using Options = Fault;
  static Declaration<Options> declare() {
    Declaration<Options> d("turn", "Everybody looks along x");
    d.input<Observations>("people").output<Observations>("the same, with headings");
    d.parameters(fault_parameter());
    return d;
  }
  Turn(const Options& options, const BuildContext&) : fault_(options.fault) {}

 protected:
  void do_describe(const NodeIo&, Observations& observations) override {
    for (Observation& o : observations.items) {
      o.heading_rad = 0;
      if (fault_ == "moves") o.position_m.x() += 1;
      if (fault_ == "doubts") o.probability *= 0.5;
    }
    if (fault_ == "drops" && !observations.items.empty()) observations.items.pop_back();
    if (fault_ == "random" && !observations.items.empty())
      observations.items[0].heading_rad = ++calls_;
    if (fault_ == "assumes") observations.items.at(0).heading_rad = 1;
  }

 private:
  std::string fault_;
  static inline int calls_ = 0;
};

TEST(DescriberContractTest, EachBrokenPromiseIsCaught) {
  expect_caught<Turn>({
      {"moves", "a describer must not move or reorder observations"},
      {"doubts", "changes more of an observation than its heading and features"},
      {"drops", "a describer must not add or drop observations"},
      {"random", "the same input gives another output"},
      {"assumes", "frames in which nobody is seen threw"},
  });
}

/// Gives every observation the id of its place in the list; open for one frame, then final.
class ByIndex final : public Associator {
 public:
  using Options = Fault;
  static Declaration<Options> declare() {
    Declaration<Options> d("by-index", "The n-th observation is person n");
    d.input<Observations>("people").output<Tracks>("tracks").parameters(fault_parameter());
    return d;
  }
  ByIndex(const Options& options, const BuildContext&) : fault_(options.fault) {}

 protected:
  AssociatorOutput do_push(const AssociatorInput& input) override {
    AssociatorOutput out = finals();
    for (std::size_t i = 0; i < input.observations->items.size(); ++i) {
      TrackPoint p;
      p.id = static_cast<TrackId>(i) + (fault_ == "zero-id" ? 0 : 1);
      p.frame = input.frame;
      p.position_m = input.observations->items[i].position_m;
      p.score = fault_ == "score" ? 2 : 1;
      if (fault_ == "random") p.score = 1.0 / ++calls_;
      if (fault_ == "future") p.frame += 1;
      if (fault_ == "final-twice") p.final = true;
      if (fault_ == "other-frame")
        p.frame = input.frame / 2 * 2 == input.frame ? input.frame : input.frame - 1;
      out.points.push_back(p);
      open_.push_back(p);
    }
    if (fault_ == "two-at-once" && !out.points.empty()) out.points.push_back(out.points.back());
    if (fault_ == "ghost") {
      TrackPoint p;
      p.id = 1000;
      p.frame = input.frame;
      out.points.push_back(p);
    }
    if (fault_ == "needs-people") (void)input.observations->items.at(0);
    if (fault_ == "silent") out.points.clear();
    return out;
  }
  AssociatorOutput do_flush_tracks() override {
    AssociatorOutput out = fault_ == "silent" ? AssociatorOutput() : finals();
    if (fault_ == "stays-open") {
      for (TrackPoint& p : out.points) p.final = false;
    }
    return out;
  }

 private:
  AssociatorOutput finals() {
    AssociatorOutput out;
    out.points = std::move(open_);
    open_.clear();
    for (TrackPoint& p : out.points) p.final = true;
    return out;
  }
  std::string fault_;
  std::vector<TrackPoint> open_;
  static inline int calls_ = 0;
};

TEST(AssociatorContractTest, EachBrokenPromiseIsCaught) {
  expect_caught<ByIndex>({
      {"zero-id", "id is not positive"},
      {"score", "score not in [0, 1]"},
      {"random", "the same input gives another output"},
      {"future", "speaks of a frame that was not pushed"},
      {"other-frame", "speaks of a point again after it was final"},
      {"final-twice", "speaks of a point again after it was final"},
      {"two-at-once", "gives two points of one id and frame at once"},
      {"ghost", "tracks come out of frames in which nobody is seen"},
      {"needs-people", "a stream of empty frames threw"},
      {"silent", "give no track"},
      {"stays-open", "still open after flush"},
  });
}

}  // namespace
}  // namespace plaza::contract
