// The scenes as JSON.
#include "reports/picture/document.h"
#include "reports/scenes/scenes.h"

namespace gonio {

constexpr std::string_view of_direction = "of f of one direction of light";

template <>
inline constexpr auto description<SceneRow> = FieldList{
    Field{"material", &SceneRow::material, ""},
    Field{"light", &SceneRow::light, ""},
    Field{"speedup", &SceneRow::speedup, "time of everything on in double, over the plan's"},
    Field{"speedup_float", &SceneRow::speedup_float,
          "time of all that the material has in float, over that of the plan's effects in float"},
    Field{"ops_saved", &SceneRow::ops_saved, "share of the operations"},
    Field{"ns", &SceneRow::ns,
          "of the plan: of f of one direction of light, composed of column kernels"},
    Field{"ns_exact", &SceneRow::ns_exact, "of the same with everything on in double"},
    Field{"ns_exact_float", &SceneRow::ns_exact_float, "of the same in float"},
    Field{"ns_present_float", &SceneRow::ns_present_float,
          "of the same in float without what the material has not"},
    Field{"ns_float", &SceneRow::ns_float, "of the plan's effects in float"},
    Field{"error_quantile", &SceneRow::error_quantile,
          "quantile of the differences on the planner's fresh points"},
    Field{"error_upper", &SceneRow::error_upper, "its upper confidence bound"},
    Field{"worst", &SceneRow::worst, "greatest of them"},
    Field{"reference_error", &SceneRow::reference_error,
          "what the reference may be off by itself, at the quantile; it is in all three"},
    Field{"exceeding", &SceneRow::exceeding, "points of the verification beyond the limit"},
    Field{"samples", &SceneRow::samples, "points of the verification"},
    Field{"upper_bound", &SceneRow::upper_bound, "confidence bound of the share beyond the limit"},
    Field{"holds", &SceneRow::holds, "the verification finds the tolerance kept"},
    Field{"needs_table", &SceneRow::needs_table,
          "it keeps light between facets as a table, which no shader has"},
    Field{"kept", &SceneRow::kept, "effects, in words"},
    Field{"dropped", &SceneRow::dropped, "effects that nobody sees here"},
    Field{"absent", &SceneRow::absent, "effects that the material has not"},
    Field{"spec", &SceneRow::spec, "model of the plan"}};
static_assert(describes_every_member<SceneRow>());

template <>
inline constexpr auto description<SceneEffectRow> = FieldList{
    Field{"material", &SceneEffectRow::material, ""},
    Field{"light", &SceneEffectRow::light, ""},
    Field{"effect", &SceneEffectRow::effect, ""},
    Field{"name", &SceneEffectRow::name, "of its exact form, in words"},
    Field{"keep", &SceneEffectRow::keep, "false: its form is the cheapest"},
    Field{"form", &SceneEffectRow::form, ""},
    Field{"keeps", &SceneEffectRow::keeps, "name of the form that is kept, in words"},
    Field{"why", &SceneEffectRow::why, "structural, proved, measured"},
    Field{"reason", &SceneEffectRow::reason, "in words"},
    Field{"error_if_dropped", &SceneEffectRow::error_if_dropped,
          "quantile of the differences where only it is dropped; a bound where it is proved"},
    Field{"ns_saved", &SceneEffectRow::ns_saved,
          "by that, in double: of f of one direction of light"},
    Field{"ops_saved", &SceneEffectRow::ops_saved, "operations, of the same"}};
static_assert(describes_every_member<SceneEffectRow>());

template <>
inline constexpr auto description<SceneFrontRow> =
    FieldList{Field{"material", &SceneFrontRow::material, ""},
              Field{"light", &SceneFrontRow::light, ""},
              Field{"kept", &SceneFrontRow::kept, "effects, in words"},
              Field{"ns", &SceneFrontRow::ns, of_direction},
              Field{"ns_spread", &SceneFrontRow::ns_spread, "half the distance of the quartiles"},
              Field{"ops", &SceneFrontRow::ops, of_direction},
              Field{"error_quantile", &SceneFrontRow::error_quantile, "of the differences"},
              Field{"error_upper", &SceneFrontRow::error_upper, "its upper confidence bound"},
              Field{"worst", &SceneFrontRow::worst, ""},
              Field{"chosen", &SceneFrontRow::chosen, "it is the plan"}};
static_assert(describes_every_member<SceneFrontRow>());

template <>
inline constexpr auto description<ScenePicture> =
    FieldList{Field{"material", &ScenePicture::material, ""},
              Field{"light", &ScenePicture::light, ""},
              Field{"pixels", &ScenePicture::pixels, "width and height"},
              Field{"everything", &ScenePicture::everything,
                    "with all effects, as a display shows it: a PNG in base64"},
              Field{"planned", &ScenePicture::planned, "the same as planned"},
              Field{"difference", &ScenePicture::difference,
                    "50 times ΔE2000 of these, a byte of at most 254 a pixel in base64; "
                    "255 beside the sphere"},
              Field{"worst", &ScenePicture::worst, "greatest difference of a pixel"}};
static_assert(describes_every_member<ScenePicture>());

template <>
inline constexpr auto description<SceneLeftOut> =
    FieldList{Field{"material", &SceneLeftOut::material, "of the asset"},
              Field{"why", &SceneLeftOut::why, "found and expected"}};
static_assert(describes_every_member<SceneLeftOut>());

template <>
inline constexpr auto description<ScenesReport> = FieldList{
    constant_text("schema", "gonio.report.scenes/1"),
    Field{"full", &ScenesReport::full, setting_meaning},
    Field{"findings", at(&ScenesReport::findings, &Findings::sentences), findings_meaning},
    Field{"quantile", [](const ScenesReport& r) { return r.rows.tolerance.quantile; },
          "of the tolerance"},
    Field{"limit", [](const ScenesReport& r) { return r.rows.tolerance.limit; },
          "that it keeps, ΔE2000"},
    Field{"max", [](const ScenesReport& r) { return r.rows.tolerance.max; },
          "that no point passes, ΔE2000"},
    Field{"confidence", [](const ScenesReport& r) { return r.rows.tolerance.confidence; }, ""},
    Field{"rows", at(&ScenesReport::rows, &ScenesRows::rows), "a material under a light, each"},
    Field{"effects", at(&ScenesReport::rows, &ScenesRows::effects),
          "an effect of one of these, each"},
    Field{"front", at(&ScenesReport::rows, &ScenesRows::front),
          "sets of forms of which none is cheaper and errs less"},
    Field{"spheres", at(&ScenesReport::rows, &ScenesRows::pictures), "pictures of the scenes"},
    Field{"left_out", at(&ScenesReport::rows, &ScenesRows::left_out),
          "materials of the asset that are no scenes here"},
    inlined(&ScenesReport::pictures)};

std::string to_json(const ScenesReport& r) {
  return page_document(r);
}
std::string rows_csv(const ScenesReport& r) {
  return csv_of(r.rows.rows, Digits::six);
}
std::string scenes_schema() {
  return schema_text<ScenesReport>("gonio report scenes");
}

}  // namespace gonio
