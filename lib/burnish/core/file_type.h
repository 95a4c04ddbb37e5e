// The types of image files that are written, and the samples that each of them holds.
#pragma once

#include <optional>
#include <string>

namespace burnish {

enum class SampleType { kUint8, kUint16, kHalf, kFloat };
// The last two hold indexed normal maps only (palette/indexed_map.h): what reads and writes images here refuses them.
enum class FileType { kPng, kTga, kBmp, kTiff, kExr, kKtx2, kDds };

// Those that hold [0,1] in steps.
inline bool is_integer(SampleType type) { return type == SampleType::kUint8 || type == SampleType::kUint16; }
// "uint8", "uint16", "half", "float"
const char* name(SampleType type);
// "PNG", "TGA", …
const char* name(FileType type);

// From the extension; none, or kUnsupported, where it names no type that is written here.
std::optional<FileType> find_file_type(const std::string& name);
FileType file_type_of(const std::string& name);
// PNG, TGA, BMP: uint8; TIFF: uint16; EXR: half.
SampleType default_sample_type(FileType type);
// kUnsupported where the file type cannot hold the samples.
void require_can_hold(FileType type, SampleType sample, const std::string& name);

}  // namespace burnish
