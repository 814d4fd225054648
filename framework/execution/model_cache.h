#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace plaza {

/// FNV-1a, 64 bits: names cache entries and finds damaged ones. Not for secrets.
class Hash {
 public:
  void add(std::string_view bytes);
  std::uint64_t value() const { return value_; }
  std::string text() const;  ///< 16 hexadecimal digits

 private:
  std::uint64_t value_ = 0xcbf29ce484222325u;
};

/// Learned models on disk, each under the complete text of everything it depends on.
///
/// An entry is one file, named by the key's hash: magic "PLAZALRN", layout, length of the key, the
/// key, length of the content, the content, checksum of all before; integers are little-endian. An
/// entry is used only when every one of them fits and the key is the same text: hashes may collide,
/// keys may not.
class ModelCache {
 public:
  explicit ModelCache(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// The content under `key`; nothing when there is none or the entry is damaged or of another key.
  std::optional<std::string> find(std::string_view key) const;
  /// Stores atomically, replacing what was there. A failure is a UserError; the run can go on
  /// without.
  void store(std::string_view key, std::string_view content) const;
  void remove(std::string_view key) const;
  std::filesystem::path file_of(std::string_view key) const;

 private:
  std::filesystem::path folder_;
};

}  // namespace plaza
