#include "plaza/io/output_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <iterator>
#include <system_error>
#include <utility>

#include "plaza/core/error.h"

namespace plaza {
namespace {

constexpr std::size_t kBufferBytes = 64 * 1024;

std::string remedy(int error) {
  switch (error) {
    case ENOSPC:
    case EDQUOT:
      return "; free some space or write to another folder";
    case EFBIG:
      return "; the file system or a limit of this process (ulimit -f) allows no larger file";
    case EACCES:
    case EPERM:
    case EROFS:
      return "; choose a folder that you may write to";
    case ENOENT:
    case ENOTDIR:
      return "; the folder does not exist";
    default:
      return "";
  }
}

}  // namespace

DiskFullError::~DiskFullError() = default;

OutputFile::OutputFile(std::filesystem::path file) : file_(std::move(file)), part_(file_) {
  part_ += ".part";
  descriptor_ = ::open(part_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor_ < 0) fail("create", errno);
}

OutputFile::OutputFile(OutputFile&& other) noexcept
    : file_(std::move(other.file_)),
      part_(std::move(other.part_)),
      buffer_(std::move(other.buffer_)),
      record_ends_(std::move(other.record_ends_)),
      written_(other.written_),
      descriptor_(std::exchange(other.descriptor_, -1)) {}

OutputFile::~OutputFile() {
  if (descriptor_ < 0) return;
  close();
  ::unlink(part_.c_str());
}

void OutputFile::close() noexcept {
  ::close(descriptor_);
  descriptor_ = -1;
}

void OutputFile::fail(const char* action, int error) {
  const std::string text = "cannot " + std::string(action) + " " + file_.string() + ": " +
                           std::generic_category().message(error) + remedy(error);
  if (error == ENOSPC || error == EDQUOT) throw DiskFullError(text);
  throw UserError(text);
}

void OutputFile::write(std::string_view record) {
  if (descriptor_ < 0) throw InternalError(file_.string() + " was committed before");
  if (buffer_.size() >= kBufferBytes) flush();  // first, so that a record is taken or refused whole
  buffer_ += record;
  record_ends_.push_back(buffer_.size());
}

void OutputFile::flush() {
  std::size_t done = 0;
  while (done < buffer_.size()) {
    const ssize_t count = ::write(descriptor_, buffer_.data() + done, buffer_.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) {
      const int error = errno;
      // back to the last whole record; what stands behind it is kept for another try
      const auto beyond = std::upper_bound(record_ends_.begin(), record_ends_.end(), done);
      const std::size_t whole = beyond == record_ends_.begin() ? 0 : *std::prev(beyond);
      written_ += whole;
      buffer_.erase(0, whole);
      record_ends_.erase(record_ends_.begin(), beyond);
      for (std::size_t& end : record_ends_) end -= whole;
      if (::ftruncate(descriptor_, static_cast<off_t>(written_)) == 0) {
        ::lseek(descriptor_, static_cast<off_t>(written_), SEEK_SET);
      }
      fail("write", error);
    }
    done += static_cast<std::size_t>(count);
  }
  written_ += buffer_.size();
  drop_unwritten();
}

void OutputFile::drop_unwritten() {
  buffer_.clear();
  record_ends_.clear();
}

void OutputFile::commit() {
  if (descriptor_ < 0) throw InternalError(file_.string() + " was committed before");
  flush();
  // a disk that is full may say so only here; EINVAL and EROFS: not a file that can be synchronised
  if (::fsync(descriptor_) != 0 && errno != EINVAL && errno != EROFS) fail("write", errno);
  if (::rename(part_.c_str(), file_.c_str()) != 0) fail("rename to", errno);
  close();
}

void write_file(const std::filesystem::path& file, std::string_view content) {
  OutputFile out(file);
  out.write(content);
  out.commit();
}

}  // namespace plaza
