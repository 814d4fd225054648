#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "framework/execution/run.h"

namespace plaza {

/// Says how far a run is. On a terminal one line that renews itself, on stderr; where stderr is no
/// terminal a plain line now and then; or JSON lines on stdout:
///   {"event":"progress","phase":"stream","done":120,"total":795,"frames_per_second":64.2,"remaining_s":10.5}
/// "total" and "remaining_s" are absent where the end is not known.
class Progress {
 public:
  explicit Progress(ProgressStyle style);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// A phase of `total` frames begins: "learn", "stream", "render".
  void begin(std::string phase, std::optional<std::int64_t> total);
  /// One more frame is done.
  void tick();
  void end();

 private:
  using Clock = std::chrono::steady_clock;
  void show(Clock::time_point now);

  ProgressStyle style_;
  bool terminal_ = false;
  Clock::duration interval_{};
  std::string phase_;
  std::optional<std::int64_t> total_;
  std::int64_t done_ = 0;
  Clock::time_point start_{};
  Clock::time_point next_show_{};
  bool line_open_ = false;
};

/// "1:02:03" or "2:03".
std::string clock_text(double seconds);

}  // namespace plaza
