#pragma once

#include <filesystem>
#include <optional>

namespace plaza {

/// Something that one process at a time may do, by a lock on a file. The system takes it back when
/// the process ends, however it does.
class FileLock {
 public:
  /// Makes the file where it is missing. Nothing while another holds the lock; a file that can't be
  /// made is a UserError.
  static std::optional<FileLock> try_lock(const std::filesystem::path& file);
  FileLock() = default;
  ~FileLock();
  FileLock(FileLock&& other) noexcept;
  FileLock& operator=(FileLock&& other) noexcept;

 private:
  explicit FileLock(int descriptor) : descriptor_(descriptor) {}
  int descriptor_ = -1;
};

}  // namespace plaza
