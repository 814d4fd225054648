#include "framework/study/prepare.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <set>
#include <tuple>

#include "framework/cache/stream_keys.h"
#include "framework/config/text.h"
#include "framework/execution/model_cache.h"
#include "framework/execution/plan.h"
#include "plaza/core/error.h"

namespace plaza {
namespace {

constexpr std::size_t kMaxWords = 80;  // of a folder's name

std::string hash_text(const std::string& text) {
  Hash hash;
  hash.add(text);
  return hash.text();
}

/// Letters, digits and a few signs, so that it is a folder's name anywhere.
std::string folder_words(const std::string& text) {
  std::string words;
  for (const char c : text) {
    const bool plain =
        std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '=' || c == '_';
    if (plain) {
      words += c;
    } else if (!words.empty() && words.back() != '-') {
      words += '-';
    }
    if (words.size() >= kMaxWords) break;
  }
  return words;
}

/// Collects what is wrong with variants, and who has it.
class VariantFaults {
 public:
  void add(const Diagnostics& diagnostics, std::size_t variant) {
    for (const Diagnostic& d : diagnostics) {
      const auto known = std::find_if(faults_.begin(), faults_.end(),
                                      [&d](const Fault& f) { return f.diagnostic == d; });
      if (known == faults_.end()) {
        faults_.push_back({d, {variant}});
      } else {
        known->variants.insert(variant);
      }
    }
  }

  void throw_any(const Study& study, const Expansion& expansion) const {
    if (faults_.empty()) return;
    std::vector<Fault> faults = faults_;
    std::stable_sort(faults.begin(), faults.end(), [](const Fault& a, const Fault& b) {
      const FilePosition& p = a.diagnostic.where;
      const FilePosition& q = b.diagnostic.where;
      return std::tie(p.file, p.line, p.column) < std::tie(q.file, q.line, q.column);
    });
    Diagnostics all;
    for (const Fault& fault : faults) {
      Diagnostic d = fault.diagnostic;
      const std::size_t count = fault.variants.size();
      if (count < expansion.variants.size()) {
        d.message += " (in " + variant_text(study, expansion.variants[*fault.variants.begin()]);
        if (count > 1) d.message += " and " + std::to_string(count - 1) + " more";
        d.message += ")";
      }
      all.push_back(std::move(d));
    }
    throw UserError(all);
  }

 private:
  struct Fault {
    Diagnostic diagnostic;
    std::set<std::size_t> variants;
  };
  std::vector<Fault> faults_;
};

class Preparer {
 public:
  Preparer(PreparedStudy& prepared, const Registry& registry)
      : prepared_(prepared), registry_(registry) {}

  void run() {
    VariantFaults faults;
    for (const Job& job : prepared_.expansion.jobs) {
      try {
        prepare(job);
      } catch (const UserError& error) {
        faults.add(error.diagnostics(), job.variant);
      }
    }
    faults.throw_any(prepared_.study, prepared_.expansion);
    check_metrics();
  }

 private:
  void prepare(const Job& job) {
    const PipelineInScene read = read_pipeline_in_scene(job.request, registry_);
    const Assembly assembly = assemble(read.pipeline, read.scene, {});
    const ExecutionPlan plan = make_plan(read.pipeline, assembly);
    const StreamKeys keys = stream_keys(plan, read.pipeline, *read.scene, job.frames, libraries_);
    PreparedJob prepared;
    prepared.key = keys.whole + (prepared_.study.draw ? " drawn" : "");
    prepared.pipeline = read.pipeline.resolved_json();
    for (const std::string& key : keys.nodes) prepared.node_keys.push_back(hash_text(key));
    const Variant& variant = prepared_.expansion.variants[job.variant];
    prepared.id = folder_words(variant_text(prepared_.study, variant));
    if (job.seed) prepared.id.append("-seed-").append(std::to_string(*job.seed));
    prepared.id.append("-").append(hash_text(prepared.key).substr(0, 8));
    prepared_.jobs.push_back(std::move(prepared));
    add_metrics(read.pipeline);
  }

  void add_metrics(const ResolvedPipeline& pipeline) {
    for (const ResolvedNode& node : pipeline.nodes) {
      for (const MetricSpec& metric : node.entry->declaration.metrics) {
        const auto same = [&metric](const MetricSpec& m) {
          return m.section == metric.section && m.name == metric.name;
        };
        std::vector<MetricSpec>& all = prepared_.metrics;
        if (std::none_of(all.begin(), all.end(), same)) all.push_back(metric);
      }
    }
  }

  /// A chosen metric that no evaluator gives would be a table with holes.
  void check_metrics() const {
    DiagnosticSink faults;
    std::vector<std::string> names;
    for (const MetricSpec& metric : prepared_.metrics) {
      names.push_back(metric.section + "." + metric.name);
    }
    for (const MetricChoice& choice : prepared_.study.metrics) {
      const bool known = std::any_of(
          prepared_.metrics.begin(), prepared_.metrics.end(),
          [&choice](const MetricSpec& metric) { return is_chosen(metric, choice.text); });
      if (known) continue;
      const std::string hint = did_you_mean(choice.text, names);
      faults.add(choice.origin, "no evaluator of this study gives " + quote(choice.text) +
                                    (hint.empty() ? "; there are " + quote_all(names) : hint));
    }
    const Diagnostics all = faults.take({prepared_.study.file.string()});
    if (!all.empty()) throw UserError(all);
  }

  PreparedStudy& prepared_;
  const Registry& registry_;
  LibraryIdentities libraries_;
};

}  // namespace

PreparedStudy prepare_study(Study study, const Registry& registry) {
  PreparedStudy prepared;
  prepared.study = std::move(study);
  prepared.expansion = expand(prepared.study, registry);
  Preparer(prepared, registry).run();
  return prepared;
}

}  // namespace plaza
