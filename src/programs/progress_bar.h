#pragma once
// A progress bar on standard error: redrawn in place on a terminal, one line for each tenth in a log.

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <string>

namespace live_stiffness {

class ProgressBar {
 public:
  ProgressBar(std::string title, long total) : title_(std::move(title)), total_(std::max(1L, total)) {}

  // Call when `done` of `total` parts are finished.
  void update(long done) {
    const int percent = static_cast<int>(100.0 * std::min(done, total_) / total_);
    const bool on_terminal = isatty(STDERR_FILENO);
    if (percent == shown_ || (!on_terminal && percent / 10 == shown_ / 10 && shown_ >= 0)) return;
    shown_ = percent;
    constexpr int kWidth = 40;
    const int filled = kWidth * percent / 100;
    std::fprintf(stderr, "%s%s [%s%s] %3d %%%s", on_terminal ? "\r" : "", title_.c_str(),
                 std::string(filled, '#').c_str(), std::string(kWidth - filled, '.').c_str(), percent,
                 on_terminal && percent < 100 ? "" : "\n");
    std::fflush(stderr);
  }

 private:
  std::string title_;
  long total_;
  int shown_ = -1;
};

}  // namespace live_stiffness
