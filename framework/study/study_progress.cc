#include "framework/study/study_progress.h"

#include <unistd.h>

#include <cstdio>

#include "framework/execution/progress.h"

namespace plaza {

StudyProgress::StudyProgress(std::size_t total, std::size_t done, bool quiet)
    : total_(total),
      before_(done),
      quiet_(quiet),
      terminal_(!quiet && ::isatty(STDERR_FILENO) == 1) {
  if (done > 0) show(std::to_string(done) + " were done before");
}

StudyProgress::~StudyProgress() {
  if (line_open_) std::fputs("\n", stderr);
}

void StudyProgress::started() {
  ++running_;
  if (terminal_) show("");
}

void StudyProgress::ended(const std::string& title, const std::string& trouble) {
  --running_;
  ++ended_;
  if (!trouble.empty()) ++failed_;
  show(title + (trouble.empty() ? "" : ": " + trouble));
}

void StudyProgress::show(const std::string& event) {
  if (quiet_) return;
  std::string text =
      "study: " + std::to_string(before_ + ended_) + " of " + std::to_string(total_) + " runs";
  if (failed_ > 0) text += ", " + std::to_string(failed_) + " failed";
  const std::size_t left = total_ - before_ - ended_;
  if (ended_ > 0 && left > 0) {
    const double elapsed_s = std::chrono::duration<double>(Clock::now() - start_).count();
    text += ", about " +
            clock_text(elapsed_s / static_cast<double>(ended_) * static_cast<double>(left)) +
            " left";
  }
  if (terminal_) {
    if (running_ > 0) text += ", " + std::to_string(running_) + " at work";
    std::fputs(("\r\033[K" + text).c_str(), stderr);
    line_open_ = true;
  } else {
    if (!event.empty()) text += "; " + event;
    std::fputs(("plaza: " + text + "\n").c_str(), stderr);
  }
  std::fflush(stderr);
}

}  // namespace plaza
