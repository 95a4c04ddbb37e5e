// A recipe and a directory become jobs: one run of a tool each.
#pragma once

#include <string>
#include <vector>

#include "burnish/batch/recipe.h"

namespace burnish {

struct Job {
  std::string step;
  std::string source;                // the file it is for; empty where it is for all
  std::vector<std::string> command;  // "burnish-normals", its arguments
  std::vector<std::string> inputs;   // as in the command: relative to the build directory, or absolute
  std::vector<std::string> outputs;  // relative to the build directory
  std::string depfile;               // what else it read; empty where Ninja could not read its inputs' names there
};

// Of N shards, numbered from 0, one does the files whose place in their step's list leaves that remainder; what is for
// all, and what that needs, every one does.
struct Shard {
  int index = 0, count = 1;
};

struct BatchFolders {
  std::string directory;  // of the files
  std::string build;      // of the outputs
};

// In the order of the steps, then of the files. kMalformed, naming the recipe, line and key, for globs that fit no
// file, outputs that two jobs would write or that lie outside the build directory, and results of another step that a
// file has not.
std::vector<Job> plan_jobs(const std::vector<RecipeStep>& steps, const BatchFolders& folders, Shard shard = {});

}  // namespace burnish
