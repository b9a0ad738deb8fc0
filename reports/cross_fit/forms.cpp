// What is fitted, and what becomes of its parameters.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "brdf/model/presets.h"
#include "reports/cross_fit/cases.h"

#include <fmt/format.h>

namespace gonio {
namespace {

constexpr std::string_view exact_word = "exact";

/// Terms by their names without prefix.
constexpr std::array fresnels{
    "schlick", "schlick.f90", "schlick.ue",        "schlick.spherical_gaussian",
    "f82",     "lazanyi",     "linear.as_written", "constant"};
constexpr std::array maskings{"smith_ggx.separable",
                              "ue_joint",
                              "schlick_ggx.half_alpha",
                              "schlick_ggx.direct",
                              "schlick_ggx.half_roughness",
                              "schlick_beckmann",
                              "smith_beckmann.correlated",
                              "smith_beckmann.rational",
                              "disney_remap",
                              "disney_coat",
                              "cook_torrance",
                              "kelemen",
                              "neumann",
                              "implicit",
                              "none"};
constexpr std::array distributions{"gtr", "gtr.as_written", "beckmann", "blinn_phong"};
constexpr std::array fresnels_few{"schlick", "f82"};
constexpr std::array distributions_few{"gtr", "gtr.as_written"};
constexpr std::array maskings_few{"smith_ggx.separable", "ue_joint", "schlick_ggx.half_alpha",
                                  "schlick_ggx.direct", "implicit"};
constexpr std::array maskings_of_gtr{"smith_gtr.separable", "smith_ggx.correlated"};
constexpr std::array distributions_of_gtr{"ggx", "gtr.as_written", "beckmann"};

/// Whole lobes as they are shipped or taught.
constexpr std::array combinations{"ggx/smith_ggx.separable/schlick",
                                  "ggx/schlick_ggx.direct/schlick",
                                  "ggx/schlick_ggx.direct/schlick.spherical_gaussian",
                                  "ggx/schlick_ggx.half_alpha/schlick",
                                  "ggx/ue_joint/schlick.ue",
                                  "ggx/disney_remap/schlick",
                                  "gtr/schlick_ggx.direct/schlick",
                                  "beckmann/cook_torrance/schlick",
                                  "blinn_phong/implicit/schlick"};

struct Whole {
  const char* name;
  const char* model;
  double scale;
};
constexpr std::array wholes{Whole{"model.gltf", "gltf", 1},
                            Whole{"model.filament", "filament", 1},
                            Whole{"model.disney, isotropic", "disney+ggx/disney_remap/schlick", 1},
                            Whole{"model.ue_mobile", "ue_mobile", std::numbers::pi},
                            Whole{"model.ue_mobile_simple", "ue_mobile_simple", std::numbers::pi},
                            Whole{"model.unity_mobile", "unity_mobile", 1}};

class Forms {
 public:
  explicit Forms(const CrossTruth& t) : t_(t) {
    add("exact", "exact", t.ndf, t.masking, exact_word);
  }
  void add_fresnel(std::string_view f) {
    auto& form = add(fmt::format("fresnel.{}", f), "fresnel", t_.ndf, t_.masking, f);
    form.metals_only = f == "lazanyi";
  }
  void add_masking(std::string_view m) {
    add(fmt::format("masking.{}", m), "masking", t_.ndf, m, exact_word);
  }
  void add_distribution(std::string_view d) {
    add(fmt::format("ndf.{}", d), "distribution", d, t_.masking, exact_word);
  }
  void add_combination(const std::string& spec) { forms_.push_back({spec, "combination", spec}); }
  void add_whole(const Whole& w) {
    CrossForm f{w.name, "model", w.model, {}, w.scale};
    // F0 is what is looked at: a preset with parameters of its own would be fitted in those.
    if (const Preset* p = find_preset(w.model); p && !p->own_spec.empty()) f.model = p->spec;
    // F90 = saturate(16.5 Σ F0), 1 from F0 = 0.0202 on
    if (f.name == "model.filament") f.fixed.push_back({"f90", {1}});
    forms_.push_back(std::move(f));
  }
  std::vector<CrossForm> all() { return std::move(forms_); }

 private:
  CrossForm& add(std::string name,
                 std::string kind,
                 std::string_view ndf,
                 std::string_view masking,
                 std::string_view fresnel) {
    return forms_.emplace_back(
        CrossForm{std::move(name), std::move(kind), to_text(model_of_lobe(ndf, masking, fresnel))});
  }
  const CrossTruth& t_;
  std::vector<CrossForm> forms_;
};

/// The exact Fresnel term of a fit: of metals in terms of F0 and edge tint, so that F0 is a parameter.
ModelSpec with_exact(ModelSpec model, const FresnelSurface& s) {
  for (auto& lobe : model.lobes)
    if (lobe.fresnel == exact_word) lobe.fresnel = s.kind == "metal" ? "gulbrandsen" : "dielectric";
  return model;
}

/// Parameters of a form that are not free, but follow from the surface.
std::vector<Setting> held_by(const ModelSpec& model, const FresnelSurface& s) {
  if (model.lobes.empty()) return {};
  const auto& fresnel = model.lobes.back().fresnel;
  if (fresnel == "schlick.ue")  // F0 of green decides for all channels
    return {{"f0_green", {s.f0(s.channels() / 2)}}};
  if (fresnel == "lazanyi") {  // n and k make one F0: k alone is free
    Setting eta{"eta", {}};
    for (const auto& i : s.index) eta.values.push_back(i.n);
    return {eta};
  }
  return {};
}

const FittedParameter* find(const FitDocument& d, std::string_view name) {
  const auto it = std::ranges::find(d.parameters, name, &FittedParameter::name);
  return it == d.parameters.end() ? nullptr : &*it;
}

/// F0 of a fit in a channel, whatever its Fresnel term calls it.
CrossValue f0_value(const FitDocument& d, const FresnelSurface& s, std::size_t channel) {
  CrossValue v{"f0", s.channel(channel), s.f0(channel), no_value, 0, ParameterStatus::fixed};
  if (const auto* f0 = find(d, "f0")) {
    const std::size_t c = f0->value.size() > 1 ? channel : 0;
    v.fitted = f0->value[c];
    v.status = f0->status[c];
    return v;
  }
  const auto *eta = find(d, "eta"), *k = find(d, "k");
  const auto& free = k ? *k : *eta;
  v.fitted = f0_of_index({eta->value[channel], k ? k->value[channel] : 0});
  v.status = free.status[channel];
  return v;
}

std::vector<CrossValue> values_of(const FitDocument& d,
                                  const CrossTruth& t,
                                  const FresnelSurface& s,
                                  double roughness) {
  const auto* alpha = find(d, "roughness");
  std::vector<CrossValue> out{{"roughness", "", roughness, alpha->value[0], 0, alpha->status[0]}};
  for (std::size_t c = 0; c < s.channels(); ++c) out.push_back(f0_value(d, s, c));
  if (const auto* gamma = find(d, "gamma"))
    out.push_back({"gamma", "", t.shape.empty() ? 2 : t.shape[0].values[0], gamma->value[0], 0,
                   gamma->status[0]});
  if (const auto* kd = find(d, "kd"))
    for (std::size_t c = 0; c < kd->value.size(); ++c)
      out.push_back({"kd", s.channel(c), 0, kd->value[c], 0, kd->status[c]});
  return out;
}

Table scaled(Table t, double by) {
  for (auto& channel : t.values)
    for (auto& f : channel) f *= by;
  return t;
}

}  // namespace

std::string_view short_form(std::string_view name) {
  for (const std::string_view prefix : {"masking.", "fresnel.", "ndf.", "model."})
    if (name.starts_with(prefix)) return name.substr(prefix.size());
  return name;
}

std::vector<CrossForm> cross_forms(const CrossTruth& t) {
  Forms f(t);
  if (t.ndf == "gtr") {
    f.add_fresnel("schlick");
    for (const auto* m : maskings_of_gtr) f.add_masking(m);
    for (const auto* d : distributions_of_gtr) f.add_distribution(d);
    f.add_combination("ggx/smith_ggx.correlated/exact");
    f.add_combination("ggx/smith_ggx.correlated/schlick");
    return f.all();
  }
  if (t.multiple) {
    for (const auto* x : fresnels_few) f.add_fresnel(x);
    for (const auto* m : maskings_few) f.add_masking(m);
    for (const auto* d : distributions_few) f.add_distribution(d);
    f.add_combination("lambert+ggx/smith_ggx.correlated/exact");
  } else {
    for (const auto* x : fresnels) f.add_fresnel(x);
    for (const auto* m : maskings) f.add_masking(m);
    for (const auto* d : distributions) f.add_distribution(d);
    f.add_combination("beckmann/smith_beckmann.correlated/exact");
  }
  f.add_combination("gtr/smith_gtr.correlated/exact");
  for (const auto* c : combinations) f.add_combination(c);
  for (const auto& w : wholes) f.add_whole(w);
  return f.all();
}

CrossCase fit_case(const CrossTruth& t,
                   const CrossForm& f,
                   const FresnelSurface& s,
                   double roughness,
                   const CrossSlice& slice,
                   Metric metric) {
  FitOptions o;
  const auto model = with_exact(parse_model(f.model), s);
  o.model = to_text(model);
  o.fixed = f.fixed;
  for (auto& held : held_by(model, s)) o.fixed.push_back(std::move(held));
  o.metric = metric;
  o.intervals = Intervals::independent;
  o.bin_sensitivity = false;
  const auto fitted = [&](const Table& table) {
    return fit(f.scale == 1 ? table : scaled(table, f.scale), o).document;
  };
  const FitDocument d = fitted(slice.table);
  CrossCase out{t.name,
                f.name,
                f.kind,
                d.model,
                s.material,
                roughness,
                metric,
                "",
                d.solver.termination == "converged",
                d.residuals.log_rms,
                slice.log_error,
                values_of(d, t, s, roughness)};
  if (slice.half) {
    // With A and B of the halves and M = (A + B)/2, A − M = (A − B)/2 has the deviation that M has.
    const auto other = values_of(fitted(*slice.half), t, s, roughness);
    for (std::size_t i = 0; i < other.size(); ++i)
      out.values[i].error = std::abs(other[i].fitted - out.values[i].fitted);
  }
  return out;
}

double CrossValue::shift() const {
  return parameter == "f0" ? fitted / truth - 1 : fitted - truth;
}

bool CrossCase::is_dielectric() const {
  return material.starts_with("IOR ");
}
bool CrossCase::is_determined(const CrossValue& v) const {
  return std::isfinite(v.fitted) && (v.status == ParameterStatus::free || log_rms < 1e-6);
}
const CrossValue* CrossCase::find(std::string_view parameter, std::string_view channel) const {
  const auto it = std::ranges::find_if(values, [&](const CrossValue& v) {
    return v.parameter == parameter && (channel.empty() || v.channel == channel);
  });
  return it == values.end() ? nullptr : &*it;
}

}  // namespace gonio
