#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace plaza {

/// Starts `words[0]` with the rest as arguments; what it prints is appended to `log`. It dies with
/// this process, and a Ctrl-C of the terminal does not reach it. A failure is a UserError.
pid_t start_child(const std::vector<std::string>& words, const std::filesystem::path& log);

/// "ended by signal 11 (Segmentation fault)".
std::string signal_words(int signal);

/// "" for a child that ended by itself, else signal_words().
std::string signal_text(int wait_status);

/// The path of the running program.
std::filesystem::path own_program();

}  // namespace plaza
