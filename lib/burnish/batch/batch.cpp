#include "burnish/batch/batch.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <unordered_map>

#include "burnish/batch/ninja_file.h"
#include "burnish/core/error.h"
#include "burnish/core/output_set.h"
#include "burnish/core/whole_file.h"

namespace burnish {
namespace fs = std::filesystem;
namespace {

std::vector<Job> planned(const BatchOptions& o) {
  const std::vector<RecipeStep> steps = read_recipe(o.recipe);
  for (const RecipeStep& step : steps)
    if (const std::string tool = "burnish-" + step.tool[0]; !fs::exists(fs::path(o.tools) / tool))
      step.at.fail("tool", "there is no " + tool);
  return plan_jobs(steps, o.folders, o.shard);
}

// "build" or, of a shard, "build-2-of-4": Ninja's file, and where its log is.
std::string graph_name(Shard shard) {
  return shard.count == 1 ? "build" : "build-" + std::to_string(shard.index) + "-of-" + std::to_string(shard.count);
}

std::string graph_of(const BatchOptions& o, const std::vector<Job>& jobs) {
  return ninja_text(jobs, o.tools, o.launcher, o.shard.count == 1 ? "." : "." + graph_name(o.shard));
}

// One run at a time: another, and what one that was killed has left running, is waited for. Ninja and its jobs inherit
// the file, and with it the lock.
class Lock {
 public:
  explicit Lock(const std::string& path) : file_(::open(path.c_str(), O_RDWR | O_CREAT, 0666)) {
    if (file_ < 0) throw file_error(ErrorKind::kIo, path, std::string("cannot be written: ") + std::strerror(errno));
    while (::flock(file_, LOCK_EX) != 0 && errno == EINTR) {
    }
  }
  ~Lock() { ::close(file_); }
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;

 private:
  int file_;
};

}  // namespace

BatchResult run_batch(const BatchOptions& o, const Progress& progress) {
  const std::vector<Job> jobs = planned(o);
  const std::string text = graph_of(o, jobs), name = graph_name(o.shard) + ".ninja",
                    path = (fs::path(o.folders.build) / name).string();
  std::error_code error;
  fs::create_directories(o.folders.build, error);
  if (error) throw file_error(ErrorKind::kIo, o.folders.build, "cannot be made: " + error.message());
  const Lock lock((fs::path(o.folders.build) / ("." + graph_name(o.shard) + ".lock")).string());
  if (!fs::exists(path) || read_file(path) != text) write_file(path, text);
  return {jobs.size(), run_ninja({o.folders.build, name, o.jobs, o.keep_going}, progress)};
}

std::vector<DueJob> due_jobs(const BatchOptions& o) {
  const std::vector<Job> jobs = planned(o);
  std::unordered_map<std::string, const Job*> job_of;
  std::vector<std::string> commands;
  for (const Job& job : jobs) {
    commands.push_back(command_of(job, o.tools, o.launcher));
    job_of.emplace(commands.back(), &job);
  }
  if (fs::is_directory(o.folders.build)) {
    const ScratchFile file;
    write_file(file.path(), graph_of(o, jobs));
    commands = commands_to_run({o.folders.build, fs::absolute(file.path()).string(), 0, true});
  }
  std::vector<DueJob> due;
  for (const std::string& command : commands)
    if (const auto at = job_of.find(command); at != job_of.end()) due.push_back({*at->second, command});
  return due;
}

}  // namespace burnish
