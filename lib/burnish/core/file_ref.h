// A file to read or to write, and the name it goes by in messages.
#pragma once

#include <string>
#include <utility>

namespace burnish {

// A file as it is opened, and as people know it (kStandardInput and kStandardOutput too).
struct FileRef {
  std::string path, name;
  FileRef() = default;
  FileRef(std::string p) : path(p), name(std::move(p)) {}
  FileRef(const char* p) : path(p), name(p) {}
  FileRef(std::string p, std::string n) : path(std::move(p)), name(std::move(n)) {}
  bool empty() const { return path.empty(); }
};

// kIo, with the reason, where the file is missing, a directory or not to be read.
void require_readable(const FileRef& file);

}  // namespace burnish
