// Runs files through fuzz targets, without a fuzzer.
//
//   burnish-fuzz-replay TARGET FILE…    exit 0 unless one of them ends the program
#include <cstdio>
#include <string_view>

#include "burnish/core/error.h"
#include "burnish/core/whole_file.h"
#include "target.h"

int main(int argc, char** argv) {
  const burnish::fuzz::Target* target = nullptr;
  for (const auto* t : burnish::fuzz::Target::all())
    if (argc > 1 && std::string_view(argv[1]) == t->name()) target = t;
  if (!target || argc < 3) {
    std::fprintf(stderr, "expected burnish-fuzz-replay TARGET FILE…, TARGET being one of\n");
    for (const auto* t : burnish::fuzz::Target::all()) std::fprintf(stderr, "  %s\n", t->name());
    return 1;
  }
  for (int i = 2; i < argc; i++) {
    std::fprintf(stderr, "%s\n", argv[i]);  // the last line of a log says which one it was
    try {
      const std::string bytes = burnish::read_file(argv[i]);
      target->run({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
    } catch (const burnish::Error& error) {
      std::fprintf(stderr, "%s\n", error.what());
      return 2;
    }
  }
  return 0;
}
