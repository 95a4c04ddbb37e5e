#include "burnish/core/file_type.h"

#include <algorithm>
#include <filesystem>
#include <vector>

#include "burnish/core/error.h"
#include "burnish/core/lower_case.h"
#include "burnish/core/wording.h"

namespace burnish {
namespace {

struct FileTypeInfo {
  FileType type;
  const char* name;
  std::vector<const char*> extensions;
  SampleType default_sample;
  std::vector<SampleType> samples;
};

const std::vector<FileTypeInfo>& file_types() {
  using enum SampleType;
  static const std::vector<FileTypeInfo> table{
      {FileType::kPng, "PNG", {".png"}, kUint8, {kUint8, kUint16}},
      {FileType::kTga, "TGA", {".tga"}, kUint8, {kUint8}},
      {FileType::kBmp, "BMP", {".bmp"}, kUint8, {kUint8}},
      {FileType::kTiff, "TIFF", {".tif", ".tiff"}, kUint16, {kUint8, kUint16, kFloat}},
      {FileType::kExr, "EXR", {".exr"}, kHalf, {kHalf, kFloat}},
      {FileType::kKtx2, "KTX2", {".ktx2"}, kUint8, {}},
      {FileType::kDds, "DDS", {".dds"}, kUint8, {}},
  };
  return table;
}

const FileTypeInfo& info_of(FileType type) { return *std::ranges::find(file_types(), type, &FileTypeInfo::type); }

}  // namespace

const char* name(SampleType type) {
  switch (type) {
    case SampleType::kUint8:
      return "uint8";
    case SampleType::kUint16:
      return "uint16";
    case SampleType::kHalf:
      return "half";
    default:
      return "float";
  }
}

const char* name(FileType type) { return info_of(type).name; }

std::optional<FileType> find_file_type(const std::string& file) {
  const std::string extension = lower_case_extension(file);
  for (const FileTypeInfo& t : file_types())
    for (const char* e : t.extensions)
      if (extension == e) return t.type;
  return std::nullopt;
}

FileType file_type_of(const std::string& file) {
  if (const std::optional<FileType> type = find_file_type(file)) return *type;
  throw file_error(
      ErrorKind::kUnsupported, file,
      "expected an output named .png, .tif, .exr, .tga or .bmp (.ktx2 or .dds for indexed normal maps), got '" +
          std::filesystem::path(file).extension().string() + "'");
}

SampleType default_sample_type(FileType type) { return info_of(type).default_sample; }

void require_can_hold(FileType type, SampleType sample, const std::string& file) {
  const FileTypeInfo& t = info_of(type);
  if (std::ranges::find(t.samples, sample) != t.samples.end()) return;
  if (t.samples.empty())
    throw file_error(ErrorKind::kUnsupported, file, std::string(t.name) + " is written for indexed normal maps only");
  std::vector<std::string> held;
  for (SampleType s : t.samples) held.emplace_back(name(s));
  throw file_error(ErrorKind::kUnsupported, file,
                   std::string(t.name) + " holds " + joined(held, " or ") + ", not " + name(sample));
}

}  // namespace burnish
