#include "burnish/ptm/files/open_ptm.h"

#include <fstream>

#include "burnish/ptm/files/ptm_exr.h"
#include "burnish/ptm/files/ptm_file.h"

namespace burnish {
namespace {

bool is_exr(const FileRef& file) {
  char head[4] = {};
  std::ifstream(file.path, std::ios::binary).read(head, sizeof head);
  return std::string(head, sizeof head) == "v/1\x01";
}

}  // namespace

OpenPtm open_ptm(const FileRef& file) {
  require_readable(file);
  if (is_exr(file)) return {open_ptm_exr(file), "EXR"};
  PtmFile map = read_ptm(file);
  const std::string format = map.format;
  return {std::make_unique<PtmInBytes>(std::move(map)), format};
}

}  // namespace burnish
