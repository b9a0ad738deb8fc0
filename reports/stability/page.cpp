// The atlas as JSON.
#include "reports/picture/document.h"
#include "reports/stability/stability.h"

namespace gonio {

template <>
inline constexpr auto description<StabilityRow> = FieldList{
    Field{"id", &StabilityRow::id, "of the catalogue"},
    Field{"form", &StabilityRow::form,
          "how its angles are given: cross, |n × h|²; cosine, only NoH; frame, facet (VoH), "
          "cosines (NoL, NoV), directions"},
    Field{"number", &StabilityRow::number,
          "half, mixed, float, double; flushed: results below the least normal number become "
          "0; contracted: a b + c is rounded once"},
    Field{"evidence", &StabilityRow::evidence,
          "exhaustive: every input was looked at; searched: there may be worse"},
    Field{"worst_ulp", &StabilityRow::worst_ulp, "most error in units of the last digit"},
    Field{"ulp_beyond", &StabilityRow::ulp_beyond,
          "most units over what a unit of the inputs is worth there, where that is above one"},
    Field{"worst_rel", &StabilityRow::worst_rel, "most relative error"},
    Field{"proved_rel", &StabilityRow::proved_rel, "bound of it, where one is proved"},
    Field{"condition", &StabilityRow::condition,
          "units of the last digit that a unit of the inputs is worth, where worst_ulp is"},
    Field{"inputs", &StabilityRow::at, "where worst_rel is"},
    Field{"inputs_hex", &StabilityRow::inputs_hex, "the same in the number's bits"},
    Field{"flags", &StabilityRow::flags,
          "that a half raises on the way there: overflow, underflow"},
    Field{"nonfinite", &StabilityRow::nonfinite, "inputs without a value, of those looked at"},
    Field{"nonfinite_at", &StabilityRow::nonfinite_at, "the first of them"},
    Field{"negative", &StabilityRow::negative, "inputs whose value is below 0"},
    Field{"overflow", &StabilityRow::overflow,
          "inputs whose value is larger than the number holds"},
    Field{"vanished", &StabilityRow::vanished, "inputs whose value is 0 and should not be"},
    Field{"irreciprocal", &StabilityRow::irreciprocal,
          "inputs with another value where light and view are exchanged"},
    Field{"not_monotone", &StabilityRow::not_monotone,
          "neighbours between which the value rises where it should fall, or falls where it "
          "should rise"},
    Field{"decides", &StabilityRow::decides, "parameter that people clamp"},
    Field{"safe_from", &StabilityRow::safe_from,
          "of it: from there on every input looked at keeps the tolerance; null: nowhere"},
    Field{"tolerance", &StabilityRow::tolerance, "relative, or absolute"},
    Field{"is_absolute", &StabilityRow::is_absolute,
          "of a Fresnel term in few bits, which may be next to 0"},
    Field{"lost", &StabilityRow::lost, "inputs that do not keep the tolerance"},
    Field{"finite_from", &StabilityRow::finite_from,
          "of it: from there on a value is proved for every input; null: not proved"},
    Field{"evaluations", &StabilityRow::evaluations, ""},
    Field{"settled", &StabilityRow::settled,
          "searches from two seeds agree within a factor of two"},
    Field{"stable", &StabilityRow::stable,
          "id of the form that stands for the same without the fault"},
    Field{"operations", &StabilityRow::operations, "of one sample"},
    Field{"stable_operations", &StabilityRow::stable_operations, "of that form"},
    Field{"misses", &StabilityRow::misses,
          "float and double: more than 8 units beyond what the inputs are worth, or no value; "
          "half and mixed: the tolerance is not kept from alpha 0.05 on, or of another parameter "
          "everywhere"},
    Field{"reason", &StabilityRow::reason, "why it misses"},
    Field{"worst_rel_alpha_0_05", &StabilityRow::worst_from_usual,
          "most relative error from alpha 0.05 on, of a distribution in half or mixed that "
          "misses"}};
static_assert(describes_every_member<StabilityRow>());

template <>
inline constexpr auto description<ClampRow> = FieldList{
    Field{"clamp", &ClampRow::clamp, "as shaders write it"},
    Field{"where", &ClampRow::where, "id of the form that it was measured in"},
    Field{"by", &ClampRow::by, "alpha, or cosine: the smaller of NoL and NoV"},
    Field{"number", &ClampRow::number, ""},
    Field{"no_value_without", &ClampRow::no_value_without,
          "largest of these at which an input has no value without it; null: all have one"},
    Field{"no_value_with", &ClampRow::no_value_with, "the same with it"},
    Field{"worst_without", &ClampRow::worst_without,
          "most relative error of the others, against the form without it in double"},
    Field{"worst_with", &ClampRow::worst_with, "the same with it"},
    Field{"changed_to", &ClampRow::changed_to,
          "largest of these at which it changes a value by more than 1 %, in double"},
    Field{"changed_most", &ClampRow::changed_most, "most |with/without − 1|, in double"}};
static_assert(describes_every_member<ClampRow>());

template <>
inline constexpr auto description<HighlightRow> = FieldList{
    Field{"id", &HighlightRow::id, "spec of the model"},
    Field{"number", &HighlightRow::number, ""},
    Field{"zenith_deg", "°", &HighlightRow::zenith_deg, "most of light and view"},
    Field{"least_f0", &HighlightRow::least_f0, "F0 is from there to 1"},
    Field{"tolerance", &HighlightRow::tolerance, "relative; a tenth more than the search asks for"},
    Field{"safe_from", &HighlightRow::safe_from,
          "alpha from which a search finds nothing that breaks it; null: nowhere"},
    Field{"finite_from", &HighlightRow::finite_from,
          "alpha from which a search finds a value for every input; null: nowhere"}};
static_assert(describes_every_member<HighlightRow>());

template <>
inline constexpr auto description<AnyGpuRow> = FieldList{
    Field{"id", &AnyGpuRow::id, "of the catalogue"},
    Field{"form", &AnyGpuRow::form, "how its angles are given"},
    Field{"number", &AnyGpuRow::number, "float or half"},
    Field{"domain", &AnyGpuRow::domain, "for which the bound is proved, or was looked for"},
    Field{"evidence", &AnyGpuRow::evidence, "proved; open: there is no bound"},
    Field{"proved_rel", &AnyGpuRow::proved_rel, "bound of the relative error"},
    Field{"keeps", &AnyGpuRow::keeps, "it is at most 1 %"},
    Field{"finite", &AnyGpuRow::finite, "a value is proved for every input of the domain"},
    Field{"why", &AnyGpuRow::why, "where 1 % is not proved"}};
static_assert(describes_every_member<AnyGpuRow>());

template <>
inline constexpr auto description<OrderRow> = FieldList{
    Field{"id", &OrderRow::id, "of the catalogue"},
    Field{"form", &OrderRow::form, "how its angles are given"},
    Field{"number", &OrderRow::number, "float or half"},
    Field{"written", &OrderRow::written, "most relative error in the formula's own order"},
    Field{"regrouped", &OrderRow::regrouped, "the same over all orders"},
    Field{"inputs", &OrderRow::at, "where that is"},
    Field{"no_value", &OrderRow::no_value, "inputs without a value in the formula's own order"},
    Field{"lost", &OrderRow::lost, "further ones without a value in some order"},
    Field{"evaluations", &OrderRow::inputs, "inputs that were looked at, each in 16 orders"},
    Field{"needs_precise", [](const OrderRow& r) { return r.needs_precise(); },
          "it keeps the number's tolerance as it is written, and in some order it does not"}};
static_assert(describes_every_member<OrderRow>());

template <>
inline constexpr auto description<StabilityReport> = FieldList{
    constant_text("schema", "gonio.report.stability/1"),
    Field{"full", &StabilityReport::full, setting_meaning},
    Field{"findings", at(&StabilityReport::findings, &Findings::sentences), findings_meaning},
    Field{"rows", at(&StabilityReport::rows, &StabilityRows::rows), "a form in a number, each"},
    Field{"clamps", at(&StabilityReport::rows, &StabilityRows::clamps),
          "what each saves and costs"},
    Field{"highlights", at(&StabilityReport::rows, &StabilityRows::highlights),
          "D V F of a metal's highlight, and then NoL"},
    Field{"any_gpu", at(&StabilityReport::rows, &StabilityRows::any_gpu),
          "what is proved under all that Vulkan allows a GPU"},
    Field{"orders", at(&StabilityReport::rows, &StabilityRows::orders),
          "what a compiler costs that regroups sums and products"},
    inlined(&StabilityReport::pictures)};

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
