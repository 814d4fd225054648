#include "plugins/sources/common/camera_files.h"

#include <algorithm>
#include <fstream>
#include <system_error>
#include <utility>

namespace plaza::sources {
namespace {

constexpr const char* kDocFolder = "/usr/share/doc/";

std::string missing_file_remedy(const std::filesystem::path& file) {
  const std::string path = file.string();
  if (path.starts_with(kDocFolder)) {
    const std::string rest = path.substr(std::string(kDocFolder).size());
    const std::string package = rest.substr(0, rest.find('/'));
    return "this file comes from the documentation of Debian's package " + package +
           ": apt-get install " + package +
           "; minimal images drop /usr/share/doc (path-exclude in /etc/dpkg/dpkg.cfg.d): remove "
           "that "
           "rule and apt-get install --reinstall " +
           package;
  }
  std::error_code error;
  std::filesystem::path folder = file.parent_path();
  while (!folder.empty() && folder != folder.root_path() &&
         !std::filesystem::exists(folder, error)) {
    folder = folder.parent_path();
  }
  if (!folder.empty() && folder != file.parent_path()) {
    return "there is no folder below " + folder.string() +
           "; paths start at the pipeline's folder, $PLAZA_DATA names the data folder";
  }
  return "the folder exists, the file does not: check the name";
}

}  // namespace

std::string entry_pointer(const std::string& parameter, const std::string& camera) {
  std::string pointer = "/" + parameter + "/";
  for (const char c : camera) {
    if (c == '~') {
      pointer += "~0";
    } else if (c == '/') {
      pointer += "~1";
    } else {
      pointer += c;
    }
  }
  return pointer;
}

std::string size_text(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

std::string list_cameras(const Scene& scene) {
  std::string text;
  for (const Camera& camera : scene.cameras) {
    text += (text.empty() ? "'" : ", '") + camera.name() + "'";
  }
  return text;
}

Diagnostics check_known_cameras(const Scene& scene, const std::string& parameter,
                                const CameraPaths& paths) {
  Diagnostics faults;
  for (const auto& [camera, path] : paths) {
    if (scene.camera_index(camera)) continue;
    faults.push_back(
        fault_at(entry_pointer(parameter, camera),
                 "the scene has no camera '" + camera + "'; it has " + list_cameras(scene)));
  }
  return faults;
}

Diagnostics check_cameras(const Scene& scene, const std::string& parameter,
                          const CameraPaths& paths, const std::vector<std::string>& missing) {
  Diagnostics faults = check_known_cameras(scene, parameter, paths);
  for (const Camera& camera : scene.cameras) {
    if (paths.contains(camera.name()) || std::ranges::count(missing, camera.name()) > 0) continue;
    faults.push_back(
        fault_at("/" + parameter, "camera '" + camera.name() +
                                      "' of the scene has no entry; give it one, or name it "
                                      "in \"missing_cameras\" to run without its images"));
  }
  for (std::size_t i = 0; i < missing.size(); ++i) {
    const std::string pointer = "/missing_cameras/" + std::to_string(i);
    if (!scene.camera_index(missing[i])) {
      faults.push_back(fault_at(
          pointer, "the scene has no camera '" + missing[i] + "'; it has " + list_cameras(scene)));
    } else if (paths.contains(missing[i])) {
      faults.push_back(fault_at(pointer, "camera '" + missing[i] +
                                             "' is declared missing and has an entry in \"" +
                                             parameter + "\"; remove one of the two"));
    }
  }
  return faults;
}

Diagnostics check_entries(
    const Scene& scene, const std::string& parameter, const CameraPaths& paths,
    const std::function<std::string(std::size_t, const std::filesystem::path&)>& fault_of) {
  std::vector<std::string> found(scene.cameras.size());
  parallel_for(found.size(), [&](std::size_t c) {
    const auto entry = paths.find(scene.cameras[c].name());
    if (entry == paths.end()) return;
    try {
      found[c] = fault_of(c, entry->second);
    } catch (const UserError& error) {
      found[c] = error.what();
    }
  });
  Diagnostics faults;
  for (std::size_t c = 0; c < found.size(); ++c) {
    if (found[c].empty()) continue;
    const std::string& name = scene.cameras[c].name();
    faults.push_back(
        fault_at(entry_pointer(parameter, name), "camera '" + name + "': " + found[c]));
  }
  return faults;
}

std::string size_fault(const Camera& camera, int width, int height) {
  if (width == camera.width() && height == camera.height()) return {};
  return " is " + size_text(width, height) + ", the calibration of camera '" + camera.name() +
         "' is for " + size_text(camera.width(), camera.height());
}

std::string file_fault(const std::filesystem::path& file) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (status.type() == std::filesystem::file_type::not_found) {
    return "there is no file " + file.string() + "; " + missing_file_remedy(file);
  }
  if (std::filesystem::is_directory(status)) {
    return file.string() + " is a folder; a file is needed";
  }
  if (!std::ifstream(file, std::ios::binary)) {
    return file.string() + " cannot be opened for reading; check its permissions";
  }
  return {};
}

std::string file_stamp(const std::filesystem::path& file) {
  std::error_code error;
  const auto size = std::filesystem::file_size(file, error);
  if (error) return file.string() + " unreadable";
  const auto time = std::filesystem::last_write_time(file, error);
  return file.string() + " " + std::to_string(size) + " " +
         std::to_string(time.time_since_epoch().count());
}

}  // namespace plaza::sources
