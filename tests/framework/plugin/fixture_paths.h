#pragma once

#include <filesystem>
#include <string>

#include "tests/support/temporary_folder.h"

namespace plaza {

/// Folder of one fixture plugin.
inline std::filesystem::path fixture_folder(const std::string& name) {
  return std::filesystem::path(PLAZA_PLUGIN_FIXTURES) / name;
}

/// Its library: "old-version" -> .../old-version/plaza_old_version.so
inline std::filesystem::path fixture_library(const std::string& name) {
  std::string file = name;
  for (char& c : file) c = c == '-' ? '_' : c;
  return fixture_folder(name) / ("plaza_" + file + ".so");
}

using test::TemporaryFolder;

}  // namespace plaza
