// A recipe over a directory, run by Ninja: what is out of date, many jobs at once.
//
// Ninja's file and log stay in the build directory, so that the next run knows what is done: after a kill too, since
// a job counts only when its tool has said so, and tools put their files into place whole.
#pragma once

#include "burnish/batch/jobs.h"
#include "burnish/batch/run_ninja.h"

namespace burnish {

struct BatchOptions {
  FileRef recipe;
  BatchFolders folders;
  std::string tools;     // the folder that they are in
  std::string launcher;  // in front of every command
  Shard shard;           // each has a log of its own
  int jobs = 0;          // at once; 0: one a core
  bool keep_going = false;
};

struct BatchResult {
  std::size_t jobs = 0;
  NinjaResult ran;
};

// Makes the build directory where it is missing. Errors of read_recipe(), plan_jobs(), ninja_text() and run_ninja();
// kIo where the build directory cannot be written.
BatchResult run_batch(const BatchOptions& options, const Progress& progress = {});

// What would run now, as commands for a shell and the jobs they are of. Changes nothing.
struct DueJob {
  Job job;
  std::string command;
};
std::vector<DueJob> due_jobs(const BatchOptions& options);

}  // namespace burnish
