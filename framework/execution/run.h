#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/config/pipeline.h"
#include "plaza/component/evaluator.h"
#include "plaza/component/sink.h"

namespace plaza {

enum class ProgressStyle { kQuiet, kTerminal, kJsonLines };

struct RunOptions {
  std::int64_t first_frame = 0;           ///< --frames A:B, A included
  std::optional<std::int64_t> end_frame;  ///< B excluded; nothing: to the end of the source
  std::filesystem::path output_folder;
  std::filesystem::path cache_folder;  ///< of learned models
  int threads = 0;                     ///< 0: all cores; 1: sequential, the reference
  ProgressStyle progress = ProgressStyle::kTerminal;
  /// What nodes give is read from the cache where it is there, and kept where that is worth it.
  bool reuse = false;
  /// Computing must take this many times as long as reading back; 0: everything is kept.
  double least_gain = 2;
  std::optional<std::uintmax_t> cache_limit_bytes;  ///< nothing: default_cache_limit()
  bool draw = true;  ///< false: sinks and renderers rest, and whatever works for them alone
};

/// What a run left behind.
struct RunReport {
  bool complete = false;
  std::int64_t frames = 0;
  double seconds = 0;
  double node_seconds = 0;  ///< what all nodes took together, also those of other cores
  Evaluation evaluation;    ///< of the main branch
  std::map<std::string, Evaluation> branches;  ///< of the others, by the node that gives the tracks
  std::vector<Artifact> artifacts;
  std::string stop_reason;         ///< why it is not complete
  std::vector<std::string> notes;  ///< what went wrong without ending the run
};

/// The life of a run: check, learn, stream, flush, render, evaluate, write. When a node fails, what
/// was complete is written, marked as partial, and the error is rethrown with node, frame and
/// camera. An interruption (request_stop) ends it in the same clean way without an error.
RunReport run_pipeline(const ResolvedPipeline& pipeline, std::shared_ptr<const Scene> scene,
                       const RunOptions& options);

/// Asks the running pipeline to stop after the frames in flight. Async-signal-safe.
void request_stop() noexcept;

}  // namespace plaza
