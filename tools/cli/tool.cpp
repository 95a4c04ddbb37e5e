#include "cli/tool.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iostream>
#include <limits>

#include "burnish/core/error.h"
#include "burnish/core/parallel.h"
#include "burnish/core/shell_quoted.h"
#include "burnish/core/whole_file.h"
#include "cli/argument_files.h"
#include "cli/depfile.h"
#include "cli/exit_code.h"
#include "cli/manual.h"
#include "cli/options.h"
#include "cli/sudden_end.h"
#include "cli/version.h"

namespace burnish::cli {
namespace {

// On standard output; the exit code.
int print(const std::string& text) { return std::cout << text << std::flush ? kOk : kIo; }

std::string one_line(std::string text) {
  std::ranges::replace(text, '\n', ' ');
  return text;
}

// The library calls what it was asked for by its name, "levels: expected …": shown as the option that it is here.
std::string as_option(const CLI::App& app, const std::string& message) {
  const std::size_t colon = message.find(':');
  if (colon == std::string::npos || !app.get_option_no_throw("--" + message.substr(0, colon))) return message;
  return "--" + message;
}

// What CLI11 says; of a number that is none, in the words of our own errors.
std::string parse_message(const CLI::ParseError& error) {
  const std::string said = error.what(), start = "Could not convert: ", between = " = ";
  const std::size_t value = said.find(between);
  if (!said.starts_with(start) || value == std::string::npos) return said;
  return said.substr(start.size(), value - start.size()) + ": expected a number, got '" +
         said.substr(value + between.size()) + "'";
}

void spool_standard_input(const std::string& path) {
  const auto fail = [](const std::string& what) {
    throw file_error(ErrorKind::kIo, kStandardInput, what + ": " + std::strerror(errno));
  };
  const std::string cannot_be_kept = "cannot be kept in a temporary file";
  std::ofstream out(path, std::ios::binary);
  std::vector<char> buffer(1 << 20);
  for (ssize_t n; (n = ::read(STDIN_FILENO, buffer.data(), buffer.size())) != 0;) {
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail("cannot be read");
    if (!out.write(buffer.data(), n)) fail(cannot_be_kept);
  }
  if (!out.flush()) fail(cannot_be_kept);
}

}  // namespace

Tool::Tool(const ToolText& text, std::string (*libraries)()) : text_(text), app_(text.summary, text.name) {
  app_.footer("Example:\n" + text.example +
              "\n\nExit codes: 0 ok, 1 usage, 2 file cannot be read or written, 3 input is malformed or does not fit,\n"
              "4 internal, 5 not supported, 10 a check or threshold was not met.");
  app_.set_help_flag("-h,--help", "Print this help and exit");
  app_.set_version_flag("--version", [libraries] {
    return std::string("burnish " BURNISH_VERSION " (" BURNISH_GIT_DESCRIBE "), " BURNISH_COMPILER ", ") + libraries() +
           thread_library() + ", CLI11 " CLI11_VERSION;
  });
  app_.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::Throw);
  app_.add_flag("-q,--quiet", quiet_, "Nothing on standard error but errors")->group("Common");
  app_.add_flag("-v,--verbose", verbose_, "Adds the full command line to an error, and what the codecs say")
      ->group("Common");
  app_.add_option("-j,--threads", threads_, "Threads; 0 uses all. The output never depends on it")
      ->check(in_range(0, 4096))
      ->type_name("N")
      ->group("Common");
  if (libraries != no_libraries)  // images are read
    app_.add_option("--max-texels", max_texels_,
                    "Refuse inputs that say they have more texels; default 1073741824, 32768x32768")
        ->check(in_range(std::int64_t(1), std::numeric_limits<std::int64_t>::max()))
        ->type_name("N")
        ->group("Common");
  app_.add_option("--report", report_, "Write what was done and measured as JSON; '-' is standard output")
      ->type_name("FILE")
      ->group("Common");
  app_.add_option("--depfile", depfile_, "Write what was read, in the syntax of Make")
      ->type_name("FILE")
      ->group("Common");
  app_.add_option_function<std::string>(
          kArgumentsFrom,
          [](const std::string&) {  // whose own are in its place by now
            throw CLI::ValidationError(kArgumentsFrom, "expected arguments in such a file, got the option itself");
          },
          "Read more arguments, quoted as for a shell, from FILE: more than a command line holds")
      ->type_name("FILE")
      ->group("Common");
}

// Codecs print what they make of a damaged file, libpng with no way to stop it. While a tool works, standard error
// leads nowhere and the tool's own lines go to a copy of it.
void Tool::silence_codecs() {
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // sanitizers report there
  const int copy = ::fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 3);
  std::FILE* messages = copy < 0 ? nullptr : ::fdopen(copy, "w");
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (messages && nowhere >= 0 && ::dup2(nowhere, STDERR_FILENO) >= 0) {
    std::setvbuf(messages, nullptr, _IONBF, 0);
    messages_ = messages;
  }
  if (nowhere >= 0) ::close(nowhere);
#endif
}

int Tool::fail(int code, const std::string& message) {
  if (bar_) bar_->clear();
  std::string text = text_.name + ": error: " + one_line(message) + "\n";
  if (verbose_) text += text_.name + ": command: " + command_ + "\n";
  std::fputs(text.c_str(), messages_);
  return code;
}

void Tool::note_input(const std::string& path) {
  if (std::ranges::find(inputs_, path) == inputs_.end()) inputs_.push_back(path);
  if (path != "-") output_set_->protect(path);
}

FileRef Tool::read(const std::string& path) {
  note_input(path);
  if (path != "-") return path;
  if (standard_input_) throw file_error(ErrorKind::kUsage, kStandardInput, "is named as an input twice");
  standard_input_.emplace();
  spool_standard_input(standard_input_->path());
  return {standard_input_->path(), kStandardInput};
}

FileRef Tool::write(const std::string& path) {
  FileRef file = output_set_->add(path);
  outputs_.push_back(path);
  return file;
}

void Tool::warn(const std::string& message) {
  if (quiet_) return;
  if (bar_) bar_->clear();
  std::fputs((text_.name + ": warning: " + one_line(message) + "\n").c_str(), messages_);
}

Progress Tool::progress() {
  return [this](double fraction) { bar_->update(fraction); };
}

void Tool::finish(const Json& stats, double seconds) {
  const std::string first_output = outputs_.empty() ? "" : outputs_.front();
  if (!report_.empty()) {
    const Json report{{"tool", text_.name},  {"version", BURNISH_VERSION}, {"command", arguments_}, {"inputs", inputs_},
                      {"outputs", outputs_}, {"seconds", seconds},         {"stats", stats}};
    write_file(report_file_, report.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
  }
  if (!missed_.empty() && !depfile_.empty()) {
    output_set_->discard(depfile_file_);  // only success is done
  } else if (!depfile_.empty()) {
    std::vector<std::string> files = inputs_;
    std::erase(files, "-");
    write_file(depfile_file_, depfile_text(first_output, files));
  }
  output_set_->commit();
}

int Tool::run(int argc, char** argv, const std::function<Json()>& action) {
  arguments_.assign(argv, argv + argc);
  arguments_[0] = text_.name;
  try {
    arguments_ = with_arguments_of_files(arguments_);
  } catch (const Error& error) {
    return fail(exit_code(error.kind()), error.what());
  }
  for (const std::string& argument : arguments_) command_ += (command_.empty() ? "" : " ") + shell_quoted(argument);
  // For packages, and on no help page.
  if (arguments_.size() == 2 && arguments_[1] == "--man") return print(man_page(app_, text_, BURNISH_VERSION));
  if (arguments_.size() == 3 && arguments_[1] == "--completion") try {
      return print(completion(app_, arguments_[2]));
    } catch (const Error& error) {
      return fail(kUsage, error.what());
    }
  try {
    std::vector<const char*> words;
    for (const std::string& word : arguments_) words.push_back(word.c_str());
    words[0] = argv[0];
    app_.parse(int(words.size()), words.data());
  } catch (const CLI::Success& request) {  // --help, --version
    app_.exit(request, std::cout, std::cerr);
    return print("");
  } catch (const CLI::ParseError& error) {
    return fail(kUsage, parse_message(error) + " (" + text_.name + " --help explains)");
  }
  std::signal(SIGPIPE, SIG_IGN);  // a closed pipe is an error like any other
  try {
    if (!verbose_) silence_codecs();
    end_cleanly(text_.name, ::fileno(messages_));
    output_set_.emplace();
    bar_.emplace(messages_, text_.name, quiet_);
    // Reserved before any work, put into place after what they speak of.
    if (!report_.empty()) report_file_ = output_set_->add(report_, 1);
    if (!depfile_.empty()) depfile_file_ = output_set_->add(depfile_, 2);
    const ThreadLimit limit(threads_);
    set_texel_limit(max_texels_);
    const auto start = std::chrono::steady_clock::now();
    const Json stats = action();
    finish(stats, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    bar_->clear();
    output_set_.reset();
    if (!missed_.empty()) return fail(kThreshold, missed_);
    return kOk;
  } catch (const Error& error) {
    output_set_.reset();
    standard_input_.reset();
    return fail(exit_code(error.kind()), as_option(app_, error.what()));
  } catch (const CLI::ParseError& error) {
    output_set_.reset();
    return fail(kUsage, error.what());
  } catch (const std::exception& error) {
    output_set_.reset();
    return fail(kInternal, message_of(error));
  }
}

}  // namespace burnish::cli
