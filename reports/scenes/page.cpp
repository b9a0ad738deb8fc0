// The scenes as JSON.
#include "reports/picture/document.h"
#include "reports/scenes/scenes.h"

namespace gonio {

constexpr std::string_view of_direction = "of f of one direction of light";

template <>
struct Description<SceneRow> {
  static constexpr auto fields() {
    using R = SceneRow;
    return std::tuple{
        field("material", "", &R::material, ""),
        field("light", "", &R::light, ""),
        field("speedup", "", &R::speedup, "time of everything on in double, over the plan's"),
        field("speedup_float", "", &R::speedup_float,
              "time of everything on in float, over that of the plan's effects in float"),
        field("ops_saved", "", &R::ops_saved, "share of the operations"),
        field("ns", "", &R::ns,
              "of the plan: of f of one direction of light, composed of column kernels"),
        field("ns_exact", "", &R::ns_exact, "of the same with everything on in double"),
        field("ns_exact_float", "", &R::ns_exact_float, "of the same in float"),
        field("ns_present_float", "", &R::ns_present_float,
              "of the same in float without what the material has not"),
        field("ns_float", "", &R::ns_float, "of the plan's effects in float"),
        field("error_quantile", "", &R::error_quantile,
              "quantile of the differences on the planner's fresh points"),
        field("error_upper", "", &R::error_upper, "its upper confidence bound"),
        field("worst", "", &R::worst, "greatest of them"),
        field("exceeding", "", &R::exceeding, "points of the verification beyond the limit"),
        field("samples", "", &R::samples, "points of the verification"),
        field("upper_bound", "", &R::upper_bound, "confidence bound of the share beyond the limit"),
        field("holds", "", &R::holds, "the verification finds the tolerance kept"),
        field("kept", "", &R::kept, "effects, in words"),
        field("dropped", "", &R::dropped, "effects that nobody sees here"),
        field("absent", "", &R::absent, "effects that the material has not"),
        field("spec", "", &R::spec, "model of the plan")};
  }
};
static_assert(describes_every_member<SceneRow>());

template <>
struct Description<SceneEffectRow> {
  static constexpr auto fields() {
    using R = SceneEffectRow;
    return std::tuple{
        field("material", "", &R::material, ""),
        field("light", "", &R::light, ""),
        field("effect", "", &R::effect, ""),
        field("name", "", &R::name, "of its exact form, in words"),
        field("keep", "", &R::keep, "false: its form is the cheapest"),
        field("form", "", &R::form, ""),
        field("keeps", "", &R::keeps, "name of the form that is kept, in words"),
        field("why", "", &R::why, "structural, proved, measured"),
        field("reason", "", &R::reason, "in words"),
        field("error_if_dropped", "", &R::error_if_dropped,
              "quantile of the differences where it alone is dropped; a bound where it is proved"),
        field("ns_saved", "", &R::ns_saved, "by that, in double: of f of one direction of light"),
        field("ops_saved", "", &R::ops_saved, "operations, of the same")};
  }
};
static_assert(describes_every_member<SceneEffectRow>());

template <>
struct Description<SceneFrontRow> {
  static constexpr auto fields() {
    using R = SceneFrontRow;
    return std::tuple{field("material", "", &R::material, ""),
                      field("light", "", &R::light, ""),
                      field("kept", "", &R::kept, "effects, in words"),
                      field("ns", "", &R::ns, of_direction),
                      field("ns_spread", "", &R::ns_spread, "half the distance of the quartiles"),
                      field("ops", "", &R::ops, of_direction),
                      field("error_quantile", "", &R::error_quantile, "of the differences"),
                      field("error_upper", "", &R::error_upper, "its upper confidence bound"),
                      field("worst", "", &R::worst, ""),
                      field("chosen", "", &R::chosen, "it is the plan")};
  }
};
static_assert(describes_every_member<SceneFrontRow>());

template <>
struct Description<ScenePicture> {
  static constexpr auto fields() {
    using P = ScenePicture;
    return std::tuple{field("material", "", &P::material, ""),
                      field("light", "", &P::light, ""),
                      field("pixels", "", &P::pixels, "width and height"),
                      field("everything", "", &P::everything,
                            "with all effects, as a display shows it: a PNG in base64"),
                      field("planned", "", &P::planned, "the same as planned"),
                      field("difference", "", &P::difference,
                            "50 times ΔE2000 of these, a byte of at most 254 a pixel in base64; "
                            "255 beside the sphere"),
                      field("worst", "", &P::worst, "greatest difference of a pixel")};
  }
};
static_assert(describes_every_member<ScenePicture>());

template <>
struct Description<SceneLeftOut> {
  static constexpr auto fields() {
    using L = SceneLeftOut;
    return std::tuple{field("material", "", &L::material, "of the asset"),
                      field("why", "", &L::why, "found and expected")};
  }
};
static_assert(describes_every_member<SceneLeftOut>());

template <>
struct Description<ScenesReport> {
  static constexpr auto fields() {
    using R = ScenesReport;
    return std::tuple{
        constant_text("schema", "gonio.report.scenes/1"),
        field("full", "", &R::full, setting_meaning),
        field("findings", "", at(&R::findings, &Findings::sentences), findings_meaning),
        field(
            "quantile", "", [](const R& r) { return r.rows.tolerance.quantile; },
            "of the tolerance"),
        field(
            "limit", "", [](const R& r) { return r.rows.tolerance.limit; },
            "that it keeps, ΔE2000"),
        field(
            "max", "", [](const R& r) { return r.rows.tolerance.max; },
            "that no point passes, ΔE2000"),
        field(
            "confidence", "", [](const R& r) { return r.rows.tolerance.confidence; }, ""),
        field("rows", "", at(&R::rows, &ScenesRows::rows), "a material under a light, each"),
        field("effects", "", at(&R::rows, &ScenesRows::effects), "an effect of one of these, each"),
        field("front", "", at(&R::rows, &ScenesRows::front),
              "sets of forms of which none is cheaper and errs less"),
        field("spheres", "", at(&R::rows, &ScenesRows::pictures), "pictures of the scenes"),
        field("left_out", "", at(&R::rows, &ScenesRows::left_out),
              "materials of the asset that are no scenes here"),
        inlined(&R::pictures)};
  }
};

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
