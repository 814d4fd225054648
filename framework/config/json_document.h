#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "plaza/core/diagnostic.h"

namespace plaza {

/// A JSON text with the position of every value and key, which nlohmann does not keep.
struct JsonDocument {
  nlohmann::json root;
  std::string file;
  std::map<std::string, FilePosition> values;  ///< JSON pointer -> where the value begins
  std::map<std::string, FilePosition> keys;    ///< JSON pointer of a member -> where its key begins

  /// Position of the value at `pointer`, or of its nearest ancestor that has one.
  FilePosition position(std::string_view pointer) const;
  FilePosition key_position(std::string_view pointer) const;
};

/// Parses strict JSON (no comments). Syntax errors, duplicate keys, nesting beyond 64 levels and invalid
/// UTF-8 are a UserError with file:line:column, all duplicates at once.
JsonDocument parse_json(std::string_view text, const std::string& file);

/// The same from a file; a file that is missing, a folder, or over 64 MiB is a UserError.
JsonDocument read_json(const std::filesystem::path& file);

/// One step of a JSON pointer, escaped ("~0", "~1").
std::string pointer_token(std::string_view key);

}  // namespace plaza
