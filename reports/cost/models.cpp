// The whole models that are measured: what they compute, and how far from the truth that is.
#include "reports/cost/models.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "brdf/catalogue/masking_shape.h"
#include "brdf/catalogue/registry.h"
#include "brdf/formula/smith_gtr.h"
#include "brdf/in_number/number.h"
#include "brdf/model/evaluate.h"
#include "brdf/model/presets.h"
#include "image/display.h"
#include "integrate/albedo/directional_albedo.h"
#include "reports/audit/entry.h"
#include "reports/measure/light_unit.h"
#include "reports/measure/samples.h"
#include "reports/measure/surfaces.h"

#include <fmt/format.h>

namespace gonio::costing {
namespace {

using auditing::Row;

/// Compositions that engineers choose among, the exact ones first.
constexpr std::string_view specs[] = {"ggx/smith_ggx.correlated/dielectric",
                                      "ggx/smith_ggx.correlated/conductor",
                                      "ggx/smith_ggx.correlated/schlick",
                                      "ggx/smith_ggx.correlated/f82",
                                      "ggx/smith_ggx.separable/schlick",
                                      "ggx/hammon/schlick",
                                      "ggx/schlick_ggx.direct/schlick",
                                      "ggx/schlick_ggx.half_alpha/schlick",
                                      "beckmann/smith_beckmann.correlated/schlick",
                                      "beckmann/smith_beckmann.rational/schlick",
                                      "gtr/smith_ggx.correlated/schlick",
                                      "gtr/smith_gtr.correlated/schlick",
                                      "lambert+ggx/smith_ggx.correlated/schlick",
                                      "lambert.coupled+ggx/smith_ggx.correlated/schlick"};

std::string_view ndf_of(const Model& m) {
  return catalogue()[m.lobes[0].ndf.term].about->id;
}

/// The model as it stands for a surface without diffuse reflection; none where its Fresnel term is not
/// for such a surface.
std::optional<BoundModel> standing_for(const Whole& w, const FresnelSurface& s, double roughness) {
  const auto f0 = exact_values(s, std::array{1.0});
  Setting reflectance{"f0", {}};
  for (const auto& of_channel : f0) reflectance.values.push_back(of_channel[0]);
  const bool is_metal = s.kind == "metal";
  if (const auto* preset = find_preset(w.id)) {
    std::vector<Setting> settings{{"roughness", {roughness}}};
    for (const auto& p : preset->parameters) {
      const std::string name(p.name);
      if (name == "specular_color") settings.push_back({name, reflectance.values});
      if (name == "base_color")
        settings.push_back({name, is_metal ? reflectance.values : std::vector<double>{0}});
      if (name == "metallic") settings.push_back({name, {is_metal ? 1.0 : 0.0}});
    }
    return bind_model(w.id, settings, s.channels());
  }
  std::vector<Setting> settings{{"alpha", {roughness * roughness}}};
  const auto& m = w.model.model;
  if (m.find("gamma")) settings.push_back({"gamma", {2}});
  if (m.find("kd")) settings.push_back({"kd", {0}});
  const std::string_view fresnel = catalogue()[m.lobes[0].fresnel.term].about->id;
  if (fresnel == "fresnel.dielectric" || fresnel == "fresnel.conductor") {
    if (is_metal != (fresnel == "fresnel.conductor")) return {};
    settings.push_back({"eta", {}});
    for (const auto& i : s.index) settings.back().values.push_back(i.n);
    if (is_metal) {
      settings.push_back({"k", {}});
      for (const auto& i : s.index) settings.back().values.push_back(i.k);
    }
  } else {
    const auto forms = forms_for(s);
    const auto form = std::ranges::find_if(
        forms, [&](const FresnelForm& f) { return catalogue()[f.term].about->id == fresnel; });
    settings.insert(settings.end(), form->settings.begin(), form->settings.end());
  }
  return bind_model(m.spec, settings, s.channels());
}

BoundModel truth_for(const Whole& w, const FresnelSurface& s, double roughness) {
  const auto shape = shape_of_term(ndf_of(w.model.model));
  const std::string ndf(shape == "beckmann" ? "beckmann" : "ggx");
  std::vector<Setting> settings{{"alpha", {roughness * roughness}}, {"eta", {}}};
  for (const auto& i : s.index) settings[1].values.push_back(i.n);
  if (s.kind == "metal") {
    settings.push_back({"k", {}});
    for (const auto& i : s.index) settings[2].values.push_back(i.k);
  }
  return bind_model(fmt::format("{}/smith_{}.correlated/{}", ndf, ndf,
                                s.kind == "metal" ? "conductor" : "dielectric"),
                    settings, s.channels());
}

std::vector<double> values_of(std::string_view term, double alpha, std::span<const Row> rows) {
  return values_in(Number::double_, find_term(term), std::array{alpha}, rows);
}

const std::vector<Row>& above_horizon() {
  static const auto rows = [] {
    auto all = auditing::pairs();
    std::erase_if(all, [](const Row& r) { return !(r.nol > 0 && r.nov > 0); });
    return all;
  }();
  return rows;
}

/// [channel][row] of them.
template <class F>
std::vector<std::vector<double>> values_in(const BoundModel& b) {
  static const auto columns = [] {
    AngleColumns<F> x(above_horizon().size(), true);
    for (std::size_t i = 0; i < x.size(); ++i) x.set(i, above_horizon()[i]);
    return x;
  }();
  std::vector<Column<F>> f;
  std::vector<F*> out;
  for (std::size_t c = 0; c < b.model.channels; ++c)
    out.push_back(f.emplace_back(columns.padded()).data());
  const std::vector<F> values(b.values.begin(), b.values.end());
  evaluate<F>(b.model, values, columns.block(), out);
  std::vector<std::vector<double>> v;
  for (const auto* column : out) v.emplace_back(column, column + columns.size());
  return v;
}

std::array<FresnelSurface, 2> surfaces() {
  return {dielectric(1.5, "glass"), metal(*find_metal("Au"))};
}

/// The largest that gold differs by in even light, at NoV 0.1, 0.5 and 1 and roughness 0.2, 0.5 and 1; not a
/// number where the model is not for metals.
double delta_e_of_gold(const Whole& w) {
  static constexpr std::array mu{0.1, 0.5, 1.0};
  constexpr Goal goal{1e-5, 400'000};
  const auto gold = metal(*find_metal("Au"));
  double most = 0;
  for (const double roughness : {0.2, 0.5, 1.0}) {
    const auto model = standing_for(w, gold, roughness);
    if (!model) return std::numeric_limits<double>::quiet_NaN();
    auto found = directional_albedo(*model, mu, 0, goal);
    const auto truth = directional_albedo(truth_for(w, gold, roughness), mu, 0, goal);
    for (std::size_t i = 0; i < mu.size(); ++i) {
      for (auto& v : found[i].value) v /= light_unit(w.id);
      most = std::max(most,
                      delta_e_2000(lab_of_albedo(found[i].value), lab_of_albedo(truth[i].value)));
    }
  }
  return most;
}

}  // namespace

std::vector<Whole> wholes() {
  std::vector<Whole> out;
  for (const auto spec : specs) out.push_back({std::string(spec), bind_model(spec, {}, 1)});
  for (const auto& p : presets())  // as a renderer evaluates them
    out.push_back({std::string(p.about.id), bind_model(p.about.id, {}, 3)});
  return out;
}

std::size_t table_bytes(std::string_view term) {
  return term.starts_with("masking.smith_gtr")
             ? sizeof(smith_gtr::fixed::table) + sizeof(smith_gtr::fixed::mixture)
             : 0;
}
std::size_t table_bytes(const Model& m) {
  std::size_t sum = 0;
  for (const auto& l : m.lobes) sum += table_bytes(catalogue()[l.masking.term].about->id);
  return sum;
}

CostError error_of_term(std::size_t term, Number number) {
  const auto& of = catalogue()[term];
  std::size_t truth = term;
  while (!catalogue()[truth].about->reference().empty())
    truth = find_term(catalogue()[truth].about->reference());
  if (role_of(of.about->id) == Role::masking && !of.anisotropic)
    truth = find_term(fmt::format("masking.smith_{}.correlated", shape_of_term(of.about->id)));
  const auto d = auditing::distance_between(term, truth, number);
  CostError e{std::string(catalogue()[truth].about->id), ""};
  if (d) e.measure = d->measure, e.max = d->most.value, e.rms = d->rms;
  return e;
}

template <class F>
CostError error_of_whole(const Whole& w) {
  CostError e{"", "f 4 NoL NoV / D of the truth, which is G2 F"};
  const auto& rows = above_horizon();
  double squares = 0;
  std::size_t n = 0;
  for (const auto& s : surfaces())
    for (int i = 1; i <= 10; ++i) {
      const double roughness = i / 10.0;
      const auto model = standing_for(w, s, roughness);
      if (!model) continue;
      const auto truth = truth_for(w, s, roughness);
      if (e.truth.find(to_text(truth.model.spec)) == e.truth.npos)
        e.truth += (e.truth.empty() ? "" : ", ") + to_text(truth.model.spec);
      const auto f = values_in<F>(*model), g = values_in<double>(truth);
      const auto d = values_of(ndf_of(truth.model), roughness * roughness, rows);
      const double least = *std::ranges::max_element(d) * 1e-6;
      for (std::size_t c = 0; c < f.size(); ++c)
        for (std::size_t k = 0; k < rows.size(); ++k) {
          const double off =
              std::abs(f[c][k] / light_unit(w.id) - g[c][k]) * 4 * rows[k].nol * rows[k].nov / d[k];
          if (!(d[k] >= least && std::isfinite(off))) continue;
          e.max = std::max(e.max, off);
          squares += off * off;
          ++n;
        }
    }
  e.rms = std::sqrt(squares / static_cast<double>(n));
  e.delta_e = delta_e_of_gold(w);
  return e;
}
template CostError error_of_whole<float>(const Whole&);
template CostError error_of_whole<double>(const Whole&);

}  // namespace gonio::costing
