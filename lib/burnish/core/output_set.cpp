#include "burnish/core/output_set.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <climits>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <mutex>

#include "burnish/core/error.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;

// Paths a signal handler may unlink: slots of a fixed table, each published by one atomic pointer.
constexpr int kSlots = 4096;  // a turn of frames with their auxiliary images
std::atomic<const char*> g_temporaries[kSlots];

int publish(const std::string& path) {
  char* copy = ::strdup(path.c_str());
  for (int i = 0; i < kSlots; i++) {
    const char* expected = nullptr;
    if (g_temporaries[i].compare_exchange_strong(expected, copy)) return i;
  }
  std::free(copy);
  throw Error(ErrorKind::kInternal, "too many outputs at once");
}

void withdraw(int slot) {
  if (slot >= 0) std::free(const_cast<char*>(g_temporaries[slot].exchange(nullptr)));
}

struct Temporary {
  std::string path;
  int slot = -1;
};

// Creates a file that did not exist; without a path, and errno set, where that cannot be. Published first, so that no
// signal falls between.
Temporary create_unique(const fs::path& directory, const std::string& name) {
  const std::string stem = name.substr(0, 200);  // of the 255 bytes a name may have
  for (int n = 0; n < 1000; n++) {
    const fs::path p =
        directory / ("." + stem + "." + std::to_string(::getpid()) + "-" + std::to_string(n) + ".burnish-tmp");
    const int slot = publish(p.string());
    const int fd = ::open(p.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
    if (fd >= 0) {
      ::close(fd);
      return {p.string(), slot};
    }
    const int error = errno;
    withdraw(slot);
    errno = error;
    if (error != EEXIST) return {};
  }
  return {};
}

fs::path scratch_directory() {
  const char* dir = std::getenv("TMPDIR");
  return dir && *dir ? dir : "/tmp";
}

bool same_file(const std::string& a, const std::string& b) {
  struct stat sa, sb;
  return ::stat(a.c_str(), &sa) == 0 && ::stat(b.c_str(), &sb) == 0 && sa.st_dev == sb.st_dev && sa.st_ino == sb.st_ino;
}

// Whether two names lead to one place, where there is a file or not.
bool same_place(const std::string& a, const std::string& b) {
  const fs::path pa(a), pb(b);
  const auto directory = [](const fs::path& p) { return p.has_parent_path() ? p.parent_path().string() : "."; };
  return pa.filename() == pb.filename() && same_file(directory(pa), directory(pb));
}

Error cannot_write(const std::string& name, int error) {
  return file_error(ErrorKind::kIo, name, std::string("cannot be written: ") + std::strerror(error));
}

Error is_an_input(const std::string& name) {
  return file_error(ErrorKind::kUsage, name, "is an input; name another output");
}

// To standard output, or into what stands under a name and is no file: a device or a pipe.
void copy_to_stream(const FileRef& file, bool is_stdout) {
  std::FILE* in = std::fopen(file.path.c_str(), "rb");
  std::FILE* out = is_stdout ? stdout : std::fopen(file.name.c_str(), "wbe");
  int error = in && out ? 0 : errno;
  std::vector<char> buffer(1 << 20);
  while (const std::size_t n = error ? 0 : std::fread(buffer.data(), 1, buffer.size(), in))
    if (std::fwrite(buffer.data(), 1, n, out) != n) error = errno ? errno : EIO;
  if (in && std::ferror(in) && !error) error = EIO;
  if (in) std::fclose(in);
  if (out && (is_stdout ? std::fflush(out) : std::fclose(out)) != 0 && !error) error = errno;
  if (error) throw cannot_write(file.name, error);
}

}  // namespace

void OutputSet::protect(const std::string& input) {
  inputs_.push_back(input);
  for (const Output& o : outputs_)
    if (o.kind == Kind::kFile && same_file(input, o.target)) throw is_an_input(o.file.name);
}

FileRef OutputSet::add(const std::string& name, int rank) {
  if (name == "-") {
    for (const Output& o : outputs_)
      if (o.kind == Kind::kStdout) throw file_error(ErrorKind::kUsage, kStandardOutput, "is named as an output twice");
    return add_stream(Kind::kStdout, kStandardOutput, rank);
  }
  std::error_code ignored;
  const fs::file_status status = fs::status(name, ignored);
  if (fs::is_directory(status)) throw file_error(ErrorKind::kIo, name, "expected a file to write, got a directory");
  if (fs::exists(status) && ::access(name.c_str(), W_OK) != 0) throw cannot_write(name, errno);
  if (fs::exists(status) && !fs::is_regular_file(status)) return add_stream(Kind::kDevice, name, rank);
  fs::path t = name;  // what a link leads to is replaced, not the link
  for (int hops = 0; fs::is_symlink(fs::symlink_status(t, ignored)) && hops < 40; hops++)
    t = t.parent_path() / fs::read_symlink(t, ignored);
  for (const Output& o : outputs_)
    if (o.kind == Kind::kFile && same_place(o.target, t.string()))
      throw file_error(ErrorKind::kUsage, name, "is named as an output twice");
  for (const std::string& in : inputs_)
    if (same_file(in, name)) throw is_an_input(name);
  const auto [path, slot] = create_unique(t.has_parent_path() ? t.parent_path() : fs::path("."), t.filename().string());
  if (path.empty()) throw cannot_write(name, errno);
  outputs_.push_back({FileRef(path, name), t.string(), slot, rank, Kind::kFile});
  return outputs_.back().file;
}

FileRef OutputSet::add_stream(Kind kind, const std::string& name, int rank) {
  const auto [path, slot] = create_unique(scratch_directory(), "burnish-stdout");
  if (path.empty()) throw cannot_write(scratch_directory().string(), errno);
  outputs_.push_back({FileRef(path, name), name, slot, rank, kind});
  return outputs_.back().file;
}

void OutputSet::make_directory(const std::string& name) {
  fs::path at;
  for (const fs::path& part : fs::path(name)) {
    at /= part;
    std::error_code ignored;
    if (fs::is_directory(at, ignored)) continue;
    const int slot = publish(at.string());
    if (::mkdir(at.c_str(), 0777) != 0) {
      const int error = errno;
      withdraw(slot);
      throw file_error(ErrorKind::kIo, name,
                       "cannot be made a directory: " +
                           (error == EEXIST ? "'" + at.string() + "' is a file" : std::strerror(error)));
    }
    directories_.push_back({at.string(), slot});
  }
}

void OutputSet::discard(const FileRef& file) {
  std::erase_if(outputs_, [&](const Output& o) {
    if (o.file.path != file.path) return false;
    ::unlink(o.file.path.c_str());
    withdraw(o.slot);
    return true;
  });
}

void OutputSet::commit() {
  // Streams first: a closed pipe is the failure that a rename cannot undo.
  std::ranges::stable_sort(outputs_, {}, [](const Output& o) { return o.kind == Kind::kFile ? o.rank : INT_MIN; });
  for (const Output& o : outputs_)  // a temporary that is lost is found before anything is replaced
    if (::access(o.file.path.c_str(), R_OK) != 0) throw cannot_write(o.file.name, errno);
  for (Output& o : outputs_) {
    if (o.kind != Kind::kFile) {
      copy_to_stream(o.file, o.kind == Kind::kStdout);
      ::unlink(o.file.path.c_str());
    } else if (::rename(o.file.path.c_str(), o.target.c_str()) != 0) {
      throw cannot_write(o.file.name, errno);
    }
    withdraw(o.slot);
    o.slot = -1;
  }
  outputs_.clear();
  for (const Directory& d : directories_) withdraw(d.slot);
  directories_.clear();
}

OutputSet::~OutputSet() {
  for (const Output& o : outputs_) {
    if (o.slot < 0) continue;
    ::unlink(o.file.path.c_str());
    withdraw(o.slot);
  }
  for (; !directories_.empty(); directories_.pop_back()) {
    ::rmdir(directories_.back().path.c_str());
    withdraw(directories_.back().slot);
  }
}

void OutputSet::remove_all_temporaries() noexcept {
  for (auto& slot : g_temporaries)
    if (const char* path = slot.load()) ::unlink(path);
  for (int i = kSlots; i-- > 0;)  // directories, those inside others first
    if (const char* path = g_temporaries[i].load()) ::rmdir(path);
}

ScratchFile::ScratchFile() {
  const auto [path, slot] = create_unique(scratch_directory(), "burnish-stdin");
  if (path.empty()) throw cannot_write(scratch_directory().string(), errno);
  path_ = path, slot_ = slot;
}

ScratchFile::~ScratchFile() {
  ::unlink(path_.c_str());
  withdraw(slot_);
}

}  // namespace burnish
