#pragma once

#include <cstdint>
#include <string>

#include "plaza/component/declaration.h"
#include "plaza/data/frames.h"

namespace plaza::test {

/// What all doubles can be asked for: to fail, in a phase, at a frame, in a way.
struct Failure {
  std::string fail_in;
  std::int64_t fail_at = -1;
  std::string error = "user";
};

template <class Options>
void declare_failure(Parameters<Options>& p) {
  // members of the base: the class of a member pointer is not converted when T is deduced
  p.value("fail_in", static_cast<std::string Options::*>(&Options::fail_in))
      .meaning("phase to fail in");
  p.value("fail_at", static_cast<std::int64_t Options::*>(&Options::fail_at))
      .meaning("frame to fail at");
  p.value("error", static_cast<std::string Options::*>(&Options::error)).meaning("how to fail");
}

/// Fails when that was asked for this phase and frame.
void fail_if(const Failure& failure, const std::string& phase, std::int64_t frame = -1);

/// What check() answers when it is to find fault with the value at `pointer`.
Diagnostics refusal(const std::string& pointer);

/// What doubles that work on a frame can be asked for as well: to take their time.
struct Work : Failure {
  std::int64_t jitter_us = 0;
};

template <class Options>
void declare_work(Parameters<Options>& p) {
  declare_failure(p);
  p.value("jitter_us", static_cast<std::int64_t Options::*>(&Options::jitter_us))
      .unit("us")
      .meaning("longest time that a frame takes");
}

/// Takes as long as was asked for, the same for the same frame, or fails.
void work(const Work& options, std::int64_t frame);

/// Pseudo-random, but the same for the same number.
std::uint64_t mix(std::uint64_t x);

/// Depends on every pixel of every view.
std::uint64_t checksum(const FrameSet& frames);

/// The parts of register_doubles(), a file each.
void register_frame_doubles(ComponentRegistrar& registrar);   ///< double_frames.cc
void register_people_doubles(ComponentRegistrar& registrar);  ///< double_people.cc
void register_result_doubles(ComponentRegistrar& registrar);  ///< double_results.cc

}  // namespace plaza::test
