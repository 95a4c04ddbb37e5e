// The [[object]] tables of a scene: surface, place, maps, base colour.
#pragma once

#include <string>

#include "burnish/core/toml_file.h"
#include "burnish/render/scene.h"

namespace burnish {

// kMalformed for what samples/README.md does not allow. Files are relative to the directory.
Object parse_object(const TomlTable& table, const std::string& directory);

}  // namespace burnish
