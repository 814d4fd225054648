#include "framework/execution/disk_reserve.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <string>
#include <system_error>

namespace plaza {

void DiskReserve::hold(const std::filesystem::path& folder, std::uintmax_t bytes) {
  release();
  std::error_code error;
  const std::filesystem::space_info space = std::filesystem::space(folder, error);
  if (error) return;
  std::string name = (folder / ".reserve-XXXXXX").string();
  descriptor_ = ::mkostemp(name.data(), O_CLOEXEC);
  if (descriptor_ < 0) return;
  ::unlink(name.c_str());
  // zeros are never written in its stead (as posix_fallocate does): that would cost time and not
  // hold on file systems that compress or copy on write
  if (::fallocate(descriptor_, 0, 0, static_cast<off_t>(std::min(bytes, space.available / 2))) != 0)
    release();
}

void DiskReserve::release() noexcept {
  if (descriptor_ >= 0) ::close(descriptor_);
  descriptor_ = -1;
}

}  // namespace plaza
