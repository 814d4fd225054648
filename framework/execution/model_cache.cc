#include "framework/execution/model_cache.h"

#include <unistd.h>

#include <fstream>
#include <sstream>
#include <system_error>

#include "plaza/core/error.h"
#include "plaza/io/output_file.h"

namespace plaza {
namespace {

constexpr std::string_view kMagic = "PLAZALRN";
constexpr std::uint64_t kLayout = 1;
constexpr std::size_t kWord = 8;

void append_word(std::string& bytes, std::uint64_t value) {
  for (std::size_t i = 0; i < kWord; ++i) bytes += static_cast<char>((value >> (8 * i)) & 0xff);
}

/// Takes pieces off the front of an entry; every length is checked against what is there.
class Cursor {
 public:
  explicit Cursor(std::string_view bytes) : rest_(bytes) {}
  std::optional<std::string_view> bytes(std::uint64_t count) {
    if (count > rest_.size()) return std::nullopt;
    const std::string_view piece = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return piece;
  }
  std::optional<std::uint64_t> word() {
    const auto piece = bytes(kWord);
    if (!piece) return std::nullopt;
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < kWord; ++i) {
      value |= static_cast<std::uint64_t>(static_cast<unsigned char>((*piece)[i])) << (8 * i);
    }
    return value;
  }
  bool at_end() const { return rest_.empty(); }

 private:
  std::string_view rest_;
};

std::uint64_t hash_of(std::string_view bytes) {
  Hash hash;
  hash.add(bytes);
  return hash.value();
}

}  // namespace

void Hash::add(std::string_view bytes) {
  for (const char c : bytes) {
    value_ ^= static_cast<unsigned char>(c);
    value_ *= 0x100000001b3u;
  }
}

std::string Hash::text() const {
  static constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text;
  for (int shift = 60; shift >= 0; shift -= 4) text += kDigits[(value_ >> shift) & 0xf];
  return text;
}

std::filesystem::path ModelCache::file_of(std::string_view key) const {
  Hash hash;
  hash.add(key);
  return folder_ / (hash.text() + ".learned");
}

std::optional<std::string> ModelCache::find(std::string_view key) const {
  std::ifstream in(file_of(key), std::ios::binary);
  if (!in) return std::nullopt;
  std::ostringstream text;
  text << in.rdbuf();
  const std::string entry = std::move(text).str();
  if (entry.size() < kWord) return std::nullopt;

  const std::string_view body = std::string_view(entry).substr(0, entry.size() - kWord);
  Cursor checksum(std::string_view(entry).substr(body.size()));
  if (checksum.word() != hash_of(body)) return std::nullopt;

  Cursor cursor(body);
  if (cursor.bytes(kMagic.size()) != kMagic || cursor.word() != kLayout) return std::nullopt;
  const auto key_size = cursor.word();
  if (!key_size || cursor.bytes(*key_size) != key) return std::nullopt;
  const auto content_size = cursor.word();
  if (!content_size) return std::nullopt;
  const auto content = cursor.bytes(*content_size);
  if (!content || !cursor.at_end()) return std::nullopt;
  return std::string(*content);
}

void ModelCache::store(std::string_view key, std::string_view content) const {
  std::string entry(kMagic);
  append_word(entry, kLayout);
  append_word(entry, key.size());
  entry += key;
  append_word(entry, content.size());
  entry += content;
  append_word(entry, hash_of(entry));

  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (error) throw UserError("cannot create " + folder_.string() + ": " + error.message());
  // a name of this process's own first: two runs may learn the same thing at the same time
  const std::filesystem::path target = file_of(key);
  std::filesystem::path own = target;
  own += '.';
  own += std::to_string(::getpid());
  write_file(own, entry);
  std::filesystem::rename(own, target, error);
  if (error) {
    const std::string reason = error.message();
    std::filesystem::remove(own, error);
    throw UserError("cannot write " + target.string() + ": " + reason);
  }
}

void ModelCache::remove(std::string_view key) const {
  std::error_code ignored;  // it will be overwritten if it can't be removed
  std::filesystem::remove(file_of(key), ignored);
}

}  // namespace plaza
