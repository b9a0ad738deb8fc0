// The report on Schlick's approximation as JSON.
#include <algorithm>

#include "reports/picture/document.h"
#include "reports/schlick/schlick.h"

namespace gonio {

template <>
inline constexpr auto description<FresnelRow> = FieldList{
    Field{"form", &FresnelRow::form, "id of the form, and after a comma which variant of it"},
    Field{"kind", &FresnelRow::kind,
          "dielectric, dielectric_inside (light in the denser medium), metal, spectral (linear "
          "RGB)"},
    Field{"name", &FresnelRow::name, "material and channel"},
    Field{"material", &FresnelRow::material, ""},
    Field{"channel", &FresnelRow::channel, "empty of a grey surface"},
    Field{"eta", &FresnelRow::eta, "transmitted over incident index; null of a spectrum"},
    Field{"k", &FresnelRow::k, "extinction over the incident index; null of a spectrum"},
    Field{"max_abs", &FresnelRow::max_abs, "greatest |F − exact|"},
    Field{"max_abs_theta_deg", "°", &FresnelRow::max_abs_theta_deg, "angle where max_abs is"},
    Field{"max_rel", &FresnelRow::max_rel, "greatest |F/exact − 1|"},
    Field{"max_rel_theta_deg", "°", &FresnelRow::max_rel_theta_deg, "angle where max_rel is"},
    Field{"rms", &FresnelRow::rms, "RMS of F − exact over the angle"},
    Field{"bias", &FresnelRow::bias,
          "error of the light that an even sky sends back, 2 ∫ (F − exact) c dc"},
    Field{"within_1_percent_to_deg", "°", &FresnelRow::within_deg,
          "angle up to which the error is at most 0.01"}};
static_assert(describes_every_member<FresnelRow>());

template <>
struct Description<SchlickReport> {
  static constexpr auto fields() {
    using R = SchlickReport;
    return FieldList{
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
