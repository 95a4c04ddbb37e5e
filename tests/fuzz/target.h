// A fuzz target: bytes of a file, and the function of the library that reads such files.
//
// A file of this folder defines one. Under libFuzzer it is a program of its own; burnish-fuzz-replay has all of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "burnish/core/file_ref.h"

namespace burnish::fuzz {

// A file in memory, which readers open by a path.
class MemoryFile {
 public:
  explicit MemoryFile(const std::string& name);  // how messages call it
  ~MemoryFile();
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  void hold(std::span<const std::uint8_t> bytes);  // in place of what it held
  const FileRef& ref() const { return ref_; }

 private:
  int descriptor_;
  FileRef ref_;
};

class Target {
 public:
  // Made before main() begins. `file_name`: what the file is called, where the reader goes by that.
  Target(const char* name, const char* file_name, void (*read)(const FileRef& file));

  // All there are.
  static std::vector<const Target*>& all();
  const char* name() const { return name_; }
  // Ends the program for whatever but a proper burnish::Error: one line, and no fault of ours.
  void run(std::span<const std::uint8_t> bytes) const;

 private:
  const char* name_;
  const char* file_name_;
  void (*read_)(const FileRef& file);
};

}  // namespace burnish::fuzz
