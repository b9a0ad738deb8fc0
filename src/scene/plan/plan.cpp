#include "scene/plan/plan.h"

#include <algorithm>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

#include "base/error.h"
#include "base/rounded.h"
#include "scene/plan/budget.h"
#include "scene/plan/confidence.h"
#include "scene/plan/cost.h"
#include "scene/plan/material_planner.h"
#include "scene/plan/reference.h"

#include <fmt/format.h>

namespace gonio::scene {

bool MaterialPlan::needs_table() const {
  return forms[Effect::compensation] == Form::tabulated;
}

std::string compensation_in_words(std::string_view form) {
  return form == "none"          ? "single scattering"
         : form == "kulla_conty" ? "Kulla and Conty's lobe"
         : form == "turquin"     ? "Turquin's factor"
         : form == "fdez_aguera" ? "Fdez-Agüera's factor"
                                 : "walks between facets";
}

double Candidate::spread() const {
  return std::max(ns_spread, least_spread * ns);
}

bool Candidate::is_as_fast_as(const Candidate& other) const {
  return are_too_near({counted_ns, spread()}, {other.counted_ns, other.spread()});
}

bool Candidate::is_simpler_than(const Candidate& other) const {
  return std::tuple(ops, kept(), forms.form) <
         std::tuple(other.ops, other.kept(), other.forms.form);
}

void count_times(std::vector<Candidate>& all, const Look& look) {
  const auto is_dearer = [&](const Candidate& a, const Candidate& b) {  // or the same
    for (std::size_t i = 0; i < effect_count; ++i) {
      const auto e = static_cast<Effect>(i);
      const auto& offered = look.offer(e).forms;  // cheapest first
      if (std::ranges::find(offered, a.forms[e]) < std::ranges::find(offered, b.forms[e]))
        return false;
    }
    return a.ops >= b.ops;
  };
  for (auto& c : all) {
    c.counted_ns = c.ns;
    for (const auto& other : all)
      if (other.ns < c.counted_ns && is_dearer(other, c)) c.counted_ns = other.ns;
  }
}

std::size_t Candidate::kept() const {
  std::size_t n = 0;
  for (std::size_t e = 0; e < effect_count; ++e) n += forms.keeps(static_cast<Effect>(e));
  return n;
}

namespace {

/// Says why each form that was measured, or proved to change little, is kept or dropped.
void give_reasons(MaterialPlan& p, const Tolerance& t, bool has_budget) {
  const auto unit = t.metric == Metric::relative ? "" : "ΔE2000 ";
  for (auto& e : p.effects) {
    if (e.why == Why::structural) continue;
    if (e.why == Why::proved) {
      e.reason = fmt::format("dropping it changes no point by more than {}{}, by proof", unit,
                             rounded_up(e.error_if_dropped));
      continue;
    }
    e.reason = fmt::format("dropping only this changes {} % of the points by more than {}{}",
                           in_percent(1 - t.quantile), unit, rounded_down(e.error_if_dropped));
    if (e.keep || e.error_if_dropped <= t.limit) continue;
    e.reason += p.holds ? ", but with the other forms of this plan the limit is kept, as its check "
                          "found"
                : has_budget
                    ? ", but no set that the budget allows keeps the tolerance with a plan's margin"
                    : ", but no set keeps the tolerance with a plan's margin and this one "
                      "is the closest";
  }
}

/// Shares the scene's time out, and checks what each material got.  Where a set fails there that had seemed to keep the tolerance, the
/// time is shared out anew.
void share(Plan& plan, const Lit& lit, const PlanOptions& options) {
  const Scene& s = lit.scene;
  std::vector<Sharer> sharers;
  for (auto& m : plan.materials) {
    std::ranges::sort(m.sets, [](auto& a, auto& b) { return a.is_simpler_than(b); });
    Sharer sharer{m.coverage, {}};
    for (const auto& c : m.sets)
      sharer.choices.push_back({c.ns * m.directions, c.error.upper,
                                c.error.worst > m.margin.most_worst, c.spread() * m.directions,
                                sharer.choices.size()});
    sharers.push_back(std::move(sharer));
  }
  std::vector<std::map<std::size_t, JudgedSet>> checked(plan.materials.size());
  const auto index_of = [&](const MaterialPlan& m) {
    return static_cast<std::size_t>(std::ranges::find(s.materials, m.name, &Material::name) -
                                    s.materials.begin());
  };
  const auto check = [&](const MaterialPlan& m, const Candidate& c) -> JudgedSet {
    const auto index = index_of(m);
    const Look& look = lit.looks[index];
    const Surface exact = look.surface(look.exact()), surface = look.surface(c.forms);
    FreshDifferences fresh;
    fresh.draw_to(fresh_points(s, options, surface), s, lit.drawer(index, options.directions),
                  checking, exact, surface);
    return {c.forms,  c.ns,
            c.ops,    judge(fresh.all, s.tolerance),
            m.margin, judge(fresh.own, s.tolerance).quantile};
  };
  Shares shares;
  for (bool again = true; again;) {
    shares = share_out(sharers, *s.budget_ns, s.tolerance.limit);
    again = false;
    for (std::size_t i = 0; i < plan.materials.size(); ++i) {
      auto& m = plan.materials[i];
      const std::size_t k = shares.choice[i];
      if (checked[i].contains(k)) continue;
      const auto& found = checked[i].emplace(k, check(m, m.sets[k])).first->second;
      if (found.keeps_margin()) continue;
      auto& choice = sharers[i].choices[k];
      again |= !choice.breaks && choice.error <= s.tolerance.limit;
      choice.error = std::max(choice.error, found.error.upper);
      choice.breaks = true;
      for (auto& each : m.front)
        if (each.forms == found.forms) each.failed = {found.error.worst, found.error.bound};
    }
  }
  plan.budget = Budget{*s.budget_ns, shares.ns, 0, shares.fits};
  for (std::size_t i = 0; i < plan.materials.size(); ++i) {
    auto& m = plan.materials[i];
    take(m, lit.looks[index_of(m)], checked[i].at(shares.choice[i]));
    m.ns_spread = m.sets[shares.choice[i]].spread();
    if (!m.needs_table()) m.without_table.reset();
    m.could_hold = std::ranges::any_of(m.front, [&](const Candidate& each) {
      return each.error.keeps(s.tolerance) && !each.failed;
    });
  }
  for (const auto& m : plan.materials)
    plan.budget->error = std::max(plan.budget->error, m.checked.upper);
}

/// Gives each material that an object has the plan of the first that is the same.
void name_all(Plan& plan, const Lit& lit) {
  const auto planned = std::exchange(plan.materials, {});
  const auto& all = lit.scene.materials;
  for (std::size_t m = 0; m < all.size(); ++m) {
    if (std::ranges::find(lit.scene.objects, m, &Object::material) == lit.scene.objects.end())
      continue;
    plan.materials.push_back(
        *std::ranges::find(planned, all[lit.same_as[m]].name, &MaterialPlan::name));
    plan.materials.back().name = all[m].name;
  }
}

/// Nothing is claimed beyond what was compared: nobody knows how far that is off.
void claim_no_bound(MaterialPlan& m) {
  constexpr double none = std::numeric_limits<double>::infinity();
  m.checked.upper = m.checked.bound = m.reference_error = m.shipped_upper = none;
  if (m.failed) m.failed->error.bound = m.failed->error.upper = none;
  for (auto& c : m.front) {
    c.error.upper = none;
    if (c.failed) c.failed->exceeding_bound = none;
  }
}

}  // namespace

std::size_t samples_of_verification(const Scene& s) {
  constexpr std::size_t most = 65'536;
  const std::size_t needed = draws_needed(s.tolerance.quantile, s.tolerance.confidence);
  if (4 * needed > most)
    throw bad_input(s.path, "/tolerance",
                    fmt::format("quantile {} with confidence {}, which {} points would show",
                                s.tolerance.quantile, s.tolerance.confidence, needed),
                    fmt::format("what {} points can show", most / 4));
  return std::max(verified_samples, 4 * needed);
}

Margin margin_of(const Scene& s) {
  constexpr double reserve = 0.9;  // no draw shows the very worst point
  return {
      share_that_passes(s.tolerance.quantile, samples_of_verification(s), s.tolerance.confidence),
      reserve * s.tolerance.max};
}

std::size_t points_of_plan(const Scene& s, std::size_t samples) {
  const std::size_t verified = samples_of_verification(s);
  return verified > verified_samples ? std::max(samples, verified / 2) : samples;
}

Plan plan_scene(const Scene& s, const PlanOptions& asked, const std::function<void(double)>& done) {
  PlanOptions options = asked;
  options.samples = points_of_plan(s, asked.samples);
  if (const std::size_t verified = samples_of_verification(s); verified > verified_samples)
    options.fresh = std::max(asked.fresh, 4 * verified);
  const Lit lit(s);
  Plan plan{s.sha256, s.tolerance, {}, {}, false, {}, options.cost};
  for (std::size_t m = 0; m < s.materials.size(); ++m) {
    if (lit.same_as[m] != m || !lit.is_seen(m)) continue;
    plan.materials.push_back(plan_material(lit, m, options));
    plan.materials.back().name = s.materials[m].name;
    if (done) done(static_cast<double>(m + 1) / static_cast<double>(s.materials.size()));
  }
  if (s.budget_ns) share(plan, lit, options);
  for (auto& m : plan.materials) {
    give_reasons(m, s.tolerance, s.budget_ns.has_value());
    if (!m.bounded) claim_no_bound(m);
  }
  name_all(plan, lit);
  plan.holds = std::ranges::all_of(plan.materials, &MaterialPlan::holds);
  std::vector<std::string> specs;
  for (auto& m : plan.materials) {
    m.spec = own_files_as_named(s.path, m.spec);
    specs.push_back(m.spec);
  }
  plan.shaders = own_files(specs, s.path);
  return plan;
}

}  // namespace gonio::scene
