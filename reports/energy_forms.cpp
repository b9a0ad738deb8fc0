// What every masking form loses at F = 1, by roughness and angle.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "brdf/presets.h"
#include "brdf/registry.h"
#include "integrate/directional_albedo.h"
#include "reports/energy_parts.h"
#include "reports/masking_shape.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

namespace gonio {
namespace {

constexpr double pi = std::numbers::pi;
constexpr Goal goal{1e-5, 400'000};

/// The models in white, and by what an engine divides that keeps its lights without 1/π.
struct WhiteModel {
  std::string_view id;
  double divisor;
};
constexpr WhiteModel white_models[] = {
    {"model.ue_mobile", pi}, {"model.ue_mobile_simple", pi}, {"model.unity_mobile", 1}};

std::vector<EnergyForm> all_forms() {
  std::vector<EnergyForm> out;
  for (const auto& t : catalogue()) {
    const std::string masking(t.about->id);
    if (role_of(masking) != Role::masking || t.anisotropic) continue;
    const std::string ndf = "ndf." + std::string(shape_of_term(masking));
    if (ndf != "ndf.gtr") {
      out.push_back({masking, ndf, masking, "", 0, 1, {}, {}, {}});
      continue;
    }
    for (const double gamma : {1.5, 3.0})
      out.push_back(
          {fmt::format("{}, gamma {}", masking, gamma), ndf, masking, "", gamma, 1, {}, {}, {}});
  }
  for (const auto& m : white_models) {
    const std::string spec(find_preset(m.id)->spec);
    const auto first = spec.find('/');
    out.push_back({std::string(m.id),
                   "ndf." + spec.substr(0, first),
                   "masking." + spec.substr(first + 1, spec.rfind('/') - first - 1),
                   std::string(m.id),
                   0,
                   m.divisor,
                   {},
                   {},
                   {}});
  }
  return out;
}

BoundModel bound(const EnergyForm& f, double roughness) {
  if (!f.model.empty())
    return bind_model(f.model, {{"roughness", {roughness}}, {"specular_color", {1}}}, 1);
  std::vector<Setting> s{{"alpha", {roughness * roughness}}, {"f0", {1}}};
  if (f.gamma > 0) s.push_back({"gamma", {f.gamma}});
  return bind_model(fmt::format("{}/{}/constant", short_id(f.ndf), short_id(f.masking)), s, 1);
}

/// E and its bound, as an engine has it; mu 0 is the average.
std::pair<double, double> albedo(const EnergyForm& f, double roughness, double mu) {
  const auto b = bound(f, roughness);
  const auto a =
      mu > 0 ? directional_albedo(b, {&mu, 1}, 0, goal)[0] : hemispherical_albedo(b, goal);
  return {a.value[0] / f.divisor, a.error / f.divisor};
}

struct Side {
  double at, value;
};
/// Where f passes 0 between two places on either side of it, to 5e-4: the chord's zero time and again, the
/// side that stays halved (the Illinois method).
double between(const std::function<double(double)>& f, Side a, Side b) {
  while (std::abs(b.at - a.at) > 5e-4) {
    const double x = b.at - b.value * (b.at - a.at) / (b.value - a.value), y = f(x);
    if (std::abs(x - b.at) < 2.5e-4) return x;
    if ((y > 0) == (b.value > 0))
      a.value /= 2;
    else
      a = b;
    b = {x, y};
  }
  return b.at;
}

std::vector<Crossing> crossings(const EnergyForm& f) {
  std::vector<Crossing> out;
  for (const double mu : crossing_mu) {
    const auto loss = [&](double r) { return 1 - albedo(f, r, mu).first; };
    std::vector<double> at, losses;
    if (mu > 0) {
      for (const auto& row : f.rows)
        if (row.mu == mu) at.push_back(row.roughness), losses.push_back(1 - row.albedo);
    } else {
      for (const auto& a : f.averages) at.push_back(a.roughness), losses.push_back(1 - a.albedo);
    }
    for (const double share : crossing_shares) {
      double r = std::numeric_limits<double>::quiet_NaN();
      const auto first = std::ranges::find_if(losses, [&](double l) { return l > share; });
      if (first == losses.begin()) {
        r = 0;
      } else if (first != losses.end()) {
        const auto i = static_cast<std::size_t>(first - losses.begin());
        const auto beyond = [&](double x) { return loss(x) - share; };
        r = between(beyond, {at[i - 1], losses[i - 1] - share}, {at[i], losses[i] - share});
      }
      out.push_back({share, mu, r});
    }
  }
  return out;
}

}  // namespace

void add_forms(EnergyReport& report,
               const EnergyOptions& o,
               const std::function<void(double)>& done) {
  const auto &roughness = o.roughness, &mu = o.mu;
  report.forms = all_forms();
  if (!o.forms.empty())
    std::erase_if(report.forms, [&](const EnergyForm& f) {
      return std::ranges::find(o.forms, f.name) == o.forms.end();
    });
  std::size_t finished = 0;
  for (std::size_t i = 0; i < report.forms.size(); ++i) {
    auto& f = report.forms[i];
    f.rows.resize(roughness.size() * mu.size());
    f.averages.resize(roughness.size());
    tbb::parallel_for(std::size_t{0}, roughness.size(), [&](std::size_t r) {
      const auto b = bound(f, roughness[r]);
      const auto at = directional_albedo(b, mu, 0, goal);
      for (std::size_t m = 0; m < mu.size(); ++m)
        f.rows[r * mu.size() + m] = {roughness[r], mu[m], at[m].value[0] / f.divisor,
                                     at[m].error / f.divisor};
      const auto [average, error] = albedo(f, roughness[r], 0);
      f.averages[r] = {roughness[r], average, error};
    });
    f.crossings = crossings(f);
    done(static_cast<double>(++finished) / static_cast<double>(report.forms.size()));
  }
}

}  // namespace gonio
