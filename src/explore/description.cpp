// What a page is told in words and ranges, as JSON.
#include <algorithm>
#include <cmath>

#include "brdf/catalogue/registry.h"
#include "brdf/cost/model_operations.h"
#include "brdf/model/model_names.h"
#include "brdf/model/presets.h"
#include "brdf/model/roughness.h"
#include "explore/sphere.h"
#include "optics/refractive_index.h"

#include <nlohmann/json.hpp>

namespace gonio::explore {
namespace {

using Json = nlohmann::ordered_json;

std::string text(std::string_view s) {
  return std::string(s);
}

/// A slider's range: where a fit looks, widened to the value that is there.
Json slider_of(const ModelParameter& p, std::span<const double> values) {
  const Parameter& about = *p.about;
  double low = std::max(about.fit.low, about.legal.low),
         high = std::min(about.fit.high, about.legal.high);
  for (const double v : values) low = std::min(low, v), high = std::max(high, v);
  constexpr double wide = 20;
  return {{"name", p.name},
          {"roughness", is_alpha(p.name) ? roughness_name(p.name) : ""},
          {"first", p.first},
          {"count", p.count},
          {"low", about.legal.low},
          {"high", std::min(about.legal.high, 1e300)},
          {"from", low},
          {"to", high},
          {"log", low > 0 && high >= wide * low},
          {"start", about.start},
          {"meaning", text(about.meaning)}};
}

}  // namespace

std::string Surface::description() const {
  const auto* m = model();
  if (!m) return Json{{"channels", table()->channels}}.dump();
  Json parts = Json::array(), parameters = Json::array();
  const auto id = [](const TermUse& use) { return text(catalogue()[use.term].id()); };
  for (const auto& d : m->model.diffuse) parts.push_back({id(d)});
  for (const auto& l : m->model.lobes) parts.push_back({id(l.ndf), id(l.masking), id(l.fresnel)});
  for (const auto& p : m->model.parameters)
    parameters.push_back(slider_of(p, std::span(m->values).subspan(p.first, p.count)));
  const std::string spec = to_text(m->model.spec);
  return Json{{"spec", spec},
              {"name", model_names(std::span(&spec, 1)).front()},
              {"channels", m->model.channels},
              {"anisotropic", m->model.anisotropic},
              {"operations", operations_of(m->model).total()},
              {"parts", parts},
              {"parameters", parameters}}
      .dump();
}

std::string catalogue_json() {
  Json terms = Json::array(), models = Json::array(), known_metals = Json::array();
  const auto about = [](const About& a) {
    return Json{{"id", text(a.id)},
                {"title", text(a.title)},
                {"formula", text(a.formula)},
                {"source", text(a.source)},
                {"ships", text(a.ships)}};
  };
  for (const auto& t : catalogue()) {
    Json one = about(*t.about);
    one["role"] = text(name_of(t.role()));
    one["short"] = text(short_id(t.id()));
    terms.push_back(std::move(one));
  }
  for (const auto& p : presets()) {
    Json one = about(p.about);
    one["spec"] = text(p.spec);
    models.push_back(std::move(one));
  }
  for (const auto& m : metals())
    known_metals.push_back({{"symbol", text(m.symbol)}, {"name", text(m.name)}});
  Json lights = Json::array(), wide = Json::array();
  for (const auto& l : sphere_lights()) lights.push_back(text(l.name));
  for (const auto& l : wide_lights()) wide.push_back(text(l.name));
  return Json{{"terms", terms},   {"models", models},    {"metals", known_metals},
              {"lights", lights}, {"wide_lights", wide}, {"passes", WideSphere::passes}}
      .dump();
}

}  // namespace gonio::explore
