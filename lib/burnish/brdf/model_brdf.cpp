#include "burnish/brdf/model_brdf.h"

#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "burnish/brdf/banks.h"
#include "burnish/brdf/blinn_phong.h"
#include "burnish/brdf/ward.h"
#include "burnish/core/error.h"
#include "burnish/core/number_text.h"

namespace burnish {
namespace {

constexpr LocalFrame kFrame{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

template <typename Specular>
class ModelBrdf final : public Brdf {
 public:
  ModelBrdf(double k_d, Specular specular) : k_d_(k_d), specular_(std::move(specular)) {}

 private:
  Vec3d reflected_above(Vec3d l, Vec3d v) const override {
    const double grey = k_d_ / kPi * l.z + specular_(l, v);
    return {grey, grey, grey};
  }

  double k_d_;
  Specular specular_;
};

template <typename Specular>
std::shared_ptr<const Brdf> model(double k_d, Specular specular) {
  return std::make_shared<const ModelBrdf<Specular>>(k_d, std::move(specular));
}

Error wrong(const std::string& message) { return Error(ErrorKind::kUsage, "SOURCE: " + message); }

using Parameters = std::map<std::string, double>;

// Overwrites `values`, which hold all that the model takes.
void read_parameters(const std::string& source, std::string list, Parameters& values) {
  std::string known;
  for (const auto& [name, value] : values) known += (known.empty() ? "" : ", ") + name;
  std::set<std::string> given;
  for (std::size_t begin = 0; begin < list.size();) {
    const std::size_t end = std::min(list.find(',', begin), list.size());
    const std::string item = list.substr(begin, end - begin);
    const std::size_t equals = std::min(item.find('='), item.size());
    const std::string name = item.substr(0, equals), text = item.substr(std::min(equals + 1, item.size()));
    const auto found = values.find(name);
    if (found == values.end())
      throw wrong("expected parameters out of " + known + ", got '" + name + "' in '" + source + "'");
    if (!given.insert(name).second) throw wrong("'" + name + "' is given twice in '" + source + "'");
    const std::optional<double> value = number_in<double>(text);
    const bool width = name[0] == 'a';
    if (!value || !std::isfinite(*value) || !(width ? *value > 0 : *value >= 0))
      throw wrong("expected " + name + " as a number " + (width ? "above 0" : "of at least 0") + ", got '" + text +
                  "' in '" + source + "'");
    found->second = *value;
    begin = end + 1;
  }
}

}  // namespace

bool is_model_source(const std::string& source) {
  const std::size_t colon = source.find(':');
  return colon != std::string::npos && source.find_first_of("/.") > colon;
}

std::shared_ptr<const Brdf> model_brdf(const std::string& source) {
  const std::size_t colon = std::min(source.find(':'), source.size());
  const std::string name = source.substr(0, colon), list = source.substr(std::min(colon + 1, source.size()));
  Parameters p{{"ks", 1}, {"kd", 0}};
  if (name == "banks") {
    read_parameters(source, list, p);
    return model(p["kd"], [k_s = p["ks"]](Vec3d l, Vec3d v) { return banks(kFrame, k_s, l, v); });
  }
  if (name == "blinn-phong") {
    p.insert({{"ax", 1}, {"ay", 1}, {"n", 32}});
    read_parameters(source, list, p);
    return model(p["kd"], [m = BlinnPhong{p["ks"], p["ax"], p["ay"], p["n"]}](Vec3d l, Vec3d v) {
      return blinn_phong(kFrame, m, normalized(l + v));
    });
  }
  if (name == "ward") {
    p.insert({{"ax", 0.2}, {"ay", 0.2}});
    read_parameters(source, list, p);
    return model(p["kd"], [m = Ward{p["ks"], p["ax"], p["ay"]}](Vec3d l, Vec3d v) { return ward(kFrame, m, l, v); });
  }
  throw wrong("expected the model ward, banks or blinn-phong, got '" + name + "'");
}

}  // namespace burnish
