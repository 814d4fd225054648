#pragma once

#include <csignal>

namespace plaza {

/// While it lives, the first SIGINT or SIGTERM asks the running pipeline to stop cleanly; a second
/// one ends the process as if nobody had listened. One at a time.
class InterruptScope {
 public:
  InterruptScope();
  ~InterruptScope();
  InterruptScope(const InterruptScope&) = delete;
  InterruptScope& operator=(const InterruptScope&) = delete;

  /// 128 + the signal that came, as shells report it.
  int exit_status() const;

 private:
  struct sigaction interrupt_before_ {};
  struct sigaction terminate_before_ {};
};

}  // namespace plaza
