#pragma once

#include <filesystem>

#include "framework/plugin/loader.h"

namespace plaza::test {

/// All plugins of the build tree, as users have them.
inline const Registry& real_registry() {
  static const Registry registry = [] {
    Registry r;
    load_plugins({std::filesystem::path(PLAZA_BINARY_DIR) / "lib/plaza/plugins"}, r);
    return r;
  }();
  return registry;
}

}  // namespace plaza::test
