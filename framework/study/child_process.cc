#include "framework/study/child_process.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <system_error>

#include "plaza/core/error.h"

namespace plaza {

pid_t start_child(const std::vector<std::string>& words, const std::filesystem::path& log) {
  // all that allocates comes before the fork: other threads of this process may hold its locks
  std::vector<std::string> copies = words;
  std::vector<char*> arguments;
  for (std::string& word : copies) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const int out = ::open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
  if (out < 0) throw UserError("cannot write " + log.string() + ": " + std::strerror(errno));
  const pid_t parent = ::getpid();
  const pid_t child = ::fork();
  if (child == 0) {
    ::setpgid(0, 0);
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != parent) ::_exit(127);  // it died before that
    ::dup2(out, STDOUT_FILENO);
    ::dup2(out, STDERR_FILENO);
    ::execvp(arguments[0], arguments.data());
    constexpr int kNoProgram = 127;
    ::_exit(kNoProgram);
  }
  const int error = errno;
  ::close(out);
  if (child < 0) throw UserError(std::string("cannot start a process: ") + std::strerror(error));
  return child;
}

std::string signal_words(int signal) {
  return "ended by signal " + std::to_string(signal) + " (" + ::strsignal(signal) + ")";
}

std::string signal_text(int wait_status) {
  return WIFSIGNALED(wait_status) ? signal_words(WTERMSIG(wait_status)) : std::string();
}

std::filesystem::path own_program() {
  std::error_code error;
  std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  if (error) throw InternalError("cannot tell the path of this program: " + error.message());
  return program;
}

}  // namespace plaza
