#include <csignal>
#include <iostream>
#include <string>
#include <vector>

#include "framework/cli/program.h"

int main(int argc, char** argv) {
  // A reader that goes away (`plaza run --progress json | head`) or a limit on file sizes (ulimit
  // -f) is no reason to die without a word: writing fails with an error of its own then.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  return plaza::run_program(std::vector<std::string>(argv + 1, argv + argc), std::cerr);
}
