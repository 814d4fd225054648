#pragma once

#include <array>
#include <mutex>
#include <opencv2/core/mat.hpp>
#include <opencv2/core/ocl.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "plaza/core/error.h"

/// What modalities share that compute on an OpenCL device, through OpenCV's buffers and queues.
namespace plaza::opencl {

/// Name of the device that OpenCV uses; empty when there is none. OpenCV takes the one that the
/// environment variable OPENCV_OPENCL_DEVICE names ("PLATFORM:TYPE:DEVICE", ":CPU:" for the first
/// processor).
std::string device_name();

/// What a component's check() says of its parameter "device" when it asks for OpenCL: nothing when
/// there is a device.
Diagnostics check_device();

/// A program of the device, made from OpenCL C. Thread-safe; calls wait for nothing, what reads
/// their results from the same thread does.
class Program {
 public:
  /// Throws UserError when there is no device or when it refuses the program, with its own words.
  explicit Program(const char* source);

  /// Runs a kernel with one work item per element of `size`. Matrices are passed as a pointer with
  /// step and offset in bytes, unless wrapped (see in(), out()).
  template <class... Args>
  void run(const char* name, std::array<std::size_t, 2> size, const Args&... args) const {
    cv::ocl::Kernel kernel(name, program_);  // holds its arguments: one per call
    kernel.args(argument(args)...);
    enqueue(kernel, name, size);
  }

 private:
  static cv::ocl::KernelArg argument(const cv::UMat& matrix) {
    return cv::ocl::KernelArg::ReadOnlyNoSize(matrix);
  }
  static cv::ocl::KernelArg argument(const cv::ocl::KernelArg& argument) { return argument; }
  static int argument(int value) { return value; }
  static void enqueue(cv::ocl::Kernel& kernel, const char* name, std::array<std::size_t, 2> size);

  cv::ocl::Program program_;
};

/// A plain array on the device, as a kernel's argument.
inline cv::ocl::KernelArg in(const cv::UMat& array) {
  return cv::ocl::KernelArg::PtrReadOnly(array);
}
inline cv::ocl::KernelArg out(const cv::UMat& array) {
  return cv::ocl::KernelArg::PtrWriteOnly(array);
}

/// Copies host memory to the device as a plain array; an empty one gets a byte, since OpenCL knows
/// no empty buffers. Throws std::invalid_argument beyond 2 GB.
cv::UMat upload_bytes(const void* data, std::size_t bytes);
template <class T>
cv::UMat upload(std::span<const T> values) {
  return upload_bytes(values.data(), values.size_bytes());
}
/// Room for `bytes` bytes on the device; at least one.
cv::UMat room_for(std::size_t bytes);
/// Waits for the kernels that this thread has run, and copies back.
void download_bytes(const cv::UMat& array, void* data, std::size_t bytes);

/// What an immutable host object has on the device: made when it is first asked for, once.
/// Thread-safe.
template <class T>
class OnDevice {
 public:
  template <class Make>
  const T& get(const Make& make) const {
    std::call_once(once_, [&] { value_ = make(); });
    return value_;
  }

 private:
  mutable std::once_flag once_;
  mutable T value_;
};

/// Fewer templates than these are not worth a round trip to a device.
inline constexpr std::size_t kLeastTemplates = 64;

}  // namespace plaza::opencl
