// The one target of a program, as libFuzzer calls it. One thread: others would only wait for each other.
#include "burnish/core/image_io.h"
#include "burnish/core/parallel.h"
#include "target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  static const burnish::ThreadLimit one(1);
  static const bool codecs = (burnish::set_codec_threads(1), true);
  (void)codecs;
  burnish::fuzz::Target::all().front()->run({bytes, size});
  return 0;
}
