#include "target.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

#include "burnish/core/error.h"

namespace burnish::fuzz {
namespace {

[[noreturn]] void stop(const std::string& why) {
  std::fprintf(stderr, "fuzz: %s\n", why.c_str());
  std::abort();
}

}  // namespace

MemoryFile::MemoryFile(const std::string& name)
    : descriptor_(::memfd_create("burnish-fuzz", MFD_CLOEXEC)),
      ref_("/proc/self/fd/" + std::to_string(descriptor_), name) {
  if (descriptor_ < 0) stop("there is no file in memory");
}

MemoryFile::~MemoryFile() { ::close(descriptor_); }

void MemoryFile::hold(std::span<const std::uint8_t> bytes) {
  const auto size = ::ssize_t(bytes.size());
  if (::ftruncate(descriptor_, 0) != 0 || ::pwrite(descriptor_, bytes.data(), bytes.size(), 0) != size)
    stop("a file in memory cannot be written");
}

Target::Target(const char* name, const char* file_name, void (*read)(const FileRef& file))
    : name_(name), file_name_(file_name), read_(read) {
  all().push_back(this);
}

std::vector<const Target*>& Target::all() {
  static std::vector<const Target*> targets;
  return targets;
}

void Target::run(std::span<const std::uint8_t> bytes) const {
  static MemoryFile file(file_name_);
  file.hold(bytes);
  try {
    read_(file.ref());
  } catch (const Error& error) {
    const std::string message = error.what();
    if (error.kind() == ErrorKind::kInternal) stop("an error that says it is a fault of ours: " + message);
    if (message.empty() || message.find('\n') != std::string::npos) stop("an error not of one line: " + message);
  }
}

}  // namespace burnish::fuzz
