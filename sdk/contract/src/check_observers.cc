// Detectors, describers and affinity terms: what makes, enriches and compares observations.
#include <algorithm>
#include <cmath>
#include <map>
#include <thread>

#include "digest.h"
#include "features.h"
#include "stage.h"

namespace plaza::contract {
namespace {

void check_boxes(const Observations& observations, const Stage& stage, Findings& findings) {
  for (const Observation& o : observations.items) {
    for (const ViewBox& b : o.boxes) {
      findings.require(b.camera < stage.scene().cameras.size(),
                       "a box names a camera that the scene lacks");
      const bool good = std::isfinite(b.box.left) && std::isfinite(b.box.top) && b.box.width >= 0 &&
                        b.box.height >= 0 && std::isfinite(b.box.width) &&
                        std::isfinite(b.box.height);
      findings.require(good, "a box is not finite or has a negative size");
    }
  }
}

/// A detector's probability is a non-decreasing function of its score, over all frames.
void check_scores(std::vector<Observation> all, Findings& findings) {
  std::stable_sort(all.begin(), all.end(),
                   [](const Observation& a, const Observation& b) { return a.score < b.score; });
  for (std::size_t i = 1; i < all.size(); ++i) {
    const bool same = all[i - 1].score == all[i].score;
    const bool good = same ? all[i - 1].probability == all[i].probability
                           : all[i - 1].probability <= all[i].probability;
    if (good) continue;
    findings.add("probability is no rising function of the score: " +
                 std::to_string(all[i - 1].probability) + " at " +
                 std::to_string(all[i - 1].score) + ", " + std::to_string(all[i].probability) +
                 " at " + std::to_string(all[i].score));
    return;
  }
}

std::string inputs_of(const Call& call) {
  std::string text;
  for (std::size_t i = 0; i < call.input_count(); ++i) text += digest(call.input(i)) + "\n";
  return text;
}

/// Processes one frame; what came out, as text.
std::string processed(Node& node, Call& call, const Stage& stage, Findings& findings) {
  const std::string before = inputs_of(call);
  node.process(call.io());
  findings.require(inputs_of(call) == before, "process() changes its input");
  for (std::size_t i = 0; i < call.output_count(); ++i) {
    const PortSpec& declared = stage.declaration().outputs[i];
    if (!call.output(i)) {
      findings.add("output " + std::to_string(i) + " (" + declared.type + ") was not emitted");
    } else if (call.output(i)->port() != declared.type) {
      findings.add("output " + std::to_string(i) + " is declared as " + declared.type + " but is " +
                   std::string(call.output(i)->port()));
    } else {
      const auto* o = dynamic_cast<const Observations*>(call.output(i).get());
      if (o != nullptr) check_boxes(*o, stage, findings);
      const PayloadPtr received = call.input_count() > 0 ? call.input(0) : nullptr;
      FeatureCheck(stage.declaration(), findings).look_at(*call.output(i), received.get());
    }
  }
  return call.digest_of_outputs();
}

/// The world with every view missing and nobody seen.
Provider blind_provider(const Stage& stage) {
  return [&stage](const std::string& port, std::int64_t frame) -> PayloadPtr {
    const std::size_t cameras = stage.scene().cameras.size();
    if (port == FrameSet::kPort) {
      auto frames = std::make_shared<FrameSet>(stage.world().frames(frame));
      frames->views.assign(cameras, cv::Mat());
      return frames;
    }
    if (port == Detections::kPort) {
      auto detections = std::make_shared<Detections>();
      detections->views.resize(cameras);
      return detections;
    }
    if (port == Observations::kPort) return std::make_shared<Observations>();
    if (port == ForegroundMask::kPort) {
      auto masks = std::make_shared<ForegroundMask>();
      masks->views.resize(cameras);
      return masks;
    }
    if (port == EvidenceSet::kPort) {
      auto evidence = std::make_shared<EvidenceSet>();
      evidence->views.resize(cameras);
      return evidence;
    }
    return stage.world().payload(port, frame);
  };
}

}  // namespace

void check_detector(const Stage& stage, Findings& findings) {
  const auto detector = stage.make_as<Detector>();
  const std::int64_t count = stage.world().frame_count();
  const auto detect = [&](Detector& d, std::int64_t frame) {
    return processed(d, *stage.call(frame), stage, findings);
  };
  std::map<std::int64_t, std::string> forward;
  std::vector<Observation> all;
  for (std::int64_t frame = 0; frame < count; ++frame) {
    findings.step("detect()", [&] {
      const auto call = stage.call(frame);
      forward[frame] = processed(*detector, *call, stage, findings);
      const auto* o = dynamic_cast<const Observations*>(call->output(0).get());
      if (o != nullptr) all.insert(all.end(), o->items.begin(), o->items.end());
    });
  }
  check_scores(std::move(all), findings);
  for (std::int64_t frame = count - 1; frame >= 0; frame -= 3) {
    findings.require(detect(*detector, frame) == forward[frame],
                     "a frame's result depends on the frames seen before it");
  }
  const auto second = stage.make_as<Detector>();
  const std::int64_t any = std::min<std::int64_t>(5, count - 1);
  findings.require(detect(*second, any) == forward[any],
                   "a second detector with the same parameters gives another result");
  findings.step("a frame in which no view has an image", [&] {
    const auto call = stage.call(1, blind_provider(stage));
    processed(*detector, *call, stage, findings);
    const auto* o = dynamic_cast<const Observations*>(call->output(0).get());
    findings.require(o == nullptr || o->items.empty(),
                     "people are found where no view shows anything");
  });
  findings.step("detect() without the optional inputs",
                [&] { processed(*detector, *stage.call(2, false), stage, findings); });

  // frames are processed concurrently
  std::vector<std::string> results(static_cast<std::size_t>(std::min<std::int64_t>(count, 8)));
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < 2; ++t) {
    threads.emplace_back([&, t] {
      for (std::size_t i = t; i < results.size(); i += 2) {
        const auto call = stage.call(static_cast<std::int64_t>(i));
        try {
          detector->process(call->io());
          results[i] = call->digest_of_outputs();
        } catch (const std::exception&) {
          results[i] = "threw";
        }
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (std::size_t i = 0; i < results.size(); ++i) {
    findings.require(results[i] == forward[static_cast<std::int64_t>(i)],
                     "frames processed in several threads at once have other results");
  }
}

void check_describer(const Stage& stage, Findings& findings) {
  const auto run = [&](bool optional_inputs) {
    const auto describer = stage.make_as<Describer>();
    std::string text;
    for (std::int64_t frame = 0; frame < stage.world().frame_count(); ++frame) {
      findings.step("describe()", [&] {
        const auto call = stage.call(frame, optional_inputs);
        text += processed(*describer, *call, stage, findings);
        const auto* before = dynamic_cast<const Observations*>(call->input(0).get());
        const auto* after = dynamic_cast<const Observations*>(call->output(0).get());
        if (before == nullptr || after == nullptr) return;
        findings.require(digest_of_the_undescribed(*before) == digest_of_the_undescribed(*after),
                         "changes more of an observation than its heading and features");
      });
    }
    return text;
  };
  findings.require(run(true) == run(true), "the same input gives another output");
  run(false);
  findings.step("frames in which nobody is seen", [&] {
    const auto describer = stage.make_as<Describer>();
    const auto call = stage.call(1, blind_provider(stage));
    processed(*describer, *call, stage, findings);
  });
}

void check_affinity(const Stage& stage, Findings& findings) {
  const auto term = stage.make_as<AffinityTerm>();
  const Described world = describe_world(stage, 6);
  std::vector<Observation> later;
  for (std::size_t frame = 3; frame < 6; ++frame) {
    const auto& items = world.frames[frame].items;
    later.insert(later.end(), items.begin(), items.end());
  }
  Observation far_away;
  far_away.position_m = {400, -300};
  later.push_back(far_away);
  std::vector<Observation> loaded;
  for (const Observation& o : later) loaded.push_back(with_loaded_features(o, world.features));
  std::vector<AffinityEnd> ends;
  std::vector<AffinityEnd> loaded_ends;
  for (std::size_t i = 0; i < later.size(); ++i) {
    ends.push_back({&later[i], 0.3 + 0.1 * static_cast<double>(i % 3)});
    loaded_ends.push_back({&loaded[i], ends[i].time_s});
  }
  const auto evaluate = [](const AffinityTerm& t, const AffinityEnd& from,
                           const std::vector<AffinityEnd>& to) {
    std::vector<double> out(to.size(), 17);
    t.evaluate(from, to, out);
    return out;
  };
  const auto second = stage.make_as<AffinityTerm>();
  for (const Observation& observation : world.frames[2].items) {
    const AffinityEnd from{&observation, 0.2};
    const std::vector<double> together = evaluate(*term, from, ends);
    for (const double v : together)
      findings.require(std::isfinite(v) && v <= 0, "log A is not finite and <= 0");
    findings.require(
        evaluate(*term, from, ends) == together && evaluate(*second, from, ends) == together,
        "the same link has another affinity the second time");
    for (std::size_t i = 0; i < ends.size(); ++i) {
      findings.require(evaluate(*term, from, {ends[i]})[0] == together[i],
                       "a link's affinity depends on the other links of the batch");
    }
    const Observation again = with_loaded_features(observation, world.features);
    findings.require(evaluate(*term, {&again, 0.2}, loaded_ends) == together,
                     "features that were saved and loaded have another affinity");
    // a bare observation has a place and a time and nothing else: either the cue is missing, and
    // the term says nothing, or place and time are all the cue there is
    Observation bare = observation;
    bare.heading_rad.reset();
    bare.boxes.clear();
    bare.features = FeatureSet();
    const std::vector<double> without = evaluate(*term, {&bare, 0.2}, ends);
    for (std::size_t i = 0; i < ends.size(); ++i) {
      findings.require(without[i] == 0 || without[i] == together[i],
                       "the term is not 0 though its cue is missing");
    }
  }
  findings.step("evaluate() of no link", [&] { evaluate(*term, {&later[0], 0.0}, {}); });
}

}  // namespace plaza::contract
