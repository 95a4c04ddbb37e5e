#include "cli/progress_bar.h"

#include <unistd.h>

#include <algorithm>

namespace burnish::cli {

ProgressBar::ProgressBar(std::FILE* stream, std::string label, bool quiet)
    : stream_(stream),
      label_(std::move(label)),
      enabled_(!quiet && ::isatty(::fileno(stream))),
      last_(std::chrono::steady_clock::now()) {}

void ProgressBar::update(double fraction) {
  const auto now = std::chrono::steady_clock::now();
  if (!enabled_ || now - last_ < std::chrono::milliseconds(100)) return;
  last_ = now;
  drawn_ = true;
  constexpr int kWidth = 30;
  const int full = int(std::clamp(fraction, 0.0, 1.0) * kWidth);
  std::fprintf(stream_, "\r%s [%.*s%*s] %3d%%", label_.c_str(), full, "##############################", kWidth - full,
               "", int(fraction * 100));
  std::fflush(stream_);
}

void ProgressBar::clear() {
  if (drawn_) std::fprintf(stream_, "\r\033[K");
  drawn_ = false;
}

}  // namespace burnish::cli
