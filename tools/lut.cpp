// burnish-lut: the functions that shading looks up, sampled into tables.
#include <filesystem>
#include <tuple>

#include "burnish/brdf/tables/table_c_header.h"
#include "burnish/brdf/tables/table_error.h"
#include "burnish/core/error.h"
#include "burnish/core/number_text.h"
#include "cli/options.h"
#include "cli/tool.h"

using namespace burnish;
using namespace burnish::cli;

namespace {

template <typename T>
Words<T> by_name(std::initializer_list<T> values) {
  Words<T> words;
  for (const T value : values) words.emplace_back(name(value), value);
  return words;
}

// What stands between the characters `at`.
std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts;
  for (std::size_t first = 0, end = 0; end != std::string::npos; first = end + 1) {
    end = text.find(at, first);
    parts.push_back(text.substr(first, end - first));
  }
  return parts;
}

// Numbers alone; none where the text holds anything else.
std::vector<double> numbers(const std::string& text, char between) {
  std::vector<double> values;
  for (const std::string& part : split(text, between)) {
    const std::optional<double> value = number_in<double>(part);
    if (!value) return {};
    values.push_back(*value);
  }
  return values;
}

std::vector<Range> parse_domain(const std::string& text) {
  std::vector<Range> domain;
  for (const std::string& part : split(text, ',')) {
    const std::vector<double> ends = numbers(part, ':');
    if (ends.size() != 2)
      throw CLI::ValidationError("--domain", "expected ranges such as 0:1 or 0:16,0:1, got '" + text + "'");
    domain.push_back({ends[0], ends[1]});
  }
  return domain;
}

Vec3d parse_light(const std::string& text) {
  const std::vector<double> rgb = numbers(text, ',');
  if (rgb.size() != 3) throw CLI::ValidationError("--light", "expected a colour such as 1,0.9,0.8, got '" + text + "'");
  return {rgb[0], rgb[1], rgb[2]};
}

// Options that one function has.
void require_own_options(const CLI::App& app, LookupKind kind) {
  using enum LookupKind;
  for (const auto& [option, owner] : {std::pair{"--approximate", kBanksR},
                                      {"--exponent", kStrand},
                                      {"--layout", kStrand},
                                      {"--light", kLightFactor},
                                      {"--ambient", kLightFactor},
                                      {"--transition", kLightFactor}})
    if (app.count(option) && kind != owner)
      throw Error(ErrorKind::kUsage, std::string(option) + " is for " + name(owner) + ", not for " + name(kind));
}

bool is_c_header(const ImageOutput& output) {
  if (std::filesystem::path(output.path).extension() != ".h") return false;
  if (!output.output_type.empty())
    throw file_error(ErrorKind::kUsage, output.path, "--output-type " + output.output_type + " is for standard output");
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  Tool tool({"burnish-lut", "The functions that shading looks up, sampled into tables.",
             "  burnish-lut ward-e -o ward_e.exr --size 128x64\n"
             "  burnish-lut banks-r -o banks_r.exr -d float --max-error 0.01\n"
             "  burnish-lut strand -o strand.png --exponent 50 --layout cube-z\n"
             "  burnish-lut light-factor -o light_factor.h --light 1,0.9,0.8 --transition 0.4"});
  CLI::App& app = tool.app();
  LookupFunction function;
  ImageOutput output;
  output.as.what = "a lookup table";
  output.as.also = "C header (.h)";
  TableSampling sampling = TableSampling::kEdge;
  TableLayout layout = TableLayout::kPlain;
  int width = 256, height = 0;
  double max_error = 0;

  using enum LookupKind;
  add_choice<LookupKind>(app, "FUNCTION", function.kind,
                         by_name({kBanksR, kBlinnPhongF, kWardS, kWardE, kStrand, kLightFactor}),
                         "R(s), F(N,e), S(p), E(m,d), the strand of L·T and V·T, the light factor of N·L")
      ->required();
  output.add_to(app);
  app.add_option_function<std::string>(
         "--size", [&](const std::string& t) { std::tie(width, height) = parse_texels("--size", t); },
         "Texels: columns run over the first argument, rows over the second (default 256, or 256x256 where there are "
         "two)")
      ->type_name("N[xM]");
  app.add_option("--max-error", max_error,
                 "The smallest power-of-two size whose bilinear lookup errs by at most that, as stored; of offset-half "
                 "but for its outermost half texels, whose error the report has as wrap_error")
      ->type_name("E")
      ->excludes("--size");
  add_choice<TableSampling>(app, "--sampling", sampling, by_name({TableSampling::kEdge, TableSampling::kCentre}),
                            "Where texels are: edge (default) puts the outermost on the ends of the domain, centre "
                            "half a texel inside, as offset-half and cube-z need it");
  app.add_option_function<std::string>(
         "--domain", [&](const std::string& t) { function.domain = parse_domain(t); },
         "Range of each argument; default banks-r 0:1, blinn-phong-f 1:128,0:1, ward-s 0.01:1, ward-e 0:16,0:1, "
         "strand -1:1,-1:1, light-factor -1:1")
      ->type_name("A:B[,C:D]");
  app.add_flag("--approximate", function.approximate,
               "banks-r: R*(s) = 1-s in place of the root, with its errors against the root")
      ->excludes("--max-error");
  app.add_option("--exponent", function.exponent, "strand: of its specular part (default 16)")->type_name("N");
  add_choice<TableLayout>(app, "--layout", layout,
                          by_name({TableLayout::kPlain, TableLayout::kOffsetHalf, TableLayout::kCubeZ}),
                          "strand: plain (default), shifted by half its size for repeat addressing, or as the +Z face "
                          "of a cube map");
  app.add_option_function<std::string>(
         "--light", [&](const std::string& t) { function.light = parse_light(t); },
         "light-factor: colour of the light (default 1,1,1)")
      ->type_name("R,G,B");
  app.add_option("--ambient", function.ambient, "light-factor: ambient light (default 0.1)")->type_name("A");
  app.add_option("--transition", function.transition,
                 "light-factor: from ambient to full light, in units of the cosine (default 0.25; 0: a step)")
      ->type_name("WIDTH");

  return tool.run(argc, argv, [&]() -> Json {
    require_own_options(app, function.kind);
    if (function.domain.empty()) function.domain = default_domain(function.kind);
    if (!height) height = function.arguments() > 1 ? width : 1;
    if (layout != TableLayout::kPlain && !app.count("--sampling")) sampling = TableSampling::kCentre;
    const bool c_header = is_c_header(output);
    const SampleType sample = c_header ? output.sample_or(SampleType::kFloat) : output.sample();
    const FileRef file = tool.write(output.path);

    const bool smallest = app.count("--max-error") > 0;
    const Progress progress = tool.progress();
    const TableFile t{
        function, smallest ? smallest_table(function, sampling, layout, sample, max_error, part_of(progress, 0, 0.9))
                           : bake_table(function, width, height, sampling, layout)};
    LookupFunction exact = function;
    exact.approximate = false;
    const TableErrors errors =
        table_errors(exact, as_stored(t.table, sample), part_of(progress, smallest ? 0.9 : 0.1, 1));
    if (c_header) write_table_header(file, sample, t);
    else write_table(file, output.type(), sample, t);

    Json stats{{"width", t.table.texels.width},
               {"height", t.table.texels.height},
               {"max_abs_error", errors.max_abs},
               {"rms_error", errors.rms}};
    if (is_integer(sample)) stats["scale"] = table_scale(t.table);
    if (layout == TableLayout::kOffsetHalf) stats["wrap_error"] = errors.wrap;
    return stats;
  });
}
