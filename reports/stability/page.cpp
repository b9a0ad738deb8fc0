// The atlas as JSON.
#include "reports/picture/document.h"
#include "reports/stability/stability.h"

namespace gonio {

template <>
struct Description<StabilityRow> {
  static constexpr auto fields() {
    using R = StabilityRow;
    return std::tuple{
        field("id", "", &R::id, "of the catalogue"),
        field("form", "", &R::form,
              "how its angles are given: cross, |n × h|²; cosine, NoH alone; frame, facet (VoH), "
              "cosines (NoL, NoV), directions"),
        field("number", "", &R::number,
              "half, mixed, float, double; flushed: results below the least normal number become "
              "0; contracted: a b + c is rounded once"),
        field("evidence", "", &R::evidence,
              "exhaustive: every input was looked at; searched: there may be worse"),
        field("worst_ulp", "", &R::worst_ulp, "most error in units of the last digit"),
        field("ulp_beyond", "", &R::ulp_beyond,
              "most units over what a unit of the inputs is worth there, where that is above one"),
        field("worst_rel", "", &R::worst_rel, "most relative error"),
        field("proved_rel", "", &R::proved_rel, "bound of it, where one is proved"),
        field("condition", "", &R::condition,
              "units of the last digit that a unit of the inputs is worth, where worst_ulp is"),
        field("inputs", "", &R::at, "where worst_rel is"),
        field("inputs_hex", "", &R::inputs_hex, "the same in the number's bits"),
        field("flags", "", &R::flags, "that a half raises on the way there: overflow, underflow"),
        field("nonfinite", "", &R::nonfinite, "inputs without a value, of those looked at"),
        field("nonfinite_at", "", &R::nonfinite_at, "the first of them"),
        field("negative", "", &R::negative, "inputs whose value is below 0"),
        field("overflow", "", &R::overflow, "inputs whose value is larger than the number holds"),
        field("vanished", "", &R::vanished, "inputs whose value is 0 and should not be"),
        field("irreciprocal", "", &R::irreciprocal,
              "inputs with another value where light and view are exchanged"),
        field("not_monotone", "", &R::not_monotone,
              "neighbours between which the value rises where it should fall, or falls where it "
              "should rise"),
        field("decides", "", &R::decides, "parameter that people clamp"),
        field("safe_from", "", &R::safe_from,
              "of it: from there on every input looked at keeps the tolerance; null: nowhere"),
        field("tolerance", "", &R::tolerance, "relative"),
        field("finite_from", "", &R::finite_from,
              "of it: from there on a value is proved for every input; null: not proved"),
        field("evaluations", "", &R::evaluations, ""),
        field("settled", "", &R::settled, "searches from two seeds agree within a factor of two"),
        field("stable", "", &R::stable,
              "id of the form that stands for the same without the fault"),
        field("operations", "", &R::operations, "of one sample"),
        field("stable_operations", "", &R::stable_operations, "of that form"),
        field(
            "misses", "", &R::misses,
            "float and double: more than 8 units beyond what the inputs are worth, or no value; "
            "half and mixed: the tolerance is not kept from alpha 0.05 on, or of another parameter "
            "everywhere"),
        field("reason", "", &R::reason, "why it misses"),
        field("worst_rel_alpha_0_05", "", &R::worst_from_usual,
              "most relative error from alpha 0.05 on, of a distribution in half or mixed that "
              "misses")};
  }
};
static_assert(describes_every_member<StabilityRow>());

template <>
struct Description<ClampRow> {
  static constexpr auto fields() {
    using C = ClampRow;
    return std::tuple{
        field("clamp", "", &C::clamp, "as shaders write it"),
        field("where", "", &C::where, "id of the form that it was measured in"),
        field("by", "", &C::by, "alpha, or cosine: the smaller of NoL and NoV"),
        field("number", "", &C::number, ""),
        field("no_value_without", "", &C::no_value_without,
              "largest of these at which an input has no value without it; null: all have one"),
        field("no_value_with", "", &C::no_value_with, "the same with it"),
        field("worst_without", "", &C::worst_without,
              "most relative error of the others, against the form without it in double"),
        field("worst_with", "", &C::worst_with, "the same with it"),
        field("changed_to", "", &C::changed_to,
              "largest of these at which it changes a value by more than 1 %, in double"),
        field("changed_most", "", &C::changed_most, "most |with/without − 1|, in double")};
  }
};
static_assert(describes_every_member<ClampRow>());

template <>
struct Description<AnyGpuRow> {
  static constexpr auto fields() {
    using R = AnyGpuRow;
    return std::tuple{
        field("id", "", &R::id, "of the catalogue"),
        field("form", "", &R::form, "how its angles are given"),
        field("number", "", &R::number, "float or half"),
        field("domain", "", &R::domain, "for which the bound is proved, or was looked for"),
        field("evidence", "", &R::evidence, "proved; open: there is no bound"),
        field("proved_rel", "", &R::proved_rel, "bound of the relative error"),
        field("keeps", "", &R::keeps, "it is at most 1 %"),
        field("finite", "", &R::finite, "a value is proved for every input of the domain"),
        field("why", "", &R::why, "where 1 % is not proved")};
  }
};
static_assert(describes_every_member<AnyGpuRow>());

template <>
struct Description<OrderRow> {
  static constexpr auto fields() {
    using R = OrderRow;
    return std::tuple{
        field("id", "", &R::id, "of the catalogue"),
        field("form", "", &R::form, "how its angles are given"),
        field("number", "", &R::number, "float or half"),
        field("written", "", &R::written, "most relative error in the formula's own order"),
        field("regrouped", "", &R::regrouped, "the same over all orders"),
        field("inputs", "", &R::at, "where that is"),
        field("no_value", "", &R::no_value, "inputs without a value in the formula's own order"),
        field("lost", "", &R::lost, "further ones without a value in some order"),
        field("evaluations", "", &R::inputs, "inputs that were looked at, each in 16 orders"),
        field(
            "needs_precise", "", [](const R& r) { return r.needs_precise(); },
            "it keeps the number's tolerance as it is written, and in some order it does not")};
  }
};
static_assert(describes_every_member<OrderRow>());

template <>
struct Description<StabilityReport> {
  static constexpr auto fields() {
    using R = StabilityReport;
    return std::tuple{
        constant_text("schema", "gonio.report.stability/1"),
        field("full", "", &R::full, setting_meaning),
        field("findings", "", at(&R::findings, &Findings::sentences), findings_meaning),
        field("rows", "", at(&R::rows, &StabilityRows::rows), "a form in a number, each"),
        field("clamps", "", at(&R::rows, &StabilityRows::clamps), "what each saves and costs"),
        field("any_gpu", "", at(&R::rows, &StabilityRows::any_gpu),
              "what is proved under all that Vulkan allows a GPU"),
        field("orders", "", at(&R::rows, &StabilityRows::orders),
              "what a compiler costs that regroups sums and products"),
        inlined(&R::pictures)};
  }
};

std::string to_json(const StabilityReport& r) {
  return page_document(r);
}
std::string rows_csv(const StabilityReport& r) {
  return csv_of(r.rows.rows, Digits::six);
}
std::string stability_schema() {
  return schema_text<StabilityReport>("gonio report stability");
}

}  // namespace gonio
