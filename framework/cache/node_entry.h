#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "framework/cache/feature_codec.h"
#include "plaza/data/payload.h"

namespace plaza {

/// What an entry says of itself beside its payloads.
struct EntryInfo {
  std::string use, node, port;  ///< what gave it
  std::int64_t first_frame = 0;
  std::int64_t frames = 0;
  bool declined = false;  ///< reading it back would not be worth it; there are no payloads
  /// Measured: seconds that this node and all above it took for these frames, by node.
  std::map<std::string, double> seconds;
  std::vector<std::string> notes;  ///< that a run with these frames gives, see RunReport
};

/// Writes one output of a node, frame by frame, under a name that is not the entry's until all is
/// there.
///
/// An entry is one file: magic "PLAZANOD", layout, the key, records (checksum, bytes) of each frame
/// and one of the flush, then an index: the record's places, EntryInfo, a checksum of the index; at
/// the very end where that begins. Integers are little-endian. An entry is used when every one of
/// them fits and the key is the same text.
class EntryWriter {
 public:
  /// A failure to write is a UserError, here and below; the run can go on without.
  EntryWriter(std::filesystem::path file, std::string_view key);
  ~EntryWriter();
  EntryWriter(const EntryWriter&) = delete;
  EntryWriter& operator=(const EntryWriter&) = delete;

  /// The next frame's payload (empty: none was given), or at last the one of the flush.
  void add(std::string_view bytes);
  /// Forgets all payloads, for an entry that says it is not worth keeping.
  void clear();
  std::uint64_t bytes() const { return written_; }
  /// Gives the file its name. `info.frames` is the number of records but one.
  void commit(const EntryInfo& info);

 private:
  void append(std::string_view bytes);

  std::filesystem::path file_, part_;
  std::string key_;
  int descriptor_ = -1;
  std::uint64_t written_ = 0, start_ = 0;
  std::vector<std::uint64_t> places_;
};

/// Reads entries; any frame in any order, from any thread.
class EntryReader {
 public:
  /// Nothing when there is no whole entry of this key. Payloads are checked when they are read.
  /// `loaders` read features.
  static std::unique_ptr<EntryReader> open(const std::filesystem::path& file, std::string_view key,
                                           FeatureLoaders loaders);
  /// The information of whatever entry the file holds; nothing where it is none.
  static std::optional<EntryInfo> look(const std::filesystem::path& file);
  ~EntryReader();
  EntryReader(const EntryReader&) = delete;
  EntryReader& operator=(const EntryReader&) = delete;

  const EntryInfo& info() const { return info_; }
  /// Of a frame (from 0, as the run counts), or of the flush; null where none was given. Throws
  /// DamagedEntry.
  PayloadPtr payload(std::int64_t frame) const;
  PayloadPtr flushed() const;

 private:
  EntryReader() = default;
  bool read_index(std::string_view key, bool any_key);
  PayloadPtr record(std::size_t index) const;
  std::string read(std::uint64_t offset, std::uint64_t size) const;

  std::filesystem::path file_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
  std::vector<std::uint64_t> places_;  ///< of the records, and where the last one ends
  EntryInfo info_;
  FeatureLoaders loaders_;
};

}  // namespace plaza
