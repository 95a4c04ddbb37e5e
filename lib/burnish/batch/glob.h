// Files of a directory by patterns: '*' and '?' stand for characters but '/', [a-z] for one of them, '**' as a whole
// part for any number of folders, none too. Names that begin with a dot are found by patterns that do.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace burnish {

// Whether a path, whose parts are parted by '/', fits.
bool fits_glob(std::string_view path, std::string_view pattern);
bool fits_any(std::string_view path, const std::vector<std::string>& patterns);

// All files below a directory, relative to it, in ascending order; not those below `without`, a canonical path. Links
// to folders are not followed. kIo where it cannot be read.
std::vector<std::string> files_below(const std::string& directory, const std::string& without);

}  // namespace burnish
