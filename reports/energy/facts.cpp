// What the index decides by: what is seen of lost light and of each compensation, and what they
// take.
#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "image/display.h"
#include "reports/energy/energy.h"

namespace gonio {
namespace {

/// Cosine of the view from which on colours are compared, as in the report on Fresnel.
constexpr double least_mu = 0.1;

double delta_e_of_grey(double a, double b) {
  return delta_e_2000(lab_of_display({a, a, a}), lab_of_display({b, b, b}));
}

/// The way's entry, with a place for a roughness at its end.
Facts::Scattering& entry_of(std::vector<Facts::Scattering>& to,
                            std::string_view id,
                            double f0,
                            bool of_image_light,
                            double roughness) {
  auto of = std::ranges::find_if(to, [&](const Facts::Scattering& x) {
    return x.id == id && x.f0 == f0 && x.of_image_light == of_image_light;
  });
  if (of == to.end()) of = to.insert(of, {std::string(id), f0, of_image_light, {}, {}, {}});
  if (of->roughness.empty() || of->roughness.back() != roughness) {
    of->roughness.push_back(roughness);
    of->delta_e.push_back(0);
    of->error.push_back(0);
  }
  return *of;
}

void add_scattering(std::vector<Facts::Scattering>& to, const EnergyMaterial& m) {
  for (const auto& at : m.rows) {
    if (at.mu < least_mu) continue;  // the average, at 0, too
    for (const auto& s : at.scattering) {
      double& most = entry_of(to, s.id, *m.f0, true, at.roughness).delta_e.back();
      most = std::max(most, delta_e_of_grey(s.albedo, at.truth));
    }
  }
}

/// The table of 32 × 32 texels in half, and what the split is off by under skies by formula, and under the environments given.
void add_split_sum(Facts& to, const ImageLight& light) {
  const auto table = std::ranges::find_if(
      light.tables, [](const TableError& t) { return t.size == 32 && t.stored == "half"; });
  if (table == light.tables.end()) return;
  constexpr std::size_t bytes_of_texel = 2 * 2;
  Facts::SplitSum s{table->size, table->size * table->size * bytes_of_texel, table->lookup_rms};
  std::set<std::string_view> skies;
  for (const auto& l : light.lit) {
    if (l.f0 != 1) continue;  // white metal
    skies.insert(l.environment);
    auto* const seen = l.nov == 1     ? &s.head_on
                       : l.nov == 0.5 ? &s.from_side
                       : l.nov == 0.1 ? &s.grazing
                                      : nullptr;
    if (seen) *seen = std::max(seen->value_or(0), l.delta_e);
  }
  s.skies = skies.size();
  if (!light.costs.empty()) s.ns = light.costs[0].ns;  // the split sum's
  to.split_sum = s;
}

}  // namespace

Facts facts(const EnergyRows& r) {
  Facts f;
  add_split_sum(f, r.light);
  for (const auto& m : r.materials)
    if (m.f0) add_scattering(f.scattering, m);
  for (const auto& s : r.single_lights) {  // the lights of a roughness stand side by side
    auto& way = entry_of(f.scattering, s.id, s.f0, false, s.roughness);
    if (const double most = s.delta_e + s.error; most > way.delta_e.back())
      way.delta_e.back() = most, way.error.back() = s.error;
  }
  for (const auto& c : r.compensations)
    if (c.id != "single")
      f.compensations.push_back({std::string(c.id), c.id == "fdez_aguera", c.ns - c.without_ns,
                                 std::hypot(c.spread_ns, c.without_spread_ns), c.bytes,
                                 c.without_ns});
  return f;
}

}  // namespace gonio
