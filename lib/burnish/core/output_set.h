// Outputs that appear all together and whole, or not at all.
//
// Each is written to a temporary beside its target, so that the final rename stays within one file system, under a name
// that no build's `*.png` matches; commit() renames them in the order of their ranks, then in that they were added.
// Destroyed without a commit, the set removes what it wrote and every old file is as it was.
#pragma once

#include <string>
#include <vector>

#include "burnish/core/image_io.h"

namespace burnish {

class OutputSet {
 public:
  OutputSet() = default;
  ~OutputSet();
  OutputSet(const OutputSet&) = delete;
  OutputSet& operator=(const OutputSet&) = delete;

  // Registers a file that is read, so that no output may take its place. kUsage where one already would.
  void protect(const std::string& input);
  // Reserves a temporary for the target. "-" is standard output; that, devices and pipes are copied to by commit(). Of
  // a symbolic link the file it leads to is the target. kIo where the directory is missing or not writable or the
  // target is a directory; kUsage where it is an input or is written twice.
  FileRef add(const std::string& name, int rank = 0);
  // Makes a directory for outputs, and those above it, where they are missing. kIo where that cannot be. What was made
  // goes again, empty, unless commit() follows.
  void make_directory(const std::string& name);
  // Takes one back.
  void discard(const FileRef& file);
  // Copies what goes to streams, then renames the others into place. kIo on failure.
  void commit();
  bool empty() const { return outputs_.empty(); }

  // Removes the temporaries and new directories of every live set; callable from a signal handler.
  static void remove_all_temporaries() noexcept;

 private:
  enum class Kind { kFile, kStdout, kDevice };
  struct Output {
    FileRef file;
    std::string target;  // where a file goes: its name, or where that leads
    int slot, rank;
    Kind kind;
  };
  struct Directory {
    std::string path;
    int slot;
  };
  FileRef add_stream(Kind kind, const std::string& name, int rank);

  std::vector<Output> outputs_;
  std::vector<Directory> directories_;  // made here, parents first
  std::vector<std::string> inputs_;
};

// A new empty file in the directory for temporary files, removed like the temporaries of outputs; used to hold standard
// input.
class ScratchFile {
 public:
  ScratchFile();
  ~ScratchFile();
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
  int slot_;
};

}  // namespace burnish
