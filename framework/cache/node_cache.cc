#include "framework/cache/node_cache.h"

#include <algorithm>
#include <array>
#include <system_error>
#include <tuple>
#include <utility>

#include "framework/execution/model_cache.h"
#include "framework/results/number_text.h"
#include "plaza/core/error.h"

namespace plaza {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kDefaultLimit = std::uintmax_t{20} * 1000 * 1000 * 1000;

void add_files(const fs::path& folder, const std::string& extension, bool learned,
               std::vector<CachedFile>& files) {
  std::error_code error;
  for (auto it = fs::directory_iterator(folder, error); !error && it != fs::directory_iterator();
       it.increment(error)) {
    if (it->path().extension() != extension) continue;
    std::error_code gone;  // another process may remove it meanwhile
    CachedFile file;
    file.file = it->path();
    file.bytes = it->file_size(gone);
    if (!gone) file.used = it->last_write_time(gone);
    file.learned = learned;
    if (!gone) files.push_back(std::move(file));
  }
}

}  // namespace

NodeCache::NodeCache(fs::path folder, std::uintmax_t limit_bytes, FeatureLoaders loaders)
    : folder_(std::move(folder)),
      nodes_(folder_ / "nodes"),
      limit_bytes_(limit_bytes),
      loaders_(std::move(loaders)) {}

fs::path NodeCache::file_of(std::string_view key) const {
  Hash hash;
  hash.add(key);
  return nodes_ / (hash.text() + ".node");
}

std::unique_ptr<EntryReader> NodeCache::open(std::string_view key) const {
  return EntryReader::open(file_of(key), key, loaders_);
}

std::unique_ptr<EntryWriter> NodeCache::create(std::string_view key) const {
  std::error_code error;
  fs::create_directories(nodes_, error);
  if (error) throw UserError("cannot create " + nodes_.string() + ": " + error.message());
  return std::make_unique<EntryWriter>(file_of(key), key);
}

std::optional<FileLock> NodeCache::try_lock(std::string_view key) const {
  std::error_code error;
  fs::create_directories(nodes_, error);
  fs::path file = file_of(key);
  return FileLock::try_lock(file.replace_extension(".lock"));
}

std::vector<CachedFile> NodeCache::list() const {
  std::vector<CachedFile> files;
  add_files(nodes_, ".node", false, files);
  for (CachedFile& file : files) file.info = EntryReader::look(file.file);
  add_files(folder_, ".learned", true, files);
  std::sort(files.begin(), files.end(), [](const CachedFile& a, const CachedFile& b) {
    return std::tie(b.used, a.file) < std::tie(a.used, b.file);
  });
  return files;
}

void NodeCache::remove_orphans() const {
  for (const char* extension : {".part", ".lock"}) {
    std::vector<CachedFile> files;
    add_files(nodes_, extension, false, files);
    for (const CachedFile& file : files) {
      fs::path lock = file.file;
      if (lock.extension() == ".part") lock.replace_extension("");  // HASH.node.part
      const auto held = FileLock::try_lock(lock.replace_extension(".lock"));
      std::error_code ignored;  // it is in nobody's way
      if (held) fs::remove(file.file, ignored);
    }
  }
}

std::uintmax_t NodeCache::make_room() const {
  remove_orphans();
  std::vector<CachedFile> files;
  add_files(nodes_, ".node", false, files);
  add_files(folder_, ".learned", true, files);
  std::sort(files.begin(), files.end(), [](const CachedFile& a, const CachedFile& b) {
    return std::tie(b.used, a.file) < std::tie(a.used, b.file);
  });
  std::uintmax_t kept = 0;
  std::uintmax_t freed = 0;
  for (const CachedFile& file : files) {
    if (kept + file.bytes <= limit_bytes_) {
      kept += file.bytes;
      continue;
    }
    std::error_code error;
    if (fs::remove(file.file, error)) freed += file.bytes;
  }
  return freed;
}

std::size_t NodeCache::clear(const std::string& use) const {
  remove_orphans();
  std::size_t count = 0;
  for (const CachedFile& file : list()) {
    if (!use.empty() && (!file.info || file.info->use != use)) continue;
    std::error_code error;
    if (fs::remove(file.file, error)) ++count;
  }
  return count;
}

std::uintmax_t default_cache_limit(const fs::path& folder) {
  fs::path existing = fs::absolute(folder);
  std::error_code error;
  while (!fs::exists(existing, error) && existing.has_relative_path()) {
    existing = existing.parent_path();
  }
  const fs::space_info space = fs::space(existing, error);
  return error ? kDefaultLimit : std::min(kDefaultLimit, space.available / 2);
}

std::string size_text(std::uintmax_t bytes) {
  constexpr std::array<const char*, 4> kUnits = {"B", "kB", "MB", "GB"};
  constexpr double kStep = 1000;
  auto value = static_cast<double>(bytes);
  std::size_t unit = 0;
  while (value >= kStep && unit + 1 < kUnits.size()) {
    value /= kStep;
    ++unit;
  }
  return fixed_text(value, unit == 0 ? 0 : 1) + " " + kUnits[unit];
}

}  // namespace plaza
