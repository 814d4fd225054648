#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "plaza/core/diagnostic.h"

namespace plaza {

/// A JSON text with the position of every value and key, which nlohmann does not keep. Columns
/// count characters (code points), as editors do.
struct JsonDocument {
  nlohmann::json root;
  std::string file;
  std::map<std::string, FilePosition, std::less<>>
      values;  ///< JSON pointer -> where the value begins
  std::map<std::string, FilePosition, std::less<>>
      keys;  ///< pointer of a member -> where its key begins

  /// Position of the value at `pointer`, or of its nearest ancestor that has one.
  FilePosition position(std::string_view pointer) const;
  /// Position of the member's key, or what position() says where there is no such member.
  FilePosition key_position(std::string_view pointer) const;
};

/// Objects and arrays may be nested this deep.
inline constexpr std::size_t kMaxJsonDepth = 64;
/// Longest accepted key; pointers are made of keys, and a key this long is no name.
inline constexpr std::size_t kMaxJsonKeyBytes = 1024;
/// Largest accepted file.
inline constexpr std::uintmax_t kMaxJsonFileBytes = std::uintmax_t{64} << 20U;

/// Parses strict JSON (no comments; a byte order mark is skipped). Syntax errors, duplicate keys,
/// nesting beyond 64 levels, keys over 1024 bytes, numbers beyond a double and invalid UTF-8 are a
/// UserError with file:line:column, all duplicates at once. `file` is only a name for messages.
JsonDocument parse_json(std::string_view text, const std::string& file);

/// The same from a file; a file that is missing, not a regular file, or over 64 MiB is a UserError.
JsonDocument read_json(const std::filesystem::path& file);

/// The contents of a JSON file, under the same conditions.
std::string read_text_file(const std::filesystem::path& file);

/// One step of a JSON pointer, escaped ("~0", "~1").
std::string pointer_token(std::string_view key);

/// The steps of a JSON pointer, unescaped: "/a~1b/0" -> "a/b", "0". An empty pointer has none.
std::vector<std::string> pointer_tokens(std::string_view pointer);

}  // namespace plaza
