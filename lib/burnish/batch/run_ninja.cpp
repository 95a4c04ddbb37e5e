#include "burnish/batch/run_ninja.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <functional>
#include <optional>
#include <string_view>

#include "burnish/core/error.h"

namespace burnish {
namespace {

constexpr int kNotFound = 127;

// Starts Ninja and hands each line of its output to `take`; its exit code.
int for_each_line(const std::vector<std::string>& arguments, const std::function<void(const std::string&)>& take) {
  std::vector<char*> argv;
  for (const std::string& a : arguments) argv.push_back(const_cast<char*>(a.c_str()));
  argv.push_back(nullptr);
  int pipe[2];
  if (::pipe2(pipe, O_CLOEXEC) != 0) throw Error(ErrorKind::kIo, std::string("no pipe: ") + std::strerror(errno));
  const pid_t parent = ::getpid(), child = ::fork();
  if (child < 0) throw Error(ErrorKind::kIo, std::string("no process: ") + std::strerror(errno));
  if (child == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (::getppid() != parent) ::_exit(1);  // it has ended already
    std::signal(SIGPIPE, SIG_DFL);
    ::setenv("NINJA_STATUS", "[%f/%t] ", 1);
    ::dup2(pipe[1], STDOUT_FILENO);
    ::dup2(pipe[1], STDERR_FILENO);
    ::execvp(argv[0], argv.data());
    ::_exit(kNotFound);
  }
  ::close(pipe[1]);
  std::FILE* lines = ::fdopen(pipe[0], "r");
  char* line = nullptr;
  std::size_t size = 0;
  for (ssize_t n; (n = ::getline(&line, &size, lines)) >= 0;) {
    if (n > 0 && line[n - 1] == '\n') n--;
    take(std::string(line, std::size_t(n)));
  }
  std::free(line);
  std::fclose(lines);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFSIGNALED(status))
    throw Error(ErrorKind::kInternal, std::string("Ninja was ended: ") + ::strsignal(WTERMSIG(status)));
  if (WEXITSTATUS(status) == kNotFound)
    throw Error(ErrorKind::kIo, "there is no ninja to run: install it (Debian: ninja-build)");
  return WEXITSTATUS(status);
}

std::vector<std::string> command_line(const NinjaOptions& o) {
  std::vector<std::string> words{"ninja", "-C", o.build, "-f", o.file, "-k", o.keep_going ? "0" : "1"};
  if (o.jobs > 0) words.insert(words.end(), {"-j", std::to_string(o.jobs)});
  return words;
}

// "[3/20] rest"
struct Status {
  std::size_t finished, total;
  std::string rest;
};
std::optional<Status> status_in(const std::string& line) {
  Status s{};
  if (!line.starts_with('[')) return {};
  const char *at = line.data() + 1, *const end = line.data() + line.size();
  const auto number = [&](std::size_t& n, std::string_view behind) {
    const auto [next, error] = std::from_chars(at, end, n);
    at = next;
    if (error != std::errc() || !std::string_view(at, std::size_t(end - at)).starts_with(behind)) return false;
    at += behind.size();
    return true;
  };
  if (!number(s.finished, "/") || !number(s.total, "] ")) return {};
  s.rest.assign(at, end);
  return s;
}

constexpr std::string_view kFailed = "FAILED: ", kNinjaError = "ninja: error: ", kFromNinja = "ninja: ";

}  // namespace

NinjaResult run_ninja(const NinjaOptions& options, const Progress& progress) {
  NinjaResult result;
  std::string refused;
  enum { kElsewhere, kCommand, kOutput } at = kElsewhere;  // in the lines about a failed job
  const int code = for_each_line(command_line(options), [&](const std::string& line) {
    if (const std::optional<Status> status = status_in(line)) {
      result.finished = status->finished;
      report_progress(progress, status->total ? double(status->finished) / double(status->total) : 1);
      at = kElsewhere;
    } else if (line.starts_with(kFailed)) {
      const std::size_t last = line.find_last_not_of(' ');
      result.failed.push_back({line.substr(kFailed.size(), last + 1 - kFailed.size()), ""});
      at = kCommand;
    } else if (line.starts_with(kFromNinja)) {
      if (line.starts_with(kNinjaError)) refused = line.substr(kNinjaError.size());
      at = kElsewhere;
    } else if (at == kCommand) {
      at = kOutput;
    } else if (at == kOutput) {
      std::string& message = result.failed.back().message;
      message += (message.empty() ? "" : " ") + line;
    }
  });
  if (code != 0 && result.failed.empty())
    throw Error(ErrorKind::kInternal,
                "Ninja says: " + (refused.empty() ? "exit code " + std::to_string(code) : refused));
  return result;
}

std::vector<std::string> commands_to_run(const NinjaOptions& options) {
  std::vector<std::string> words = command_line(options), commands;
  words.insert(words.end(), {"-n", "-v"});
  std::string refused;
  const int code = for_each_line(words, [&](const std::string& line) {
    if (const std::optional<Status> status = status_in(line)) commands.push_back(status->rest);
    else if (line.starts_with(kNinjaError)) refused = line.substr(kNinjaError.size());
  });
  if (code != 0) throw Error(ErrorKind::kInternal, "Ninja says: " + refused);
  return commands;
}

}  // namespace burnish
