#include "scene/plan/document.h"

#include <algorithm>
#include <optional>

#include "base/json/describe.h"
#include "brdf/model/own_files.h"
#include "scene/description/scene_keys.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace gonio {

namespace {

std::vector<std::string_view> names(std::span<const scene::Form> forms) {
  std::vector<std::string_view> all;
  std::ranges::transform(forms, std::back_inserter(all), name_of<scene::Form>);
  return all;
}
/// Forms by their effects, as a plan's sets have them.
Json write_forms(const void* value) {
  const auto& forms = *static_cast<const scene::Forms*>(value);
  Json out = Json::object();
  for (const auto name : names_of<scene::Effect>)
    out[std::string(name)] = std::string(forms.name(*find_value<scene::Effect>(name)));
  return out;
}
void read_forms(const JsonReader& j, void* value) {
  auto& forms = *static_cast<scene::Forms*>(value);
  visit_members_in(j, {0, scene::effect_count}, [&](const auto& name, const JsonReader& form) {
    const auto effect = find_value<scene::Effect>(name);
    if (!effect) form.fail(fmt::format("'{}'", name), "an effect");
    const auto found = scene::find_form(*effect, form.string());
    if (!found) form.fail(either(names(scene::forms_of(*effect))));
    forms[*effect] = *found;
  });
}
Json forms_schema() {
  Json of = Json::object();
  for (const auto name : names_of<scene::Effect>) {
    const auto forms = names(scene::forms_of(*find_value<scene::Effect>(name)));
    of[std::string(name)] = {{"enum", std::vector<std::string>(forms.begin(), forms.end())}};
  }
  return {{"type", "object"}, {"properties", of}, {"additionalProperties", false}};
}
constexpr JsonForm forms_json{write_forms, read_forms, forms_schema};
constexpr Numbers amounts{0, Numbers::any}, shares{0, 1};
constexpr const char* plan_version = "gonio.plan/2";

}  // namespace

template <>
inline constexpr const JsonForm* json_form<scene::Forms> = &forms_json;

template <>
inline constexpr auto description<scene::Budget> = FieldList{
    Field{"budget_ns", &scene::Budget::budget_ns, "mean time of a visible point", amounts},
    Field{"ns", &scene::Budget::ns, "of the plan", amounts},
    Field{"error", &scene::Budget::error,
          "upper bound of the worst material's quantile, on fresh points", amounts},
    Field{"fits", &scene::Budget::fits, "false: even the cheapest forms take longer"}};

template <>
struct Description<scene::FreshError> {
  static constexpr auto fields() {
    using F = scene::FreshError;
    return FieldList{field("worst", &F::worst, "greatest difference", amounts),
                     field("exceeding_bound", if_there(&F::exceeding_bound),
                           "upper bound of the share beyond the limit", shares)};
  }
};

template <>
struct Description<scene::Candidate> {
  static constexpr auto fields() {
    using C = scene::Candidate;
    using scene::Judgement;
    return FieldList{
        field("forms", &C::forms, "by effect"),
        field("ns", &C::ns, "of f of one direction of light", Numbers{}),
        field("ns_spread", &C::ns_spread, "half the distance of the quartiles", Numbers{}),
        field("ops", &C::ops, "operations of the same", amounts),
        field("error_quantile", at(&C::error, &Judgement::quantile), "quantile of the differences",
              amounts),
        field("error_upper", if_there(at(&C::error, &Judgement::upper)),
              "its upper confidence bound", amounts),
        field("worst", at(&C::error, &Judgement::worst), "greatest difference", amounts),
        field("samples", at(&C::error, &Judgement::samples),
              "points that sets are compared on, which these errors are of", or_default),
        field("failed", if_there(&C::failed),
              "errors on the fresh points of a set that was checked there and failed")};
  }
};

template <>
struct Description<scene::JudgedSet> {
  static constexpr auto fields() {
    using S = scene::JudgedSet;
    using scene::Judgement;
    return FieldList{
        field("forms", &S::forms, "by effect"),
        field("ns", &S::ns, "of f of one direction of light", Numbers{}),
        field("ops", &S::ops, "operations of the same", amounts),
        field("error_upper", if_there(at(&S::error, &Judgement::upper)),
              "upper confidence bound of the quantile of the differences", amounts),
        field("worst", at(&S::error, &Judgement::worst), "greatest difference", amounts),
        field("most_worst", at(&S::margin, &scene::Margin::most_worst),
              "what that may be, for a verification to agree", amounts),
        field("exceeding_bound", if_there(at(&S::error, &Judgement::bound)),
              "upper bound of the share beyond the limit", shares),
        field("most_exceeding", at(&S::margin, &scene::Margin::most_exceeding),
              "what that may be, for a verification to agree", shares),
        field("samples", at(&S::error, &Judgement::samples), "points that these errors are of",
              or_default)};
  }
};

template <>
inline constexpr auto description<scene::PlannedEffect> = FieldList{
    Field{"effect", &scene::PlannedEffect::effect, ""},
    Field{"keep", &scene::PlannedEffect::keep, "false: its form is the cheapest"},
    Field{"form", &scene::PlannedEffect::form, "in which it is computed", not_empty},
    Field{"why", &scene::PlannedEffect::why, "ground of the choice"},
    Field{"error_if_dropped", &scene::PlannedEffect::error_if_dropped,
          "quantile of the differences where only it takes its cheapest form; a bound of all "
          "of them where it is proved",
          amounts},
    Field{"ns_saved", &scene::PlannedEffect::ns_saved, "by that, of f of one direction of light",
          Numbers{}},
    Field{"ops_saved", &scene::PlannedEffect::ops_saved, "operations, of the same", Numbers{}},
    Field{"reason", &scene::PlannedEffect::reason, "in words", not_empty, or_default}};

template <>
struct Description<scene::MaterialPlan> {
  template <class Member>
  static constexpr auto checked(Member member) {
    return at(&scene::MaterialPlan::checked, member);
  }
  static constexpr auto fields() {
    using M = scene::MaterialPlan;
    using scene::Judgement;
    return FieldList{
        field("effects", &M::effects, "each effect once",
              Entries{scene::effect_count, scene::effect_count}),
        field("spec", &M::spec,
              "model of these forms; compensation, spectrum, environment and precision are not in "
              "it",
              not_empty),
        field("parameters", &M::parameters, "of the spec", Numbers{}, or_default),
        field("speedup", &M::speedup,
              "time of the effects that the material has, exact in float, over the plan's",
              amounts),
        field("ops_saved", &M::ops_saved, "share of the operations", Numbers{}, or_default),
        field("ns", &M::ns, "of f of one direction of light", amounts, or_default),
        field("ns_spread", &M::ns_spread, "of ns, as sets are compared by it; 0: not known",
              amounts, or_default),
        field("ns_exact", &M::ns_exact,
              "of the same, the effects that the material has exact, in float", amounts,
              or_default),
        field("error_quantile", checked(&Judgement::quantile), "of the differences on fresh points",
              amounts),
        field("reference", &M::reference,
              "form of the light between facets that differences are of: tabulated from walks; "
              "where no walk is known "
              "another, without bound",
              or_default),
        field("shipped_error_upper", if_there(&M::shipped_upper),
              "least error_upper of a compensation that shaders have, all else exact", amounts),
        field("without_table", if_there(&M::without_table),
              "where the plan keeps the table, which no shader has: of the sets without it the one "
              "that was nearest to the margin where sets are compared, on fresh points"),
        field("reference_error", if_there(&M::reference_error),
              "quantile of two standard errors of the reference on the same points: in the "
              "differences",
              amounts),
        field("holds", &M::holds,
              "the tolerance, with the margin by which a verification is likely to agree; else "
              "this is the nearest plan"),
        field(
            "error_upper", if_there(checked(&Judgement::upper)),
            "its upper confidence bound over points, two standard errors of the reference in each "
            "difference",
            amounts),
        field("worst", checked(&Judgement::worst), "greatest difference of these", amounts,
              or_default),
        field("exceeding_bound", if_there(checked(&Judgement::bound)),
              "upper bound of the share beyond the limit", shares),
        field("most_worst", at(&M::margin, &scene::Margin::most_worst), "what worst may be",
              amounts, or_default),
        field("most_exceeding", at(&M::margin, &scene::Margin::most_exceeding),
              "what exceeding_bound may be", shares, or_default),
        field("samples", checked(&Judgement::samples), "fresh points"),
        field("passed_over", &M::passed_over, "cheaper sets that failed on the fresh points",
              or_default),
        field("failed", if_there(&M::failed),
              "the cheapest of these, or else the nearest set with one form cheaper, by the points "
              "that sets are compared on; and what it failed by"),
        field("only_unseen", &M::only_unseen,
              "no set keeps the tolerance where sets are compared and its margin on fresh points: "
              "only what changes no point by a hundredth of the limit is dropped",
              or_default),
        field("coverage", &M::coverage, "share of the picture that shows the material", shares,
              or_default),
        field("directions", &M::directions, "of light that come to a point, on average", amounts,
              or_default),
        field("front", &M::front, "sets of forms of which none is cheaper and errs less",
              or_default)};
  }
};

template <>
inline constexpr auto description<scene::Plan> =
    FieldList{constant_text("schema", plan_version),
              Field{"holds", &scene::Plan::holds, "for every material"},
              Field{"scene_sha256", &scene::Plan::scene_sha256,
                    "of the scene and all that it names", not_empty},
              Field{"tolerance", &scene::Plan::tolerance, "that the plan was made for", or_default},
              Field{"materials", by_name(&scene::Plan::materials), "by name", Entries{0, 10'000}},
              Field{"budget", if_there(&scene::Plan::budget), "where the scene has one"},
              Field{own_files_key, if_there(&scene::Plan::shaders), own_files_meaning}};

}  // namespace gonio

namespace gonio::scene {

namespace {

/// Forms of a material's effects, each offered.
/// \param scene  its path
Forms forms_in(const MaterialPlan& m,
               const Look& look,
               const std::string& scene,
               const JsonReader& at) {
  Forms forms = look.exact();
  std::array<bool, effect_count> told{};
  for (std::size_t i = 0; i < m.effects.size(); ++i) {
    const auto& e = m.effects[i];
    const auto place = at.at("effects").at(i);
    if (std::exchange(told[static_cast<std::size_t>(e.effect)], true))
      place.at("effect").fail("each effect once");
    const auto& offered = look.offer(e.effect).forms;
    const auto found = std::ranges::find(offered, e.form, name_of<Form>);
    if (found == offered.end())
      place.at("form").fail(
          fmt::format("a form that this material offers: {}", fmt::join(names(offered), ", ")));
    forms[e.effect] = *found;
    if (e.keep != forms.keeps(e.effect))
      place.at("keep").fail(forms.keeps(e.effect) ? "true, as its form is not the cheapest"
                                                  : "false, as its form is the cheapest");
  }
  if (const Forms plain = look.plain(forms); plain != forms)
    for (std::size_t i = 0; i < effect_count; ++i)
      if (const auto e = static_cast<Effect>(i); plain[e] != forms[e])
        at.at("effects").fail(fmt::format("{} '{}', which is all that the other forms leave of it",
                                          name_of(e), plain.name(e)));
  const Surface surface = look.surface(forms);
  if (const auto spec = own_files_as_named(scene, surface.spec()); spec != m.spec)
    at.at("spec").fail(fmt::format("'{}', which its forms make", spec));
  // Who edits forms by hand need not know the parameters that others have, but these are the
  // material's.
  const auto parameters = surface.parameters();
  for (const auto& [name, values] : m.parameters) {
    const auto own =
        std::ranges::find(parameters, name, &std::pair<std::string, std::vector<double>>::first);
    if (own != parameters.end() && own->second != values)
      at.at("parameters").at(name).fail("what its forms make of the scene's material");
  }
  return forms;
}

}  // namespace

std::string to_json(const Plan& p) {
  return json_text(p);
}

std::string plan_schema() {
  return schema_text<Plan>("Plan");
}

namespace {

/// Plans before the second version called a compensation exact.
void read_document(const JsonReader& root, Plan& file) {
  constexpr std::string_view before = "gonio.plan/1";
  root.expect_object();
  if (root.has("schema") && root.at("schema").string() == before)
    root.at("schema").fail(
        fmt::format("'{}', compared with a compensation", before),
        fmt::format("'{}', which `gonio plan SCENE -o PLAN` makes anew", plan_version));
  read_record(root, file);
}

}  // namespace

PlannedForms read_plan(const std::string& path, const Scene& s, const std::vector<Look>& looks) {
  const JsonDocument document(path, Places::pointer);
  const JsonReader& root = document.root();
  Plan file;
  file.tolerance = s.tolerance;
  read_document(root, file);
  if (file.scene_sha256 != s.sha256)
    root.at("scene_sha256").fail(fmt::format("'{}', which is that of {}", s.sha256, s.path));
  if (file.tolerance != s.tolerance) root.at("tolerance").fail("that of the scene");
  PlannedForms planned{std::vector<std::optional<Forms>>(s.materials.size())};
  for (const auto& material : file.materials) {
    const auto found = std::ranges::find(s.materials, material.name, &Material::name);
    const auto at = root.at("materials").at(material.name);
    if (found == s.materials.end()) at.fail("a material of the scene");
    const auto index = static_cast<std::size_t>(found - s.materials.begin());
    planned.by_material[index] = forms_in(material, looks[index], s.path, at);
  }
  for (const auto& object : s.objects)
    if (!planned.by_material[object.material])
      root.at("materials")
          .fail(fmt::format("no '{}'", s.materials[object.material].name),
                "every material that an object has");
  return planned;
}

PlannedMaterial read_planned_material(const std::string& path, const std::string& name) {
  const JsonDocument document(path, Places::pointer);
  Plan file;
  read_document(document.root(), file);
  std::vector<std::string_view> known;
  for (auto& m : file.materials) {
    known.push_back(m.name);
    if (m.name != name) continue;
    PlannedMaterial planned{own_files_beside(path, m.spec), std::move(m.parameters), {}};
    const auto at = document.root().at("materials").at(name).at("effects");
    for (std::size_t i = 0; i < m.effects.size(); ++i) {
      const Effect effect = m.effects[i].effect;
      const auto found = find_form(effect, m.effects[i].form);
      if (!found) at.at(i).at("form").fail(either(names(forms_of(effect))));
      planned.forms[effect] = *found;
    }
    return planned;
  }
  refuse_name(name, known, "material of the plan");
}

}  // namespace gonio::scene
