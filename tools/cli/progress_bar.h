// A progress bar, drawn only where its stream is a terminal.
#pragma once

#include <chrono>
#include <cstdio>
#include <string>

namespace burnish::cli {

class ProgressBar {
 public:
  ProgressBar(std::FILE* stream, std::string label, bool quiet);
  ~ProgressBar() { clear(); }
  void update(double fraction);  // draws at most ten times a second
  void clear();                  // leaves the line as if nothing had been drawn

 private:
  std::FILE* stream_;
  std::string label_;
  bool enabled_, drawn_ = false;
  std::chrono::steady_clock::time_point last_;
};

}  // namespace burnish::cli
