// Dependency files in the syntax of Make, as Ninja and CMake read it too.
#pragma once

#include <string>
#include <vector>

namespace burnish::cli {

// "target: first second", with spaces, '#', '$' and '\' before them escaped, and a newline at the end.
std::string depfile_text(const std::string& target, const std::vector<std::string>& inputs);

}  // namespace burnish::cli
