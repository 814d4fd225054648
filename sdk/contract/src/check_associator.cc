#include <map>
#include <set>
#include <utility>

#include "digest.h"
#include "features.h"
#include "stage.h"

namespace plaza::contract {
namespace {

/// One step of a stream: nothing where an input is empty.
struct Step {
  std::int64_t frame;
  std::shared_ptr<const Observations> observations;
  std::shared_ptr<const Tracklets> tracklets;
};

class AssociatorCheck {
 public:
  AssociatorCheck(const Stage& stage, Findings& findings) : stage_(stage), findings_(findings) {}

  void run() {
    const std::vector<Step> world = world_stream();
    const std::string first = stream("the world", world);
    findings_.require(first == stream("the world", world), "the same input gives another output");
    stream("no frame at all", {});
    stream("one frame", {world.front()});
    std::vector<Step> empty = world;
    for (Step& step : empty) {
      step.observations = std::make_shared<Observations>();
      step.tracklets = std::make_shared<Tracklets>();
    }
    findings_.require(stream("empty frames", empty).empty(),
                      "tracks come out of frames in which nobody is seen");
    std::vector<Step> gaps = world;
    for (Step& step : gaps) step.frame = 3 * step.frame + (step.frame > 15 ? 100000 : 0);
    stream("gaps between frames", gaps);
    stream("coinciding people", coinciding());
    if (reads(Observations::kPort)) {
      findings_.require(!stream("exact observations", exact_stream()).empty(),
                        "40 frames of exact observations of people far apart give no track");
    }
  }

 private:
  bool reads(std::string_view port) const {
    for (const std::string& type : stage_.inputs()) {
      if (type == port) return true;
    }
    return false;
  }

  std::vector<Step> world_stream() const {
    std::vector<Step> steps;
    const Provider provider = stage_.world_provider();
    for (std::int64_t frame = 0; frame < stage_.world().frame_count(); ++frame) {
      steps.push_back({frame,
                       std::static_pointer_cast<const Observations>(
                           provider(std::string(Observations::kPort), frame)),
                       std::static_pointer_cast<const Tracklets>(
                           provider(std::string(Tracklets::kPort), frame))});
    }
    return steps;
  }

  std::vector<Step> exact_stream() const {
    std::vector<Step> steps = world_stream();
    for (Step& step : steps) {
      step.observations =
          std::make_shared<Observations>(stage_.world().true_observations(step.frame));
    }
    return steps;
  }

  std::vector<Step> coinciding() const {
    std::vector<Step> steps = exact_stream();
    for (Step& step : steps) {
      auto twice = std::make_shared<Observations>(*step.observations);
      const auto& items = step.observations->items;
      twice->items.insert(twice->items.end(), items.begin(), items.end());
      step.observations = twice;
    }
    return steps;
  }

  /// Pushes all steps and flushes; everything that came out, as text.
  std::string stream(const std::string& what, const std::vector<Step>& steps) {
    std::string text;
    findings_.step("a stream of " + what, [&] {
      const auto associator = stage_.make_as<Associator>();
      pushed_.clear();
      final_.clear();
      for (const Step& step : steps) {
        pushed_.insert(step.frame);
        AssociatorInput input;
        input.frame = step.frame;
        input.time_ns = stage_.scene().time_of_frame(step.frame);
        if (reads(Observations::kPort)) input.observations = step.observations.get();
        if (reads(Tracklets::kPort)) input.tracklets = step.tracklets.get();
        text += receive(associator->push(input), what);
      }
      text += receive(associator->flush_tracks(), what);
    });
    return text;
  }

  std::string receive(const AssociatorOutput& output, const std::string& what) {
    std::string text;
    std::set<std::pair<TrackId, std::int64_t>> in_this_step;
    for (const TrackPoint& point : output.points) {
      const std::pair<TrackId, std::int64_t> key(point.id, point.frame);
      const std::string where = " (stream of " + what + ")";
      if (!pushed_.contains(point.frame))
        findings_.add("speaks of a frame that was not pushed" + where);
      if (final_.contains(key)) findings_.add("speaks of a point again after it was final" + where);
      if (!in_this_step.insert(key).second)
        findings_.add("gives two points of one id and frame at once" + where);
      if (point.final) final_.insert(key);
      for (std::size_t i = 0; i < point.boxes.size(); ++i) {
        if (point.boxes[i].camera >= stage_.scene().cameras.size()) {
          findings_.add("a box names a camera that the scene lacks" + where);
        }
      }
      text += digest(point) + "\n";
    }
    Tracklets given;
    given.items = output.tracklets;
    FeatureCheck(stage_.declaration(), findings_).look_at(given, nullptr);
    for (const Tracklet& tracklet : output.tracklets) {
      if (tracklet.points.empty()) findings_.add("gives a tracklet without points");
      for (std::size_t i = 0; i < tracklet.points.size(); ++i) {
        const TrackPoint& point = tracklet.points[i];
        if (!pushed_.contains(point.frame))
          findings_.add("a tracklet speaks of a frame that was not pushed");
        if (point.id != tracklet.id)
          findings_.add("a tracklet's point has another id than the tracklet");
        if (i > 0 && tracklet.points[i - 1].frame >= point.frame) {
          findings_.add("a tracklet's points are not by rising frame");
        }
        text += digest(point) + "\n";
      }
    }
    return text;
  }

  const Stage& stage_;
  Findings& findings_;
  std::set<std::int64_t> pushed_;
  std::set<std::pair<TrackId, std::int64_t>> final_;
};

}  // namespace

void check_associator(const Stage& stage, Findings& findings) {
  AssociatorCheck(stage, findings).run();
}

}  // namespace plaza::contract
