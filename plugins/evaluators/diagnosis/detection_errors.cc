#include "detection_errors.h"

#include <numeric>
#include <string>
#include <utility>

namespace plaza::diagnosis {
namespace {

constexpr std::size_t kResults = 0, kTruth = 1;
constexpr const char* kErrorsSection = "errors";

template <std::size_t N>
std::int64_t sum_of(const std::array<std::int64_t, N>& counts) {
  return std::accumulate(counts.begin(), counts.end(), std::int64_t{0});
}

double ratio(std::int64_t part, std::int64_t all) {
  return static_cast<double>(part) / static_cast<double>(all);
}

std::string name_of(const char* before, std::string_view kind, const char* after = "") {
  std::string name = before;
  name.append(kind).append(after);
  return name;
}

MetricSpec error_metric(std::string name, Better better, std::string meaning, bool detail) {
  MetricSpec m;
  m.section = kErrorsSection;
  m.name = std::move(name);
  m.better = better;
  m.meaning = std::move(meaning);
  m.detail = detail;
  return m;
}

constexpr std::array<const char*, kMissKinds> kMissMeanings = {
    "behind static occluders",
    "behind people nearer to the camera",
    "at the border of an image or of the area",
    "close to another person",
    "hidden, the truth says, by what nobody described",
    "in sight, and found at a wrong place",
    "in sight, and nothing found"};

constexpr std::array<const char*, kAlarmKinds> kAlarmMeanings = {
    "paired with a miss", "where somebody was found already",
    "at the border of the area, where annotation ends",
    "in line with people in every view that would show it", "none of these"};

void declare_metrics(Declaration<DetectionErrors::Options>& d) {
  d.metric(error_metric("misses", Better::kLower, "people who count and were not found", false));
  d.metric(error_metric("false_alarms", Better::kLower, "observations of nobody", false));
  for (std::size_t i = 0; i < kMissKinds; ++i) {
    const std::string_view kind = to_string(static_cast<MissKind>(i));
    const std::string meaning = kMissMeanings[i];
    d.metric(error_metric(name_of("missed_", kind), Better::kLower, "misses " + meaning, false));
    d.metric(error_metric(name_of("missed_", kind, "_share"), Better::kNeither,
                          "share of the misses: " + meaning, true));
  }
  for (std::size_t i = 0; i < kAlarmKinds; ++i) {
    const std::string_view kind = to_string(static_cast<AlarmKind>(i));
    const std::string meaning = kAlarmMeanings[i];
    d.metric(
        error_metric(name_of("alarms_", kind), Better::kLower, "false alarms: " + meaning, false));
    d.metric(error_metric(name_of("alarms_", kind, "_share"), Better::kNeither,
                          "share of the false alarms: " + meaning, true));
  }
  for (std::size_t i = 0; i < kStandings; ++i) {
    const std::string_view standing = to_string(static_cast<Standing>(i));
    d.metric(error_metric(name_of("people_", standing), Better::kNeither,
                          "true people of this standing, found or not", true));
    d.metric(error_metric(name_of("miss_rate_", standing), Better::kLower,
                          "share of them that was not found", true));
  }
}

}  // namespace

Declaration<DetectionErrors::Options> DetectionErrors::declare() {
  Parameters<Options> p;
  declare_error_rules(p);
  Declaration<Options> d("detection-errors",
                         "Counts misses and false alarms by kind: why a detector was wrong.");
  d.source("after Hoiem, Chodpathumwan, Dai, ECCV 2012, and TIDE (Bolya et al., ECCV 2020)")
      .input<Observations>(
          "what is judged; where a view has no measured box, the scene's body is drawn")
      .input<GroundTruth>("the truth")
      .parameters(std::move(p));
  declare_metrics(d);
  return d;
}

DetectionErrors::DetectionErrors(const Options& options, const BuildContext& context)
    : options_(options), sorter_(context.scene, options) {}

void DetectionErrors::do_observe(const NodeIo& io) {
  if (!io.has(kResults) || !io.has(kTruth)) return;
  const FrameErrors errors =
      sorter_.sort(io.in<GroundTruth>(kTruth), io.in<Observations>(kResults));
  for (const PersonSight& person : errors.people) {
    ++people_[static_cast<std::size_t>(person.standing)];
  }
  for (const Miss& miss : errors.misses) {
    ++misses_[static_cast<std::size_t>(miss.kind)];
    ++missed_people_[static_cast<std::size_t>(miss.sight.standing)];
  }
  for (const FalseAlarm& alarm : errors.alarms) ++alarms_[static_cast<std::size_t>(alarm.kind)];
}

Evaluation DetectionErrors::do_evaluate() {
  if (sum_of(people_) == 0) return {};  // no true boxes: nothing was compared
  const std::int64_t misses = sum_of(misses_), alarms = sum_of(alarms_);
  nlohmann::json section;
  section["overlap"] = options_.overlap;
  section["misses"] = misses;
  section["false_alarms"] = alarms;
  for (std::size_t i = 0; i < kMissKinds; ++i) {
    const std::string_view kind = to_string(static_cast<MissKind>(i));
    section[name_of("missed_", kind)] = misses_[i];
    if (misses > 0) section[name_of("missed_", kind, "_share")] = ratio(misses_[i], misses);
  }
  for (std::size_t i = 0; i < kAlarmKinds; ++i) {
    const std::string_view kind = to_string(static_cast<AlarmKind>(i));
    section[name_of("alarms_", kind)] = alarms_[i];
    if (alarms > 0) section[name_of("alarms_", kind, "_share")] = ratio(alarms_[i], alarms);
  }
  for (std::size_t i = 0; i < kStandings; ++i) {
    const std::string_view standing = to_string(static_cast<Standing>(i));
    section[name_of("people_", standing)] = people_[i];
    if (people_[i] > 0) {
      section[name_of("miss_rate_", standing)] = ratio(missed_people_[i], people_[i]);
    }
  }
  return {{kErrorsSection, std::move(section)}};
}

}  // namespace plaza::diagnosis
