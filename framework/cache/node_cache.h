#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "framework/cache/file_lock.h"
#include "framework/cache/node_entry.h"

namespace plaza {

/// Something that stands in the cache.
struct CachedFile {
  std::filesystem::path file;
  std::uintmax_t bytes = 0;
  std::filesystem::file_time_type used;
  bool learned = false;           ///< a learned model, not a node's output
  std::optional<EntryInfo> info;  ///< of a node's output; nothing: damaged
};

/// What nodes gave, on disk, under the complete text of everything it depends on. Several processes
/// may use one folder: entries appear whole, what is open stays readable when it is removed.
class NodeCache {
 public:
  /// Entries stand in FOLDER/nodes, next to learned models. `limit_bytes` is for both together.
  /// `loaders` read the features of what is kept.
  NodeCache(std::filesystem::path folder, std::uintmax_t limit_bytes, FeatureLoaders loaders = {});

  /// The entry under `key`, or null. What is damaged is not used.
  std::unique_ptr<EntryReader> open(std::string_view key) const;
  /// Creates the folder where it is missing.
  std::unique_ptr<EntryWriter> create(std::string_view key) const;
  /// The right to compute `key`; nothing while another process has it.
  std::optional<FileLock> try_lock(std::string_view key) const;
  std::uintmax_t limit_bytes() const { return limit_bytes_; }
  const FeatureLoaders& loaders() const { return loaders_; }

  /// Everything in the cache, the most recently used first.
  std::vector<CachedFile> list() const;
  /// Removes what was used longest ago until the rest fits the limit, and parts that processes
  /// which were killed have left. Returns the bytes that were freed.
  std::uintmax_t make_room() const;
  /// Removes all entries, those of one component when `use` names one. Returns their number.
  std::size_t clear(const std::string& use) const;

 private:
  std::filesystem::path file_of(std::string_view key) const;
  void remove_orphans() const;

  std::filesystem::path folder_;
  std::filesystem::path nodes_;
  std::uintmax_t limit_bytes_;
  FeatureLoaders loaders_;
};

/// 20 GB, or half of what the disk of `folder` has free when that is less.
std::uintmax_t default_cache_limit(const std::filesystem::path& folder);

/// "1.5 GB".
std::string size_text(std::uintmax_t bytes);

}  // namespace plaza
