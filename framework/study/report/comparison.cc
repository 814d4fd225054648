#include "framework/study/report/comparison.h"

#include <algorithm>
#include <map>
#include <utility>

namespace plaza {
namespace {

constexpr std::uint64_t kBootstrapSeed = 1;

using Labels = std::vector<std::string>;

/// A variant's values on the baseline's axes, and on the others.
struct Split {
  Labels treatment, rest;
};

Split split(const Study& study, const Labels& labels) {
  Split split;
  for (std::size_t a = 0; a < labels.size(); ++a) {
    const bool compared = study.baseline.values.contains(study.axes[a].name);
    (compared ? split.treatment : split.rest).push_back(labels[a]);
  }
  return split;
}

Labels baseline_labels(const Study& study) {
  Labels labels;
  for (const Axis& axis : study.axes) {
    const auto it = study.baseline.values.find(axis.name);
    if (it != study.baseline.values.end()) labels.push_back(it->second);
  }
  return labels;
}

std::string text_of(const Study& study, const Labels& treatment) {
  std::string text;
  std::size_t next = 0;
  for (const Axis& axis : study.axes) {
    if (!study.baseline.values.contains(axis.name)) continue;
    text += (text.empty() ? "" : ", ") + axis.name + "=" + treatment[next++];
  }
  return text;
}

}  // namespace

std::vector<Comparison> compare_with_baseline(const StudyResults& results) {
  const Study& study = results.prepared->study;
  const Expansion& expansion = results.prepared->expansion;
  std::vector<Comparison> comparisons;
  if (study.baseline.values.empty()) return comparisons;
  const Labels baseline = baseline_labels(study);

  std::map<std::pair<Labels, std::size_t>, std::size_t> partners;  // (rest, repetition) -> job
  std::vector<Labels> treatments;                                  // in the order of the variants
  for (std::size_t j = 0; j < expansion.jobs.size(); ++j) {
    const Split at = split(study, expansion.variants[expansion.jobs[j].variant].labels);
    if (at.treatment == baseline) {
      partners[{at.rest, expansion.jobs[j].repetition}] = j;
    } else if (std::find(treatments.begin(), treatments.end(), at.treatment) == treatments.end()) {
      treatments.push_back(at.treatment);
    }
  }
  for (const Labels& treatment : treatments) {
    Comparison& comparison = comparisons.emplace_back();
    comparison.label = text_of(study, treatment);
    comparison.differences.resize(results.columns.size());
    for (std::size_t j = 0; j < expansion.jobs.size(); ++j) {
      const Split at = split(study, expansion.variants[expansion.jobs[j].variant].labels);
      if (at.treatment != treatment) continue;
      const auto partner = partners.find({at.rest, expansion.jobs[j].repetition});
      if (partner == partners.end()) continue;
      for (std::size_t c = 0; c < results.columns.size(); ++c) {
        const auto& own = results.jobs[j].figures[c];
        const auto& other = results.jobs[partner->second].figures[c];
        if (own && other) comparison.differences[c].push_back(*own - *other);
      }
    }
    for (const std::vector<double>& differences : comparison.differences) {
      comparison.estimates.push_back(bootstrap_mean(differences, kBootstrapSeed));
    }
  }
  return comparisons;
}

std::string baseline_text(const Study& study) {
  return study.baseline.values.empty() ? std::string() : text_of(study, baseline_labels(study));
}

int verdict(const Estimate& estimate, Better better) {
  if (!estimate.distinct() || better == Better::kNeither) return 0;
  return (estimate.mean > 0) == (better == Better::kHigher) ? 1 : -1;
}

}  // namespace plaza
