#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "framework/config/pipeline.h"
#include "framework/study/study.h"

namespace plaza {

/// One combination of the axes' values.
struct Variant {
  std::vector<std::string> labels;  ///< by axis
};

/// "gate_m=0.5, detector=edges"; of a study without axes its name.
std::string variant_text(const Study& study, const Variant& variant);

/// One run of a study.
struct Job {
  std::size_t variant = 0;
  std::size_t repetition = 0;
  std::optional<std::uint64_t> seed;
  PipelineRequest request;
  FrameRange frames;
};

struct Expansion {
  std::vector<Variant> variants;  ///< the first axis changes slowest
  std::vector<Job> jobs;          ///< by variant, then repetition
};

/// More jobs than this are taken for a mistake.
inline constexpr std::size_t kMaxStudyJobs = 100000;

/// All combinations. `registry` and `study` must outlive the jobs' requests. Throws UserError for a
/// study of too many jobs.
Expansion expand(const Study& study, const Registry& registry);

}  // namespace plaza
