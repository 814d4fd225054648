#pragma once

#include <cstdint>
#include <filesystem>

namespace plaza {

/// Disk space held back while a run goes on, so that its results still fit when something fills the
/// disk: a video, a neighbour. The file has no name, so it goes with the process, however that
/// ends. Where the file system can't hold space, or has too little, it holds back less, or nothing.
class DiskReserve {
 public:
  DiskReserve() = default;
  ~DiskReserve() { release(); }
  DiskReserve(const DiskReserve&) = delete;
  DiskReserve& operator=(const DiskReserve&) = delete;

  /// Holds back `bytes` in `folder`, at most half of what is free there.
  void hold(const std::filesystem::path& folder, std::uintmax_t bytes);
  /// Gives the space back.
  void release() noexcept;

 private:
  int descriptor_ = -1;
};

}  // namespace plaza
