// Evaluators, sinks and renderers: what a run leaves behind.
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <sstream>

#include "digest.h"
#include "plaza/component/learner.h"
#include "stage.h"

namespace plaza::contract {
namespace {

namespace fs = std::filesystem;

/// The world as a perfect detector and a perfect tracker would report it.
Provider perfect_provider(const Stage& stage) {
  return [&stage](const std::string& port, std::int64_t frame) -> PayloadPtr {
    const World& world = stage.world();
    if (port == Observations::kPort)
      return std::make_shared<Observations>(world.true_observations(frame));
    return world.payload(port, frame);
  };
}

/// The same with every third person missing, the others displaced, false alarms, and ids that
/// change.
Provider spoiled_provider(const Stage& stage) {
  return [&stage](const std::string& port, std::int64_t frame) -> PayloadPtr {
    const World& world = stage.world();
    const Eigen::Vector2d error(0.21, -0.13);
    if (port == Observations::kPort) {
      auto out = std::make_shared<Observations>(world.true_observations(frame));
      if (frame % 3 == 0 && !out->items.empty()) out->items.pop_back();
      for (Observation& o : out->items) {
        o.position_m += error;
        if (o.heading_rad) *o.heading_rad += 0.4;
        for (ViewBox& b : o.boxes) b.box.left += 0.3 * b.box.width;
      }
      Observation false_alarm;
      false_alarm.position_m = {4.5, 4.5};
      false_alarm.probability = 0.9;
      out->items.push_back(false_alarm);
      return out;
    }
    if (port == Tracks::kPort) {
      auto out = std::make_shared<Tracks>(world.true_tracks(frame));
      if (frame % 3 == 0 && !out->points.empty()) out->points.pop_back();
      for (TrackPoint& p : out->points) {
        if (frame >= world.frame_count() / 2) p.id += 10;
        p.position_m += error;
        if (p.heading_rad) *p.heading_rad += 0.4;
        for (ViewBox& b : p.boxes) b.box.left += 0.3 * b.box.width;
      }
      TrackPoint ghost;
      ghost.id = 99;
      ghost.frame = frame;
      ghost.position_m = {4.5, 4.5};
      ghost.score = 1;
      ghost.final = true;
      out->points.push_back(ghost);
      return out;
    }
    return world.payload(port, frame);
  };
}

Evaluation evaluated(const Stage& stage, const Provider& provider, std::int64_t frames) {
  const auto evaluator = stage.make_as<Evaluator>();
  for (std::int64_t frame = 0; frame < frames; ++frame) {
    evaluator->process(stage.call(frame, provider)->io());
  }
  const Provider nothing = [](const std::string&, std::int64_t) -> PayloadPtr { return nullptr; };
  evaluator->flush(stage.call(frames, nothing)->io());
  return evaluator->evaluate();
}

std::string content_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void empty_folder(const fs::path& folder) {
  fs::remove_all(folder);
  fs::create_directories(folder);
}

/// Every artifact must be a complete file in the output folder. Their text files by name.
std::map<std::string, std::string> check_artifacts(const std::vector<Artifact>& artifacts,
                                                   const Stage& stage, Findings& findings) {
  std::map<std::string, std::string> texts;
  for (const Artifact& artifact : artifacts) {
    const fs::path relative = artifact.file.lexically_relative(stage.output_folder());
    findings.require(!relative.empty() && *relative.begin() != "..",
                     "an artifact lies outside the output folder");
    findings.require(!artifact.what.empty(), "an artifact does not say what it is");
    if (!fs::exists(artifact.file)) {
      findings.add("the artifact " + artifact.file.filename().string() + " does not exist");
      continue;
    }
    const std::string extension = artifact.file.extension().string();
    const bool is_text = extension == ".txt" || extension == ".csv" || extension == ".json";
    if (!is_text) continue;
    const std::string content = content_of(artifact.file);
    if (!content.empty() && content.back() != '\n') {
      findings.add(artifact.file.filename().string() + " ends in the middle of a line");
    }
    if (extension == ".json" && !nlohmann::json::accept(content)) {
      findings.add(artifact.file.filename().string() + " is not valid JSON");
    }
    texts[relative.string()] = content;
  }
  return texts;
}

}  // namespace

void check_evaluator(const Stage& stage, Findings& findings) {
  const std::int64_t frames = stage.world().frame_count();
  Evaluation perfect, spoiled;
  if (!findings.step("the evaluation of a perfect result",
                     [&] { perfect = evaluated(stage, perfect_provider(stage), frames); }) ||
      !findings.step("the evaluation of a spoiled result",
                     [&] { spoiled = evaluated(stage, spoiled_provider(stage), frames); })) {
    return;
  }
  findings.require(evaluated(stage, spoiled_provider(stage), frames) == spoiled,
                   "the same input gives other figures");
  std::map<std::string, std::set<std::string>> declared;
  for (const MetricSpec& m : stage.declaration().metrics) declared[m.section].insert(m.name);
  std::set<std::string> parameters;
  for (const ParameterSpec& p : stage.declaration().parameters) parameters.insert(p.name);
  for (const auto& [section, values] : spoiled) {
    if (!declared.contains(section)) {
      findings.add("gives section \"" + section + "\", of which it declares no metric");
      continue;
    }
    for (const auto& [name, value] : values.items()) {
      if (value.is_number() && !declared[section].contains(name) && !parameters.contains(name)) {
        findings.add("gives \"" + section + "." + name +
                     "\", which is neither a declared metric nor a parameter");
      }
    }
  }
  std::size_t compared = 0;
  for (const MetricSpec& m : stage.declaration().metrics) {
    const auto good = perfect.find(m.section), bad = spoiled.find(m.section);
    if (good == perfect.end() || bad == spoiled.end()) continue;
    if (!good->second.contains(m.name) || !bad->second.contains(m.name)) continue;
    const nlohmann::json &g = good->second.at(m.name), &b = bad->second.at(m.name);
    if (!g.is_number() || !b.is_number()) continue;
    ++compared;
    const double difference = g.get<double>() - b.get<double>();
    const bool worse = (m.better == Better::kHigher && difference < -1e-12) ||
                       (m.better == Better::kLower && difference > 1e-12);
    if (worse) {
      findings.add("metric \"" + m.section + "." + m.name + "\" is worse for a perfect result (" +
                   g.dump() + ") than for a spoiled one (" + b.dump() + ")");
    }
  }
  findings.require(compared > 0, "gives none of its declared metrics for a perfect result");
  findings.step("the evaluation of no frame at all",
                [&] { evaluated(stage, perfect_provider(stage), 0); });
}

void check_sink(const Stage& stage, Findings& findings) {
  const std::int64_t all = stage.world().frame_count();
  const auto written = [&](std::int64_t frames, bool complete) {
    empty_folder(stage.output_folder());
    std::map<std::string, std::string> texts;
    findings.step("writing " + std::to_string(frames) + " frames", [&] {
      const auto sink = stage.make_as<Sink>();
      for (std::int64_t frame = 0; frame < frames; ++frame) {
        const auto call = stage.call(frame, frame % 4 != 3);
        sink->process(call->io());
      }
      if (complete) {
        const Provider nothing = [](const std::string&, std::int64_t) -> PayloadPtr {
          return nullptr;
        };
        sink->flush(stage.call(frames, nothing)->io());
      }
      texts = check_artifacts(sink->finish(complete), stage, findings);
    });
    return texts;
  };
  const auto first = written(all, true);
  findings.require(first == written(all, true), "the same input gives other files");
  written(all / 2, false);
  written(0, true);
  written(0, false);
}

void check_renderer(const Stage& stage, Findings& findings) {
  const std::int64_t all = stage.world().frame_count();
  const auto rendered = [&](std::int64_t begin, std::int64_t end, std::int64_t stop,
                            bool complete) {
    empty_folder(stage.output_folder());
    findings.step("rendering frames " + std::to_string(begin) + " to " + std::to_string(stop), [&] {
      const auto renderer = stage.make_as<Renderer>();
      renderer->begin(begin, end);
      for (std::int64_t frame = begin; frame < stop; ++frame) {
        const World& world = stage.world();
        renderer->render({.frame = frame,
                          .time_ns = stage.scene().time_of_frame(frame),
                          .frames = &world.frames(frame),
                          .tracks = world.true_tracks(frame).points,
                          .ground_truth = frame % 2 == 0 ? &world.ground_truth(frame) : nullptr});
      }
      check_artifacts(renderer->end(complete), stage, findings);
    });
  };
  rendered(0, all, all, true);
  rendered(all / 2, all, all, true);
  rendered(0, all, all / 2, false);
  rendered(0, all, 0, false);
  rendered(0, 0, 0, true);
}

void check_learner(const Stage& stage, Findings& findings) {
  const auto taught = std::dynamic_pointer_cast<Node>(stage.make());
  if (!taught || taught->learner() == nullptr) return;
  std::ostringstream saved;
  taught->learner()->save(saved);
  const auto restored = std::dynamic_pointer_cast<Node>(stage.make_untaught());
  findings.step("load() of what save() wrote", [&] {
    std::istringstream in(saved.str());
    restored->learner()->load(in);
    std::ostringstream again;
    restored->learner()->save(again);
    findings.require(again.str() == saved.str(), "save() after load() gives other bytes");
  });
  const std::string half = saved.str().substr(0, saved.str().size() / 2);
  findings.must_throw<Error>("load() of a file cut in half", "plaza::Error", [&] {
    std::istringstream in(half);
    std::dynamic_pointer_cast<Node>(stage.make_untaught())->learner()->load(in);
  });
  findings.require(taught->learner()->extra_key() == restored->learner()->extra_key(),
                   "extra_key() differs between two nodes with the same parameters");
}

}  // namespace plaza::contract
