// The one target of a program, as libFuzzer calls it. One thread: others would only wait for each other.
#include "burnish/core/parallel.h"
#include "target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  static const burnish::ThreadLimit one(1);
  burnish::fuzz::Target::all().front()->run({bytes, size});
  return 0;
}
