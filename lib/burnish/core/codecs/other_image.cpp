#include <dlfcn.h>

#include <new>

#include "burnish/core/codecs/image_codecs.h"
#include "burnish/core/codecs/openimageio.h"
#include "burnish/core/error.h"
#include "burnish/core/parallel.h"

namespace burnish::detail {
namespace {

// By its plain name: where it lies is said by the program (RUNPATH) or by LD_LIBRARY_PATH.
const OpenImageIo& openimageio(const FileRef& wanted_for) {
  static constexpr const char* kModule = "burnish-openimageio.so";
  static void* const module = ::dlopen(kModule, RTLD_NOW | RTLD_LOCAL);
  static const std::string why = module ? "" : ::dlerror();
  static const void* const symbol = module ? ::dlsym(module, kOpenImageIoSymbol) : nullptr;
  const auto says = [](const char* text) { return why.find(text) != why.npos; };
  if (says("failed to map segment") || says("cannot allocate memory")) throw std::bad_alloc();  // as glibc puts it
  if (!symbol)
    throw file_error(ErrorKind::kIo, wanted_for.name,
                     "expected the module " + std::string(kModule) + " for files of its type, got none (" + why + ")");
  return *static_cast<const OpenImageIo*>(symbol);
}

}  // namespace

std::unique_ptr<ImageSource> open_other_image(const FileRef& file, const std::string& codec) {
  return openimageio(file).open(file, codec, thread_limit());
}

std::unique_ptr<ImageSink> create_other_image(const FileRef& file, FileType type, const ImageShape& shape) {
  return openimageio(file).create(file, type, shape, thread_limit());
}

}  // namespace burnish::detail
