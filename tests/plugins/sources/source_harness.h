#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "plaza/component/build_context.h"
#include "plaza/component/source.h"
#include "plaza/data/frames.h"
#include "plaza/geometry/scene.h"
#include "tests/support/temporary_folder.h"

namespace plaza::sources {

inline constexpr int kWidth = 64;
inline constexpr int kHeight = 48;

using test::TemporaryFolder;

inline Camera test_camera(const std::string& name, int width = kWidth, int height = kHeight) {
  PinholeIntrinsics intrinsics;
  intrinsics.fx_px = intrinsics.fy_px = 50;
  intrinsics.cx_px = width / 2.0;
  intrinsics.cy_px = height / 2.0;
  CameraFromWorld pose;
  pose.rotation << 1, 0, 0, 0, 0, -1, 0, 1, 0;  // looks along +y, one metre above the ground
  pose.translation << 0, 1, 0;
  return Camera::pinhole(name, {width, height}, intrinsics, pose);
}

inline std::shared_ptr<Scene> test_scene(const std::vector<std::string>& cameras,
                                         double frame_rate_hz = 10) {
  auto scene = std::make_shared<Scene>();
  scene->name = "test";
  for (const std::string& name : cameras) scene->cameras.push_back(test_camera(name));
  scene->area = {.min_m = {-5, 1}, .max_m = {5, 9}};
  scene->frame_rate_hz = frame_rate_hz;
  return scene;
}

/// A source with what the kernel does around it.
template <class S>
class Driver {
 public:
  Driver(typename S::Options options, std::shared_ptr<const Scene> scene) : scene_(scene) {
    BuildContext context;
    context.name = "cameras";
    context.scene = scene;
    source_ = std::make_unique<S>(options, context);
  }
  S& operator*() { return *source_; }
  S* operator->() { return source_.get(); }

  /// What a source emits in one frame, by output; nothing at the end.
  std::optional<std::vector<PayloadPtr>> read(std::int64_t frame) {
    std::vector<PayloadPtr> slots(4);
    const std::vector<int> outputs = {0, 1, 2, 3};
    NodeIo io(frame, scene_->time_of_frame(frame), slots.data(), {}, outputs);
    if (!source_->read(io)) {
      for (const PayloadPtr& slot : slots) EXPECT_EQ(slot, nullptr) << "emitted at the end";
      return std::nullopt;
    }
    return slots;
  }
  template <class T>
  std::shared_ptr<const T> read_as(std::int64_t frame, std::size_t output = 0) {
    const auto slots = read(frame);
    return slots ? std::static_pointer_cast<const T>(slots->at(output)) : nullptr;
  }
  std::shared_ptr<const FrameSet> frames(std::int64_t frame) { return read_as<FrameSet>(frame); }

  /// Frames from `first` to the end.
  std::vector<std::shared_ptr<const FrameSet>> rest(std::int64_t first = 0) {
    std::vector<std::shared_ptr<const FrameSet>> all;
    while (auto set = frames(first++)) all.push_back(std::move(set));
    return all;
  }

 private:
  std::shared_ptr<const Scene> scene_;
  std::unique_ptr<S> source_;
};

inline bool same_image(const cv::Mat& a, const cv::Mat& b) {
  if (a.size() != b.size() || a.type() != b.type()) return false;
  for (int y = 0; y < a.rows; ++y) {
    if (!std::equal(a.ptr(y), a.ptr(y) + static_cast<std::size_t>(a.cols) * a.elemSize(),
                    b.ptr(y))) {
      return false;
    }
  }
  return true;
}

/// Different for every number, and kept through lossy coding: the grey level in the middle says it.
inline cv::Mat numbered_image(int number, int width = kWidth, int height = kHeight) {
  return {height, width, CV_8UC3, cv::Scalar::all(8 + 6 * number)};
}

/// The number that numbered_image() drew, -1 for an empty image.
inline int number_in(const cv::Mat& image) {
  if (image.empty()) return -1;
  return (image.at<cv::Vec3b>(image.rows / 2, image.cols / 2)[1] - 8 + 3) / 6;
}

inline std::string read_bytes(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

inline void write_bytes(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

/// "pointer: message" of each fault.
inline std::vector<std::string> texts(const Diagnostics& faults) {
  std::vector<std::string> out;
  for (const Diagnostic& fault : faults) out.push_back(to_string(fault));
  return out;
}

/// The UserError that `body` throws; fails the test when it throws none.
template <class F>
UserError user_error(const F& body) {
  try {
    body();
  } catch (const UserError& error) {
    return error;
  }
  ADD_FAILURE() << "no UserError";
  return UserError("none");
}

}  // namespace plaza::sources
