// burnish-ptm info: what a file says.
#include <array>
#include <memory>
#include <sstream>

#include "burnish/core/whole_file.h"
#include "burnish/ptm/coefficient_range.h"
#include "ptm/ptm.h"

namespace burnish::cli {
namespace {

constexpr std::array<const char*, kPtmTerms> kTerms{"u^2", "v^2", "u*v", "u", "v", "1"};

// A row a term, of what stands in the stats.
std::string table(const Json& stats) {
  std::string text = "term";
  for (const char* column : {"least", "most", "scale", "bias"})
    if (stats.contains(column)) text += std::string(14 - std::string(column).size(), ' ') + column;
  for (int k = 0; k < kPtmTerms; k++) {
    text += "\n" + std::string(kTerms[k]) + std::string(4 - std::string(kTerms[k]).size(), ' ');
    for (const char* column : {"least", "most", "scale", "bias"}) {
      if (!stats.contains(column)) continue;
      char number[16];
      std::snprintf(number, sizeof number, "%14.6g", stats[column][k].get<double>());
      text += number;
    }
  }
  return text + "\n";
}

Json run(Tool& tool, const std::string& input) {
  const PtmInput map = open_input(tool, input);
  const PtmShape& shape = map.rows->shape();
  Json stats{{"format", map.format}, {"width", shape.width}, {"height", shape.height}, {"type", name(map.made_of)}};
  const CoefficientRange range = coefficient_range(*map.rows);
  stats["least"] = range.least, stats["most"] = range.most;
  if (const PtmBytes* bytes = map.rows->bytes()) stats["scale"] = bytes->scale, stats["bias"] = bytes->bias;
  if (!map.description.is_null()) stats["description"] = map.description;

  const CLI::Option* report = tool.app().get_option("--report");
  if (report->count() && report->as<std::string>() == "-") return stats;  // standard output is the report's
  const FileRef out = tool.write("-");
  std::ostringstream text;
  text << map.format << ", " << name(map.made_of) << ", " << shape.width << "x" << shape.height << " texels\n"
       << table(stats);
  for (const char* key : {"parameters", "noise_factor", "source"})
    if (map.description.is_object() && map.description.contains(key))
      text << key << ": " << map.description[key].dump() << "\n";
  write_file(out, text.str());
  return stats;
}

}  // namespace

Verb add_info(Tool& tool) {
  const auto input = std::make_shared<std::string>();
  CLI::App& verb = add_verb(tool, "info", "Says what a file holds, on standard output",
                            "  burnish-ptm info coin.ptm\n"
                            "  burnish-ptm info coin/ --report -");
  add_input(verb, *input);
  return {&verb, [input, &tool] { return run(tool, *input); }};
}

}  // namespace burnish::cli
