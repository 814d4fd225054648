#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/plugin/registry.h"

namespace plaza {

/// Exit statuses that scripts rely on. An interrupted run ends with 128 + the signal, as shells
/// report it.
inline constexpr int kExitDone = 0;
inline constexpr int kExitUserError = 2;
inline constexpr int kExitInternalError = 3;

/// What all commands share: the options given before or after any command, and what follows from
/// them.
class CliContext {
 public:
  std::vector<std::string> plugin_paths;  ///< --plugin-path, as given
  int exit_status = kExitDone;            ///< of a command that returns without throwing

  /// All components of all plugins; loaded at the first call, so that commands which need none
  /// (help, eval) start at once and work beside a broken plugin.
  const Registry& registry();

 private:
  std::optional<Registry> registry_;
};

}  // namespace plaza
