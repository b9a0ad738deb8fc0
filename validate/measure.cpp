#include "validate/measure.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "brdf/catalogue/registry.h"
#include "brdf/model/evaluate.h"
#include "geometry/half_difference.h"
#include "image/display.h"
#include "integrate/scattering/compensation.h"
#include "validate/coat.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gonio::validating {
namespace {

constexpr std::string_view searched = "searched";

std::vector<std::vector<double>> values_of(const std::vector<Albedo>& all) {
  std::vector<std::vector<double>> out;
  for (const auto& a : all) out.push_back(a.value);
  return out;
}

/// Way by which a compensation is known to the integrals; none of single scattering and of all of it.
std::optional<Compensation> compensation_of(Bounces b) {
  return find_value<Compensation>(name_of(b));
}

double greatest(const std::vector<double>& all) {
  double most = -HUGE_VAL;
  for (const double x : all) most = worse(most, x);
  return most;
}

/// A check whose worst is at a point of the domain.
BudgetCheck checked(const Choice& c, std::string budget, double limit, const Found& w) {
  BudgetCheck out{std::move(budget), limit, w.value, w.value <= limit, std::string(searched)};
  if (w.value == 0) return out;  // nowhere
  if (c.domain.roughness) out.at.emplace_back("roughness", w.at.roughness);
  out.at.emplace_back("mu", w.at.mu);
  out.substance = w.at.substance.name;
  return out;
}

BudgetCheck worst_checked(const Choice& c,
                          std::string budget,
                          double limit,
                          const Effort& effort,
                          const ErrorAt& error,
                          const std::function<void(double)>& done) {
  return checked(c, std::move(budget), limit,
                 worst(c, effort, on_grid(c, effort, error, done), error));
}

/// Albedos that a search may have found before, by a text that says all that they depend on.
template <class Compute>
std::vector<std::vector<double>> known_or(const Effort& effort,
                                          const std::string& key,
                                          const Compute& compute) {
  if (!effort.known) return compute();
  const auto at = effort.known->find(key);
  return at != effort.known->end() ? at->second : (*effort.known)[key] = compute();
}
std::string key_of(std::string_view of,
                   const Shipped& side,
                   std::span<const double> values,
                   std::span<const double> mu) {
  return fmt::format("{} {} {} {}", of, name_of(side.scattering), fmt::join(values, ","),
                     fmt::join(mu, ","));
}

ErrorAt against_reference(const Choice& c, const Effort& effort, auto difference) {
  return
      [&c, &effort, difference](const Substance& s, double roughness, std::span<const double> mu) {
        const auto of = [&](const Shipped& side) {
          const BoundModel b = bound(c, side, s, roughness);
          const auto compute = [&] { return albedos(side, b, mu, effort); };
          return side.coating
                     ? compute()
                     : known_or(effort, key_of(to_text(b.model.spec), side, b.values, mu), compute);
        };
        const auto shipped = of(c.shipped), reference = of(c.reference);
        std::vector<double> out;
        for (std::size_t m = 0; m < mu.size(); ++m)
          out.push_back(difference(shipped[m], reference[m]));
        return out;
      };
}

/// Lobes alone, with F = 1.
BoundModel white_lobes(const BoundModel& b) {
  BoundModel f = furnace(b);
  f.model.diffuse.clear();
  return f;
}

/// Albedos of the white lobes, which do not depend on the Fresnel term.
std::vector<std::vector<double>> white_albedos(const Shipped& side,
                                               const BoundModel& b,
                                               std::span<const double> mu,
                                               const Effort& effort) {
  std::string of = "white";
  std::vector<double> values;
  for (const Lobe& lobe : b.model.lobes)
    for (const TermUse* t : {&lobe.ndf, &lobe.masking}) {
      of += fmt::format(" {}", t->term);
      for (const std::size_t p : t->parameters)
        values.push_back(b.values[b.model.parameters[p].first]);
    }
  return known_or(effort, key_of(of, side, values, mu),
                  [&] { return albedos(white_lobes(b), side.scattering, mu, effort); });
}

/// What of a model is known to gain energy by its formula; "" if nothing is.
std::string why_energy_is_gained(const Choice& c) {
  const BoundModel b = bound(c, c.shipped, substances(c).front(), roughnesses(c).front());
  const auto id = [](const TermUse& t) { return catalogue()[t.term].about->id; };
  for (const Lobe& lobe : b.model.lobes) {
    if (id(lobe.ndf) != "ndf.gtr1" || !id(lobe.masking).starts_with("masking.smith_gtr.")) continue;
    for (const std::size_t p : lobe.masking.parameters)
      if (const auto& of = b.model.parameters[p];
          of.name.starts_with("gamma") && b.values[of.first] != 1)
        return fmt::format(
            "The masking is that of gamma {:g}, the distribution has gamma 1: what one shows the "
            "other does not hide",
            b.values[of.first]);
  }
  for (const TermUse& t : b.model.diffuse)
    if (catalogue()[t.term].coupled)
      return "The diffuse term leaves 1 − F of the half vector, and at grazing angles the lobe "
             "reflects more than that F";
  return "";
}

}  // namespace

std::vector<std::vector<double>> albedos(const BoundModel& b,
                                         Bounces bounces,
                                         std::span<const double> mu,
                                         const Effort& effort) {
  const Goal& goal = effort.goal;
  if (const auto how = compensation_of(bounces))
    return values_of(compensated_albedo(b, *how, mu, 0, goal));
  if (bounces == Bounces::single) return values_of(directional_albedo(b, mu, 0, goal));
  const auto lobes = half_space(b, mu, 1e-5);
  const auto diffuse = diffuse_albedo(b, mu, 0, goal);
  std::vector<std::vector<double>> out;
  for (std::size_t m = 0; m < mu.size(); ++m)
    out.push_back(with_diffuse(lobes.at[m], diffuse[m]).value);
  return out;
}

std::vector<std::vector<double>> albedos(const Shipped& side,
                                         const BoundModel& b,
                                         std::span<const double> mu,
                                         const Effort& effort) {
  return side.coating ? Coated(b, *side.coating).albedos(mu)
                      : albedos(b, side.scattering, mu, effort);
}

BudgetCheck check_albedo_error(const Choice& c,
                               const Effort& effort,
                               const std::function<void(double)>& done) {
  const auto largest = [](const std::vector<double>& a, const std::vector<double>& b) {
    double most = 0;
    for (std::size_t k = 0; k < a.size(); ++k)
      if (const double off = a[k] - b[k]; worse(std::abs(most), std::abs(off)) != std::abs(most))
        most = off;
    return most;
  };
  const auto error = against_reference(
      c, effort, [&](const auto& a, const auto& b) { return std::abs(largest(a, b)); });
  const auto w = worst(c, effort, on_grid(c, effort, error, done), error);
  auto out = checked(c, "albedo_error", *c.budgets.albedo_error, w);
  if (out.holds) return out;
  const auto off = against_reference(c, effort, largest)(w.at.substance, w.at.roughness,
                                                         std::span(&w.at.mu, 1))[0];
  out.words = off < 0 ? "The model is too dark" : "The model is too bright";
  return out;
}

BudgetCheck check_delta_e(const Choice& c,
                          const Effort& effort,
                          const std::function<void(double)>& done) {
  const auto& budget = *c.budgets.delta_e_2000;
  const auto error =
      against_reference(c, effort, [](const std::vector<double>& a, const std::vector<double>& b) {
        return delta_e_2000(lab_of_albedo(a), lab_of_albedo(b));
      });
  auto grid = on_grid(c, effort, error, done);
  if (budget.quantile >= 1)
    return checked(c, "delta_e_2000", budget.limit, worst(c, effort, grid, error));
  std::ranges::stable_sort(grid, {}, &Found::value);
  const auto n = static_cast<double>(grid.size());
  const auto at = static_cast<std::size_t>(std::max(std::ceil(budget.quantile * n) - 1, 0.0));
  return checked(c, "delta_e_2000", budget.limit, grid[at]);
}

BudgetCheck check_energy_gain(const Choice& c,
                              const Effort& effort,
                              const std::function<void(double)>& done) {
  const auto error = [&](const Substance& s, double roughness, std::span<const double> mu) {
    const BoundModel b = bound(c, c.shipped, s, roughness);
    const auto as_it_is = albedos(c.shipped, b, mu, effort);
    const auto white = b.model.lobes.empty() ? as_it_is : white_albedos(c.shipped, b, mu, effort);
    std::vector<double> out;
    for (std::size_t m = 0; m < mu.size(); ++m)
      out.push_back(worse(0, worse(greatest(as_it_is[m]), greatest(white[m])) - 1));
    return out;
  };
  BudgetCheck out = worst_checked(c, "energy_gain", *c.budgets.energy_gain, effort, error, done);
  if (!out.holds) out.words = why_energy_is_gained(c);
  return out;
}

BudgetCheck check_energy_loss(const Choice& c,
                              const Effort& effort,
                              const std::function<void(double)>& done) {
  const auto error = [&](const Substance& s, double roughness, std::span<const double> mu) {
    const BoundModel b = bound(c, c.shipped, s, roughness);
    std::vector<double> out;
    for (const auto& albedo : white_albedos(c.shipped, b, mu, effort)) {
      double lost = 0;
      for (const double e : albedo) lost = worse(lost, 1 - e);
      out.push_back(lost);
    }
    return out;
  };
  return worst_checked(c, "energy_loss", *c.budgets.energy_loss, effort, error, done);
}

BudgetCheck check_fresnel_error(const Choice& c) {
  const AngleSteps at = angle_steps(360);
  BudgetCheck out{"fresnel_error", *c.budgets.fresnel_error, -1, true, std::string(searched)};
  double theta = 0;
  for (const auto& s : substances(c)) {
    const BoundModel b = bound(c, c.shipped, s, 1);
    const auto exact = exact_values(*s.surface, at.cosine);
    const std::size_t term = b.model.lobes[0].fresnel.term;
    FresnelForm form{std::string(catalogue()[term].about->id), term};
    for (const auto& [name, values] : named_values(b)) form.settings.push_back({name, values});
    for (std::size_t k = 0; k < exact.size(); ++k) {
      const auto f = form_values(form, *s.surface, k, at.cosine);
      for (std::size_t i = 0; i < f.size(); ++i)
        if (const double off = std::abs(f[i] - exact[k][i]); !(off <= out.found)) {
          out.found = off;
          out.substance = s.name;
          theta = at.theta_deg[i];
        }
    }
  }
  out.at = {{"theta", theta}};
  out.holds = out.found <= out.limit;
  return out;
}

BudgetCheck check_reciprocity(const Choice& c,
                              const Effort& effort,
                              const std::function<void(double)>& done) {
  if (c.shipped.scattering == Bounces::fdez_aguera ||
      c.shipped.scattering == Bounces::deterministic)
    throw bad_input(c.path, "/budgets/reciprocity",
                    fmt::format("scattering {}, which has no f of two directions",
                                name_of(c.shipped.scattering)),
                    "single, turquin or kulla_conty");
  constexpr int turns = 13;
  const auto error = [&](const Substance& s, double roughness, std::span<const double> mu) {
    const BoundModel b = bound(c, c.shipped, s, roughness);
    std::vector<double> others = cosines(c, effort);
    const auto relative = [&](double light, double view) {
      std::vector<FrameAngles<double>> there, back;
      for (int k = 0; k < turns; ++k) {
        const double phi = std::numbers::pi * k / (turns - 1);
        const Direction l = direction(std::acos(light), 0.4),
                        v = direction(std::acos(view), 0.4 + phi);
        there.push_back(frame_angles({l, v}));
        back.push_back(frame_angles({v, l}));
      }
      if (!c.shipped.coating) return std::pair(evaluate(b, there), evaluate(b, back));
      const Coated coated(b, *c.shipped.coating);
      return std::pair(coated.values(there), coated.values(back));
    };
    // What Turquin's factor does: 1 + F0 (1/E − 1), E of the viewer's direction.
    const auto factor = [&](std::span<const double> at) {
      std::vector<std::vector<double>> out(at.size(), std::vector<double>(b.model.channels, 1.0));
      if (c.shipped.scattering != Bounces::turquin || b.model.lobes.empty()) return out;
      const auto bright = albedos(b, Bounces::turquin, at, effort),
                 plain = albedos(b, Bounces::single, at, effort);
      for (std::size_t m = 0; m < at.size(); ++m)
        for (std::size_t k = 0; k < out[m].size(); ++k)
          if (plain[m][k] > 0) out[m][k] = bright[m][k] / plain[m][k];
      return out;
    };
    const auto mine = factor(mu), theirs = factor(others);
    std::vector<double> out;
    for (std::size_t m = 0; m < mu.size(); ++m) {
      double most = 0;
      for (std::size_t o = 0; o < others.size(); ++o) {
        const auto [f, g] = relative(mu[m], others[o]);
        for (std::size_t k = 0; k < f.size(); ++k)
          for (std::size_t i = 0; i < f[k].size(); ++i) {
            const double there = f[k][i] * theirs[o][k], back = g[k][i] * mine[m][k];
            const double larger = std::max(std::abs(there), std::abs(back));
            if (!(larger <= 0)) most = worse(most, std::abs(there - back) / larger);
          }
      }
      out.push_back(most);
    }
    return out;
  };
  return worst_checked(c, "reciprocity", *c.budgets.reciprocity, effort, error, done);
}

}  // namespace gonio::validating
