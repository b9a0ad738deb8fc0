// The cheapest choice that keeps every budget.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "base/error.h"
#include "brdf/catalogue/masking_shape.h"
#include "brdf/catalogue/registry.h"
#include "validate/measure.h"
#include "validate/words.h"

#include <fmt/format.h>

namespace gonio {
namespace {

using namespace validating;

/// The choice under another masking, Fresnel term or scattering, and what it costs.
struct Candidate {
  Choice choice;
  std::size_t operations;
  std::size_t changes;  ///< from the choice that was given
};

/// The choice's spec, whose only lobe is its first.
ModelSpec one_lobe(const Choice& c) {
  const Model m = c.shipped.composed();
  if (m.lobes.size() != 1 || m.anisotropic || c.shipped.coating)
    throw bad_input(c.path, "/model", fmt::format("'{}'", c.shipped.model),
                    "one isotropic lobe of D/V/F that is no coat: a suggestion exchanges those; of "
                    "a shader name one function, FILE:D/V/F");
  const auto name = [](const TermUse& t) {
    return std::string(short_id(catalogue()[t.term].id()));
  };
  const auto& [ndf, masking, fresnel] = m.lobes[0];
  return {m.diffuse.empty() ? "" : name(m.diffuse[0]), {{name(ndf), name(masking), name(fresnel)}}};
}

/// True of a term that the substances give all parameters, or that has them from the choice.
bool can_be(const Choice& c) {
  try {
    for (const auto& s : substances(c)) {
      const BoundModel b = bound(c, c.shipped, s, 1);
      for (const auto& p : b.model.lobes[0].fresnel.parameters) {
        const auto& name = b.model.parameters[p].name;
        if (std::ranges::find(b.given, name) == b.given.end()) return false;
      }
    }
    return true;
  } catch (const Error&) {  // the substance has no such parameters
    return false;
  }
}

std::vector<Candidate> candidates(const Choice& c) {
  const ModelSpec given = one_lobe(c);
  const LobeSpec& own = given.lobes[0];
  constexpr Bounces ways[] = {Bounces::single, Bounces::turquin, Bounces::kulla_conty};
  std::vector<Candidate> all;
  const auto add = [&](const std::string& masking, const std::string& fresnel, Bounces way) {
    Candidate x{c, 0,
                std::size_t{masking != own.masking} + std::size_t{fresnel != own.fresnel} +
                    std::size_t{way != c.shipped.scattering}};
    x.choice.shipped.model = to_text(ModelSpec{given.diffuse, {{own.ndf, masking, fresnel}}});
    x.choice.shipped.scattering = way;
    if (!can_be(x.choice)) return;
    x.choice.budgets.operations = HUGE_VAL;
    x.operations = static_cast<std::size_t>(check_operations(x.choice).found);
    x.choice.budgets.operations = c.budgets.operations;
    all.push_back(std::move(x));
  };
  for (const auto& m : catalogue()) {
    if (m.role() != Role::masking || m.anisotropic ||
        shape_of_term(m.id()) != shape_of_term(own.ndf))
      continue;
    for (const auto& f : catalogue()) {
      if (f.role() != Role::fresnel) continue;
      for (const Bounces way : ways)
        add(std::string(short_id(m.id())), std::string(short_id(f.id())), way);
    }
  }
  std::ranges::stable_sort(all, {},
                           [](const Candidate& x) { return std::pair(x.operations, x.changes); });
  return all;
}

/// Budgets that a choice breaks, the found over the limit where that is largest, and what was found.
struct Verdict {
  std::vector<BudgetCheck> broken;
  std::size_t lacking = 0;  ///< budgets that cannot be asked of it
  double excess = 0;

  std::size_t count() const { return broken.size() + lacking; }
  bool is_nearer(const Verdict& other) const {
    return std::pair(count(), excess) < std::pair(other.count(), other.excess);
  }
};

/// Part by which a coarse search may take a budget for broken that is kept, of limits of albedos and colours.
double slack_of(const Effort& effort, std::string_view budget) {
  if (effort.refined) return 0;
  if (budget == "delta_e_2000") return 0.3;
  return budget == "albedo_error" || budget.starts_with("energy_") ? 2 * effort.goal.error : 0;
}

/// \param best  no nearer one is sought than that: what is known not to be is not looked at further; nullptr: all is
Verdict judged(const Choice& c, const Effort& effort, const Verdict* best) {
  Verdict v;
  for (const auto& check : checks_of(c, effort)) {
    try {
      auto b = check.check({});
      if (b.holds || b.found <= b.limit + slack_of(effort, b.budget)) continue;
      v.excess = std::max(v.excess, b.limit > 0 ? b.found / b.limit : HUGE_VAL);
      v.broken.push_back(std::move(b));
    } catch (const Error&) {  // a budget that cannot be asked of it is not kept
      v.excess = HUGE_VAL;
      ++v.lacking;
    }
    if (best && !v.is_nearer(*best)) break;
  }
  return v;
}

}  // namespace

std::optional<Suggestion> suggest(const Choice& c, const ReportProgress& done) {
  const auto all = candidates(c);
  KnownAlbedos coarsely, finely;
  const Effort quick = coarse(&coarsely);
  Effort whole;
  whole.known = &finely;
  const Candidate* nearest = nullptr;
  Verdict least;
  const auto suggestion = [&](const Candidate& x, std::string why) {
    const Shipped& s = x.choice.shipped;
    return Suggestion{
        s.model,
        std::string(name_of(s.scattering)),
        least.count() == 0,
        std::move(why),
        x.operations,
        static_cast<std::size_t>(least.count() == 0 ? &x - all.data() : std::ssize(all))};
  };
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (done) done("choices", static_cast<double>(i) / static_cast<double>(all.size()));
    auto v = judged(all[i].choice, quick, nearest ? &least : nullptr);
    if (v.count() == 0) v = judged(all[i].choice, whole, nearest ? &least : nullptr);
    if (nearest && !v.is_nearer(least)) continue;
    nearest = &all[i];
    least = std::move(v);
    if (least.count() == 0)
      return suggestion(
          *nearest, fmt::format("It keeps every budget with {} operations a sample, and none of {} "
                                "cheaper choices does.",
                                nearest->operations, i));
  }
  if (!nearest) return {};
  least = judged(nearest->choice, whole, nullptr);
  std::string why = fmt::format("None of {} choices keeps every budget.", all.size());
  std::vector<std::string> stopped_by;
  for (const auto& b : least.broken) {
    why += " This one stops at " + b.budget + ". " + sentence(b);
    stopped_by.push_back(b.budget);
  }
  auto s = suggestion(*nearest, std::move(why));
  s.stopped_by = std::move(stopped_by);
  return s;
}

}  // namespace gonio
