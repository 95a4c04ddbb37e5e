#include "burnish/batch/jobs.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <unordered_map>

#include "burnish/batch/glob.h"
#include "burnish/core/error.h"

namespace burnish {
namespace fs = std::filesystem;
namespace {

// What a step reads for one run of its tool.
struct Item {
  std::string source;  // relative to the directory; empty: all
  std::string stem, dir;
  std::size_t place = 0;
  std::vector<std::string> inputs;  // from the build directory; what the command names
  std::vector<std::string> needed;  // the same with what goes with them
};

struct Result {
  Item item;
  std::vector<std::string> outputs;
};

bool begins_an_output_option(const std::string& argument) {
  return argument.starts_with("-o") || argument.starts_with("--output");
}

// Ninja ends a name in a depfile at a quote and some others, and would take what is before it for a file.
bool ninja_finds_in_depfiles(const std::string& path) { return path.find_first_of("'\"`:;*&|<>^") == path.npos; }

class Plan {
 public:
  explicit Plan(const BatchFolders& folders)
      : directory_(folders.directory),
        build_(fs::weakly_canonical(fs::absolute(folders.build))),
        from_build_(fs::canonical(folders.directory).lexically_relative(build_)),
        files_(files_below(folders.directory, build_.string())) {}

  void add(const RecipeStep& step) {
    std::vector<Result>& results = results_[step.name];
    for (Item& item : items(step)) {
      Job job = job_of(step, item);
      for (const std::string& output : job.outputs) claim(step, output, item);
      results.push_back({std::move(item), job.outputs});
      jobs_.push_back(std::move(job));
      places_.push_back(step.together ? kAll : results.back().item.place);
    }
  }

  std::vector<Job> shard(Shard shard) const {
    std::unordered_map<std::string, std::size_t> maker;
    for (std::size_t i = 0; i < jobs_.size(); i++)
      for (const std::string& output : jobs_[i].outputs) maker.emplace(output, i);
    std::vector<char> chosen(jobs_.size());
    for (std::size_t i = jobs_.size(); i-- > 0;) {  // inputs are made by jobs further to the front
      if (places_[i] == kAll || int(places_[i] % std::size_t(shard.count)) == shard.index) chosen[i] = true;
      if (!chosen[i]) continue;
      for (const std::string& input : jobs_[i].inputs)
        if (const auto at = maker.find(input); at != maker.end()) chosen[at->second] = true;
    }
    std::vector<Job> jobs;
    for (std::size_t i = 0; i < jobs_.size(); i++)
      if (chosen[i]) jobs.push_back(jobs_[i]);
    return jobs;
  }

 private:
  static constexpr std::size_t kAll = std::size_t(-1);

  std::vector<Item> items(const RecipeStep& step) const {
    std::vector<Item> items = step.from.empty() ? items_of_files(step) : items_of_step(step);
    for (const RecipeStep::When& when : step.when)
      if (std::ranges::none_of(items, [&](const Item& item) { return fits_any(item.source, when.files); }))
        when.at.fail("files", "fits none of the files of step '" + step.name + "'");
    if (!step.together) return items;
    if (!step.when.empty()) step.when[0].at.fail("files", "goes with steps that run for each file");
    Item all{"", step.name, "", 0, {}, {}};
    for (const Item& item : items) {
      all.inputs.insert(all.inputs.end(), item.inputs.begin(), item.inputs.end());
      all.needed.insert(all.needed.end(), item.needed.begin(), item.needed.end());
    }
    return {all};
  }

  std::vector<Item> items_of_files(const RecipeStep& step) const {
    for (const std::string& pattern : step.files)
      if (std::ranges::none_of(files_, [&](const std::string& f) { return fits_glob(f, pattern); }))
        step.at.fail("files", "no file of '" + directory_ + "' fits '" + pattern + "'");
    std::vector<Item> items;
    for (const std::string& file : files_) {
      if (!fits_any(file, step.files) || fits_any(file, step.exclude)) continue;
      const fs::path path(file);
      const std::string folder = path.parent_path().generic_string(), input = (from_build_ / path).string();
      items.push_back({file, path.stem().string(), folder.empty() ? "" : folder + "/", items.size(), {input}, {input}});
    }
    if (items.empty()) step.at.fail("exclude", "no file is left");
    return items;
  }

  std::vector<Item> items_of_step(const RecipeStep& step) const {
    std::vector<Item> items;
    for (const Result& r : results_.at(step.from)) {
      items.push_back(r.item);
      items.back().inputs = {r.outputs[0]};
      items.back().needed = r.outputs;
    }
    return items;
  }

  Job job_of(const RecipeStep& step, const Item& item) const {
    Job job{step.name, item.source, {"burnish-" + step.tool[0]}, item.needed, {}, ""};
    job.command.insert(job.command.end(), step.tool.begin() + 1, step.tool.end());
    for (const std::string& name : step.outputs)
      job.outputs.push_back(fs::path(named(step, item, name)).lexically_normal().string());

    std::vector<std::string> arguments = step.arguments;
    for (const RecipeStep::When& when : step.when)
      if (fits_any(item.source, when.files))
        arguments.insert(arguments.end(), when.arguments.begin(), when.arguments.end());
    const auto mentions = [&](const char* what) {
      return std::ranges::any_of(arguments, [&](const std::string& a) { return a.find(what) != a.npos; });
    };
    if (!mentions("{input}")) arguments.insert(arguments.begin(), "{input}");
    if (!mentions("{output}") && std::ranges::none_of(arguments, begins_an_output_option)) {
      if (job.outputs.size() > 1) step.at.fail("output", "several outputs need arguments that name them");
      arguments.insert(arguments.end(), {"-o", "{output}"});
    }
    for (const std::string& a : arguments) {
      if (a == "{input}") job.command.insert(job.command.end(), item.inputs.begin(), item.inputs.end());
      else job.command.push_back(argument(step, item, a, job));
    }
    const auto says = [&](const char* option) { return std::ranges::find(arguments, option) != arguments.end(); };
    if (says("--depfile")) step.at.fail("arguments", "--depfile is added to every command");
    if (!says("-j") && !says("--threads")) job.command.insert(job.command.end(), {"-j", "1"});  // many run at once
    job.command.push_back("--quiet");
    if (!std::ranges::all_of(job.inputs, ninja_finds_in_depfiles)) return job;
    job.depfile = job.outputs[0] + ".d";
    job.command.insert(job.command.end(), {"--depfile", job.depfile});
    return job;
  }

  // The name of an output.
  std::string named(const RecipeStep& step, const Item& item, const std::string& text) const {
    return filled_in(text, [&](const std::string& name) -> std::string {
      if (name == "stem") return item.stem;
      if (name == "dir") return item.dir;
      step.at.fail("output", "expected {stem} or {dir}, got {" + name + "}");
    });
  }

  std::string argument(const RecipeStep& step, const Item& item, const std::string& text, Job& job) const {
    return filled_in(text, [&](const std::string& name) -> std::string {
      if (name == "stem") return item.stem;
      if (name == "dir") return item.dir;
      if (name == "output") return job.outputs[0];
      if (name == "input" && item.inputs.size() == 1) return item.inputs[0];
      if (name == "source" && !item.source.empty()) return (from_build_ / item.source).string();
      if (name == "input" || name == "source")
        step.at.fail("arguments", "{" + name + "} is not one file in a step for all" +
                                      (name == "input" ? "; by itself it stands for all" : ""));
      const Result& made = result(step, item, name);
      job.inputs.insert(job.inputs.end(), made.outputs.begin(), made.outputs.end());
      return made.outputs[0];
    });
  }

  // What another step made of the same file, or of all.
  const Result& result(const RecipeStep& step, const Item& item, const std::string& name) const {
    const std::vector<Result>& results = results_.at(name);
    if (results[0].item.source.empty()) return results[0];
    const auto same = std::ranges::lower_bound(results, item.source, {}, [](const Result& r) { return r.item.source; });
    if (same == results.end() || same->item.source != item.source)
      step.at.fail("arguments", "step '" + name + "' makes nothing of " +
                                    (item.source.empty() ? "all files" : "'" + item.source + "'"));
    return *same;
  }

  void claim(const RecipeStep& step, const std::string& output, const Item& item) {
    const auto of = [&](const std::string& s, const std::string& source) {
      return "step '" + s + "'" + (source.empty() ? "" : " for '" + source + "'");
    };
    const fs::path path(output);
    if (path.is_absolute() || output.starts_with("..") || path.filename().empty() || path.filename() == ".")
      step.at.fail("output", "expected a file in the build directory, got '" + output + "'");
    const fs::path inside = (build_ / path).lexically_relative(fs::canonical(directory_));
    if (std::ranges::binary_search(files_, inside.generic_string()))
      step.at.fail("output", "'" + output + "' is one of the files that are read");
    const auto [other, is_new] = written_.emplace(output, of(step.name, item.source));
    if (!is_new)
      step.at.fail("output",
                   "'" + output + "' is written by " + other->second + " and by " + of(step.name, item.source));
  }

  std::string directory_;
  fs::path build_, from_build_;
  std::vector<std::string> files_;
  std::map<std::string, std::vector<Result>> results_;
  std::unordered_map<std::string, std::string> written_;  // by whom
  std::vector<Job> jobs_;
  std::vector<std::size_t> places_;
};

}  // namespace

std::vector<Job> plan_jobs(const std::vector<RecipeStep>& steps, const BatchFolders& folders, Shard shard) {
  if (!fs::is_directory(folders.directory))
    throw file_error(ErrorKind::kIo, folders.directory, "is not a directory that can be read");
  Plan plan(folders);
  for (const RecipeStep& step : steps) plan.add(step);
  return plan.shard(shard);
}

}  // namespace burnish
