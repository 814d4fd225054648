#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <vector>

#include "framework/execution/disk_reserve.h"
#include "framework/execution/missing_views.h"
#include "framework/execution/plan.h"
#include "framework/execution/recorder.h"
#include "framework/execution/reuse.h"
#include "framework/execution/run.h"
#include "framework/execution/run_faults.h"
#include "framework/results/branches.h"
#include "framework/results/summary.h"

namespace plaza {

/// The output folder of a run from its first file to its last, and the report and the timings that
/// are written there in the end.
class RunOutput {
 public:
  /// All must outlive it.
  RunOutput(const ResolvedPipeline& pipeline, const Scene& scene, const RunOptions& options)
      : pipeline_(pipeline), scene_(scene), options_(options) {}

  /// Creates the folder. From here on it says that its run is not complete, whatever ends the
  /// process. `plan` must outlive this object. Throws UserError when the folder cannot be made.
  void open(const ExecutionPlan& plan, const std::vector<Branch>& branches);

  /// Once open: where tracks and observations go.
  Recorder& recorder() { return *recorder_; }
  /// Once open: by node.
  std::vector<NodeTiming>& timings() { return timings_; }
  RunReport& report() { return report_; }

  /// How the run ended.
  struct End {
    std::int64_t frame = 0;  ///< one past the last frame that was done
    bool stopped = false;
  };
  /// Writes results, notes and the summary. What fails here goes to `faults`, which may hold some
  /// of the run's already.
  void write(const End& end, const MissingViews& missing_views, Reuse& reuse, RunFaults& faults);

 private:
  void add_notes(const End& end, const MissingViews& missing_views, Reuse& reuse,
                 RunFaults& faults);
  void add_notes(const PlannedNode& node, RunFaults& faults);
  Summary summary() const;

  const ResolvedPipeline& pipeline_;
  const Scene& scene_;
  const RunOptions& options_;
  const ExecutionPlan* plan_ = nullptr;
  std::chrono::steady_clock::time_point start_;
  DiskReserve reserve_;
  std::unique_ptr<Recorder> recorder_;
  std::vector<NodeTiming> timings_;
  RunReport report_;
};

}  // namespace plaza
