#include <iostream>
#include <string>
#include <vector>

#include "framework/cli/program.h"

int main(int argc, char** argv) {
  return plaza::run_program(std::vector<std::string>(argv + 1, argv + argc), std::cerr);
}
