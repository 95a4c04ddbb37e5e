// The [[material]] tables of a scene: lighting models, and sums of them.
#pragma once

#include <string>
#include <vector>

#include "burnish/core/toml_file.h"
#include "burnish/render/lighting/material.h"

namespace burnish {

// At least one: white Lambert where there are no tables. kMalformed for what samples/README.md does not allow. Files
// are relative to the directory.
std::vector<Material> parse_materials(const TomlTable& root, const std::string& directory);

}  // namespace burnish
