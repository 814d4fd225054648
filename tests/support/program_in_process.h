#pragma once

#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "framework/cli/program.h"

namespace plaza::test {

/// What a command came to: its exit status and what it printed.
struct Outcome {
  int status = 0;
  std::string out;
  std::string errors;
};

/// Runs the program with these arguments within the test's own process.
inline Outcome run_in_process(const std::vector<std::string>& arguments) {
  std::ostringstream errors;
  testing::internal::CaptureStdout();
  Outcome outcome;
  outcome.status = run_program(arguments, errors);
  outcome.out = testing::internal::GetCapturedStdout();
  outcome.errors = errors.str();
  return outcome;
}

}  // namespace plaza::test
