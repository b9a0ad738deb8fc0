// The pictures of the diffuse forms.
#include <algorithm>
#include <cmath>

#include "reports/diffuse/diffuse.h"

#include <fmt/format.h>

namespace gonio {
namespace {

void add_average(Pictures& p, const DiffuseRows& r) {
  auto f = make_figure("average");
  f.title = "What a white surface gives back";
  f.note = "on average over the hemisphere, at kd = 1; of coupled forms what the lobe leaves";
  f.x = over_roughness();
  f.y = {"average albedo"};
  for (const auto& form : r.forms) {
    FigureCurve c{form.name, {}, {}};
    for (const auto& row : r.rows)
      if (row.form == form.id && (c.x.empty() || c.x.back() != row.roughness)) {
        c.x.push_back(row.roughness);
        c.y.push_back(row.average);
      }
    f.curves.push_back(std::move(c));
  }
  if (!f.curves.empty()) p.figures.push_back(std::move(f));
}

void add_form(Pictures& p, const DiffuseForm& form, const DiffuseRows& r) {
  auto m = make_map("loss", {{"form", form.name}});
  m.title = fmt::format("Loss 1 − E of {}", form.name);
  m.note = "by roughness and angle; below 0 light is made";
  m.x = {"roughness", {}};
  m.y = {"μ = cos θ", {}};
  m.x.from = m.y.from = 0;
  m.x.to = m.y.to = 1;
  m.value = "loss 1 − E [%]";
  m.diverging = true;
  auto f = make_figure("albedo", {{"form", form.name}});
  f.title = fmt::format("E(μ) of {}", form.name);
  f.note = "kd = 1";
  f.x = {"μ = cos θ", false, 0, 1};
  f.y = {"E"};
  for (const auto& row : r.rows) {
    if (row.form != form.id) continue;
    if (m.x.at.empty() || m.x.at.back() != row.roughness) m.x.at.push_back(row.roughness);
    if (m.x.at.size() == 1) m.y.at.push_back(row.mu);
    m.values.push_back(100 * (1 - row.albedo));
    for (const double shown : {0.0, 0.2, 0.4, 0.6, 0.8, 1.0})
      if (std::abs(row.roughness - shown) < 1e-9) {
        auto& c = curve_named(f, fmt::format("r = {:g}", row.roughness));
        c.x.push_back(row.mu);
        c.y.push_back(row.albedo);
      }
  }
  if (!m.values.empty()) p.maps.push_back(std::move(m));
  if (!f.curves.empty()) p.figures.push_back(std::move(f));
}

void add_colours(Pictures& p, const DiffuseRows& r) {
  const auto name = [&](const std::string& id) { return find_form(r.forms, id)->name; };
  for (const auto& c : r.colours) {
    auto made = make_figure("delta_e",
                            {{"surface", c.surface}, {"material", c.material}, {"light", c.light}});
    auto at = std::ranges::find(p.figures, made.id, &Figure::id);
    if (at == p.figures.end()) {
      made.title = fmt::format("{}, {}, {}", c.material, c.surface, c.light);
      made.note = c.surface == "matte" ? "to EON" : "to EON below the lobe, coupled by albedos";
      made.x = over_roughness();
      made.y = {"most ΔE2000 of the points"};
      p.figures.push_back(std::move(made));
      at = p.figures.end() - 1;
    }
    auto& curve = curve_named(*at, name(c.form));
    curve.x.push_back(c.roughness);
    curve.y.push_back(c.delta_e);
  }
}

}  // namespace

Pictures pictures(const DiffuseRows& r) {
  Pictures p;
  add_average(p, r);
  for (const auto& f : r.forms) add_form(p, f, r);
  add_colours(p, r);
  return p;
}

}  // namespace gonio
