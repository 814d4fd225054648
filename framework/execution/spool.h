#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "plaza/data/frames.h"

namespace plaza {

/// Frame sets of a source that can't be read again, on disk: raw images in one file that has no
/// name any more once it is open, so that no way of dying leaves it behind.
class Spool {
 public:
  /// A full or read-only disk is a UserError naming folder and remedy.
  explicit Spool(const std::filesystem::path& folder);
  ~Spool();
  Spool(const Spool&) = delete;
  Spool& operator=(const Spool&) = delete;

  void append(const FrameSet& frames);
  std::int64_t size() const { return static_cast<std::int64_t>(entries_.size()); }
  /// The index-th frame set that was appended, bit for bit.
  std::shared_ptr<const FrameSet> read(std::int64_t index) const;

 private:
  struct View {
    int rows = 0, columns = 0, type = 0;
    std::int64_t offset = 0;
  };
  struct Entry {
    std::int64_t frame = 0, time_ns = 0;
    std::vector<View> views;
  };
  [[noreturn]] void fail(int error) const;

  std::string folder_;
  int descriptor_ = -1;
  std::int64_t bytes_ = 0;
  std::vector<Entry> entries_;
};

}  // namespace plaza
