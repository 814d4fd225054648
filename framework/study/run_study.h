#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/plugin/registry.h"
#include "framework/study/launcher.h"
#include "framework/study/study_results.h"

namespace plaza {

struct StudyOptions {
  std::filesystem::path out;
  std::filesystem::path cache_folder;
  std::optional<double> cache_limit_gb;  ///< nothing: default_cache_limit()
  int jobs = 1;
  Launcher launcher = launch_local;
  std::string hosts;                 ///< see LaunchOptions
  std::vector<std::string> program;  ///< how this program is called, its own options included
  bool retry = false;                ///< jobs that failed are run again
  bool quiet = false;
};

struct StudyEnd {
  PreparedStudy prepared;
  StudyResults results;  ///< refers to `prepared` of the same object
  bool complete = false;
};

/// Checks a study, runs the jobs that have no result yet, collects everything and writes the
/// reports. Interrupted (request_stop) it reports what there is; the same call goes on later and
/// ends with the same results. Two of them in one folder at a time are refused.
std::unique_ptr<StudyEnd> run_study(const std::filesystem::path& file, const StudyOptions& options,
                                    const Registry& registry);

}  // namespace plaza
