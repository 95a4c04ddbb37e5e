#include "burnish/brdf/tables/lookup_function.h"

#include <cmath>

#include "burnish/brdf/banks.h"
#include "burnish/brdf/blinn_phong.h"
#include "burnish/brdf/light_factor.h"
#include "burnish/brdf/strand.h"
#include "burnish/brdf/ward.h"
#include "burnish/core/error.h"
#include "burnish/core/number_text.h"

namespace burnish {
namespace {

constexpr double kAny = HUGE_VAL;

struct Argument {
  const char* name;
  Range ordinary;              // the default domain
  double least, most;          // where the function is defined
  bool without_least = false;  // but for that end, where it is infinite
};

// E is finite for every m, so that only d's pole at −1 bounds its domain; a negative m is no square.
const std::vector<Argument>& arguments_of(LookupKind kind) {
  static const std::vector<Argument> banks_r{{"s", {0, 1}, -kAny, 1}},
      blinn_phong_f{{"N", {1, 128}, 0, kAny}, {"e", {0, 1}, 0, kAny}}, ward_s{{"p", {0.01, 1}, 0, kAny, true}},
      ward_e{{"m", {0, 16}, 0, kAny}, {"d", {0, 1}, -1, kAny, true}},
      strand{{"L·T", {-1, 1}, -1, 1}, {"V·T", {-1, 1}, -1, 1}}, light_factor{{"N·L", {-1, 1}, -kAny, kAny}};
  switch (kind) {
    case LookupKind::kBanksR:
      return banks_r;
    case LookupKind::kBlinnPhongF:
      return blinn_phong_f;
    case LookupKind::kWardS:
      return ward_s;
    case LookupKind::kWardE:
      return ward_e;
    case LookupKind::kStrand:
      return strand;
    case LookupKind::kLightFactor:
      break;
  }
  return light_factor;
}

// "more than 0", "from -1 to 1"
std::string bounds(const Argument& a) {
  if (a.most == kAny) return (a.without_least ? "more than " : "at least ") + number_text(a.least);
  if (a.least == -kAny) return "at most " + number_text(a.most);
  return "from " + number_text(a.least) + " to " + number_text(a.most);
}

Error out_of_range(const std::string& what) { return Error(ErrorKind::kUsage, what); }

}  // namespace

const char* name(LookupKind kind) {
  static const char* const names[] = {"banks-r", "blinn-phong-f", "ward-s", "ward-e", "strand", "light-factor"};
  return names[int(kind)];
}

int LookupFunction::channels() const {
  return kind == LookupKind::kStrand ? 4 : kind == LookupKind::kLightFactor ? 3 : 1;
}

void LookupFunction::evaluate(double x, double y, double* out) const {
  switch (kind) {
    case LookupKind::kBanksR:
      out[0] = approximate ? banks_r_approximate(x) : banks_r(x);
      return;
    case LookupKind::kBlinnPhongF:
      out[0] = blinn_phong_f(x, y);
      return;
    case LookupKind::kWardS:
      out[0] = ward_s(x);
      return;
    case LookupKind::kWardE:
      out[0] = ward_e(x, y);
      return;
    case LookupKind::kStrand:
      out[0] = out[1] = out[2] = strand_diffuse(x);
      out[3] = strand_specular(x, y, exponent);
      return;
    case LookupKind::kLightFactor:
      out[0] = light_factor(x, light.x, ambient, transition);
      out[1] = light_factor(x, light.y, ambient, transition);
      out[2] = light_factor(x, light.z, ambient, transition);
      return;
  }
}

std::vector<Range> default_domain(LookupKind kind) {
  std::vector<Range> domain;
  for (const Argument& a : arguments_of(kind)) domain.push_back(a.ordinary);
  return domain;
}

void require_valid(const LookupFunction& f) {
  const std::vector<Argument>& arguments = arguments_of(f.kind);
  if (f.domain.size() != arguments.size())
    throw out_of_range(std::string("domain: ") + name(f.kind) + ": expected " + std::to_string(arguments.size()) +
                       " range(s) A:B, got " + std::to_string(f.domain.size()));
  for (std::size_t i = 0; i < arguments.size(); i++) {
    const Argument& a = arguments[i];
    const Range r = f.domain[i], single{float(r.least), float(r.most)};
    const auto refuse = [&](const std::string& expected) {
      throw out_of_range(std::string("domain: ") + name(f.kind) + ", " + a.name + ": expected " + expected + ", got " +
                         number_text(r.least) + ":" + number_text(r.most));
    };
    if (!(std::isfinite(r.least) && std::isfinite(r.most) && r.least < r.most)) refuse("two numbers, the lower first");
    if (!(std::isfinite(single.least) && std::isfinite(single.most) && single.least < single.most))
      refuse("ends that single precision tells apart");
    for (const Range& held : {r, single})
      if (held.least < a.least || held.most > a.most || (a.without_least && held.least == a.least)) refuse(bounds(a));
  }
  if (!(f.exponent > 0 && std::isfinite(f.exponent)))
    throw out_of_range("exponent: expected a number above 0, got " + number_text(f.exponent));
  const auto require_light = [](const char* what, double v) {
    if (!(v >= 0 && std::isfinite(v)))
      throw out_of_range(std::string(what) + ": expected at least 0, got " + number_text(v));
  };
  for (const double v : {f.light.x, f.light.y, f.light.z}) require_light("light", v);
  require_light("ambient", f.ambient);
  require_light("transition", f.transition);
}

}  // namespace burnish
