#include <algorithm>
#include <cstdlib>
#include <string_view>
#include <system_error>

#include "framework/plugin/loader.h"
#include "plaza/core/error.h"

// Both are set by the build, which knows the installation's layout.
#ifndef PLAZA_PLUGINS_FROM_BIN
#error "PLAZA_PLUGINS_FROM_BIN: the plugin folder relative to the executable's folder"
#endif
#ifndef PLAZA_INSTALLED_PLUGINS
#error "PLAZA_INSTALLED_PLUGINS: the absolute plugin folder of an installation"
#endif

namespace plaza {
namespace fs = std::filesystem;
namespace {

class FolderList {
 public:
  /// Of the user: must exist.
  void add_named(std::string_view list, std::string_view origin) {
    while (!list.empty()) {
      const std::size_t colon = std::min(list.find(':'), list.size());
      const std::string_view part = list.substr(0, colon);
      list.remove_prefix(std::min(colon + 1, list.size()));
      if (part.empty()) continue;
      const fs::path folder(part);
      std::error_code error;
      const fs::file_status status = fs::status(folder, error);
      const std::string where = std::string(origin) + ": " + folder.string();
      if (status.type() == fs::file_type::not_found) {
        throw UserError(where + " does not exist; name a folder that holds plaza_*.so files");
      }
      if (error) throw UserError(where + " can't be read: " + error.message());
      if (!fs::is_directory(status)) {
        throw UserError(where + " is a file; name the folder that holds it");
      }
      add(folder);
    }
  }
  /// Our own guess: may be missing.
  void add(const fs::path& folder) {
    std::error_code error;
    fs::path canonical = fs::weakly_canonical(folder, error);
    if (error) canonical = folder.lexically_normal();
    if (!canonical.has_filename()) canonical = canonical.parent_path();  // "plugins/"
    if (std::find(folders_.begin(), folders_.end(), canonical) == folders_.end()) {
      folders_.push_back(std::move(canonical));
    }
  }
  std::vector<fs::path> take() { return std::move(folders_); }

 private:
  std::vector<fs::path> folders_;
};

}  // namespace

std::vector<fs::path> plugin_search_path(const std::vector<std::string>& command_line) {
  FolderList folders;
  for (const std::string& list : command_line) folders.add_named(list, "--plugin-path");
  // NOLINTNEXTLINE(concurrency-mt-unsafe): nothing in this program writes the environment
  if (const char* list = std::getenv("PLAZA_PLUGIN_PATH"))
    folders.add_named(list, "PLAZA_PLUGIN_PATH");
  std::error_code error;
  const fs::path executable = fs::read_symlink("/proc/self/exe", error);
  if (!error) {
    folders.add(executable.parent_path() / ".." / "lib" / "plaza" / "plugins");
    folders.add(executable.parent_path() / PLAZA_PLUGINS_FROM_BIN);  // lib64, lib/x86_64-linux-gnu
  }
  folders.add(PLAZA_INSTALLED_PLUGINS);
  return folders.take();
}

std::vector<fs::path> find_plugins(const std::vector<fs::path>& folders) {
  std::vector<fs::path> libraries;
  for (const fs::path& folder : folders) {
    std::error_code error;
    if (!fs::exists(folder, error)) continue;
    fs::directory_iterator it(folder, error);
    if (error)
      throw UserError("plugin folder " + folder.string() + " can't be read: " + error.message());
    std::vector<fs::path> found;
    for (; it != fs::directory_iterator(); it.increment(error)) {
      const std::string name = it->path().filename().string();
      if (name.starts_with("plaza_") && name.ends_with(".so")) found.push_back(it->path());
      if (error) break;
    }
    if (error)
      throw UserError("plugin folder " + folder.string() + " can't be read: " + error.message());
    std::sort(found.begin(),
              found.end());  // the file system's order differs from machine to machine
    libraries.insert(libraries.end(), found.begin(), found.end());
  }
  return libraries;
}

}  // namespace plaza
