// What is to be done with a directory of files, as its user writes it in TOML: steps, each a tool and the files that it
// is run for.
//
//   [[step]]
//   name = "normals"
//   tool = "normals"                      burnish-normals
//   files = ["rocks/*.png", "**/*.tif"]   of the directory; ** is any number of folders, none too
//   output = "{dir}{stem}_n.png"          in the build directory
//   arguments = ["--wrap", "repeat"]
//
//     [[step.when]]                       more arguments for some of them
//     files = "rocks/*"
//     arguments = ["--height", "10cm"]
//
//   [[step]]
//   name = "palettes"
//   tool = "quantize"
//   from = "normals"                      what that step makes, instead of files
//   output = "{dir}{stem}.exr"
//
// In names and arguments {stem} is the file's name without its ending, {dir} its folder with a slash at the end, or
// nothing, {source} the file itself, {input} and {output} what the step reads and writes, and the name of another step
// what that made of the same file. Arguments that do not say {input} follow it; those that do not say {output} are
// followed by -o and it. A step with `together = true` runs once, for all: its {input} is every one of them, its {stem}
// its own name.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "burnish/core/file_ref.h"
#include "burnish/core/toml_file.h"

namespace burnish {

struct RecipeStep {
  std::string name;
  std::vector<std::string> tool;            // without "burnish-"; a verb follows it
  std::vector<std::string> files, exclude;  // globs
  std::string from;                         // instead of files
  bool together = false;
  std::vector<std::string> outputs;
  std::vector<std::string> arguments;
  struct When {
    std::vector<std::string> files;
    std::vector<std::string> arguments;
    TomlTable at;
  };
  std::vector<When> when;
  TomlTable at;  // for messages: where it stands
};

// kIo where it cannot be read; kMalformed, with line and key, for what is no recipe: unknown keys, names that are used
// twice or mean something else, a `from` or a name in braces without such a step, steps that wait for each other. Steps
// come behind those whose results they use.
std::vector<RecipeStep> read_recipe(const FileRef& file);

// The text with each {name} replaced by value(name).
std::string filled_in(const std::string& text, const std::function<std::string(const std::string& name)>& value);

}  // namespace burnish
