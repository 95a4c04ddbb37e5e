// What the kinds of maps that burnish-mipmap knows share.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "burnish/core/image_chain.h"
#include "burnish/normal/coding.h"
#include "burnish/palette/index_mips.h"
#include "cli/number_or_map.h"
#include "cli/options.h"
#include "cli/tool.h"
#include "ptm/ptm.h"

namespace burnish::cli {

enum class MapKind { kIndexed, kNormal, kMaterial, kPtm, kColour };

struct MipmapOptions {
  std::string input;
  std::optional<MapKind> kind;
  IndexedOutput output;  // of other kinds its path, type and format
  std::string split;
  int levels = 0;
  NormalCoding coding;
  // Indexed
  std::string palette, source;
  MipAverage average = MipAverage::kLevel;
  // Normal
  NumberOrMap roughness{"--roughness", ""};
  std::string roughness_output;
  // Material
  bool khr = false;
};

// A printf-like name with one %d, or %02d and the like, filled in; `option` is the one that gives it.
std::string level_name(const std::string& pattern, int level, const std::string& option = "--split");

// Where the levels of images go: a chain in one file, or one level a file.
class LevelFiles {
 public:
  // A chain. kUnsupported where the type holds one level only.
  LevelFiles(Tool& tool, const ImageOutput& output, int levels);
  // A file a level, named by a pattern; `option` is the one that gives it.
  LevelFiles(Tool& tool, const std::string& pattern, const std::string& option, const ImageOutput& output, int levels);

  const std::string& name() const { return files_[0].name; }  // for messages
  SampleType sample() const { return sample_; }

  // Size and channels of the base. kUnsupported as ImageChainWriter.
  void open(int width, int height, int channels, const Attributes& attributes);
  // The next rows of a level; rows of several levels may take turns.
  void write_rows(int level, const Image& rows);
  void close();

 private:
  FileType type_;
  SampleType sample_;
  int levels_;
  std::vector<FileRef> files_;  // one, or as many as levels
  // Once they are open:
  std::optional<ImageChainWriter> chain_;
  std::vector<ImageWriter> parts_;
};

// Each writes what was asked for and returns the report's stats.
Json mip_indices(Tool& tool, const MipmapOptions& options, const FileRef& file);
Json mip_normals(Tool& tool, const MipmapOptions& options, const FileRef& file);
Json mip_material(Tool& tool, const MipmapOptions& options);
Json mip_ptm(Tool& tool, const MipmapOptions& options, const PtmInput& map);

}  // namespace burnish::cli
