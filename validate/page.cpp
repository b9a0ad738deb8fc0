// The validation as JSON and as a page.
#include "reports/page/page.h"

#include "reports/page/assets.h"
#include "reports/picture/document.h"
#include "validate/validate.h"
#include "validate/words.h"

namespace gonio {

template <>
inline constexpr auto description<BudgetCheck> = std::tuple{
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
inline constexpr auto description<Suggestion> = std::tuple{
    Field{"model", &Suggestion::model, "the cheapest that keeps every budget"},
    Field{"scattering", &Suggestion::scattering, "beside it"}, Field{"why", &Suggestion::why, ""},
    Field{"cost", &Suggestion::operations, "operations of a sample"},
    Field{"tried", &Suggestion::tried, "cheaper choices, each of which breaks a budget"}};
static_assert(describes_every_member<Suggestion>());

template <>
inline constexpr auto description<Validation> = std::tuple{
    constant_text("schema", "gonio.validation/1"),
    Field{"choice", &Validation::path, "path of the choice"},
    Field{"model", &Validation::model, "that is to be shipped"},
    Field{"scattering", &Validation::scattering, "what follows light after its first bounce"},
    Field{"reference", &Validation::reference, "what the model stands for; may be empty"},
    Field{"number", &Validation::number, "in which a shader computes it"},
    Field{"holds", [](const Validation& v) { return v.holds(); }, "whether every budget is kept"},
    Field{"budgets", &Validation::budgets, "the cheapest to check first"},
    Field{"suggestion", if_there(&Validation::suggestion),
          "where one was asked for and there is one"},
    inlined(&Validation::pictures)};

std::string to_json(const Validation& v) {
  return page_document(v);
}
std::string validation_schema() {
  return schema_text<Validation>("Validation of a choice");
}
std::string validation_page_html(std::string_view data) {
  return make_report_page("Before you ship", data, assets::validate_js);
}

}  // namespace gonio
