#include "framework/execution/spool.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "plaza/core/error.h"

namespace plaza {
namespace {

/// pread and pwrite do what they can; these do it all. 0 or errno; a file that ends early is EIO.
template <class Transfer>
int transfer_all(const Transfer& transfer, std::size_t count) {
  std::size_t done = 0;
  while (done < count) {
    const ssize_t n = transfer(done, count - done);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return errno;
    if (n == 0) return EIO;
    done += static_cast<std::size_t>(n);
  }
  return 0;
}

}  // namespace

Spool::Spool(const std::filesystem::path& folder) : folder_(folder.string()) {
  std::string name = (folder / "spool-XXXXXX").string();
  descriptor_ = ::mkstemp(name.data());
  if (descriptor_ < 0) fail(errno);
  ::unlink(name.c_str());
}

Spool::~Spool() { ::close(descriptor_); }

void Spool::fail(int error) const {
  throw UserError(
      "cannot keep the images of a live source in " + folder_ + ": " +
      std::generic_category().message(error) +
      "; free some space, write to another folder, or take out the renderers that need them");
}

void Spool::append(const FrameSet& frames) {
  Entry entry{.frame = frames.frame, .time_ns = frames.time_ns, .views = {}};
  std::int64_t offset = bytes_;
  for (const cv::Mat& image : frames.views) {
    entry.views.push_back({image.rows, image.cols, image.type(), offset});
    const std::size_t row_bytes = static_cast<std::size_t>(image.cols) * image.elemSize();
    for (int row = 0; row < image.rows; ++row) {
      const int error = transfer_all(
          [&](std::size_t done, std::size_t rest) {
            return ::pwrite(descriptor_, image.ptr(row) + done, rest,
                            offset + static_cast<std::int64_t>(done));
          },
          row_bytes);
      if (error != 0) fail(error);
      offset += static_cast<std::int64_t>(row_bytes);
    }
  }
  bytes_ = offset;
  entries_.push_back(std::move(entry));
}

std::shared_ptr<const FrameSet> Spool::read(std::int64_t index) const {
  const Entry& entry = entries_.at(static_cast<std::size_t>(index));
  auto frames = std::make_shared<FrameSet>();
  frames->frame = entry.frame;
  frames->time_ns = entry.time_ns;
  for (const View& view : entry.views) {
    cv::Mat image;
    if (view.rows > 0 && view.columns > 0) {
      image.create(view.rows, view.columns, view.type);
      const int error = transfer_all(
          [&](std::size_t done, std::size_t rest) {
            return ::pread(descriptor_, image.data + done, rest,
                           view.offset + static_cast<std::int64_t>(done));
          },
          image.total() * image.elemSize());
      if (error != 0) fail(error);
    }
    frames->views.push_back(std::move(image));
  }
  return frames;
}

}  // namespace plaza
