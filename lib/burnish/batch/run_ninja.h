// Runs Ninja and tells what became of the jobs.
#pragma once

#include <string>
#include <vector>

#include "burnish/core/progress.h"

namespace burnish {

struct NinjaOptions {
  std::string build;        // the directory it works in
  std::string file;         // its file, relative to that
  int jobs = 0;             // at once; 0: one a core
  bool keep_going = false;  // after a failure
};

struct FailedJob {
  std::string outputs;  // as Ninja names them
  std::string message;  // what it said, in one line
};

struct NinjaResult {
  std::size_t finished = 0;  // jobs that ran, failed ones too
  std::vector<FailedJob> failed;
};

// kIo where there is no Ninja; kInternal, with what it says, where it refuses the file. Ninja is stopped when this
// process ends, however that happens.
NinjaResult run_ninja(const NinjaOptions& options, const Progress& progress = {});

// The commands that would run now.
std::vector<std::string> commands_to_run(const NinjaOptions& options);

}  // namespace burnish
