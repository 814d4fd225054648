#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <string_view>
#include <system_error>
#include <utility>

#include "framework/plugin/loader.h"
#include "plaza/core/error.h"

namespace plaza {
namespace {

constexpr std::chrono::seconds kPatience{30};
constexpr char kUsable = 'u';
constexpr char kRefused = 'r';

/// The first byte says whether the library can be used, the rest is the report.
std::string report_of(const std::filesystem::path& library) {
  Registry registry;
  load_plugin(library, registry);
  if (!registry.refused().empty()) return kRefused + registry.refused().front().reason;
  std::string text(1, kUsable);
  for (const ComponentEntry* entry : registry.all()) {
    if (text.size() > 1) text += ", ";
    text += entry->declaration.kind + " " + entry->declaration.name;
  }
  return text;
}

[[noreturn]] void run_child(const std::filesystem::path& library, int report_fd) {
  // the crash is expected: no core file, no handler of the parent's that would hide the signal
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  for (const int signal : {SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT, SIGTERM, SIGINT, SIGPIPE}) {
    std::signal(signal, SIG_DFL);
  }
  dup2(STDERR_FILENO, STDOUT_FILENO);  // what the library prints is not part of the answer
  std::string report;
  try {
    report = report_of(library);
  } catch (const std::exception& error) {
    report = kRefused + std::string(error.what());
  }
  std::string_view rest = report;
  while (!rest.empty()) {
    const ssize_t written = write(report_fd, rest.data(), rest.size());
    if (written < 0 && errno != EINTR) break;
    if (written > 0) rest.remove_prefix(static_cast<std::size_t>(written));
  }
  _exit(0);  // no destructor of the parent's objects
}

struct ChildOutput {
  std::string text;
  bool timed_out = false;
};

ChildOutput read_all(int fd) {
  const auto deadline = std::chrono::steady_clock::now() + kPatience;
  ChildOutput output;
  std::array<char, 4096> buffer;
  while (true) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(
        deadline - std::chrono::steady_clock::now());
    pollfd waiting{.fd = fd, .events = POLLIN, .revents = 0};
    const int ready = left.count() > 0 ? poll(&waiting, 1, static_cast<int>(left.count())) : 0;
    if (ready < 0 && errno == EINTR) continue;
    if (ready <= 0) {
      output.timed_out = true;
      return output;
    }
    const ssize_t count = read(fd, buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return output;
    output.text.append(buffer.data(), static_cast<std::size_t>(count));
  }
}

std::string signal_name(int signal) {
  const char* name = sigabbrev_np(signal);
  return name != nullptr ? "SIG" + std::string(name) : "signal " + std::to_string(signal);
}

}  // namespace

ProbeResult probe_plugin(const std::filesystem::path& library) {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) {
    throw InternalError("can't make a pipe: " + std::generic_category().message(errno));
  }
  const pid_t child = fork();
  if (child < 0) {
    const int reason = errno;
    close(ends[0]);
    close(ends[1]);
    throw InternalError("can't start a process: " + std::generic_category().message(reason));
  }
  if (child == 0) {
    close(ends[0]);
    run_child(library, ends[1]);
  }
  close(ends[1]);
  const ChildOutput output = read_all(ends[0]);
  close(ends[0]);
  if (output.timed_out) kill(child, SIGKILL);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (output.timed_out) {
    return {false, false,
            "did not finish loading within " + std::to_string(kPatience.count()) + " s"};
  }
  if (WIFSIGNALED(status)) {
    return {false, false, "crashed with " + signal_name(WTERMSIG(status)) + " while loading"};
  }
  if (output.text.empty()) {
    return {
        false, false,
        "ended the process with status " + std::to_string(WEXITSTATUS(status)) + " while loading"};
  }
  return {output.text[0] == kUsable, true, output.text.substr(1)};
}

void survey_plugins(const std::vector<std::filesystem::path>& folders, Registry& registry) {
  for (const std::filesystem::path& folder : folders) registry.add_searched(folder);
  for (const std::filesystem::path& library : find_plugins(folders)) {
    const ProbeResult probe = probe_plugin(library);
    if (probe.answered) {
      load_plugin(library, registry);
    } else {
      registry.add_refused({library, probe.report, presumed_components(library)});
    }
  }
  note_left_out(folders, registry);
}

}  // namespace plaza
