#include "burnish/palette/shared_palette.h"

#include "burnish/core/error.h"
#include "burnish/palette/files/histogram_file.h"
#include "burnish/palette/mapper.h"

namespace burnish {

CountStats count_maps(std::vector<MapFiles> files, const NormalCoding& coding, std::optional<NormalSpace> space,
                      const FileRef& histogram, const Progress& progress) {
  if (files.empty()) throw Error(ErrorKind::kUsage, "expected at least one map, got none");
  HistogramFile out;
  std::vector<SpaceOfFile> spaces;
  for (const MapFiles& f : files) spaces.push_back({f.normals.name, recorded_space(ImageReader(f.normals))});
  out.space = space ? space : agreed_space(spaces);
  MapSet maps(std::move(files), coding);
  out.counts.add(maps, progress);
  write_histogram(histogram, out);
  const auto [texels, invalid] = out.counts.texels();
  const Histogram counted = histogram_of(std::move(out.counts));
  return {texels, invalid, counted.distinct, counted.exact};
}

SharedPalette fit_shared_palette(const std::vector<FileRef>& files, const PaletteOptions& options,
                                 std::optional<NormalSpace> space, const Progress& progress) {
  if (files.empty()) throw Error(ErrorKind::kUsage, "expected at least one histogram, got none");
  require_sane(options);
  SharedPalette out;
  NormalCounts counts;
  for (std::size_t i = 0; i < files.size(); i++) {
    const HistogramFile file = read_histogram(files[i]);
    out.spaces.push_back({files[i].name, file.space});
    try {
      counts.add(file.counts);
    } catch (const Error& too_much) {
      throw file_error(too_much.kind(), files[i].name, too_much.what());
    }
    report_progress(progress, 0.3 * double(i + 1) / double(files.size()));
  }
  if (!space) space = agreed_space(out.spaces).value_or(NormalSpace::kTangent);
  QuantizeStats& s = out.stats;
  s.texels = counts.texels().counted, s.invalid_texels = counts.texels().invalid;
  const Histogram histogram = histogram_of(std::move(counts));
  const std::string names = "'" + files[0].name + "'" + (files.size() > 1 ? " and the others" : "");
  require_encodable(options.encoding, histogram.material.size(), names);
  out.palette = fit_palette(histogram, options, *space, names, part_of(progress, 0.3, 0.9));
  s.set_angles(nearest_angles(histogram, out.palette, entry_ranges(out.palette, histogram.material, "palette")));
  s.normals = int(out.palette.normals.size());
  s.distinct_input_normals = histogram.distinct;
  s.lossless = histogram.exact && s.max_deg == 0;
  return out;
}

}  // namespace burnish
