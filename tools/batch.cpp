// burnish-batch: a recipe over a directory of files, run by Ninja.
#include "burnish/batch/batch.h"

#include <filesystem>
#include <iostream>

#include "burnish/core/error.h"
#include "burnish/core/number_text.h"
#include "burnish/core/parallel.h"
#include "burnish/core/wording.h"
#include "cli/tool.h"

using namespace burnish;
using namespace burnish::cli;

namespace {

struct Options {
  std::string recipe, shard;
  BatchOptions batch;
  bool dry_run = false;
};

Shard parse_shard(const std::string& text) {
  const std::size_t slash = text.find('/');
  const auto index = number_in<int>(text.substr(0, slash));
  const auto count = number_in<int>(slash == std::string::npos ? "" : text.substr(slash + 1));
  if (!index || !count || *index < 0 || *index >= *count)
    throw CLI::ValidationError("--shard", "expected one of N from 0, such as 0/4, got '" + text + "'");
  return {*index, *count};
}

void add_options(CLI::App& app, Options& o) {
  app.add_option("RECIPE", o.recipe, "Steps over the files of a directory, in TOML")->required();
  app.add_option("--directory", o.batch.folders.directory, "Where the files are (default: the recipe's folder)")
      ->type_name("DIR");
  app.add_option("--build-dir", o.batch.folders.build,
                 "Where what is made goes, and what Ninja knows of it (default build); made if missing")
      ->type_name("DIR");
  app.add_flag("--dry-run", o.dry_run, "Only print the commands that would run, as JSON");
  app.add_flag("--keep-going", o.batch.keep_going, "Run on after a failure, as far as that goes");
  app.add_option("--shard", o.shard, "Only the files of part I of N, numbered from 0, with a log of its own")
      ->type_name("I/N");
  app.add_option("--launcher", o.batch.launcher, "Put before every command, such as 'nice -n 19'")->type_name("CMD");
}

Json described(const Options& o, const std::vector<DueJob>& due) {
  Json list = Json::array();
  for (const DueJob& d : due)
    list.push_back({{"directory", std::filesystem::absolute(o.batch.folders.build).lexically_normal().string()},
                    {"file", d.job.source},
                    {"step", d.job.step},
                    {"command", d.command},
                    {"outputs", d.job.outputs}});
  return list;
}

Json run(Tool& tool, Options& o) {
  BatchOptions& b = o.batch;
  if (!o.shard.empty()) b.shard = parse_shard(o.shard);
  b.recipe = tool.read(o.recipe);
  if (b.folders.directory.empty()) b.folders.directory = std::filesystem::path(o.recipe).parent_path().string();
  if (b.folders.directory.empty()) b.folders.directory = ".";
  b.tools = std::filesystem::read_symlink("/proc/self/exe").parent_path().string();
  b.jobs = thread_limit();
  if (o.dry_run) {
    const std::vector<DueJob> due = due_jobs(b);
    std::cout << described(o, due).dump(2, ' ', false, Json::error_handler_t::replace) << std::endl;
    return {{"jobs", due.size()}, {"ran", 0}, {"failed", Json::array()}};
  }
  const BatchResult result = run_batch(b, tool.progress());
  Json failed = Json::array();
  for (const FailedJob& f : result.ran.failed) {
    tool.complain(f.outputs + ": " + f.message);
    failed.push_back({{"outputs", f.outputs}, {"message", f.message}});
  }
  if (!failed.empty())
    tool.threshold_missed(std::to_string(failed.size()) + " of " + counted(result.jobs, "job") + " failed" +
                          (b.keep_going ? "" : "; --keep-going runs the others too"));
  return {{"jobs", result.jobs}, {"ran", result.ran.finished}, {"failed", failed}};
}

}  // namespace

int main(int argc, char** argv) {
  Tool tool({"burnish-batch", "A recipe over a directory of files: what is out of date is made, many files at once.",
             "  burnish-batch textures.toml --directory textures --build-dir baked\n"
             "  burnish-batch textures.toml --build-dir baked --keep-going -j 8 --report batch.json\n"
             "  burnish-batch textures.toml --build-dir baked --shard $SLURM_ARRAY_TASK_ID/4"},
            no_libraries);
  Options options;
  options.batch.folders.build = "build";
  add_options(tool.app(), options);
  return tool.run(argc, argv, [&] { return run(tool, options); });
}
