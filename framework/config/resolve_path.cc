#include <cstdlib>
#include <string_view>

#include "framework/config/pipeline.h"
#include "plaza/core/error.h"

namespace plaza {
namespace {

constexpr std::string_view kDataVariable = "$PLAZA_DATA";

bool is_folder(const std::filesystem::path& path) {
  std::error_code error;
  return std::filesystem::is_directory(path, error);
}

/// Where $PLAZA_DATA points to: the environment decides; else the first of the usual places that
/// exists, so that a pipeline works from every working folder.
std::filesystem::path data_folder(const std::filesystem::path& file) {
  if (const char* set = std::getenv("PLAZA_DATA"); set != nullptr && *set != '\0') return set;
  const std::filesystem::path beside = std::filesystem::path("..") / "shared" / "data";
  if (is_folder(beside)) return beside;
  std::error_code error;
  std::filesystem::path folder =
      std::filesystem::absolute(file, error).lexically_normal().parent_path();
  while (!error && folder.has_relative_path()) {
    if (is_folder(folder / beside)) return folder / beside;
    folder = folder.parent_path();
  }
  return beside;
}

}  // namespace

std::filesystem::path resolve_path(const std::string& text, const std::filesystem::path& file) {
  if (text.empty()) return {};
  if (text.front() == '$') {
    const std::string variable = text.substr(0, text.find('/'));
    if (variable != kDataVariable) {
      throw UserError("\"" + variable +
                      "\" is not known at the start of a path; only $PLAZA_DATA is");
    }
    const std::string rest = text.substr(variable.size());
    std::filesystem::path folder = data_folder(file);
    if (rest.size() > 1) folder /= rest.substr(1);
    return folder.lexically_normal();
  }
  return (file.parent_path() / text).lexically_normal();
}

}  // namespace plaza
