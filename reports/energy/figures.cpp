// The pictures of the energy report.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "brdf/catalogue/registry.h"
#include "reports/energy/energy.h"
#include "reports/finding/names.h"

#include <fmt/format.h>

namespace gonio {
namespace {

FigureAxis over_mu() {
  return {"μ = cos θ", false, 0, 1};
}
std::string name_of(const EnergyForm& f) {
  return std::string(f.name.starts_with("masking.") ? short_id(f.name) : f.name);
}
/// Name of an angle, of 0, which stands for the average, too.
std::string mu_name(double mu) {
  return mu > 0 ? fmt::format("{:g}", mu) : "average";
}
std::string mu_text(double mu) {
  if (mu == 0) return "on average over the hemisphere";
  return mu == 1 ? "at normal incidence" : fmt::format("at μ = {:g}", mu);
}
/// Values of a member over all, each once, in their order.
template <class List, class Get>
auto each_once(const List& list, Get get) {
  std::vector<std::decay_t<std::invoke_result_t<Get, decltype(list[0])>>> out;
  for (const auto& x : list)
    if (std::ranges::find(out, std::invoke(get, x)) == out.end())
      out.push_back(std::invoke(get, x));
  return out;
}

// --- Every masking -------------------------------------------------------------------------------

/// Loss by roughness and angle, and E over the angle at some roughnesses.
void add_form(Pictures& p, const EnergyForm& f) {
  const auto roughness = each_once(f.rows, &EnergyForm::At::roughness);
  auto m = make_map("loss", {{"form", f.name}});
  m.title = fmt::format("Loss 1 − E of {}", in_text(f.name));
  m.note = "by roughness and angle; below 0 light is made";
  m.x = {"roughness", roughness};
  m.x.from = 0;
  if (roughness.back() == 1) m.x.to = 1;
  m.y = {"μ = cos θ", each_once(f.rows, &EnergyForm::At::mu)};
  m.y.from = 0;
  m.y.to = 1;
  m.value = "loss 1 − E [%]";
  m.diverging = true;
  for (const auto& at : f.rows) m.values.push_back(100 * (1 - at.albedo));
  p.maps.push_back(std::move(m));

  auto e = make_figure("albedo", {{"form", f.name}});
  e.title = fmt::format("E(μ) of {}", in_text(f.name));
  e.note = "F = 1: what is missing to 1, masking took";
  e.x = over_mu();
  e.y = {"E"};
  std::vector<double> shown;
  for (const double wanted : {0.1, 0.3, 0.5, 0.7, 0.85, 1.0}) {
    const double near =
        *std::ranges::min_element(roughness, {}, [&](double r) { return std::abs(r - wanted); });
    if (std::ranges::find(shown, near) == shown.end()) shown.push_back(near);
  }
  for (const double r : shown) {
    FigureCurve c{fmt::format("r = {:g}", r), {}, {}};
    for (const auto& at : f.rows)
      if (at.roughness == r) {
        c.x.push_back(at.mu);
        c.y.push_back(at.albedo);
        c.y_error.push_back(at.error);
      }
    e.curves.push_back(std::move(c));
  }
  p.figures.push_back(std::move(e));
}

void add_forms(Pictures& p, const EnergyRows& r) {
  auto average = make_figure("average_loss");
  average.title = "Loss on average";
  average.note = "1 − 2 ∫ E μ dμ at F = 1, of every form";
  average.x = over_roughness();
  average.y = {"loss [%]"};
  for (const auto& f : r.forms) {
    add_form(p, f);
    FigureCurve c{name_of(f), {}, {}};
    c.label = name_of_form(f.name);
    c.dashed = f.name == form_id::smith;
    for (const auto& a : f.averages) {
      c.x.push_back(a.roughness);
      c.y.push_back(100 * (1 - a.albedo));
      c.y_error.push_back(100 * a.error);
    }
    average.curves.push_back(std::move(c));
  }
  if (!average.curves.empty()) p.figures.push_back(std::move(average));
}

// --- Bounces and compensations

using MaterialAt = EnergyMaterial::At;

void add_bounces(Pictures& p, const EnergyMaterial& m, double mu) {
  const FigureChoices choices{{"material", m.name}, {"angle", mu_name(mu)}};
  std::vector<MaterialAt> list;
  std::ranges::copy_if(m.rows, std::back_inserter(list),
                       [&](const MaterialAt& a) { return a.mu == mu; });
  const auto curve = [&](std::string name, auto value) {
    FigureCurve c{std::move(name), {}, {}};
    for (const auto& at : list) {
      c.x.push_back(at.roughness);
      c.y.push_back(value(at));
    }
    return c;
  };
  std::size_t most = 0;
  for (const auto& at : list) most = std::max(most, at.orders.size());

  auto f = make_figure("bounces", choices);
  f.title = "What leaves, by the number of facets met";
  f.note = fmt::format("{}, {}", m.name, mu_text(mu));
  f.x = over_roughness();
  f.y = {"albedo"};
  for (std::size_t n = 0; n < std::min<std::size_t>(5, most); ++n)
    f.curves.push_back(
        curve(n == 0 ? "after one bounce" : fmt::format("after {}", n + 1),
              [n](const MaterialAt& a) { return n < a.orders.size() ? a.orders[n] : 0; }));
  f.curves.push_back(curve("all", [](const MaterialAt& a) { return a.truth; }));
  f.curves.back().dashed = true;
  for (const auto& at : list) f.curves.back().y_error.push_back(at.error);
  const std::string note = f.note;
  p.figures.push_back(std::move(f));

  auto g = make_figure("beyond", choices);
  g.title = "Share that a simulation cut off there misses";
  g.note = note;
  g.x = over_roughness();
  g.y = {"share of what leaves [%]"};
  for (const std::size_t n : {1U, 2U, 3U, 5U})
    g.curves.push_back(curve(
        n == 1 ? "after more than one" : fmt::format("more than {}", n), [n](const MaterialAt& a) {
          const auto end =
              a.orders.begin() + static_cast<std::ptrdiff_t>(std::min(n, a.orders.size()));
          return 100 * (a.truth - std::accumulate(a.orders.begin(), end, 0.0)) / a.truth;
        }));
  p.figures.push_back(std::move(g));
}

/// Adds errors of the compensations where `shown` says so, over what `x` gives.
template <class Shown, class X>
void add_errors(Figure& f, const EnergyMaterial& m, Shown shown, X x) {
  for (const auto& at : m.rows) {
    if (!shown(at)) continue;
    for (const auto& s : at.scattering) {
      auto& c = curve_named(f, s.id.starts_with("scattering.") ? short_id(s.id) : s.id);
      c.label = name_of_form(s.id);
      c.x.push_back(x(at));
      c.y.push_back(s.albedo - at.truth);
    }
  }
}

void add_materials(Pictures& p, const EnergyRows& r) {
  for (const auto& m : r.materials) {
    const FigureAxis error{"E − truth"};
    for (const double mu : each_once(m.rows, &MaterialAt::mu)) {
      add_bounces(p, m, mu);
      auto f = make_figure("compensation", {{"material", m.name}, {"angle", mu_name(mu)}});
      f.title = "Error over roughness";
      f.note = fmt::format("{}, {}", m.name, mu_text(mu));
      f.x = over_roughness();
      f.y = error;
      add_errors(
          f, m, [&](const MaterialAt& a) { return a.mu == mu; },
          [](const MaterialAt& a) { return a.roughness; });
      p.figures.push_back(std::move(f));
    }
    const double rough = std::ranges::max(m.rows, {}, &MaterialAt::roughness).roughness;
    auto f = make_figure("compensation_by_angle", {{"material", m.name}});
    f.title = "Error over the angle";
    f.note = fmt::format("{}, roughness {:g}", m.name, rough);
    f.x = over_mu();
    f.y = error;
    add_errors(
        f, m, [&](const MaterialAt& a) { return a.mu > 0 && a.roughness == rough; },
        [](const MaterialAt& a) { return a.mu; });
    p.figures.push_back(std::move(f));
  }
}

// --- Error against time

void add_estimators(Pictures& p, const EnergyRows& r) {
  const auto place = [](const EstimatorPoint& e) { return std::pair{e.roughness, e.mu}; };
  for (const auto& at : each_once(r.estimators, place)) {
    auto f = make_figure("estimators", {{"roughness", fmt::format("{:g}", at.first)},
                                        {"mu", fmt::format("{:g}", at.second)}});
    f.title = fmt::format("roughness {:g}, μ = {:g}", at.first, at.second);
    f.note = "one E(μ, α) of GGX at F = 1, on one thread";
    f.x = {"time [ns]", true};
    f.y = {"error of E", true};
    for (const auto& e : r.estimators) {
      if (place(e) != at) continue;
      auto& c = curve_named(f, e.estimator, FigureCurve::Kind::both);
      c.x.push_back(e.ns);
      c.y.push_back(std::max(e.error, 1e-13));  // the truth is known to that
      c.x_error.push_back(e.ns_spread);
    }
    p.figures.push_back(std::move(f));
  }
}

// --- Image-based light

void add_split_sum(Pictures& p, const EnergyRows& r) {
  if (r.light.table_samples.empty()) return;
  auto f = make_figure("split_sum_samples");
  f.title = "A and B by importance sampling";
  f.note = "Hammersley points from D, against quadrature, 16 × 16 texels";
  f.x = {"samples", true};
  f.y = {"error", true};
  for (const auto& [name, value] :
       {std::pair{"A, most", &TableSamples::a}, std::pair{"A, RMS", &TableSamples::a_rms},
        std::pair{"B, most", &TableSamples::b}, std::pair{"B, RMS", &TableSamples::b_rms}}) {
    FigureCurve c{name, {}, {}, FigureCurve::Kind::both};
    for (const auto& t : r.light.table_samples) {
      c.x.push_back(static_cast<double>(t.samples));
      c.y.push_back(t.*value);
    }
    f.curves.push_back(std::move(c));
  }
  p.figures.push_back(std::move(f));
}

std::string rule_name(std::string_view rule) {
  if (rule == "riemann") return "equal steps in θ and φ, low ends";
  if (rule == "riemann_midpoint") return "equal steps, middles";
  if (rule == "cosine") return "drawn from the cosine";
  std::string name(rule);
  std::ranges::replace(name, '_', ' ');
  return name;
}

void add_irradiance(Pictures& p, const EnergyRows& r) {
  for (const bool time : {false, true})
    for (const auto& light : each_once(r.light.irradiance, &IrradianceRow::light)) {
      auto f =
          make_figure(time ? "irradiance_by_time" : "irradiance_by_samples", {{"light", light}});
      f.title = light;
      f.note = "RMS over normals, relative to the exact value";
      f.x = {time ? "time of one normal [ns]" : "samples", true};
      f.y = {"RMS error [%]", true};
      for (const auto& i : r.light.irradiance) {
        if (i.light != light) continue;
        auto& c = curve_named(f, rule_name(i.rule), FigureCurve::Kind::both);
        c.x.push_back(time ? i.ns : static_cast<double>(i.samples));
        c.y.push_back(100 * i.rms);
        if (time) c.x_error.push_back(i.spread_ns);
      }
      p.figures.push_back(std::move(f));
    }
}

}  // namespace

Pictures pictures(const EnergyRows& r) {
  Pictures p;
  add_forms(p, r);
  add_materials(p, r);
  add_estimators(p, r);
  add_split_sum(p, r);
  add_irradiance(p, r);
  return p;
}

}  // namespace gonio
