// Lookup tables in image files, with all that a shader needs to look them up.
//
// Attributes (core/attributes.h):
//   burnish:function    as name(LookupKind)
//   burnish:domain      lo, hi of each argument
//   burnish:sampling    "edge" or "centre"
//   burnish:layout      "plain", "offset-half" or "cube-z"
//   burnish:parameters  JSON: {"approximate":false} of banks-r, {"exponent":16} of strand,
//                       {"light":[1,1,1],"ambient":0.1,"transition":0.25} of light-factor, {} of the others
//   burnish:scale       of integer samples, one number a channel: true value = stored · scale
// half and float hold the values themselves. TGA and BMP hold no attributes: they are written where the scale is 1, and
// not read.
#pragma once

#include "burnish/brdf/tables/lookup_table.h"
#include "burnish/core/file_ref.h"
#include "burnish/core/file_type.h"

namespace burnish {

struct TableFile {
  LookupFunction function;
  LookupTable table;  // true values
};

// {"exponent":16}
std::string parameters_json(const LookupFunction& function);

// kUnsupported where the file's type cannot hold the samples or record the scale, or those not hold the values.
void write_table(const FileRef& file, FileType type, SampleType sample, const TableFile& table);

// kMalformed where an attribute is missing or unknown, or function, size and channels do not fit each other.
TableFile read_table(const FileRef& file);

}  // namespace burnish
