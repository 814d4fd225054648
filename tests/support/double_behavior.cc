#include "tests/support/double_behavior.h"

#include <chrono>
#include <cstdlib>
#include <stdexcept>
#include <thread>

#include "plaza/core/error.h"
#include "plaza/io/output_file.h"

namespace plaza::test {

void fail_if(const Failure& failure, const std::string& phase, std::int64_t frame) {
  if (failure.fail_in != phase || failure.fail_at != frame) return;
  if (failure.error == "user") throw UserError("asked to fail; ask for something else");
  if (failure.error == "internal") throw InternalError("asked to fail");
  if (failure.error == "full") throw DiskFullError("cannot write: the disk is full");
  if (failure.error == "crash") std::abort();
  if (failure.error == "foreign") throw std::out_of_range("a plugin's own trouble");
  throw 42;
}

Diagnostics refusal(const std::string& pointer) {
  Diagnostics faults(1);
  faults[0].pointer = pointer;
  faults[0].message = "can't be used; choose another";
  return faults;
}

void work(const Work& options, std::int64_t frame) {
  fail_if(options, "process", frame);
  if (options.jitter_us <= 0) return;
  const auto us =
      mix(static_cast<std::uint64_t>(frame) + 99) % static_cast<std::uint64_t>(options.jitter_us);
  std::this_thread::sleep_for(std::chrono::microseconds(us));
}

std::uint64_t mix(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

std::uint64_t checksum(const FrameSet& frames) {
  std::uint64_t sum = 17;
  for (const cv::Mat& image : frames.views) {
    sum = mix(sum + 1);
    for (int row = 0; row < image.rows; ++row) {
      for (int b = 0; b < image.cols * 3; ++b) sum = sum * 131 + image.ptr(row)[b];
    }
  }
  return sum;
}

}  // namespace plaza::test
