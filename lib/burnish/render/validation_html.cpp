#include "burnish/render/validation_html.h"

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>

#include "burnish/render/picture.h"

namespace burnish {
namespace {

constexpr const char* kStyle = R"(
  body { font: 15px/1.5 system-ui, sans-serif; margin: 2rem auto; max-width: 110rem;
         padding: 0 1rem; color: #222; background: #fff }
  h1 { font-size: 1.4rem } .pass { color: #176b2c } .miss { color: #a51d1d }
  table { border-collapse: collapse; margin: 1rem 0 }
  th, td { text-align: left; padding: .2rem 1.2rem .2rem 0; border-bottom: 1px solid #ddd }
  td.n { font-variant-numeric: tabular-nums }
  .pictures { display: flex; flex-wrap: wrap; gap: 1rem } figure { margin: 0; flex: 1 1 20rem }
  figure img { width: 100%; height: auto; image-rendering: pixelated; background: #000 }
  .legend { height: .8rem } .ends { display: flex; justify-content: space-between; font-size: .85rem }
)";

std::string base64(const std::string& bytes) {
  constexpr const char* kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  const auto byte = [&](std::size_t i) { return i < bytes.size() ? std::uint32_t(std::uint8_t(bytes[i])) : 0u; };
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::uint32_t group = byte(i) << 16 | byte(i + 1) << 8 | byte(i + 2);
    for (int k = 0; k < 4; k++) out += i + k <= bytes.size() ? kDigits[group >> (18 - 6 * k) & 63] : '=';
  }
  return out;
}

std::string escaped(const std::string& text) {
  std::string out;
  for (char c : text)
    out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '"' ? "&quot;" : std::string(1, c);
  return out;
}

std::string number(double x) {
  if (std::isinf(x)) return "∞ (no difference)";
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", x);
  return text;
}

std::string figure(const std::string& png, const std::string& alt, const std::string& caption) {
  return "<figure><img alt=\"" + alt + "\" src=\"data:image/png;base64," + base64(png) + "\"><figcaption>" + caption +
         "</figcaption></figure>\n";
}

const ToleranceCheck* check_of(const Validation& v, const std::string& name) {
  for (const ToleranceCheck& c : v.checks)
    if (c.name == name) return &c;
  return nullptr;
}

std::string metric_row(const Validation& v, const std::string& label, double value, const std::string& tolerance) {
  std::string row = "<tr><th>" + label + "</th><td class=\"n\">" + number(value) + "</td>";
  if (const ToleranceCheck* c = check_of(v, tolerance))
    row += std::string("<td class=\"n\">") + (tolerance.starts_with("min") ? "at least " : "at most ") +
           number(c->allowed) + "</td><td class=\"" + (c->met ? "pass\">met" : "miss\">not met") + "</td>";
  else row += "<td>–</td><td></td>";
  return row + "</tr>\n";
}

bool uses_one_light_and_view(const Scene& scene) {
  for (const Light& light : scene.lights)
    if (light.type == LightType::kPoint) return false;
  return scene.camera.type == CameraType::kOrthographic;
}

}  // namespace

std::string validation_html(const Scene& scene, const Validation& v, const ValidationPictures& pictures) {
  const std::string path = name(v.path), file = escaped(std::filesystem::path(scene.name).filename().string());
  std::string out = "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>" + file + ": " + path +
                    " against analytic</title>\n<style>" + kStyle + "</style></head><body>\n";
  out += "<h1>" + file + ": path <em>" + path + "</em> against its analytic twin: ";
  if (v.checks.empty()) out += "measured</h1>\n<p>The scene sets no tolerance.</p>\n";
  else
    out += v.passed() ? "<span class=\"pass\">passed</span></h1>\n"
                      : "<span class=\"miss\">tolerance not met</span></h1>\n";
  out += "<table><tr><th>linear RGB, over " + std::to_string(v.metrics.pixels) +
         " pixels</th><th>measured</th><th>tolerance</th><th></th></tr>\n";
  out += metric_row(v, "PSNR (dB, peak 1)", v.metrics.psnr_db, "min_psnr_db");
  out += metric_row(v, "root mean square error", v.metrics.rmse, "max_rmse");
  out += metric_row(v, "largest difference", v.metrics.max_abs, "max_abs");
  out += metric_row(v, "95 % of differences are at most", v.metrics.p95_abs, "max_p95_abs");
  out += "</table>\n";
  if (!uses_one_light_and_view(scene))
    out +=
        "<p>A point light or a perspective view differs from point to point; the colour table takes both at "
        "the object's "
        "origin. The difference shown holds that as well as the quantization.</p>\n";
  const int twin_samples = scene.validation.samples.value_or(scene.samples);
  const auto grid = [](int n) { return std::to_string(n) + "×" + std::to_string(n) + " samples a pixel"; };
  out += "<div class=\"pictures\">\n" + figure(pictures.picture, path, path + ", " + grid(scene.samples)) +
         figure(pictures.twin, "analytic", "analytic, " + grid(twin_samples)) +
         figure(pictures.difference, "difference",
                "difference of the worst channel; grey shows no object<div class=\"legend\" style=\"background: " +
                    heat_css_gradient() + "\"></div><div class=\"ends\"><span>0</span><span>" + number(v.heat_max / 2) +
                    "</span><span>" + number(v.heat_max) + "</span></div>") +
         "</div>\n</body></html>\n";
  return out;
}

}  // namespace burnish
