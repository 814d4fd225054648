#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/execution_doubles.h"

namespace plaza::test {

/// Runs of the real program over the doubles, in a folder of their own.
class ProgramRun : public ::testing::Test {
 protected:
  void SetUp() override;

  /// Writes pipeline.json: the plain nodes over `frames` frames that take `delay_us` each, and
  /// `more` nodes behind them.
  void write_pipeline(std::int64_t frames, std::int64_t delay_us, const nlohmann::json& more = {});
  /// `plaza run` of it into `out`, for a shell or, as words, for exec.
  std::vector<std::string> command(const std::filesystem::path& out, int threads,
                                   const std::vector<std::string>& options = {"--quiet"}) const;

  /// Everything that bears its final name, and every part, is valid: whole JSON, whole rows of one
  /// width. A complete run has left no part.
  static void expect_valid(const std::filesystem::path& out);
  static nlohmann::json summary(const std::filesystem::path& out);

  TemporaryFolder folder_;
};

}  // namespace plaza::test
