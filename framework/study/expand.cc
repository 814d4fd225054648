#include "framework/study/expand.h"

#include <algorithm>

#include "framework/config/extends.h"
#include "plaza/core/error.h"

namespace plaza {
namespace {

/// Fragments of nodes are merged, all else is set.
void apply(ConfigValue& root, const Setting& setting, const Registry& registry,
           DiagnosticSink& diagnostics) {
  if (setting.pointer == "/nodes") {
    ConfigValue* nodes = root.find("nodes");
    if (nodes != nullptr) merge_config(*nodes, setting.value, diagnostics);
    return;
  }
  apply_setting(root, setting, registry, diagnostics);
}

class Expander {
 public:
  Expander(const Study& study, const Registry& registry) : study_(study), registry_(registry) {}

  Expansion run() {
    check_size();
    std::vector<std::size_t> at(study_.axes.size(), 0);
    do {
      Variant variant;
      for (std::size_t a = 0; a < at.size(); ++a) {
        variant.labels.push_back(study_.axes[a].values[at[a]].label);
      }
      add_jobs(at, expansion_.variants.size());
      expansion_.variants.push_back(std::move(variant));
    } while (next(at));
    return std::move(expansion_);
  }

 private:
  void check_size() const {
    std::size_t jobs = std::max<std::size_t>(study_.seeds.size(), 1);
    for (const Axis& axis : study_.axes) {
      if (jobs <= kMaxStudyJobs) jobs *= axis.values.size();
    }
    if (jobs <= kMaxStudyJobs) return;
    throw user_error(study_.axes.empty() ? study_.seeds_origin : study_.axes_origin,
                     "axes and seeds make more than " + std::to_string(kMaxStudyJobs) +
                         " runs; split the study");
  }

  bool next(std::vector<std::size_t>& at) const {
    for (std::size_t a = at.size(); a-- > 0;) {
      if (++at[a] < study_.axes[a].values.size()) return true;
      at[a] = 0;
    }
    return false;
  }

  void add_jobs(const std::vector<std::size_t>& at, std::size_t variant) {
    Change all = study_.base;
    for (std::size_t a = 0; a < at.size(); ++a) {
      const Change& change = study_.axes[a].values[at[a]].change;
      if (change.pipeline) all.pipeline = change.pipeline;
      if (change.frames) all.frames = change.frames;
      all.settings.insert(all.settings.end(), change.settings.begin(), change.settings.end());
    }
    const std::size_t repetitions = std::max<std::size_t>(study_.seeds.size(), 1);
    for (std::size_t r = 0; r < repetitions; ++r) {
      Job job;
      job.variant = variant;
      job.repetition = r;
      job.frames = all.frames.value_or(FrameRange{});
      job.request.file = *all.pipeline;
      std::vector<Setting> settings = all.settings;
      if (!study_.seeds.empty()) {
        job.seed = study_.seeds[r];
        for (const std::string& pointer : study_.seed_parameters) {
          settings.push_back({pointer, study_.seeds_origin,
                              to_config_value(nlohmann::json(*job.seed), study_.seeds_origin)});
        }
      }
      job.request.edit = [settings = std::move(settings), &registry = registry_](
                             ConfigValue& root, DiagnosticSink& diagnostics) {
        for (const Setting& setting : settings) apply(root, setting, registry, diagnostics);
      };
      expansion_.jobs.push_back(std::move(job));
    }
  }

  const Study& study_;
  const Registry& registry_;
  Expansion expansion_;
};

}  // namespace

std::string variant_text(const Study& study, const Variant& variant) {
  std::string text;
  for (std::size_t a = 0; a < variant.labels.size(); ++a) {
    text += (text.empty() ? "" : ", ") + study.axes[a].name + "=" + variant.labels[a];
  }
  return text.empty() ? study.name : text;
}

Expansion expand(const Study& study, const Registry& registry) {
  return Expander(study, registry).run();
}

}  // namespace plaza
