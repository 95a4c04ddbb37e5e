// burnish-normals: displacement map to normal map.
#include "burnish/core/error.h"
#include "burnish/normal/height_map.h"
#include "cli/options.h"
#include "cli/tool.h"

using namespace burnish;
using namespace burnish::cli;

namespace {

const Words<Wrap> kWraps{
    {"fit", Wrap::kFit}, {"clamp", Wrap::kClamp}, {"repeat", Wrap::kRepeat}, {"mirror", Wrap::kMirror}};

// W[xH], each a length.
void parse_size(const std::string& text, HeightMapOptions& options) {
  const std::size_t x = text.find('x');
  options.size_u = parse_length("--size", text.substr(0, x));
  options.size_v = x == std::string::npos ? 0 : parse_length("--size", text.substr(x + 1));
  if (options.size_u <= 0 || (x != std::string::npos && options.size_v <= 0))
    throw CLI::ValidationError("--size", "expected positive lengths, got '" + text + "'");
}

}  // namespace

int main(int argc, char** argv) {
  Tool tool({"burnish-normals", "Displacement map to normal map, by a least-squares plane per texel.",
             "  burnish-normals rocks.tif -o rocks_n.png --height 10cm --size 2m --wrap repeat"});
  CLI::App& app = tool.app();
  std::string input;
  ImageOutput output;
  HeightMapOptions options;
  NormalCoding coding;
  std::string mask;

  app.add_option("HEIGHT", input, "Displacement map; '-' is standard input")->required();
  output.add_to(app);
  app.add_option_function<std::string>(
         "--height", [&](const std::string& t) { options.height = parse_length("--height", t); },
         "Displacement of the value 1.0, in the units of --size: 2m, 10cm, 5mm or a number, which counts as metres "
         "beside them (default 1)")
      ->type_name("H");
  app.add_option_function<std::string>(
         "--size", [&](const std::string& t) { parse_size(t, options); },
         "Extent of the whole map, as 2m or 2mx1m (default: one unit a texel)")
      ->type_name("W[xH]");
  app.add_option("--neighbors", options.neighbors, "Texels that the plane is fitted to: 4, 8, 24, 48 or 80 (default 4)")
      ->check(CLI::IsMember({4, 8, 24, 48, 80}))
      ->type_name("Q");
  add_choice<FitWeights>(app, "--weights", options.weights,
                         {{"uniform", FitWeights::kUniform}, {"gaussian", FitWeights::kGaussian}},
                         "Weights of the fit (default uniform; gaussian: sigma is half the radius)");
  std::optional<Wrap> wrap, wrap_u, wrap_v;
  const auto add_wrap = [&](const std::string& flag, std::optional<Wrap>& value, const std::string& help) {
    Words<std::optional<Wrap>> words;
    for (const auto& [word, w] : kWraps) words.emplace_back(word, w);
    add_choice<std::optional<Wrap>>(app, flag, value, words, help);
  };
  add_wrap("--wrap", wrap, "Beyond the map: fit (default) uses only texels that exist");
  add_wrap("--wrap-u", wrap_u, "The same, for the left and right sides only");
  add_wrap("--wrap-v", wrap_v, "The same, for the top and bottom sides only");
  app.add_option("--mask", mask, "Texels where it is 0 take no part and store (0,0,1)")->type_name("FILE");
  app.add_option("--mid-level", options.mid_level,
                 "Stored value that means no displacement (default 0); no slope depends on it")
      ->type_name("M");
  app.add_option("--channel", options.channel,
                 "Channel of the heights, by name or by number from 0 (default the first)")
      ->type_name("C");
  add_normal_coding(app, coding, false);

  return tool.run(argc, argv, [&]() -> Json {
    options.wrap_u = wrap_u.value_or(wrap.value_or(Wrap::kFit));
    options.wrap_v = wrap_v.value_or(wrap.value_or(Wrap::kFit));
    const FileType type = output.type();
    const SampleType sample = output.sample();
    const FileRef height = tool.read(input);
    if (!mask.empty()) options.mask = tool.read(mask);
    const NormalMapTarget target{tool.write(output.path), type, sample, coding};
    const HeightMapStats stats = convert_height_map(height, options, target, tool.progress());
    if (stats.colour_channels_differ)
      tool.warn("'" + input + "': colour channels differ; the first was taken for the height (--channel chooses)");
    return {{"width", stats.width},
            {"height", stats.height},
            {"max_slope_deg", stats.max_slope_deg},
            {"mean_tilt_deg", stats.mean_tilt_deg},
            {"degenerate_texels", stats.degenerate_texels}};
  });
}
