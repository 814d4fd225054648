#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

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

/// A folder of the running test's own, removed at its end.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "plaza-test-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr)
      throw std::runtime_error("can't make a temporary folder");
    // canonical: libraries are reported by their canonical path
    path_ = std::filesystem::canonical(pattern);
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path write(const std::string& name, const std::string& content) const {
    std::ofstream(path_ / name, std::ios::binary) << content;
    return path_ / name;
  }
  std::filesystem::path folder(const std::string& name) const {
    std::filesystem::create_directories(path_ / name);
    return path_ / name;
  }

 private:
  std::filesystem::path path_;
};

}  // namespace plaza
