// The report on diffuse forms as JSON.
#include "reports/diffuse/diffuse.h"
#include "reports/picture/document.h"

namespace gonio {

template <>
inline constexpr auto description<DiffuseRow> =
    FieldList{Field{"form", &DiffuseRow::form, "id"},
              Field{"roughness", &DiffuseRow::roughness, "as a renderer's slider sets it"},
              Field{"mu", &DiffuseRow::mu, "cosine of the angle to the normal"},
              Field{"albedo", &DiffuseRow::albedo,
                    "directional, at kd = 1; of a coupled form what a lobe leaves"},
              Field{"error", &DiffuseRow::error, "bound of the albedo's own"},
              Field{"average", &DiffuseRow::average, "2 ∫ E μ dμ at this roughness"}};
static_assert(describes_every_member<DiffuseRow>());

template <>
inline constexpr auto description<DiffuseForm> = FieldList{
    Field{"form", &DiffuseForm::id, "id"},
    Field{"name", &DiffuseForm::name, ""},
    Field{"parameter", &DiffuseForm::parameter, "its own, by the slider's roughness r"},
    Field{"coupled", &DiffuseForm::coupled, "it reflects what a lobe's interface leaves"},
    Field{"with_interface", &DiffuseForm::with_interface,
          "an interface of F0 = 0.04 is in it, or above it"},
    Field{"most_albedo", &DiffuseForm::most_albedo, "largest of a direction, at kd = 1"},
    Field{"most_roughness", &DiffuseForm::most_roughness, "where that is"},
    Field{"most_mu", &DiffuseForm::most_mu, "where that is"},
    Field{"least_average", &DiffuseForm::least_average, "least average albedo over roughness"},
    Field{"reciprocity", &DiffuseForm::reciprocity,
          "most |f(l,v) − f(v,l)| over the larger of them"},
    Field{"most_with_lobe", &DiffuseForm::most_with_lobe,
          "largest albedo with a GGX lobe of F0 = 0.04 on top"},
    Field{"operations", &DiffuseForm::operations, "of one sample"},
    Field{"cost_ns", "ns", &DiffuseForm::ns, "time of a sample in float, in cache, median"},
    Field{"spread_ns", "ns", &DiffuseForm::spread_ns, "half the distance of the quartiles"}};
static_assert(describes_every_member<DiffuseForm>());

template <>
inline constexpr auto description<DiffuseColour> =
    FieldList{Field{"form", &DiffuseColour::form, "id"},
              Field{"surface", &DiffuseColour::surface,
                    "matte: against EON; plastic: against EON below a lobe"},
              Field{"material", &DiffuseColour::material, "chalk, grey, terracotta"},
              Field{"light", &DiffuseColour::light,
                    "front, side, rim: of a ball; even: of a plane, by angle"},
              Field{"roughness", &DiffuseColour::roughness, ""},
              Field{"delta_e_2000", &DiffuseColour::delta_e, "most over the points lit"},
              Field{"delta_e_2000_mean", &DiffuseColour::delta_e_mean, "over the points"},
              Field{"given_back", &DiffuseColour::given_back,
                    "on average over the hemisphere, over the reference's; below 1 where kd = 1 "
                    "gives back less"}};
static_assert(describes_every_member<DiffuseColour>());

template <>
inline constexpr auto description<DiffuseReport> = FieldList{
    constant_text("schema", "gonio.report.diffuse/1"),
    Field{"full", &DiffuseReport::full, setting_meaning},
    Field{"findings", at(&DiffuseReport::findings, &Findings::sentences), findings_meaning},
    Field{"rows", at(&DiffuseReport::rows, &DiffuseRows::rows),
          "a form at a roughness and an angle"},
    Field{"forms", at(&DiffuseReport::rows, &DiffuseRows::forms), ""},
    Field{"colours", at(&DiffuseReport::rows, &DiffuseRows::colours), "beside the reference"},
    inlined(&DiffuseReport::pictures)};

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
