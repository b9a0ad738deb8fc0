#include "scene/plan/document.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/file.h"
#include "base/json/form.h"
#include "scene/description/scene_keys.h"

#include <fmt/format.h>

namespace gonio::scene {

constexpr Numbers amounts{0, Numbers::any};

template <class Form>
void keys(Form& f, Budget& b) {
  f.required("budget_ns", b.budget_ns, "mean time of a visible point", amounts);
  f.required("ns", b.ns, "of the plan", amounts);
  f.required("error", b.error, "upper bound of the worst material's quantile", amounts);
  f.required("fits", b.fits, "false: even the cheapest forms take longer");
}

namespace {

constexpr Numbers shares{0, 1};

struct FrontFile {
  std::vector<std::pair<std::string, std::string>> forms;
  double ns = 0, ns_spread = 0, ops = 0, error_quantile = 0, worst = 0;
  std::optional<double> error_upper;
};
template <class Form>
void keys(Form& f, FrontFile& c) {
  f.required("forms", c.forms, "by effect", Entries{0, effect_count});
  f.required("ns", c.ns, "of f of one direction of light", Numbers{});
  f.required("ns_spread", c.ns_spread, "half the distance of the quartiles", Numbers{});
  f.required("ops", c.ops, "operations of the same", amounts);
  f.required("error_quantile", c.error_quantile, "quantile of the differences", amounts);
  f.optional("error_upper", c.error_upper, "its upper confidence bound", amounts);
  f.required("worst", c.worst, "greatest difference", amounts);
}

struct EffectFile {
  Effect effect{};
  bool keep = false;
  std::string form;
  Why why{};
  double error_if_dropped = 0, ns_saved = 0, ops_saved = 0;
  std::string reason;
};
template <class Form>
void keys(Form& f, EffectFile& e) {
  f.required("effect", e.effect, "");
  f.required("keep", e.keep, "false: its form is the cheapest");
  f.required("form", e.form, "in which it is computed");
  f.required("why", e.why, "ground of the choice");
  f.required(
      "error_if_dropped", e.error_if_dropped,
      "quantile of the differences where it alone takes its cheapest form; a bound of all of "
      "them where it is proved",
      amounts);
  f.required("ns_saved", e.ns_saved, "by that, of f of one direction of light", Numbers{});
  f.required("ops_saved", e.ops_saved, "operations, of the same", Numbers{});
  f.optional("reason", e.reason, "in words");
}

struct MaterialFile {
  std::vector<EffectFile> effects;
  std::string spec;
  std::vector<std::pair<std::string, std::vector<double>>> parameters;
  double speedup = 1, ops_saved = 0, ns = 0, ns_exact = 0;
  double error_quantile = 0;
  std::optional<double> error_upper;
  double worst = 0, exceeding_bound = 1, coverage = 0, directions = 0;
  std::uint64_t samples = 0, passed_over = 0;
  std::vector<FrontFile> front;
};
template <class Form>
void keys(Form& f, MaterialFile& m) {
  f.required("effects", m.effects, "each effect once", Entries{effect_count, effect_count});
  f.required(
      "spec", m.spec,
      "model of these forms; compensation, spectrum, environment and precision are not in it");
  f.optional("parameters", m.parameters, "of the spec");
  f.required("speedup", m.speedup, "time of all effects exact, over the plan's", amounts);
  f.optional("ops_saved", m.ops_saved, "share of the operations", Numbers{});
  f.optional("ns", m.ns, "of f of one direction of light", amounts);
  f.optional("ns_exact", m.ns_exact, "of the same, all effects exact", amounts);
  f.required("error_quantile", m.error_quantile, "of the differences on fresh points", amounts);
  f.optional("error_upper", m.error_upper, "its upper confidence bound", amounts);
  f.optional("worst", m.worst, "greatest difference of these", amounts);
  f.optional("exceeding_bound", m.exceeding_bound, "upper bound of the share beyond the limit",
             shares);
  f.required("samples", m.samples, "fresh points");
  f.optional("passed_over", m.passed_over, "cheaper sets that failed on the fresh points");
  f.optional("coverage", m.coverage, "share of the picture that shows the material", shares);
  f.optional("directions", m.directions, "of light that come to a point, on average", amounts);
  f.optional("front", m.front, "sets of forms of which none is cheaper and errs less");
}

struct PlanFile {
  std::string scene_sha256;
  std::optional<Tolerance> tolerance;
  std::vector<std::pair<std::string, MaterialFile>> materials;
  std::optional<Budget> budget;
};
template <class Form>
void keys(Form& f, PlanFile& p) {
  f.constant("schema", "gonio.plan/1");
  f.required("scene_sha256", p.scene_sha256, "of the scene and all that it names");
  f.optional("tolerance", p.tolerance, "that the plan was made for");
  f.required("materials", p.materials, "by name", Entries{0, 10'000});
  f.optional("budget", p.budget, "where the scene has one");
}

std::optional<double> finite(double x) {
  return std::isfinite(x) ? std::optional(x) : std::nullopt;
}

MaterialFile file_of(const MaterialPlan& m) {
  MaterialFile f;
  f.spec = m.spec;
  f.parameters = m.parameters;
  f.speedup = m.speedup;
  f.ops_saved = m.ops_saved;
  f.ns = m.ns;
  f.ns_exact = m.ns_exact;
  for (const auto& e : m.effects)
    f.effects.push_back(
        {e.effect, e.keep, e.form, e.why, e.error_if_dropped, e.ns_saved, e.ops_saved, e.reason});
  f.error_quantile = m.checked.quantile;
  f.error_upper = finite(m.checked.upper);
  f.worst = m.checked.worst;
  f.exceeding_bound = m.checked.bound;
  f.coverage = m.coverage;
  f.directions = m.directions;
  f.samples = m.checked.samples;
  f.passed_over = m.passed_over;
  for (const auto& c : m.front) {
    FrontFile row{
        {}, c.ns, c.ns_spread, c.ops, c.error.quantile, c.error.worst, finite(c.error.upper)};
    for (const auto& e : m.effects)
      row.forms.emplace_back(name_of(e.effect), c.forms.name(e.effect));
    f.front.push_back(std::move(row));
  }
  return f;
}

/// Forms of a material's effects, each offered.
Forms forms_in(const MaterialFile& m, const Look& look, const JsonReader& at) {
  Forms forms = look.exact();
  std::array<bool, effect_count> told{};
  for (std::size_t i = 0; i < m.effects.size(); ++i) {
    const auto& e = m.effects[i];
    const auto place = at.at("effects").at(i);
    if (std::exchange(told[static_cast<std::size_t>(e.effect)], true))
      place.at("effect").fail("each effect once");
    std::vector<std::string_view> offered;
    for (const auto form : look.offer(e.effect).forms) offered.push_back(forms_of(e.effect)[form]);
    const auto found = std::ranges::find(offered, e.form);
    if (found == offered.end())
      place.at("form").fail(
          fmt::format("a form that this material offers: {}", fmt::join(offered, ", ")));
    forms[e.effect] = look.offer(e.effect).forms[static_cast<std::size_t>(found - offered.begin())];
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
  if (surface.spec() != m.spec)
    at.at("spec").fail(fmt::format("'{}', which its forms make", surface.spec()));
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
  PlanFile f{p.scene_sha256, p.tolerance, {}, p.budget};
  for (const auto& m : p.materials) f.materials.emplace_back(m.name, file_of(m));
  return form_json(f).dump(2);
}

std::string plan_schema() {
  return form_schema<PlanFile>("Plan");
}

PlannedForms read_plan(const std::string& path, const Scene& s, const std::vector<Look>& looks) {
  const JsonDocument document(path, InputFile(path).read_rest(most_document_bytes),
                              Places::pointer);
  const JsonReader& root = document.root();
  PlanFile file;
  read_form(root, file);
  if (file.scene_sha256 != s.sha256)
    root.at("scene_sha256").fail(fmt::format("'{}', which is that of {}", s.sha256, s.path));
  if (file.tolerance && *file.tolerance != s.tolerance)
    root.at("tolerance").fail("that of the scene");
  PlannedForms planned{std::vector<std::optional<Forms>>(s.materials.size())};
  for (const auto& [name, material] : file.materials) {
    const auto found = std::ranges::find(s.materials, name, &Material::name);
    const auto at = root.at("materials").at(name);
    if (found == s.materials.end()) at.fail("a material of the scene");
    const auto index = static_cast<std::size_t>(found - s.materials.begin());
    planned.by_material[index] = forms_in(material, looks[index], at);
  }
  for (const auto& object : s.objects)
    if (!planned.by_material[object.material])
      root.at("materials")
          .fail(fmt::format("no '{}'", s.materials[object.material].name),
                "every material that an object has");
  return planned;
}

std::string_view PlannedMaterial::form(Effect e) const {
  const auto at = std::ranges::find(forms, e, &std::pair<Effect, std::string>::first);
  return at == forms.end() ? std::string_view{} : at->second;
}

PlannedMaterial read_planned_material(const std::string& path, const std::string& name) {
  const JsonDocument document(path, InputFile(path).read_rest(most_document_bytes),
                              Places::pointer);
  PlanFile file;
  read_form(document.root(), file);
  std::vector<std::string_view> known;
  for (auto& [material, what] : file.materials) {
    known.push_back(material);
    if (material != name) continue;
    PlannedMaterial planned{std::move(what.spec), std::move(what.parameters), {}};
    for (auto& e : what.effects) planned.forms.emplace_back(e.effect, std::move(e.form));
    return planned;
  }
  refuse_name(name, known, "material of the plan");
}

}  // namespace gonio::scene
