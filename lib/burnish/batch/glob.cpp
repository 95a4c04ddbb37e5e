#include "burnish/batch/glob.h"

#include <fnmatch.h>

#include <algorithm>
#include <filesystem>

#include "burnish/core/error.h"

namespace burnish {
namespace fs = std::filesystem;
namespace {

// The part up to the next '/', and what is behind it.
std::pair<std::string_view, std::string_view> parted(std::string_view path) {
  const std::size_t slash = path.find('/');
  return slash == path.npos ? std::pair(path, std::string_view())
                            : std::pair(path.substr(0, slash), path.substr(slash + 1));
}

}  // namespace

bool fits_glob(std::string_view path, std::string_view pattern) {
  while (!pattern.empty()) {
    const auto [part, further] = parted(pattern);
    if (part == "**") {
      for (std::string_view rest = path; !rest.empty(); rest = parted(rest).second) {
        if (rest.front() == '.') return fits_glob(rest, further);
        if (further.empty() ? rest.find('/') == rest.npos : fits_glob(rest, further)) return true;
      }
      return false;
    }
    const auto [name, rest] = parted(path);
    if (fnmatch(std::string(part).c_str(), std::string(name).c_str(), FNM_PERIOD) != 0) return false;
    pattern = further, path = rest;
  }
  return path.empty();
}

bool fits_any(std::string_view path, const std::vector<std::string>& patterns) {
  return std::ranges::any_of(patterns, [&](const std::string& p) { return fits_glob(path, p); });
}

std::vector<std::string> files_below(const std::string& directory, const std::string& without) {
  std::vector<std::string> files;
  std::error_code error;
  fs::recursive_directory_iterator at(directory, error);
  for (; !error && at != fs::recursive_directory_iterator(); at.increment(error)) {
    if (at->is_directory() && !at->is_symlink()) {
      if (fs::canonical(at->path()) == without) at.disable_recursion_pending();
    } else if (at->is_regular_file()) {
      files.push_back(at->path().lexically_relative(directory).generic_string());
    }
  }
  if (error) throw file_error(ErrorKind::kIo, directory, "cannot be read: " + error.message());
  std::ranges::sort(files);
  return files;
}

}  // namespace burnish
