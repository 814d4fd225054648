#include <algorithm>
#include <fstream>
#include <iterator>
#include <string>
#include <system_error>

#include "framework/plugin/loader.h"

namespace plaza {
namespace fs = std::filesystem;

void note_left_out(const std::vector<fs::path>& folders, Registry& registry) {
  for (const fs::path& folder : folders) {
    std::error_code error;
    std::vector<fs::path> notes;
    for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
      if (at->path().extension() == kLeftOutExtension) notes.push_back(at->path());
    }
    std::sort(notes.begin(), notes.end());
    for (const fs::path& note : notes) {
      const fs::path library = fs::path(note).replace_extension(".so");
      if (fs::exists(library) || registry.library_named(library.filename())) continue;
      std::ifstream in(note);
      std::string reason(std::istreambuf_iterator<char>(in), {});
      while (!reason.empty() && reason.back() == '\n') reason.pop_back();
      registry.add_refused(
          {library, "it was left out of this build: " + reason, presumed_components(library)});
    }
  }
}

}  // namespace plaza
