// Jobs as a file that Ninja runs.
//
// Each job is an edge whose depfile Ninja keeps in its own log. A job runs again when what it reads, its command or the
// tool itself has changed.
#pragma once

#include <string>
#include <vector>

#include "burnish/batch/jobs.h"

namespace burnish {

// The words of a command as a shell takes them.
std::string shell_command(const std::vector<std::string>& words);

// What Ninja runs for a job: `launcher` in front, and the tool by its path.
std::string command_of(const Job& job, const std::string& tools, const std::string& launcher);

// `tools`: the folder of the tools. `launcher`: put before every command as it stands, may be empty. `log_directory`:
// where Ninja keeps its log, relative to the build directory. kUnsupported for names with a newline.
std::string ninja_text(const std::vector<Job>& jobs, const std::string& tools, const std::string& launcher,
                       const std::string& log_directory);

}  // namespace burnish
