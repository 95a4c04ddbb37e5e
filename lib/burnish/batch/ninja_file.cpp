#include "burnish/batch/ninja_file.h"

#include "burnish/core/error.h"
#include "burnish/core/shell_quoted.h"

namespace burnish {
namespace {

void require_one_line(const std::string& text) {
  if (text.find_first_of("\n\r") != text.npos)
    throw Error(ErrorKind::kUnsupported,
                "a name or argument with a newline is not taken by Ninja: '" + excerpt(text) + "'");
}

std::string value(const std::string& text) {
  require_one_line(text);
  std::string out;
  for (const char c : text) out += c == '$' ? "$$" : std::string(1, c);
  return out;
}

std::string path(const std::string& text) {
  require_one_line(text);
  std::string out;
  for (const char c : text) out += (c == '$' || c == ' ' || c == ':' ? "$" : "") + std::string(1, c);
  return out;
}

}  // namespace

std::string shell_command(const std::vector<std::string>& words) {
  std::string all;
  for (const std::string& word : words) all += (all.empty() ? "" : " ") + shell_quoted(word);
  return all;
}

namespace {

// Longer than an argument may be on Linux (128 KiB), less what stands before: the tool reads them from a file then.
constexpr std::size_t kLongestCommand = 100000;

std::string command_line(std::vector<std::string> words, const std::string& tools, const std::string& launcher) {
  words[0] = tools + "/" + words[0];
  return (launcher.empty() ? "" : launcher + " ") + shell_command(words);
}

}  // namespace

std::string command_of(const Job& job, const std::string& tools, const std::string& launcher) {
  return command_line(job.command, tools, launcher);
}

std::string ninja_text(const std::vector<Job>& jobs, const std::string& tools, const std::string& launcher,
                       const std::string& log_directory) {
  std::string text = "ninja_required_version = 1.10\nbuilddir = " + value(log_directory) +
                     "\n"
                     "rule run\n"
                     "  command = $run\n"
                     "  description = $out\n";
  for (const Job& job : jobs) {
    text += "build";
    for (const std::string& output : job.outputs) text += " " + path(output);
    text += ": run |";
    for (const std::string& input : job.inputs) text += " " + path(input);
    text += " " + path(tools + "/" + job.command[0]) + "\n";
    const std::string command = command_of(job, tools, launcher);
    if (command.size() <= kLongestCommand) {
      text += "  run = " + value(command) + "\n";
    } else {
      const std::string file = job.outputs[0] + ".arguments";
      const std::vector<std::string> arguments(job.command.begin() + 1, job.command.end());
      text += "  run = " + value(command_line({job.command[0], "--arguments-from", file}, tools, launcher)) +
              "\n  rspfile = " + value(file) + "\n  rspfile_content = " + value(shell_command(arguments)) + "\n";
    }
    if (!job.depfile.empty()) text += "  deps = gcc\n  depfile = " + value(job.depfile) + "\n";
  }
  return text;
}

}  // namespace burnish
