#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "framework/plugin/registry.h"

namespace plaza {

/// Folders to look for plugins in, in order, without duplicates: `command_line` (--plugin-path,
/// each may hold several separated by ':'), PLAZA_PLUGIN_PATH, ../lib/plaza/plugins relative to the
/// executable (build and install trees look alike), the install directory. The latter two need not
/// exist. Throws UserError when a folder that the user names does not exist or is none.
std::vector<std::filesystem::path> plugin_search_path(const std::vector<std::string>& command_line);

/// The libraries to try in these folders: every plaza_*.so, folder by folder, by name within a
/// folder. Folders that don't exist give none; throws UserError when one can't be read.
std::vector<std::filesystem::path> find_plugins(const std::vector<std::filesystem::path>& folders);

/// Loads every plaza_*.so of every folder into the registry. A library that can't be used becomes a
/// RefusedPlugin; it never ends the program (one that crashes while loading does: see
/// probe_plugin). Of two libraries with one file name, the one found first is used.
void load_plugins(const std::vector<std::filesystem::path>& folders, Registry& registry);

/// Loads one library, which is recorded as refused when it can't be used or is not the first with
/// its file name. One that is loaded already (through a link, too) is skipped.
void load_plugin(const std::filesystem::path& library, Registry& registry);

/// A build that lacks what a plugin needs leaves a note in the plugin's place, plaza_NAME.left-out,
/// with the reason and the remedy (CMake: plaza_leave_out_plugin).
inline constexpr char kLeftOutExtension[] = ".left-out";

/// Records the plugins that such notes in these folders speak of as refused, but for those that are
/// there all the same. load_plugins() and survey_plugins() do it.
void note_left_out(const std::vector<std::filesystem::path>& folders, Registry& registry);

/// Names of what a library that can't be asked presumably provides: plaza_min_cost_flow.so gives
/// "min-cost-flow".
std::vector<std::string> presumed_components(const std::filesystem::path& library);

/// Outcome of loading one library in a child process.
struct ProbeResult {
  bool usable = false;
  bool answered = true;  ///< false: the library ended or held up the process
  std::string report;    ///< the components it gives, or why it can't be used (signal and all)
};

/// `plaza plugins --probe FILE`: a plugin that crashes is a line in a report. Must be called while
/// the process has one thread.
ProbeResult probe_plugin(const std::filesystem::path& library);

/// load_plugins() for a report: every library is tried in a child process before it is loaded here,
/// so that one which crashes is recorded as refused.
void survey_plugins(const std::vector<std::filesystem::path>& folders, Registry& registry);

}  // namespace plaza
