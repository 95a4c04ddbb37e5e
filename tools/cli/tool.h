// What all tools share: parsing, errors and exit codes, inputs and outputs, report, depfile, progress.
//
// A tool declares its options on app(), then calls run() with what it does: one library call, and the figures for the
// report.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <cstdio>
#include <deque>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "burnish/core/image_io.h"
#include "burnish/core/output_set.h"
#include "burnish/core/progress.h"
#include "burnish/core/texel_limit.h"
#include "cli/image_libraries.h"
#include "cli/progress_bar.h"

namespace burnish::cli {

using Json = nlohmann::ordered_json;

struct ToolText {
  std::string name;     // "burnish-normals"
  std::string summary;  // one line
  std::string example;  // one or more command lines
};

class Tool {
 public:
  explicit Tool(const ToolText& text, std::string (*libraries)() = image_libraries);

  CLI::App& app() { return app_; }

  // Runs `action` once the command line is parsed; returns the exit code. The action's result is the report's "stats".
  int run(int argc, char** argv, const std::function<Json()>& action);

  // For actions. A file that will be read: enters the report and the depfile; "-" is standard input, spooled to a
  // temporary.
  FileRef read(const std::string& path);
  // A file that was read on the way, such as what a scene names.
  void also_read(const std::string& path) { note_input(path); }
  // A file that will be written, all at once when the action has succeeded.
  FileRef write(const std::string& path);
  // A directory for such files: made, with those above it, where it is missing; taken away again when the run fails.
  void make_directory(const std::string& path) { output_set_->make_directory(path); }
  // A line on standard error, unless quiet.
  void warn(const std::string& message);
  // The same as an error, which does not end the run.
  void complain(const std::string& message) { fail(0, message); }
  Progress progress();
  // Says at the end that a threshold was not met: outputs are kept, the code is 10.
  void threshold_missed(const std::string& message) { missed_ = message; }

 private:
  int fail(int code, const std::string& message);
  void silence_codecs();
  void note_input(const std::string& path);
  void finish(const Json& stats, double seconds);

  ToolText text_;
  CLI::App app_;
  bool quiet_ = false, verbose_ = false;
  int threads_ = 0;
  std::int64_t max_texels_ = kDefaultTexelLimit;
  std::string report_, depfile_;
  FileRef report_file_, depfile_file_;
  std::FILE* messages_ = stderr;  // where this tool's own lines go
  std::string command_;
  std::vector<std::string> arguments_;
  std::vector<std::string> inputs_, outputs_;
  std::optional<OutputSet> output_set_;
  std::optional<ScratchFile> standard_input_;
  std::optional<ProgressBar> bar_;
  std::string missed_;
};

}  // namespace burnish::cli
