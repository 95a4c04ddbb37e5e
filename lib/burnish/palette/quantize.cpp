#include "burnish/palette/quantize.h"

#include <algorithm>

#include "burnish/core/error.h"
#include "burnish/core/number_text.h"
#include "burnish/palette/files/cube_image.h"
#include "burnish/palette/fit/cube_fit.h"
#include "burnish/palette/histogram.h"
#include "burnish/palette/mapper.h"

namespace burnish {
namespace {

void check(const QuantizeOptions& o, const std::vector<MapFiles>& maps) {
  const auto usage = [](const std::string& message) { throw Error(ErrorKind::kUsage, message); };
  if (maps.empty()) usage("expected at least one map, got none");
  if (o.palette.empty()) require_sane(o);
  if (!(o.dither_amount >= 0 && o.dither_amount <= 1))
    usage("dither-amount: expected 0 to 1, got " + number_text(o.dither_amount));
  if (o.encoding == MaterialEncoding::kSplit && std::ranges::any_of(maps, [](auto& m) { return !m.rgb.empty(); }))
    usage("an image of colours needs a material encoding: alpha or subcubes");
}

// A given palette that needs no histogram to be understood.
std::optional<Palette> read_given(const QuantizeOptions& o) {
  if (o.palette.empty() || o.encoding != MaterialEncoding::kSplit) return std::nullopt;
  Palette given = read_palette(o.palette, o.coding.green);
  if (o.space && given.space != *o.space)
    throw file_error(
        ErrorKind::kMalformed, o.palette.name,
        std::string("expected a palette in ") + name(*o.space) + " space, got one in " + name(given.space) + " space");
  return given;
}

// Where the materials are, for messages.
std::string material_files(const MapSet& maps) {
  const std::string& first = maps.files(0).material.name;
  for (std::size_t i = 1; i < maps.size(); i++)
    if (maps.files(i).material.name != first) return "'" + first + "' and the others";
  return "'" + first + "'";
}

// Made of what another quantizer made of the cube.
Palette palette_of_colours(const QuantizeOptions& o, NormalSpace space, const Histogram& histogram) {
  const MaterialCube cube(o.encoding, int(histogram.material.size()));
  const std::vector<Colour> colours = read_cube_colours(o.palette, cube);
  return palette_of(meanings(colours, cube, histogram.material.size()), histogram.material, space);
}

}  // namespace

void MapStats::set_angles(const AngleStats& angles) {
  rms_deg = angles.rms_deg(), mean_deg = angles.mean_deg();
  p95_deg = angles.p95_deg(), max_deg = angles.max_deg();
}

QuantizeResult quantize_normal_maps(std::vector<MapFiles> files, const QuantizeOptions& options, const MapSink& sink,
                                    const Progress& progress) {
  check(options, files);
  std::optional<Palette> given = read_given(options);
  QuantizeResult result;
  std::vector<SpaceOfFile> spaces;
  for (const MapFiles& f : files) spaces.push_back({f.normals.name, recorded_space(ImageReader(f.normals))});
  for (const SpaceOfFile& s : spaces) result.maps.push_back({{}, s.space});
  const NormalSpace space = given           ? given->space
                            : options.space ? *options.space
                                            : agreed_space(spaces).value_or(NormalSpace::kTangent);
  MapSet maps(std::move(files), options.coding);
  const Histogram histogram = count_normals(maps, part_of(progress, 0, 0.3));
  require_encodable(options.encoding, histogram.material.size(), material_files(maps));

  result.palette = given ? std::move(*given)
                   : !options.palette.empty()
                       ? palette_of_colours(options, space, histogram)
                       : fit_palette(histogram, options, space, material_files(maps), part_of(progress, 0.3, 0.8));
  Mapper mapper(histogram, result.palette, options.palette.empty() ? "palette" : options.palette.name, options.dither,
                options.dither_amount);
  AngleStats angles;
  for (std::size_t i = 0; i < maps.size(); i++) {
    OpenMap& open = maps.open(i);
    if (const FileRef& rgb = maps.files(i).rgb; !rgb.empty())
      write_cube_image(rgb, maps.files(i), options.coding,
                       MaterialCube(options.encoding, int(histogram.material.size())), histogram.material);
    const double from = double(i) / double(maps.size()), to = double(i + 1) / double(maps.size());
    const AngleStats of_map = mapper.run(open, sink(i, result.palette, open.width(), open.height()),
                                         part_of(part_of(progress, 0.8, 1), from, to));
    angles += of_map;
    MapStats& s = result.maps[i];
    s.texels = histogram.maps[i].counted, s.invalid_texels = histogram.maps[i].invalid;
    s.set_angles(of_map);
  }

  QuantizeStats& s = result.stats;
  for (const MapStats& m : result.maps) s.texels += m.texels, s.invalid_texels += m.invalid_texels;
  s.set_angles(angles);
  s.normals = int(result.palette.normals.size());
  s.distinct_input_normals = histogram.distinct;
  s.lossless = histogram.exact && s.max_deg == 0;
  return result;
}

QuantizedMap quantize_normal_map(const MapFiles& map, const QuantizeOptions& options, const Progress& progress) {
  QuantizedMap result;
  const auto keep = [&](std::size_t, const Palette&, int width, int) {
    return append_to(result.map.levels.emplace_back(), width);
  };
  QuantizeResult quantized = quantize_normal_maps({map}, options, keep, progress);
  result.stats = quantized.stats;
  result.map.palette = std::move(quantized.palette);
  return result;
}

}  // namespace burnish
