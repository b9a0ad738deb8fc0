// The cheapest choice that keeps every budget.
#include <algorithm>

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

/// Distribution of the only lobe, and what of the spec stands before it.
struct OneLobe {
  std::string before, ndf, masking, fresnel;
};
OneLobe one_lobe(const Choice& c) {
  const Model m = c.shipped.composed();
  if (m.lobes.size() != 1 || m.anisotropic || c.shipped.coating)
    throw bad_input(c.path, "/model", fmt::format("'{}'", c.shipped.model),
                    "one isotropic lobe that is no coat, for which a suggestion looks");
  OneLobe o;
  for (const auto& d : m.diffuse) o.before += std::string(short_id(catalogue()[d.term].id())) + '+';
  const auto name = [](const TermUse& t) {
    return std::string(short_id(catalogue()[t.term].id()));
  };
  o.ndf = name(m.lobes[0].ndf);
  o.masking = name(m.lobes[0].masking);
  o.fresnel = name(m.lobes[0].fresnel);
  return o;
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
  const OneLobe own = one_lobe(c);
  constexpr Bounces ways[] = {Bounces::single, Bounces::turquin, Bounces::kulla_conty};
  std::vector<Candidate> all;
  const auto add = [&](const std::string& masking, const std::string& fresnel, Bounces way) {
    Candidate x{c, 0,
                std::size_t{masking != own.masking} + std::size_t{fresnel != own.fresnel} +
                    std::size_t{way != c.shipped.scattering}};
    x.choice.shipped.model = fmt::format("{}{}/{}/{}", own.before, own.ndf, masking, fresnel);
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

bool keeps(const Choice& c, const Effort& effort) {
  return std::ranges::all_of(checks_of(c, effort), [](const NamedCheck& check) {
    try {
      return check.check({}).holds;
    } catch (const Error&) {  // a budget that cannot be asked of it is not kept
      return false;
    }
  });
}

}  // namespace

std::optional<Suggestion> suggest(const Choice& c, const ReportProgress& done) {
  const auto all = candidates(c);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (done) done("cheaper choices", static_cast<double>(i) / static_cast<double>(all.size()));
    if (!keeps(all[i].choice, coarse) || !keeps(all[i].choice, {})) continue;
    const Shipped& s = all[i].choice.shipped;
    return Suggestion{
        s.model, std::string(name_of(s.scattering)),
        fmt::format("It keeps every budget with {} operations a sample, and none of {} cheaper "
                    "choices does.",
                    all[i].operations, i),
        all[i].operations, i};
  }
  return {};
}

}  // namespace gonio
