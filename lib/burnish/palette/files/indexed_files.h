// The file formats of indexed maps, one source file each; burnish/palette/indexed_map.h chooses among them.
#pragma once

#include <optional>
#include <string>

#include "burnish/palette/indexed_map.h"

namespace burnish::detail {

// What the formats carry as text beside the indices, and its checks.
std::string materials_to_json(const std::vector<MaterialInterval>& materials);
std::vector<MaterialInterval> materials_from_json(const std::string& json, const std::string& file_name);
// kUnsupported unless the file's normals have +y up, as all of this room's do.
void require_y_up(const std::string& y, const std::string& file_name);
// kMalformed where no codec could unpack so many samples from the file: a few bytes must not make us ask for gigabytes.
void require_room_for(const FileRef& file, std::int64_t width, std::int64_t height, std::int64_t bits);
// kMalformed unless the intervals cover the palette in ascending order, normals have a length and indices are inside.
// Normals that are not unit to 1e-4 are made so.
void validate(Palette& palette, const std::string& file_name);
void validate(IndexedMap& map, const std::string& file_name);

// Readers of maps leave it to their caller to validate the indices.

// PNG: up to 256 entries as colour type 3, more as 16-bit grey; everything else in an iTXt chunk `burnish`.
bool is_indexed_png(const FileRef& file);
IndexedMap read_indexed_png(const FileRef& file, GreenAxis green);
void write_indexed_png(const FileRef& file, const IndexedMap& map);
// N×1 RGB of the palette alone; none where the file is no such image of ours.
std::optional<Palette> read_palette_png(const FileRef& file);
void write_palette_png(const FileRef& file, const Palette& palette);

// EXR: one UINT channel `index`, palette and intervals in attributes.
bool is_indexed_exr(const FileRef& file);
IndexedMap read_indexed_exr(const FileRef& file);
void write_indexed_exr(const FileRef& file, const IndexedMap& map);
// N×1 float RGB with the same attributes.
std::optional<Palette> read_palette_exr(const FileRef& file);
void write_palette_exr(const FileRef& file, const Palette& palette);

// KTX2: VK_FORMAT_R8_UINT or R16_UINT, palette and intervals as key/value data. What is read has no normals where the
// file holds no palette. kUnsupported for other formats, arrays, cubes, volumes, supercompression.
bool is_indexed_ktx2(const FileRef& file);
IndexedMap read_indexed_ktx2(const FileRef& file);
void write_indexed_ktx2(const FileRef& file, const IndexedMap& map);

// DDS: DXGI_FORMAT_R8_UINT or R16_UINT, indices only: what is read has no normals. kUnsupported
// for other formats, arrays, cubes, volumes.
bool is_indexed_dds(const FileRef& file);
IndexedMap read_indexed_dds(const FileRef& file);
void write_indexed_dds(const FileRef& file, const IndexedMap& map);

}  // namespace burnish::detail
