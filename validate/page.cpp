// The validation as JSON and as a page.
#include "reports/page/page.h"

#include "reports/page/assets.h"
#include "reports/picture/document.h"
#include "validate/validate.h"
#include "validate/words.h"

namespace gonio {

template <>
struct Description<BudgetCheck> {
  static constexpr auto fields() {
    using B = BudgetCheck;
    return std::tuple{
        field("budget", &B::budget, "its key in the choice"),
        field(
            "title", [](const B& b) { return title_of(b.budget); }, "what it limits"),
        field("limit", &B::limit, "that the choice sets"),
        field("found", &B::found, "the worst of the domain"),
        field(
            "limit_text", [](const B& b) { return value_text(b.budget, b.limit); },
            "the limit as people write it"),
        field(
            "found_text", [](const B& b) { return value_text(b.budget, b.found); },
            "the same of the worst"),
        field("holds", &B::holds, "whether the worst keeps the limit"),
        field("evidence", &B::evidence, "proved, exhaustive, searched, counted or measured"),
        field("at", &B::at, "inputs of the worst: roughness, mu, theta [°] …"),
        field("substance", &B::substance, "of the worst; may be empty"),
        field("place", place_text, "the same as text; may be empty"),
        field("words", &B::words, "more of what was found; may be empty"),
        field(
            "sentence", [](const B& b) { return sentence(b); },
            "what was found, where, and what is allowed")};
  }
};
static_assert(describes_every_member<BudgetCheck>());

template <>
struct Description<Suggestion> {
  static constexpr auto fields() {
    using S = Suggestion;
    return std::tuple{field("model", &S::model, "the cheapest that keeps every budget"),
                      field("scattering", &S::scattering, "beside it"), field("why", &S::why, ""),
                      field("cost", &S::operations, "operations of a sample"),
                      field("tried", &S::tried, "cheaper choices, each of which breaks a budget")};
  }
};
static_assert(describes_every_member<Suggestion>());

template <>
struct Description<Validation> {
  static constexpr auto fields() {
    using V = Validation;
    return std::tuple{
        constant_text("schema", "gonio.validation/1"),
        field("choice", &V::path, "path of the choice"),
        field("model", &V::model, "that is to be shipped"),
        field("scattering", &V::scattering, "what follows light after its first bounce"),
        field("reference", &V::reference, "what the model stands for; may be empty"),
        field("number", &V::number, "in which a shader computes it"),
        field(
            "holds", [](const V& v) { return v.holds(); }, "whether every budget is kept"),
        field("budgets", &V::budgets, "the cheapest to check first"),
        field("suggestion", if_there(&V::suggestion), "where one was asked for and there is one"),
        inlined(&V::pictures)};
  }
};

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
