#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "framework/plugin/registry.h"

namespace plaza {

/// Folders to look for plugins in, in order, without duplicates: `command_line` (--plugin-path, each may
/// hold several separated by ':'), PLAZA_PLUGIN_PATH, ../lib/plaza/plugins relative to the executable
/// (build and install trees look alike), the install directory.
std::vector<std::filesystem::path> plugin_search_path(const std::vector<std::string>& command_line);

/// Loads every plaza_*.so of every folder into the registry. A library that can't be used becomes a
/// RefusedPlugin; it never ends the program (one that crashes while loading does: see probe_plugin).
/// A folder named by the user that does not exist is a UserError.
void load_plugins(const std::vector<std::filesystem::path>& folders, Registry& registry);

/// Outcome of loading one library in a child process.
struct ProbeResult {
  bool usable = false;
  std::string report;  ///< the components it gives, or why it can't be used (signal and all)
};

/// `plaza plugins --probe FILE`: a plugin that crashes is a line in a report.
ProbeResult probe_plugin(const std::filesystem::path& library);

}  // namespace plaza
