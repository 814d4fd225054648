#include "framework/execution/progress.h"

#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "framework/results/number_text.h"

namespace plaza {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

double rounded(double value) { return std::round(value * 10) / 10; }

}  // namespace

std::string clock_text(double seconds) {
  const auto total = static_cast<std::int64_t>(std::llround(std::max(seconds, 0.0)));
  const auto two = [](std::int64_t n) {
    return std::string(n < 10 ? "0" : "").append(std::to_string(n));
  };
  const std::int64_t hours = total / 3600;
  const std::int64_t minutes = total / 60 % 60;
  return hours > 0 ? std::to_string(hours) + ":" + two(minutes) + ":" + two(total % 60)
                   : std::to_string(minutes) + ":" + two(total % 60);
}

Progress::Progress(ProgressStyle style)
    : style_(style), terminal_(style == ProgressStyle::kTerminal && ::isatty(STDERR_FILENO) == 1) {
  if (style_ == ProgressStyle::kJsonLines) {
    interval_ = milliseconds(500);
  } else {
    interval_ = terminal_ ? Clock::duration(milliseconds(100)) : Clock::duration(seconds(10));
  }
}

Progress::~Progress() {
  if (line_open_) std::fputs("\n", stderr);
}

void Progress::begin(std::string phase, std::optional<std::int64_t> total) {
  phase_ = std::move(phase);
  total_ = total;
  done_ = 0;
  start_ = Clock::now();
  next_show_ = start_ + interval_;
}

void Progress::tick() {
  ++done_;
  if (style_ == ProgressStyle::kQuiet) return;
  if (const auto now = Clock::now(); now >= next_show_) {
    show(now);
    next_show_ = now + interval_;
  }
}

void Progress::end() {
  if (style_ == ProgressStyle::kQuiet || done_ == 0) return;
  show(Clock::now());
  if (line_open_) std::fputs("\n", stderr);
  line_open_ = false;
}

void Progress::show(Clock::time_point now) {
  const double elapsed_s = std::chrono::duration<double>(now - start_).count();
  const double rate = elapsed_s > 0 ? static_cast<double>(done_) / elapsed_s : 0;
  std::optional<double> remaining_s;
  if (total_ && rate > 0)
    remaining_s = static_cast<double>(std::max<std::int64_t>(*total_ - done_, 0)) / rate;

  if (style_ == ProgressStyle::kJsonLines) {
    nlohmann::ordered_json line = {{"event", "progress"}, {"phase", phase_}, {"done", done_}};
    if (total_) line["total"] = *total_;
    line["frames_per_second"] = rounded(rate);
    if (remaining_s) line["remaining_s"] = rounded(*remaining_s);
    std::fputs((line.dump() + "\n").c_str(), stdout);
    std::fflush(stdout);
    return;
  }
  std::string text = phase_ + ": frame " + std::to_string(done_);
  if (total_) text += " of " + std::to_string(*total_);
  text += ", " + fixed_text(rate, 1) + " frames/s";
  if (remaining_s && *remaining_s > 0) text += ", " + clock_text(*remaining_s) + " left";
  if (terminal_) {
    std::fputs(("\r\033[K" + text).c_str(), stderr);
    line_open_ = true;
  } else {
    std::fputs(("plaza: " + text + "\n").c_str(), stderr);
  }
  std::fflush(stderr);
}

}  // namespace plaza
