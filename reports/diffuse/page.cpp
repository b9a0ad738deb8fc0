// The report on diffuse forms as JSON.
#include "reports/diffuse/diffuse.h"
#include "reports/picture/document.h"

namespace gonio {

template <>
struct Description<DiffuseRow> {
  static constexpr auto fields() {
    using R = DiffuseRow;
    return std::tuple{field("form", "", &R::form, "id"),
                      field("roughness", "", &R::roughness, "as a renderer's slider sets it"),
                      field("mu", "", &R::mu, "cosine of the angle to the normal"),
                      field("albedo", "", &R::albedo,
                            "directional, at kd = 1; of a coupled form what a lobe leaves"),
                      field("error", "", &R::error, "bound of the albedo's own"),
                      field("average", "", &R::average, "2 ∫ E μ dμ at this roughness")};
  }
};
static_assert(describes_every_member<DiffuseRow>());

template <>
struct Description<DiffuseForm> {
  static constexpr auto fields() {
    using F = DiffuseForm;
    return std::tuple{
        field("form", "", &F::id, "id"),
        field("name", "", &F::name, ""),
        field("parameter", "", &F::parameter, "its own, by the slider's roughness r"),
        field("coupled", "", &F::coupled, "it reflects what a lobe's interface leaves"),
        field("with_interface", "", &F::with_interface,
              "an interface of F0 = 0.04 is in it, or above it"),
        field("most_albedo", "", &F::most_albedo, "largest of a direction, at kd = 1"),
        field("most_roughness", "", &F::most_roughness, "where that is"),
        field("most_mu", "", &F::most_mu, "where that is"),
        field("least_average", "", &F::least_average, "least average albedo over roughness"),
        field("reciprocity", "", &F::reciprocity, "most |f(l,v) − f(v,l)| over the larger of them"),
        field("most_with_lobe", "", &F::most_with_lobe,
              "largest albedo with a GGX lobe of F0 = 0.04 on top"),
        field("operations", "", &F::operations, "of one sample"),
        field("cost_ns", "ns", &F::ns, "time of a sample in float, in cache, median"),
        field("spread_ns", "ns", &F::spread_ns, "half the distance of the quartiles")};
  }
};
static_assert(describes_every_member<DiffuseForm>());

template <>
struct Description<DiffuseColour> {
  static constexpr auto fields() {
    using C = DiffuseColour;
    return std::tuple{
        field("form", "", &C::form, "id"),
        field("surface", "", &C::surface, "matte: against EON; plastic: against EON below a lobe"),
        field("material", "", &C::material, "chalk, grey, terracotta"),
        field("light", "", &C::light, "front, side, rim: of a ball; even: of a plane, by angle"),
        field("roughness", "", &C::roughness, ""),
        field("delta_e_2000", "", &C::delta_e, "that a twentieth of the points exceeds"),
        field("delta_e_2000_mean", "", &C::delta_e_mean, "over the points")};
  }
};
static_assert(describes_every_member<DiffuseColour>());

template <>
struct Description<DiffuseReport> {
  static constexpr auto fields() {
    using R = DiffuseReport;
    return std::tuple{
        constant_text("schema", "gonio.report.diffuse/1"),
        field("full", "", &R::full, setting_meaning),
        field("findings", "", at(&R::findings, &Findings::sentences), findings_meaning),
        field("rows", "", at(&R::rows, &DiffuseRows::rows), "a form at a roughness and an angle"),
        field("forms", "", at(&R::rows, &DiffuseRows::forms), ""),
        field("colours", "", at(&R::rows, &DiffuseRows::colours), "beside the reference"),
        inlined(&R::pictures)};
  }
};

std::string to_json(const DiffuseReport& r) {
  return page_document(r);
}
std::string rows_csv(const DiffuseReport& r) {
  return csv_of(r.rows.rows, Digits::six);
}
std::string diffuse_schema() {
  return schema_text<DiffuseReport>("gonio report diffuse");
}

}  // namespace gonio
