#include "fitting/solve/problem.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include "base/error.h"
#include "brdf/catalogue/registry.h"
#include "brdf/model/evaluate.h"
#include "brdf/model/presets.h"
#include "brdf/model/roughness.h"
#include "brdf/model/takes_parameter.h"
#include "optics/refractive_index.h"
#include "table/format/wavelengths.h"
#include "table/health/health.h"

#include <fmt/format.h>

namespace gonio {
namespace {

/// The user's bounds by the names of the model's parameters.
std::vector<Setting> resolved_bounds(const FitOptions& o, const BoundModel& b) {
  std::vector<Setting> all;
  for (const auto& s : o.bounds) {
    const bool is_mixed = is_mixed_colour(b.model, s.name);
    if (!is_mixed) all.push_back(s);
    for (const char* channel : {"_r", "_g", "_b"})
      if (is_mixed) all.push_back({s.name + channel, s.values});
  }
  for (auto& s : all) {
    if (is_roughness(s.name) && b.model.find(alpha_name(s.name))) {
      s.name = alpha_name(s.name);
      for (auto& v : s.values) v = alpha_of(v);
    }
    const auto* p = b.model.find(s.name);
    if (!p) throw wrong_usage(fmt::format("bounds: the model has no parameter '{}'", s.name));
    if (std::ranges::find(b.given, s.name) != b.given.end())
      throw wrong_usage(fmt::format("{} is held at a value and has bounds", s.name));
    if (std::ranges::count(all, s.name, &Setting::name) > 1)
      throw wrong_usage(
          fmt::format("bounds: {} and {} are the same parameter", s.name, roughness_name(s.name)));
    if (s.values.size() != 2 || !(s.values[0] < s.values[1]))
      throw wrong_usage(fmt::format("bounds of {}: two numbers, the lower first", s.name));
    for (const double v : s.values) check_range(*p->about, s.name, v);
  }
  return all;
}

/// The model with what is fixed.  A base colour fixes f0 and kd together with a metallic, which is held at
/// 0 where a value is asked of a model, but in a fit would be taken for free.
BoundModel bound(const FitOptions& o, std::optional<std::size_t> channels) {
  const auto is_fixed = [&](std::string_view name) {
    return std::ranges::find(o.fixed, name, &Setting::name) != o.fixed.end();
  };
  const bool stands_for_others = !compose(o.model, 1).find("base_color");
  if (stands_for_others && is_fixed("base_color") && !is_fixed("metallic"))
    throw wrong_usage(
        "base_color is held at a value and metallic is not: fix metallic=0 (or 1) too, or kd and "
        "f0");
  return bind_model(o.model, o.fixed, channels, o.grey);
}

/// True of directions of one azimuth and the opposite one, but for those along the normal: widths across them are not seen.
bool is_in_one_plane(const DirectionList& l) {
  constexpr double normal = 1e-6, same = 1e-3;  // [°]
  std::optional<double> plane;
  const auto leaves = [&](double theta, double phi) {
    if (std::abs(theta) < normal) return false;
    if (!plane) plane = phi;
    return std::abs(std::remainder(phi - *plane, 180)) > same;
  };
  for (std::size_t i = 0; i < l.theta_i_deg.size(); ++i)
    if (leaves(l.theta_i_deg[i], l.phi_i_deg[i]) || leaves(l.theta_o_deg[i], l.phi_o_deg[i]))
      return false;
  return true;
}

/// True of light from one azimuth alone, but for that along the normal: nobody turned the surface, or its table says nothing of it.
bool is_never_turned(const DirectionList& l) {
  constexpr double normal = 1e-6, same = 1e-3;  // [°]
  std::optional<double> azimuth;
  for (std::size_t i = 0; i < l.theta_i_deg.size(); ++i) {
    if (std::abs(l.theta_i_deg[i]) < normal) continue;
    if (!azimuth) azimuth = l.phi_i_deg[i];
    if (std::abs(std::remainder(l.phi_i_deg[i] - *azimuth, 360)) > same) return false;
  }
  return true;
}

/// The spec with the isotropic forms of its terms, which share one width.
ModelSpec without_tangent(ModelSpec spec) {
  constexpr std::string_view word = "_aniso";
  each_name(spec, [&](std::string& name) {
    if (const auto at = name.find(word); at != name.npos) name.erase(at, word.size());
  });
  return spec;
}

}  // namespace

FitOptions expanded(FitOptions o) {
  const Preset* preset = find_preset(o.model);
  if (!preset) return o;
  if (!preset->own_spec.empty()) {
    o.model = preset->own_spec;
    return o;
  }
  o.model = preset->spec;
  if (std::erase_if(o.fixed, [](const Setting& s) {
        return s.name == "anisotropy" && s.values == std::vector{0.0};
      }))
    o.model = to_text(without_tangent(parse_model(o.model)));
  const auto defaults = preset->resolve(PresetValues(preset->parameters, {}));
  for (const auto name : preset->held)
    if (std::ranges::find(o.fixed, name, &Setting::name) == o.fixed.end())
      o.fixed.push_back(*std::ranges::find(defaults, name, &Setting::name));
  return o;
}

FitOptions options_for(FitOptions o, const std::string& model) {
  const auto others = [&](const std::string& name) { return !takes_parameter(model, name); };
  o.model = model;
  for (auto* settings : {&o.fixed, &o.bounds})
    std::erase_if(*settings, [&](const Setting& s) { return others(s.name); });
  std::erase_if(o.grey, others);
  return o;
}

FitOptions expanded(FitOptions given, const Table& t) {
  FitOptions o = expanded(std::move(given));
  const auto metal = std::ranges::find(o.fixed, "metal", &Setting::name);
  if (metal == o.fixed.end()) return o;
  const Material* material = find_metal(metal->text);
  const auto nm = wavelengths_of(t);
  if (!material || nm.empty()) return o;
  Setting eta{"eta", {}}, k{"k", {}};
  for (const double w : nm) {
    eta.values.push_back(material->at(w).n);
    k.values.push_back(material->at(w).k);
  }
  o.fixed.erase(metal);
  o.fixed.insert(o.fixed.end(), {std::move(eta), std::move(k)});
  return o;
}

void check(const FitOptions& given) {
  const FitOptions o = expanded(given);
  resolved_bounds(o, bound(o, {}));
}

void check_azimuths(const Table& t, const Model& m) {
  if (m.anisotropic && t.grid())
    throw wrong_usage(
        fmt::format("model '{}' is anisotropic, and a table of this layout does not say how the "
                    "surface was turned",
                    to_text(m.spec)));
}

Problem pose(const Table& t, const FitOptions& o) {
  const Model m = bound(o, t.channels.size()).model;
  check_azimuths(t, m);
  if (m.anisotropic && is_in_one_plane(*t.list()))
    throw wrong_usage(fmt::format(
        "model '{}' is anisotropic, and the directions of this table all lie in one plane",
        to_text(m.spec)));
  if (m.anisotropic && is_never_turned(*t.list()))
    throw wrong_usage(fmt::format(
        "model '{}' is anisotropic, and all light of this table comes from one azimuth: "
        "it does not say how the surface was turned",
        to_text(m.spec)));
  if (o.metric == Metric::uncertainty && t.errors.empty())
    throw bad_input(t.path, "metric uncertainty", "no uncertainties",
                    "a column u_f, uBRDF, or \"uncertainty\" in the side file");
  return pose(t.channels.size(), spread_of_negatives(t), o);
}

Problem pose(std::size_t channels, double offset, const FitOptions& o) {
  BoundModel b = bound(o, channels);
  const auto own = resolved_bounds(o, b);
  std::vector<bool> free(b.model.value_count, true);
  Bounds bounds;
  std::vector<bool> narrowed;
  for (const auto& p : b.model.parameters) {
    const bool fixed = std::ranges::find(b.given, p.name) != b.given.end();
    const auto mine = std::ranges::find(own, p.name, &Setting::name);
    const bool user = mine != own.end();
    const Range range = user ? Range{mine->values[0], mine->values[1]} : p.about->fit;
    if (!fixed && std::isnan(p.about->start)) {  // of a person's file, which says nothing of it
      if (!user)
        throw wrong_usage(fmt::format(
            "{} is free and has no bounds: give them by --bounds {}=LOW,HIGH, by a comment "
            "\"// {} LOW HIGH\" in the file, or fix it by --fix {}=VALUE",
            p.name, p.name, p.name, p.name));
      for (std::size_t c = 0; c < p.count; ++c)
        b.values[p.first + c] = (range.low + range.high) / 2;
    }
    for (std::size_t c = 0; c < p.count; ++c) {
      free[p.first + c] = !fixed;
      if (fixed) continue;
      bounds.low.push_back(range.low);
      bounds.high.push_back(range.high);
      narrowed.push_back(user);
    }
  }
  for (std::size_t c = 0; c < b.model.channels; ++c) {
    std::size_t count = 0;
    for (const auto& p : b.model.parameters) count += free[p.slot(c)];
    if (count >= most_columns)
      throw wrong_usage(
          fmt::format("{} free parameters per channel; at most {} can be fitted at once", count,
                      most_columns - 1));
  }
  FreeSlots slots(b.model, std::move(free));
  return {o, std::move(b), std::move(slots), std::move(bounds), std::move(narrowed), offset};
}

bool folds(const Problem& p) {
  return is_reciprocal(p.start) && !p.options.robust;
}

Sampling sampling_for(const Problem& p, const Table& t, Bins bins, bool fold) {
  const FitOptions& o = p.options;
  return {t, bins, o.metric, p.offset, fold, o.copies, p.start.model.anisotropic};
}

Problem with_free(const Problem& p, Model model, const std::vector<bool>& mask) {
  Problem q = p;
  q.start.model = std::move(model);
  q.bounds = {};
  q.narrowed.clear();
  std::vector<bool> both(mask.size());
  for (const std::size_t s : p.free.slots()) {
    if (!(both[s] = mask[s])) continue;
    const std::size_t i = p.free.index(s);
    q.bounds.low.push_back(p.bounds.low[i]);
    q.bounds.high.push_back(p.bounds.high[i]);
    q.narrowed.push_back(p.narrowed[i]);
  }
  q.free = FreeSlots(q.start.model, std::move(both));
  return q;
}

std::vector<bool> slots_read(const Model& m) {
  std::vector<bool> read(m.value_count);
  const auto mark = [&](const TermUse& t) {
    for (const std::size_t k : t.parameters)
      std::fill_n(read.begin() + static_cast<std::ptrdiff_t>(m.parameters[k].first),
                  m.parameters[k].count, true);
  };
  bool turned = false;
  for (const auto* t : terms_of(m)) {
    mark(*t);
    turned = turned || catalogue()[t->term].anisotropic;
  }
  if (turned) read[m.tangent()->first] = true;
  return read;
}

Model with_lobes(const Model& m, std::span<const std::size_t> lobes) {
  Model some = m;
  some.lobes.clear();
  for (const std::size_t l : lobes) some.lobes.push_back(m.lobes[l]);
  return some;
}

bool are_alike(const Lobe& a, const Lobe& b) {
  return a.ndf.term == b.ndf.term && a.masking.term == b.masking.term &&
         a.fresnel.term == b.fresnel.term;
}

bool is_reciprocal(const BoundModel& b) {
  std::vector<FrameAngles<double>> there, back;
  for (const double theta_h : {2.0, 15.0, 40.0})
    for (const double theta_d : {5.0, 30.0, 45.0})
      for (const double phi_d : {10.0, 70.0}) {
        constexpr double phi_h = 50;
        const auto a = frame_angles(directions(
            HalfDifference{theta_h * degree, phi_h * degree, theta_d * degree, phi_d * degree}));
        there.push_back(a);
        back.push_back({{a.nov, a.nol, a.noh, a.voh, a.sin2_theta_h},
                        a.xoh,
                        a.yoh,
                        a.xov,
                        a.yov,
                        a.xol,
                        a.yol});
      }
  const auto f = evaluate(b, there), g = evaluate(b, back);
  for (std::size_t c = 0; c < f.size(); ++c)
    for (std::size_t i = 0; i < f[c].size(); ++i)
      if (std::abs(f[c][i] - g[c][i]) > 1e-12 * f[c][i]) return false;
  return true;
}

}  // namespace gonio
