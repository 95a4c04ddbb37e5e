// [object.reflectance] and [tables] of a scene; their keys stand in samples/README.md.
#pragma once

#include "burnish/core/toml_file.h"
#include "burnish/render/anisotropy/reflectance.h"

namespace burnish {

Reflectance parse_reflectance(const TomlTable& table, const std::string& directory);
SceneTables parse_tables(const TomlTable& table, const std::string& directory);

}  // namespace burnish
