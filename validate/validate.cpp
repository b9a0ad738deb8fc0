#include "validate/validate.h"

#include <algorithm>
#include <utility>

#include "base/error.h"
#include "validate/measure.h"

#include <fmt/format.h>

namespace gonio {
namespace {

using namespace validating;

/// Albedo of the choice, and of its reference, by the cosine, at the ends of the roughness and between.
void add_curves(Pictures& to, const Choice& c) {
  const auto s = substances(c).front();
  const auto mu = steps(c.domain.mu.value_or(Choice::Ends{0.05, 1}), 24);
  const auto rough = roughnesses(c);
  Figure f = make_figure("albedo");
  f.title = s.name.empty() ? "Directional albedo" : "Directional albedo, " + s.name;
  f.x = {"cosine of the view and the normal", false};
  f.y = {"directional albedo", false};
  std::vector<double> shown{rough.front()};
  if (rough.size() > 1) shown = {rough.front(), rough[rough.size() / 2], rough.back()};
  // A side whose parameters set its width has one curve, whatever the domain's roughness.
  const auto varies = [&](const Shipped& side) {
    return bound(c, side, s, rough.front()).values != bound(c, side, s, rough.back()).values;
  };
  for (const double r : shown) {
    const auto add = [&](const char* name, const Shipped& side, bool dashed) {
      if (r != shown.front() && !varies(side)) return;
      FigureCurve curve;
      curve.name = varies(side) ? fmt::format("{}, roughness {:.2g}", name, r) : name;
      curve.dashed = dashed;
      curve.x = mu;
      for (const auto& e : albedos(side, bound(c, side, s, r), mu))
        curve.y.push_back(e[e.size() / 2]);
      f.curves.push_back(std::move(curve));
    };
    add("choice", c.shipped, false);
    if (c.has_reference) add("reference", c.reference, true);
  }
  to.figures.push_back(std::move(f));
}

}  // namespace

std::vector<validating::NamedCheck> validating::checks_of(const Choice& c, const Effort& effort) {
  const Budgets& b = c.budgets;
  std::vector<NamedCheck> all;
  const auto add = [&](bool asked, const char* what, auto check) {
    if (!asked) return;
    all.push_back({what, [&c, effort, check](const std::function<void(double)>& part) {
                     if constexpr (std::is_invocable_v<decltype(check), const Choice&>)
                       return check(c);
                     else
                       return check(c, effort, part);
                   }});
  };
  add(b.operations.has_value(), "operations", check_operations);
  add(b.table_bytes.has_value(), "tables", check_table_bytes);
  add(b.fresnel_error.has_value(), "Fresnel", check_fresnel_error);
  add(b.albedo_error.has_value(), "albedo", check_albedo_error);
  add(b.delta_e_2000.has_value(), "colour", check_delta_e);
  add(b.energy_gain.has_value(), "energy gained", check_energy_gain);
  add(b.energy_loss.has_value(), "energy lost", check_energy_loss);
  add(b.reciprocity.has_value(), "reciprocity", check_reciprocity);
  add(b.nonfinite.has_value(), "precision", check_nonfinite);
  add(b.ns.has_value(), "time", check_time);
  return all;
}

bool Validation::holds() const {
  return std::ranges::all_of(budgets, &BudgetCheck::holds);
}

Validation validate(const Choice& c, const ReportProgress& done) try {
  Validation v{c.path,
               c.shipped.model,
               std::string(name_of(c.shipped.scattering)),
               c.has_reference ? c.reference.model : "",
               used_parameters(c, c.shipped),
               c.has_reference ? used_parameters(c, c.reference) : std::vector<UsedParameter>{},
               c.number,
               {}};
  const auto all = checks_of(c);
  const auto n = static_cast<double>(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto from = static_cast<double>(i);
    v.budgets.push_back(all[i].check(part_of(done, all[i].what, from / n, (from + 1) / n)));
  }
  if (!c.shipped.composed().lobes.empty()) add_curves(v.pictures, c);
  return v;
} catch (const Error& e) {
  if (e.code() != Exit::usage) throw;
  throw bad_input(c.path, "/model", e.what(), "a model that its budgets can be asked of");
}

}  // namespace gonio
