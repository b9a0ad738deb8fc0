// The report on Schlick's approximation as JSON.
#include <algorithm>

#include "reports/picture/document.h"
#include "reports/schlick/schlick.h"

namespace gonio {

template <>
struct Description<FresnelRow> {
  static constexpr auto fields() {
    using R = FresnelRow;
    return std::tuple{
        field("form", "", &R::form, "id of the form, and after a comma which variant of it"),
        field("kind", "", &R::kind,
              "dielectric, dielectric_inside (light in the denser medium), metal, spectral (linear "
              "RGB)"),
        field("name", "", &R::name, "material and channel"),
        field("material", "", &R::material, ""),
        field("channel", "", &R::channel, "empty of a grey surface"),
        field("eta", "", &R::eta, "transmitted over incident index; null of a spectrum"),
        field("k", "", &R::k, "extinction over the incident index; null of a spectrum"),
        field("max_abs", "", &R::max_abs, "greatest |F − exact|"),
        field("max_abs_theta_deg", "°", &R::max_abs_theta_deg, "angle where max_abs is"),
        field("max_rel", "", &R::max_rel, "greatest |F/exact − 1|"),
        field("max_rel_theta_deg", "°", &R::max_rel_theta_deg, "angle where max_rel is"),
        field("rms", "", &R::rms, "RMS of F − exact over the angle"),
        field("bias", "", &R::bias,
              "error of the light that an even sky sends back, 2 ∫ (F − exact) c dc"),
        field("within_1_percent_to_deg", "°", &R::within_deg,
              "angle up to which the error is at most 0.01")};
  }
};
static_assert(describes_every_member<FresnelRow>());

template <>
struct Description<SchlickReport> {
  static constexpr auto fields() {
    using R = SchlickReport;
    return std::tuple{
        constant_text("schema", "gonio.report.schlick/1"),
        field("full", "", &R::full, setting_meaning),
        field("findings", "", at(&R::findings, &Findings::sentences), findings_meaning),
        field("albedo_error_bound", "", albedo_error_bound,
              "numerical error of every albedo in the pictures"),
        field("rows", "", at(&R::rows, &SchlickRows::smooth), "one for each form on each surface"),
        inlined(&R::pictures)};
  }
  static double albedo_error_bound(const SchlickReport& r) {
    double bound = 0;
    for (const auto& a : r.rows.rough.albedos) bound = std::max(bound, a.bound);
    return bound;
  }
};

std::string to_json(const SchlickReport& r) {
  return page_document(r);
}
std::string rows_csv(const SchlickReport& r) {
  return csv_of(r.rows.smooth, Digits::six);
}
std::string schlick_schema() {
  return schema_text<SchlickReport>("gonio report schlick");
}

}  // namespace gonio
