#include "framework/cli/interrupt.h"

#include <unistd.h>

#include <cerrno>
#include <string_view>

#include "framework/execution/run.h"

namespace plaza {
namespace {

volatile std::sig_atomic_t received = 0;

void on_signal(int signal) {
  const int error = errno;
  received = signal;
  request_stop();
  constexpr std::string_view kMessage =
      "\nplaza: stopping after the frames in flight; once more ends at once\n";
  [[maybe_unused]] const ssize_t ignored = ::write(STDERR_FILENO, kMessage.data(), kMessage.size());
  // whichever of the two comes next is the second
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
  errno = error;
}

}  // namespace

InterruptScope::InterruptScope() {
  received = 0;
  struct sigaction action {};
  action.sa_handler = on_signal;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  ::sigaction(SIGINT, &action, &interrupt_before_);
  ::sigaction(SIGTERM, &action, &terminate_before_);
}

InterruptScope::~InterruptScope() {
  ::sigaction(SIGINT, &interrupt_before_, nullptr);
  ::sigaction(SIGTERM, &terminate_before_, nullptr);
}

int InterruptScope::exit_status() const { return 128 + (received != 0 ? received : SIGINT); }

}  // namespace plaza
