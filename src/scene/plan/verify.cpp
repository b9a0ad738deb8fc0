#include "scene/plan/verify.h"

#include <algorithm>

#include "base/json/form.h"
#include "scene/plan/reference.h"

namespace gonio::scene {
namespace {

struct VerifiedFile {
  bool holds = false;
  std::uint64_t exceeding = 0, samples = 0;
  double upper_bound = 1, confidence = 0, worst = 0, quantile = 0;
};
template <class Form>
void keys(Form& f, VerifiedFile& m) {
  constexpr Numbers share{0, 1}, amount{0, Numbers::any};
  f.required("holds", m.holds, "the tolerance");
  f.required("exceeding", m.exceeding, "points that differ by more than the limit");
  f.required("samples", m.samples, "points");
  f.required("upper_bound", m.upper_bound, "of the share of all points that do", share);
  f.required("confidence", m.confidence, "of the bound", share);
  f.required("worst", m.worst, "greatest difference", amount);
  f.required("error_quantile", m.quantile, "quantile of the differences", amount);
}

struct VerificationFile {
  bool holds = false;
  std::vector<std::pair<std::string, VerifiedFile>> materials;
};
template <class Form>
void keys(Form& f, VerificationFile& v) {
  f.constant("schema", "gonio.verification/1");
  f.required("holds", v.holds, "for every material");
  f.required("materials", v.materials, "by name");
}

}  // namespace

bool Verification::holds() const {
  return std::ranges::all_of(materials, &VerifiedMaterial::holds);
}

Verification verify(const Scene& s,
                    const PlannedForms& planned,
                    std::uint64_t seed,
                    std::optional<std::size_t> samples,
                    const std::function<void(double)>& done) {
  constexpr std::uint64_t verifying = 1'000;  // after the planner's streams
  const Lit lit(s);
  Verification v{s.tolerance, {}};
  for (std::size_t m = 0; m < s.materials.size(); ++m) {
    if (!planned.by_material[m]) continue;
    const auto& look = lit.looks[m];
    VerifiedMaterial one{s.materials[m].name, {}, false};
    one.found = judge_fresh(s, lit.drawer(m, PlanOptions{}.directions), verifying + seed,
                            samples.value_or(samples_of_verification(s)),
                            look.surface(look.exact()), look.surface(*planned.by_material[m]));
    one.holds = one.found.bound <= 1 - s.tolerance.quantile && one.found.worst <= s.tolerance.max;
    v.materials.push_back(std::move(one));
    if (done) done(static_cast<double>(m + 1) / static_cast<double>(s.materials.size()));
  }
  return v;
}

std::string to_json(const Verification& v) {
  VerificationFile f{v.holds(), {}};
  for (const auto& m : v.materials)
    f.materials.emplace_back(
        m.name, VerifiedFile{m.holds, m.found.exceeding, m.found.samples, m.found.bound,
                             v.tolerance.confidence, m.found.worst, m.found.quantile});
  return form_json(f).dump(2);
}

std::string verification_schema() {
  return form_schema<VerificationFile>("Verification of a plan");
}

}  // namespace gonio::scene
