// What leaves after all bounces, material by material, and how far from it each compensation ends.
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numeric>

#include "brdf/catalogue/registry.h"
#include "integrate/scattering/compensation.h"
#include "integrate/scattering/half_space.h"
#include "optics/spectrum.h"
#include "reports/energy/crossings.h"

#include <fmt/format.h>

namespace gonio {
namespace {

/// Materials that are sums over the channels of one model.
struct Family {
  std::string_view fresnel;
  std::vector<Setting> settings;
  struct Member {
    std::string name;
    std::vector<double> weight;  ///< by channel of the model
    double normal;               ///< reflectance at normal incidence
  };
  std::vector<Member> members;
  std::size_t channels() const { return members[0].weight.size(); }
};

constexpr std::string_view schlick = "schlick";

Family schlick_family() {
  constexpr std::array f0{1.0, 0.9, 0.5, 0.04};
  Family f{schlick, {{"f0", {f0.begin(), f0.end()}}}, {}};
  for (std::size_t k = 0; k < f0.size(); ++k) {
    std::vector<double> one(f0.size());
    one[k] = 1;
    f.members.push_back({f0[k] == 1 ? "F = 1" : fmt::format("F0 = {:g}", f0[k]), one, f0[k]});
  }
  return f;
}

/// Gold by its spectrum: what it reflects in each band of wavelengths, seen as linear sRGB under D65.
Family gold_family() {
  constexpr std::array channels{"red", "green", "blue"};
  const auto& gold = *find_metal("Au");
  const auto normal = reflectance_rgb(gold, 1);
  Setting eta{"eta", {}}, k{"k", {}};
  Family f{"conductor", {}, {}};
  for (std::size_t c = 0; c < channels.size(); ++c)
    f.members.push_back(
        {fmt::format("gold, {}", channels[c]), {}, std::clamp(normal[c], 0.0, 1.0)});
  for (const auto& band : waveband_colours()) {
    const auto index = gold.at(band.nm);
    eta.values.push_back(index.n);
    k.values.push_back(index.k);
    for (std::size_t c = 0; c < channels.size(); ++c) f.members[c].weight.push_back(band.rgb[c]);
  }
  f.settings = {eta, k};
  return f;
}

/// Σ weight · value, over channels.
double weighted(const std::vector<double>& weight, const std::vector<double>& value) {
  return std::inner_product(weight.begin(), weight.end(), value.begin(), 0.0);
}

/// What leaves at a roughness between those that were solved, by the polynomial through the four nearest.
/// \return  its error: what the polynomial through three of them differs by
Bounded between(std::span<const double> x, std::span<const Bounded> y, double at) {
  const auto n = x.size();
  const auto above = static_cast<std::size_t>(std::ranges::upper_bound(x, at) - x.begin());
  const std::size_t count = std::min<std::size_t>(4, n),
                    first = std::min(above < 2 ? 0 : above - 2, n - count);
  const auto through = [&](std::size_t from, std::size_t to) {
    double sum = 0;
    for (std::size_t i = from; i < to; ++i) {
      double product = y[i].value;
      for (std::size_t k = from; k < to; ++k)
        if (k != i) product *= (at - x[k]) / (x[i] - x[k]);
      sum += product;
    }
    return sum;
  };
  const double value = through(first, first + count);
  double error = std::abs(value - through(first, first + count - 1));
  for (std::size_t i = first; i < first + count; ++i) error = std::max(error, y[i].error);
  return {value, error};
}

BoundModel bound(const Family& family, double roughness) {
  auto settings = family.settings;
  settings.push_back({"alpha", {roughness * roughness}});
  return bind_model(fmt::format("ggx/smith_ggx.correlated/{}", family.fresnel), settings,
                    family.channels());
}

/// Crossings of the loss as a share of what should leave.
std::vector<Crossing> crossings(const EnergyMaterial& m,
                                const Family& family,
                                const Family::Member& member) {
  const auto known = [&](double mu) {
    KnownLosses k;
    for (const auto& at : m.rows)
      if (at.mu == mu) {
        k.roughness.push_back(at.roughness);
        k.loss.push_back(1 - at.orders[0] / at.truth);
      }
    return k;
  };
  return gather_crossings(known, [&](double mu, double roughness) {
    std::vector<double> x;
    std::vector<Bounded> truth;
    for (const auto& at : m.rows)
      if (at.mu == mu) x.push_back(at.roughness), truth.push_back({at.truth, at.error});
    const auto all = between(x, truth, roughness);
    const auto b = bound(family, roughness);
    const auto single = mu == 0 ? hemispherical_albedo(b, fine_goal)
                                : directional_albedo(b, {&mu, 1}, 0, fine_goal)[0];
    const double part = weighted(member.weight, single.value) / all.value;
    return Bounded{1 - part, (single.error + part * all.error) / all.value};
  });
}

/// One roughness: a row for each channel's material at each mu and on average (mu 0).
std::vector<std::vector<EnergyMaterial::At>> solve(const Family& family,
                                                   double roughness,
                                                   const std::vector<double>& mu) {
  const auto model = bound(family, roughness);
  const auto all = half_space(model, mu, 1e-5);
  std::vector<std::vector<EnergyMaterial::At>> rows(family.members.size());
  for (std::size_t m = 0; m < rows.size(); ++m) {
    const auto& weight = family.members[m].weight;
    const auto put = [&](double at, const Scattered& s) {
      EnergyMaterial::At row{roughness, at, weighted(weight, s.albedo), 0, {}, {}};
      for (std::size_t c = 0; c < weight.size(); ++c) {
        row.error += std::abs(weight[c]) * s.error[c];
        row.orders.resize(std::max(row.orders.size(), s.order[c].size()), 0);
        for (std::size_t n = 0; n < s.order[c].size(); ++n)
          row.orders[n] += weight[c] * s.order[c][n];
      }
      row.scattering = {{"single", row.orders[0]}};
      rows[m].push_back(std::move(row));
    };
    for (std::size_t i = 0; i < mu.size(); ++i) put(mu[i], all.at[i]);
    put(0, all.average);
  }
  LobeAlbedos lobes;
  for (std::size_t m = 0; m < names_of<Compensation>.size(); ++m) {
    const auto how = static_cast<Compensation>(m);
    // A and B, by which it works, are of Schlick's Fresnel.
    if (how == Compensation::fdez_aguera && family.fresnel != schlick) continue;
    const auto at = compensated_albedo(model, how, mu, 0, fine_goal, &lobes);
    const auto average = compensated_average(model, how, fine_goal, &lobes);
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const auto& weight = family.members[k].weight;
      for (std::size_t i = 0; i < mu.size(); ++i)
        rows[k][i].scattering.push_back({names_of<Compensation>[m], weighted(weight, at[i].value)});
      rows[k].back().scattering.push_back(
          {names_of<Compensation>[m], weighted(weight, average.value)});
    }
  }
  return rows;
}

}  // namespace

std::vector<EnergyMaterial> energy_materials(const EnergyOptions& o,
                                             const std::function<void(double)>& done) {
  std::vector<EnergyMaterial> out;
  std::vector<Family> all{schlick_family()};
  if (o.gold) all.push_back(gold_family());
  const double steps = static_cast<double>(all.size() * o.roughness.size());
  std::size_t finished = 0;
  for (const auto& family : all) {
    const std::size_t first = out.size();
    for (const auto& m : family.members) {
      out.push_back({m.name, fmt::format("fresnel.{}", family.fresnel), {}, {}, m.normal});
      if (family.fresnel == schlick) out.back().f0 = m.normal;
    }
    for (const double r : o.roughness) {
      const auto rows = solve(family, r, o.mu);
      for (std::size_t m = 0; m < rows.size(); ++m)
        std::ranges::copy(rows[m], std::back_inserter(out[first + m].rows));
      done(static_cast<double>(++finished) / steps);
    }
    for (std::size_t m = 0; m < family.members.size(); ++m)
      out[first + m].crossings = crossings(out[first + m], family, family.members[m]);
  }
  return out;
}

}  // namespace gonio
