#include "framework/execution/run_output.h"

#include <filesystem>
#include <system_error>
#include <utility>

#include "framework/execution/guard.h"
#include "plaza/core/error.h"
#include "plaza/io/output_file.h"

namespace plaza {
namespace {

// enough for the tracks of some hours in a few views
constexpr std::uintmax_t kReservedBytes = 16 << 20;

}  // namespace

void RunOutput::open(const ExecutionPlan& plan, const std::vector<Branch>& branches) {
  start_ = std::chrono::steady_clock::now();
  plan_ = &plan;
  std::error_code error;
  std::filesystem::create_directories(options_.output_folder, error);
  if (error) {
    throw UserError("cannot create the output folder " + options_.output_folder.string() + ": " +
                    error.message() + "; choose another one with --out");
  }
  timings_.clear();
  for (const PlannedNode& node : plan.nodes) {
    timings_.push_back({node.name, node.resolved->entry->declaration.name, 0, 0});
  }
  report_.stop_reason = "the run was ended from outside, or goes on";
  write_summary(options_.output_folder, summary());
  report_.stop_reason.clear();
  write_file(options_.output_folder / "resolved.json", pipeline_.resolved_json().dump(2) + "\n");
  reserve_.hold(options_.output_folder, kReservedBytes);
  recorder_ = std::make_unique<Recorder>(branches, plan, scene_, options_.output_folder,
                                         options_.first_frame);
}

void RunOutput::write(const End& end, const MissingViews& missing_views, Reuse& reuse,
                      RunFaults& faults) {
  reserve_.release();
  faults.attempt([&] {
    const std::vector<Artifact> files = recorder_->write(end.frame);
    report_.artifacts.insert(report_.artifacts.end(), files.begin(), files.end());
  });
  add_notes(end, missing_views, reuse, faults);
  report_.node_seconds = reuse.node_seconds(timings_);
  report_.complete = !faults.any() && !end.stopped;
  report_.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  if (faults.any()) {
    report_.stop_reason = faults.text();
  } else if (end.stopped) {
    report_.stop_reason = "interrupted after " + std::to_string(report_.frames) + " frames";
  }
  faults.attempt([&] {
    write_summary(options_.output_folder, summary());
    report_.artifacts.push_back({options_.output_folder / "summary.json", "figures of the run"});
  });
}

/// What whoever reads the results should know; of what was read from the cache, what was known
/// when it was computed.
void RunOutput::add_notes(const End& end, const MissingViews& missing_views, Reuse& reuse,
                          RunFaults& faults) {
  std::vector<std::string> learning = std::exchange(report_.notes, {});
  if (reuse.replay_end()) {
    report_.notes = reuse.kept_notes();
  } else {
    for (const std::string& note : missing_views.notes()) {
      report_.notes.push_back("node '" + plan_->nodes[plan_->clock].name + "', " + note);
    }
    for (const PlannedNode& node : plan_->nodes) add_notes(node, faults);
  }
  if (!faults.any() && !end.stopped) {
    reuse.recordings().commit(report_.frames, timings_, report_.notes);
  }
  const std::vector<std::string>& troubles = reuse.recordings().troubles();
  learning.insert(learning.end(), troubles.begin(), troubles.end());
  report_.notes.insert(report_.notes.begin(), learning.begin(), learning.end());
}

/// What a source met that was no error.
void RunOutput::add_notes(const PlannedNode& node, RunFaults& faults) {
  if (node.source == nullptr || !node.works) return;
  faults.attempt([&] {
    const auto notes = guarded(node.name, std::nullopt, [&] { return node.source->notes(); });
    for (const std::string& note : notes) {
      report_.notes.push_back("node '" + node.name + "', " + note);
    }
  });
}

Summary RunOutput::summary() const {
  return {.pipeline = pipeline_.name,
          .complete = report_.complete,
          .reason = report_.stop_reason,
          .frames = report_.frames,
          .cameras = scene_.cameras.size(),
          .seconds = report_.seconds,
          .nodes = timings_,
          .evaluation = report_.evaluation,
          .branches = report_.branches};
}

}  // namespace plaza
