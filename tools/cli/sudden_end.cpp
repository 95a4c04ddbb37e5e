#include "cli/sudden_end.h"

#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstring>
#include <new>
#include <system_error>

#include "burnish/core/output_set.h"
#include "cli/exit_code.h"

namespace burnish::cli {
namespace {

char g_start[64] = "";  // "burnish-normals: error: "
int g_messages = STDERR_FILENO;

// In one piece, by what a signal handler may call and without memory of its own.
void say(const char* message) {
  char line[512] = "";
  for (const char* part : {static_cast<const char*>(g_start), message})
    std::strncat(line, part, sizeof line - std::strlen(line) - 2);
  std::strcat(line, "\n");
  if (::write(g_messages, line, std::strlen(line)) < 0) return;  // nobody is left to tell
}

void die_of(int signal) {
  OutputSet::remove_all_temporaries();
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

extern "C" void end_by_request(int signal) { die_of(signal); }

extern "C" void end_by_fault(int signal) {
  say(signal == SIGBUS ? "an input became shorter while it was read, or memory is damaged (SIGBUS)"
                       : "a fault of the tool, or no memory is left (a signal)");
  die_of(signal);
}

[[noreturn]] void end_by_exception() {
  static std::atomic_flag ending;
  while (ending.test_and_set()) ::pause();  // another thread is at it
  OutputSet::remove_all_temporaries();
  try {
    if (std::current_exception()) std::rethrow_exception(std::current_exception());
    say("a fault of the tool");
  } catch (const std::exception& error) {
    say(message_of(error));
  } catch (...) {
    say("a fault of the tool");
  }
  ::_exit(kInternal);
}

}  // namespace

const char* message_of(const std::exception& error) {
  if (dynamic_cast<const std::bad_alloc*>(&error)) return "out of memory";
  const auto* system = dynamic_cast<const std::system_error*>(&error);
  if (system && system->code() == std::errc::resource_unavailable_try_again) return "out of memory, or of threads";
  return error.what();
}

void end_cleanly(const std::string& tool, int messages) {
  std::strncpy(g_start, (tool + ": error: ").c_str(), sizeof g_start - 1);
  g_messages = messages;
  for (const int s : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGXCPU, SIGXFSZ})
    if (std::signal(s, end_by_request) == SIG_IGN) std::signal(s, SIG_IGN);  // as nohup and job control want it
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)          // which have more to say
  for (const int s : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) std::signal(s, end_by_fault);
#endif
  std::set_terminate(end_by_exception);
}

}  // namespace burnish::cli
