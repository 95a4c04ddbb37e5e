// Arguments out of files, where there are more than a command line holds.
#pragma once

#include <string>
#include <vector>

namespace burnish::cli {

constexpr const char* kArgumentsFrom = "--arguments-from";

// The arguments with those of each --arguments-from FILE in its place. kIo where a file cannot be read; kMalformed
// where it is no text, or leaves a quote open.
std::vector<std::string> with_arguments_of_files(const std::vector<std::string>& words);

}  // namespace burnish::cli
