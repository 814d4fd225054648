#include "modalities/common/opencl.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace plaza::opencl {
namespace {

constexpr const char* kRemedy =
    "there is no OpenCL device: install a driver (on Debian pocl-opencl-icd runs on any processor, "
    "with OPENCV_OPENCL_DEVICE=:CPU:) or leave \"device\" at \"cpu\"";

int columns(std::size_t bytes) {
  if (bytes > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
    throw std::invalid_argument("more than 2 GB for an OpenCL device");
  }
  return static_cast<int>(std::max<std::size_t>(bytes, 1));
}

}  // namespace

std::string device_name() {
  if (!cv::ocl::haveOpenCL()) return {};
  const cv::ocl::Device& device = cv::ocl::Device::getDefault();
  return device.ptr() != nullptr && device.available() ? device.name() : std::string();
}

Diagnostics check_device() {
  if (!device_name().empty()) return {};
  return {fault_at("/device", kRemedy)};
}

Program::Program(const char* source) {
  if (device_name().empty()) throw UserError(kRemedy);
  cv::String log;
  program_ = cv::ocl::Program(cv::ocl::ProgramSource(source), "", log);
  if (program_.ptr() == nullptr) {
    throw UserError("the OpenCL device '" + device_name() + "' refuses the program: " + log);
  }
}

void Program::enqueue(cv::ocl::Kernel& kernel, const char* name, std::array<std::size_t, 2> size) {
  if (!kernel.run(2, size.data(), nullptr, false)) {
    throw InternalError("OpenCL kernel '" + std::string(name) + "' failed on '" + device_name() +
                        "'");
  }
}

cv::UMat room_for(std::size_t bytes) { return {1, columns(bytes), CV_8UC1}; }

cv::UMat upload_bytes(const void* data, std::size_t bytes) {
  cv::UMat array = room_for(bytes);
  if (bytes > 0) {
    // OpenCV has no matrix of constant data; it is only read
    cv::Mat(1, columns(bytes), CV_8UC1, const_cast<void*>(data)).copyTo(array);
  }
  return array;
}

void download_bytes(const cv::UMat& array, void* data, std::size_t bytes) {
  if (bytes == 0) return;
  cv::Mat host(1, columns(bytes), CV_8UC1, data);
  array.copyTo(host);
}

}  // namespace plaza::opencl
