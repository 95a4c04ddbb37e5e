#include "burnish/palette/quantize.h"

#include <algorithm>

#include "burnish/core/error.h"
#include "burnish/core/number_text.h"
#include "burnish/palette/files/cube_image.h"
#include "burnish/palette/fit/cube_fit.h"
#include "burnish/palette/fit/fit_palette.h"
#include "burnish/palette/fit/imagequant_engine.h"
#include "burnish/palette/histogram.h"
#include "burnish/palette/mapper.h"

namespace burnish {
namespace {

void check(const QuantizeOptions& o, const std::vector<MapFiles>& maps) {
  const auto usage = [](const std::string& message) { throw Error(ErrorKind::kUsage, message); };
  if (maps.empty()) usage("expected at least one map, got none");
  if (o.normals < 2 || o.normals > kMaxPaletteSize)
    usage("normals: expected 2 to 65536, got " + std::to_string(o.normals));
  if (o.target_error_deg && !(*o.target_error_deg >= 0 && *o.target_error_deg <= 180))
    usage("target-error: expected degrees from 0 to 180, got " + number_text(*o.target_error_deg));
  if (!(o.dither_amount >= 0 && o.dither_amount <= 1))
    usage("dither-amount: expected 0 to 1, got " + number_text(o.dither_amount));
  if (o.encoding == MaterialEncoding::kSplit && std::ranges::any_of(maps, [](auto& m) { return !m.rgb.empty(); }))
    usage("an image of colours needs a material encoding: alpha or subcubes");
  if (o.engine == Engine::kImagequant && o.palette.empty() && !o.target_error_deg && o.normals > kImagequantMost)
    throw Error(ErrorKind::kUnsupported,
                "engine: imagequant holds at most 256 normals, not " + std::to_string(o.normals));
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

// What the maps say, who must not contradict each other.
NormalSpace recorded_space_of_all(const std::vector<MapFiles>& files, const std::vector<QuantizedMapStats>& maps) {
  std::optional<std::size_t> first;
  for (std::size_t i = 0; i < maps.size(); i++) {
    if (!maps[i].recorded_space) continue;
    if (!first) first = i;
    const NormalSpace expected = *maps[*first].recorded_space, got = *maps[i].recorded_space;
    if (got != expected)
      throw file_error(ErrorKind::kMalformed, files[i].normals.name,
                       std::string("expected normals in ") + name(expected) + " space, as in '" +
                           files[*first].normals.name + "', got " + name(got) + " space");
  }
  return first ? *maps[*first].recorded_space : NormalSpace::kTangent;
}

void require_counting_texels(const MapSet& maps, const Histogram& histogram) {
  for (std::size_t i = 0; i < maps.size(); i++)
    if (histogram.maps[i].counted == 0)
      throw file_error(
          ErrorKind::kMalformed, maps.files(i).mask.name,
          "expected texels that are not 0, got none: it masks every texel of '" + maps.files(i).normals.name + "'");
}

// An entry for each material, where a palette is fitted, and a cube that holds them all.
void require_room_for(const QuantizeOptions& o, const MapSet& maps, int materials) {
  const std::string& first = maps.files(0).material.name;
  std::string files = "'" + first + "'";
  for (std::size_t i = 1; i < maps.size(); i++)
    if (maps.files(i).material.name != first) files = "'" + first + "' and the others";
  if (o.palette.empty() && !o.target_error_deg && o.normals < materials)
    throw Error(ErrorKind::kMalformed, "normals: expected at least one for each of the " + std::to_string(materials) +
                                           " materials in " + files + ", got " + std::to_string(o.normals));
  if (o.encoding == MaterialEncoding::kSubcubes && materials > kMostSubcubes)
    throw Error(ErrorKind::kUnsupported, "material-encoding: subcubes holds at most 4 materials, not " +
                                             std::to_string(materials) + " as in " + files);
}

Palette make_palette(const QuantizeOptions& o, NormalSpace space, const Histogram& histogram,
                     const Progress& progress) {
  const FitOptions fit{o.engine, o.encoding, space};
  if (!o.palette.empty()) {
    const MaterialCube cube(o.encoding, int(histogram.material.size()));
    const std::vector<Colour> colours = read_cube_colours(o.palette, cube);
    return palette_of(meanings(colours, cube, histogram.material.size()), histogram.material, fit.space);
  }
  if (o.target_error_deg) return fit_palette_to_error(histogram, fit, *o.target_error_deg, progress);
  return fit_palette(histogram, fit, o.normals, progress);
}

void set_angles(const AngleStats& angles, MapStats& s) {
  s.rms_deg = angles.rms_deg(), s.mean_deg = angles.mean_deg();
  s.p95_deg = angles.p95_deg(), s.max_deg = angles.max_deg();
}

}  // namespace

QuantizeResult quantize_normal_maps(std::vector<MapFiles> files, const QuantizeOptions& options, const MapSink& sink,
                                    const Progress& progress) {
  check(options, files);
  std::optional<Palette> given = read_given(options);
  QuantizeResult result;
  for (const MapFiles& f : files) result.maps.push_back({{}, recorded_space(ImageReader(f.normals))});
  const NormalSpace space = given           ? given->space
                            : options.space ? *options.space
                                            : recorded_space_of_all(files, result.maps);
  MapSet maps(std::move(files), options.coding);
  const Histogram histogram = count_normals(maps, part_of(progress, 0, 0.3));
  require_counting_texels(maps, histogram);
  require_room_for(options, maps, int(histogram.material.size()));

  IndexedMap map;
  map.palette = given ? std::move(*given) : make_palette(options, space, histogram, part_of(progress, 0.3, 0.8));
  Mapper mapper(histogram, map.palette, options.palette.empty() ? "palette" : options.palette.name, options.dither,
                options.dither_amount);
  AngleStats angles;
  for (std::size_t i = 0; i < maps.size(); i++) {
    OpenMap& open = maps.open(i);
    if (const FileRef& rgb = maps.files(i).rgb; !rgb.empty())
      write_cube_image(rgb, open, MaterialCube(options.encoding, int(histogram.material.size())), histogram.material);
    map.levels.clear();
    map.levels.emplace_back(open.texels.width(), open.texels.height());
    const double from = double(i) / double(maps.size()), to = double(i + 1) / double(maps.size());
    const AngleStats of_map = mapper.run(open, map.levels[0], part_of(part_of(progress, 0.8, 1), from, to));
    angles += of_map;
    MapStats& s = result.maps[i];
    s.texels = histogram.maps[i].counted, s.invalid_texels = histogram.maps[i].invalid;
    set_angles(of_map, s);
    sink(i, map);
  }

  QuantizeStats& s = result.stats;
  for (const MapStats& m : result.maps) s.texels += m.texels, s.invalid_texels += m.invalid_texels;
  set_angles(angles, s);
  s.normals = int(map.palette.normals.size());
  s.distinct_input_normals = histogram.distinct;
  s.lossless = histogram.exact && s.max_deg == 0;
  result.palette = std::move(map.palette);
  return result;
}

QuantizedMap quantize_normal_map(const MapFiles& map, const QuantizeOptions& options, const Progress& progress) {
  QuantizedMap result;
  result.stats = quantize_normal_maps(
                     {map}, options, [&](std::size_t, const IndexedMap& m) { result.map = m; }, progress)
                     .stats;
  return result;
}

}  // namespace burnish
