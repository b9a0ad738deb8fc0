// The validation as JSON and as a page.
#include <algorithm>
#include <filesystem>

#include "reports/page/numbers.h"
#include "reports/page/render.h"
#include "reports/picture/document.h"
#include "validate/validate.h"
#include "validate/words.h"

#include <fmt/format.h>

namespace gonio {

template <>
inline constexpr auto description<BudgetCheck> = FieldList{
    Field{"budget", &BudgetCheck::budget, "its key in the choice"},
    Field{"title", [](const BudgetCheck& b) { return title_of(b.budget); }, "what it limits"},
    Field{"limit", &BudgetCheck::limit, "that the choice sets"},
    Field{"found", &BudgetCheck::found, "the worst of the domain"},
    Field{"limit_text", [](const BudgetCheck& b) { return value_text(b.budget, b.limit); },
          "the limit as people write it"},
    Field{"found_text", [](const BudgetCheck& b) { return value_text(b.budget, b.found); },
          "the same of the worst"},
    Field{"holds", &BudgetCheck::holds, "whether the worst keeps the limit"},
    Field{"evidence", &BudgetCheck::evidence, "proved, exhaustive, searched, counted or measured"},
    Field{"at", &BudgetCheck::at, "inputs of the worst: roughness, mu, theta [°] …"},
    Field{"substance", &BudgetCheck::substance, "of the worst; may be empty"},
    Field{"place", place_text, "the same as text; may be empty"},
    Field{"words", &BudgetCheck::words, "more of what was found; may be empty"},
    Field{"sentence", [](const BudgetCheck& b) { return sentence(b); },
          "what was found, where, and what is allowed"}};
static_assert(describes_every_member<BudgetCheck>());

template <>
inline constexpr auto description<UsedParameter> =
    FieldList{Field{"name", &UsedParameter::name, "as gonio models lists it"},
              Field{"values", &UsedParameter::values,
                    "one, or one per channel; empty where the domain varies them"},
              Field{"from", &UsedParameter::from, "who sets it"}};

template <>
inline constexpr auto description<Suggestion> = FieldList{
    Field{"model", &Suggestion::model, "the cheapest that keeps every budget, or the nearest"},
    Field{"scattering", &Suggestion::scattering, "beside it"},
    Field{"holds", &Suggestion::holds, "whether it keeps every budget"},
    Field{"why", &Suggestion::why, ""},
    Field{"cost", &Suggestion::operations, "operations of a sample"},
    Field{"tried", &Suggestion::tried, "choices that were compared, each of which breaks a budget"},
    Field{"stopped_by", &Suggestion::stopped_by, "budgets that a nearest one breaks"}};
static_assert(describes_every_member<Suggestion>());

template <>
inline constexpr auto description<Validation> = FieldList{
    constant_text("schema", "gonio.validation/1"),
    Field{"choice", &Validation::path, "path of the choice"},
    Field{"model", &Validation::model, "that is to be shipped"},
    Field{"scattering", &Validation::scattering, "what follows light after its first bounce"},
    Field{"reference", &Validation::reference, "what the model stands for; may be empty"},
    Field{"parameters", &Validation::parameters, "of the model"},
    Field{"reference_parameters", &Validation::reference_parameters, "of the reference"},
    Field{"number", &Validation::number, "in which a shader computes it"},
    Field{"holds", [](const Validation& v) { return v.holds(); }, "whether every budget is kept"},
    Field{"budgets", &Validation::budgets, "the cheapest to check first"},
    Field{own_files_key, if_there([](const Validation& v) {
            return own_files({v.model, v.reference});
          }),
          own_files_meaning},
    Field{"suggestion", if_there(&Validation::suggestion),
          "where one was asked for and there is one"},
    inlined(&Validation::pictures)};

std::string to_json(const Validation& v) {
  return page_document(v);
}
std::string validation_schema() {
  return schema_text<Validation>("Validation of a choice");
}

// --- The page ------------------------------------------------------------------------------------
namespace {

std::string spaced(std::string name) {
  std::ranges::replace(name, '_', ' ');
  return name;
}
std::string evidence_text(std::string_view evidence) {
  if (evidence == "proved") return "proved for every input";
  if (evidence == "exhaustive") return "every input looked at";
  if (evidence == "searched") return "searched: there may be worse";
  return evidence == "counted" ? "counted" : "measured here";
}

}  // namespace

std::string validation_page_html(const Validation& v) {
  using namespace page;
  const auto broken = std::ranges::count_if(v.budgets, [](const auto& b) { return !b.holds; });
  const auto limits = [&](std::string_view budget) {
    return std::ranges::find(v.budgets, budget, &BudgetCheck::budget) != v.budgets.end();
  };
  const auto file = std::filesystem::path(v.path).filename().string();
  Page out{"", "validate", "Before you ship",
           broken
               ? fmt::format("{} breaks {} of {}", file, broken, many(v.budgets.size(), "budget"))
               : fmt::format("{} keeps every budget", file)};
  for (const auto& b : v.budgets)
    if (!b.holds && out.findings.size() < 4) out.findings.push_back(sentence(b));
  if (limits("reciprocity") && limits("energy_loss"))
    out.findings.emplace_back(
        "A compensation that gives back all light for each view may change where light and view "
        "change places: the two budgets can conflict.");
  Table t{columns("budget|kept|>found|>allowed|at|evidence"), {}, "told-by-cell"};
  for (const auto& b : v.budgets) {
    const auto place = place_text(b);
    t.add(std::string(title_of(b.budget)),
          Cell{b.holds ? "yes" : "no", {}, {}, b.holds ? "verdict-yes" : "verdict-no"},
          value_text(b.budget, b.found), value_text(b.budget, b.limit), place.empty() ? "–" : place,
          Cell{b.words.empty() ? evidence_text(b.evidence) : b.words, {}, {}, "muted"});
  }
  out.sections = {{"Budgets", "The worst of each in the choice's domain.", {t}}};
  Section light{"Light that comes back", "Under a uniform white sky, by the view.", {}};
  for (const auto& f : v.pictures.figures) light.parts.emplace_back(Shown{f.family, f.choices});
  if (!light.parts.empty()) out.sections.push_back(light);
  if (v.suggestion)
    out.sections.push_back(
        {v.suggestion->holds ? "The cheapest that keeps every budget"
                             : "The nearest: none keeps every budget",
         "",
         {Prose{fmt::format("`{}`{} {}", v.suggestion->model,
                            v.suggestion->scattering == "single"
                                ? "."
                                : fmt::format(" with {}.", spaced(v.suggestion->scattering)),
                            v.suggestion->why)}}});
  std::vector<std::string> names;
  for (const auto* side : {&v.parameters, &v.reference_parameters})
    for (const auto& p : *side)
      if (std::ranges::find(names, p.name) == names.end()) names.push_back(p.name);
  Table parameters{columns("parameter|model|reference"), {}};
  const auto used = [](const std::vector<UsedParameter>& all, const std::string& name) {
    const auto p = std::ranges::find(all, name, &UsedParameter::name);
    return p == all.end() ? std::string("–") : value_text(*p);
  };
  for (const auto& name : names)
    parameters.add("`" + name + "`", used(v.parameters, name), used(v.reference_parameters, name));
  if (!names.empty())
    out.sections.push_back(
        {"Parameters",
         "Model and reference both take the values of the choice, but for those that "
         "`reference_parameters` or the domain set.",
         {parameters}});
  const auto code = [](const std::string& text) { return text.empty() ? text : "`" + text + "`"; };
  out.sections.push_back({"The choice",
                          "",
                          {Pairs{{{"model", code(v.model)},
                                  {"scattering", spaced(v.scattering)},
                                  {"number", std::string(name_of(v.number))},
                                  {"reference", code(v.reference)},
                                  {"file", code(v.path)}}}}});
  out.setting =
      "Albedos and colours are of the formula in double. Rounding in the shader's number is "
      "judged only by the budget of inputs without a value, and by `gonio stability`.";
  return page_html(out, v.pictures);
}

}  // namespace gonio
