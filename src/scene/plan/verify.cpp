#include "scene/plan/verify.h"

#include <algorithm>

#include "base/json/describe.h"
#include "scene/plan/reference.h"

namespace gonio {

using scene::Judgement;
using scene::Verification;
using scene::VerifiedMaterial;

namespace {

/// Material as the document has it.
struct VerifiedRow {
  VerifiedMaterial material;
  double confidence;
  std::optional<double> upper_bound;
};

std::vector<std::pair<std::string, VerifiedRow>> rows_of(const Verification& v) {
  std::vector<std::pair<std::string, VerifiedRow>> rows;
  for (const auto& m : v.materials)
    rows.emplace_back(m.name, VerifiedRow{m, v.tolerance.confidence,
                                          m.bounded ? std::optional(m.found.bound) : std::nullopt});
  return rows;
}

}  // namespace

template <>
struct Description<VerifiedRow> {
  template <class Member>
  static constexpr auto found(Member member) {
    return at(at(&VerifiedRow::material, &VerifiedMaterial::found), member);
  }
  static constexpr auto fields() {
    constexpr Numbers share{0, 1}, amount{0, Numbers::any};
    return FieldList{
        field("holds", at(&VerifiedRow::material, &VerifiedMaterial::holds), "the tolerance"),
        field("reference", at(&VerifiedRow::material, &VerifiedMaterial::reference),
              "form of the light between facets that the plan is compared with"),
        field("exceeding", found(&Judgement::exceeding),
              "points that differ by more than the limit"),
        field("samples", found(&Judgement::samples), "points"),
        field("upper_bound", if_there(&VerifiedRow::upper_bound),
              "of the share of all points that do; null: the reference's error is not known",
              share),
        field("confidence", &VerifiedRow::confidence, "of the bound", share),
        field("worst", found(&Judgement::worst), "greatest difference", amount),
        field("error_quantile", found(&Judgement::quantile), "quantile of the differences",
              amount)};
  }
};
template <>
inline constexpr auto description<Verification> =
    FieldList{constant_text("schema", "gonio.verification/1"),
              Field{"holds", [](const Verification& v) { return v.holds(); }, "for every material"},
              Field{"materials", rows_of, "by name"}};

}  // namespace gonio

namespace gonio::scene {

bool Verification::holds() const {
  return std::ranges::all_of(materials, &VerifiedMaterial::holds);
}

Verification verify(const Scene& s,
                    const PlannedForms& planned,
                    std::uint64_t seed,
                    std::optional<std::size_t> samples,
                    const std::function<void(double)>& done) {
  constexpr std::uint64_t verifying = 1'000;  // after the planner's streams
  Lit lit(s);
  lit.tell_apart(planned.by_material);
  Verification v{s.tolerance, {}};
  std::vector<std::optional<Judgement>> found(s.materials.size());
  for (std::size_t m = 0; m < s.materials.size(); ++m) {
    if (!planned.by_material[m]) continue;
    const auto& look = lit.looks[m];
    VerifiedMaterial one{s.materials[m].name,
                         std::string(look.exact().name(Effect::compensation)),
                         look.is_bounded(),
                         {},
                         false};
    auto& of_all = found[lit.same_as[m]];
    if (!of_all)
      of_all = judge_fresh(s, lit.drawer(m, PlanOptions{}.directions), verifying + seed,
                           samples.value_or(samples_of_verification(s)), look.surface(look.exact()),
                           look.surface(*planned.by_material[m]));
    one.found = *of_all;
    one.holds = one.found.holds(s.tolerance);
    v.materials.push_back(std::move(one));
    if (done) done(static_cast<double>(m + 1) / static_cast<double>(s.materials.size()));
  }
  return v;
}

std::string to_json(const Verification& v) {
  return json_text(v);
}

std::string verification_schema() {
  return schema_text<Verification>("Verification of a plan");
}

}  // namespace gonio::scene
