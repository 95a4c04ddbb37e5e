// The codecs behind ImageReader and ImageWriter, one source file each.
#pragma once

#include <memory>

#include "burnish/core/codecs/image_sink.h"
#include "burnish/core/codecs/image_source.h"

namespace burnish::detail {

std::unique_ptr<ImageSource> open_png_image(const FileRef& file);
std::unique_ptr<ImageSink> create_png_image(const FileRef& file, const ImageShape& shape);

// Channels are in the order R, G, B, A and of other names of the kind, layer by layer, the rest by name.
std::unique_ptr<ImageSource> open_exr_image(const FileRef& file);
std::unique_ptr<ImageSink> create_exr_image(const FileRef& file, const ImageShape& shape);
// What a header of an EXR has of an image's attributes.
struct ExrForm;
ExrForm exr_form(const ImageShape& shape, int levels);

// All other types, through the module that is loaded for the first of them (openimageio.h).
std::unique_ptr<ImageSource> open_other_image(const FileRef& file, const std::string& codec);
std::unique_ptr<ImageSink> create_other_image(const FileRef& file, FileType type, const ImageShape& shape);

}  // namespace burnish::detail
