#pragma once

#include <filesystem>

namespace plaza {

/// Where caches are kept unless the user names a place: $XDG_CACHE_HOME/plaza, ~/.cache/plaza, or a
/// folder among the temporary ones.
std::filesystem::path default_cache_folder();

}  // namespace plaza
