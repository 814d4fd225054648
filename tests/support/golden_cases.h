#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "plaza/core/error.h"

namespace plaza::test {

/// A folder of inputs that are broken on purpose, below tests/error: each NAME.json gets exactly
/// the diagnostics that NAME.expected holds.
///
/// A new case is a NAME.json with its NAME.expected. With PLAZA_UPDATE_EXPECTED set in the
/// environment, the tests write the latter; read what they wrote.
class GoldenFolder {
 public:
  /// `name` is the folder's below tests/error.
  explicit GoldenFolder(const std::string& name);

  const std::filesystem::path& path() const { return path_; }

  /// The NAMEs, sorted.
  std::vector<std::string> names() const;

  /// What NAME.expected holds; empty when there is no such file.
  std::string expected(const std::string& name) const;

  /// Fails where one of these files (".expected", ...) has lost its NAME.json, and where fewer than
  /// `least` cases are left: tests of a folder that was moved would find nothing and pass.
  void expect_whole(const std::set<std::string>& extensions, std::size_t least) const;

 private:
  std::filesystem::path path_;
};

/// A case's name as gtest allows it.
std::string golden_test_name(const testing::TestParamInfo<std::string>& info);

/// Tests of one case each, its name being the parameter. They run in the folder, so that
/// diagnostics name its files without their folders, and with a PLAZA_DATA that does not exist.
class GoldenCase : public testing::TestWithParam<std::string> {
 protected:
  explicit GoldenCase(const std::string& folder) : folder_(folder) {}
  void SetUp() override;
  void TearDown() override;

  const GoldenFolder& folder() const { return folder_; }
  std::string input() const { return GetParam() + ".json"; }

  /// Calls `read`, which must throw a UserError whose text is NAME.expected's; gives that error.
  template <class Read>
  std::optional<UserError> expect_explained(const Read& read) const {
    try {
      read();
    } catch (const UserError& error) {
      expect_text(error.what());
      return error;
    }
    ADD_FAILURE() << "nothing is wrong with " << input();
    return std::nullopt;
  }

  /// `command`, run by the shell, must end with status 2 and write nothing but NAME.expected, each
  /// line after "plaza: ", to stderr; neither to stdout nor into the folder.
  void expect_refused(const std::string& command) const;

 private:
  void expect_text(const std::string& errors) const;

  GoldenFolder folder_;
  std::filesystem::path before_;
};

}  // namespace plaza::test
