#include "framework/cache/cache_folder.h"

#include <cstdlib>

namespace plaza {

std::filesystem::path default_cache_folder() {
  if (const char* xdg = std::getenv("XDG_CACHE_HOME"); xdg != nullptr && *xdg == '/') {
    return std::filesystem::path(xdg) / "plaza";
  }
  if (const char* home = std::getenv("HOME"); home != nullptr && *home != '\0') {
    return std::filesystem::path(home) / ".cache" / "plaza";
  }
  return std::filesystem::temp_directory_path() / "plaza-cache";
}

}  // namespace plaza
