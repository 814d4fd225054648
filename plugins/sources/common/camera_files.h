#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "plaza/component/node.h"
#include "plaza/core/diagnostic.h"
#include "plaza/core/error.h"
#include "plaza/core/parallel.h"
#include "plaza/data/frames.h"
#include "plaza/geometry/scene.h"

namespace plaza::sources {

/// A parameter "files": { CAMERA: ... } as every source has it.
using CameraPaths = std::map<std::string, std::filesystem::path>;

/// JSON pointer of one camera's entry, "/files/view1"; "~" and "/" in names are escaped (RFC 6901).
std::string entry_pointer(const std::string& parameter, const std::string& camera);

/// Calls `body`; its errors are said to be of this camera and, where it is known, frame (from 0).
template <class F>
auto with_camera(const Camera& camera, std::optional<std::int64_t> frame, const F& body) {
  try {
    return body();
  } catch (Error& error) {
    error.add_context({.component = {}, .frame = frame, .camera = camera.name()});
    throw;
  }
}

/// "768x576".
std::string size_text(int width, int height);

/// "'view1', 'view2'", in the scene's order.
std::string list_cameras(const Scene& scene);

/// Faults between the cameras of `paths` and those of the scene: entries that the scene lacks and,
/// unless they are listed in `missing` (parameter "missing_cameras"), cameras without an entry;
/// names in `missing` that the scene lacks or that have an entry all the same.
Diagnostics check_cameras(const Scene& scene, const std::string& parameter,
                          const CameraPaths& paths, const std::vector<std::string>& missing);

/// Cameras of `paths` that the scene lacks, for sources where not every camera needs an entry.
Diagnostics check_known_cameras(const Scene& scene, const std::string& parameter,
                                const CameraPaths& paths);

/// Faults of the cameras' entries, in the scene's order: `fault_of`, called for several at once,
/// says what is wrong with the entry of a camera (its index in the scene), or throws UserError;
/// empty: nothing. Entries that the scene lacks are check_known_cameras()'s.
Diagnostics check_entries(
    const Scene& scene, const std::string& parameter, const CameraPaths& paths,
    const std::function<std::string(std::size_t, const std::filesystem::path&)>& fault_of);

/// " is 32x32, the calibration of camera 'view1' is for 64x48", to stand after a file's name; empty
/// where an image of that size fits its camera.
std::string size_fault(const Camera& camera, int width, int height);

/// The images of a frame, read concurrently: `read(c)` gives that of camera c of the scene, empty
/// where there is none; its errors are said to be of the camera and frame.
template <class Read>
std::shared_ptr<FrameSet> read_views(const Scene& scene, const NodeIo& io, const Read& read) {
  auto frames = std::make_shared<FrameSet>();
  frames->frame = io.frame();
  frames->time_ns = io.time_ns();
  frames->views.resize(scene.cameras.size());
  parallel_for(scene.cameras.size(), [&](std::size_t c) {
    frames->views[c] = with_camera(scene.cameras[c], io.frame(), [&] { return read(c); });
  });
  return frames;
}

/// What is wrong with an input file before its content is looked at, with the remedy; empty: it is
/// a regular file that can be read.
std::string file_fault(const std::filesystem::path& file);

/// "path size time", for Source::content_key(): changes when the file is replaced.
std::string file_stamp(const std::filesystem::path& file);

}  // namespace plaza::sources
