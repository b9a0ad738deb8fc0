// The energy report as JSON.
#include <array>
#include <optional>

#include "reports/energy/energy.h"
#include "reports/picture/document.h"

#include <nlohmann/json.hpp>

namespace gonio {
namespace {

/// Row of the document: a form at a roughness and an angle.
struct EnergyRow {
  const EnergyForm* form;
  const EnergyForm::At* at;
  const EnergyForm::Average* average;  ///< at the same roughness
};
std::vector<EnergyRow> rows_of(const EnergyReport& r) {
  std::vector<EnergyRow> out;
  for (const auto& f : r.rows.forms) {
    auto average = f.averages.begin();
    for (const auto& at : f.rows) {
      if (at.roughness != average->roughness) ++average;
      out.push_back({&f, &at, &*average});
    }
  }
  return out;
}

/// Crossing of a form or of a material.
struct NamedCrossing {
  std::optional<std::string> form, material;
  const Crossing* crossing;
};
std::vector<NamedCrossing> crossings_of(const EnergyReport& r) {
  std::vector<NamedCrossing> out;
  for (const auto& f : r.rows.forms)
    for (const auto& c : f.crossings) out.push_back({f.name, {}, &c});
  for (const auto& m : r.rows.materials)
    for (const auto& c : m.crossings) out.push_back({{}, m.name, &c});
  return out;
}

struct TruthRow {
  const EnergyMaterial* material;
  const EnergyMaterial::At* at;
};
std::vector<TruthRow> truth_of(const EnergyReport& r) {
  std::vector<TruthRow> out;
  for (const auto& m : r.rows.materials)
    for (const auto& at : m.rows) out.push_back({&m, &at});
  return out;
}

/// A cosine, or of 0, which stands for it, the average.
Json mu_json(double mu) {
  return mu > 0 ? number_json(mu, Digits::six) : Json("average");
}
constexpr std::string_view mu_meaning = "cosine of the angle to the normal, or \"average\"";

}  // namespace

template <>
inline constexpr auto description<EnergyRow> = FieldList{
    Field{"form", [](const EnergyRow& r) { return r.form->name; }, "name, unlike the others"},
    Field{"ndf", [](const EnergyRow& r) { return r.form->ndf; }, "id"},
    Field{"masking", [](const EnergyRow& r) { return r.form->masking; }, "id"},
    Field{"roughness", [](const EnergyRow& r) { return r.at->roughness; }, ""},
    Field{"mu", [](const EnergyRow& r) { return r.at->mu; }, "cosine of the angle to the normal"},
    Field{"albedo", [](const EnergyRow& r) { return r.at->albedo; }, "directional, at F = 1"},
    Field{"loss", [](const EnergyRow& r) { return 1 - r.at->albedo; }, "1 − albedo"},
    Field{"error", [](const EnergyRow& r) { return r.at->error; }, "bound of the albedo's own"},
    Field{"average", [](const EnergyRow& r) { return r.average->albedo; },
          "2 ∫ E μ dμ at this roughness"},
    Field{"average_error", [](const EnergyRow& r) { return r.average->error; },
          "bound of its own"}};

template <>
inline constexpr auto description<EnergyForm> = FieldList{
    Field{"form", &EnergyForm::name, "name, unlike the others"},
    Field{"ndf", &EnergyForm::ndf, "id"},
    Field{"masking", &EnergyForm::masking, "id"},
    Field{"model", &EnergyForm::model, "id of a whole model, else empty"},
    Field{"gamma",
          [](const EnergyForm& f) { return f.gamma > 0 ? std::optional(f.gamma) : std::nullopt; },
          "of GTR"},
    Field{"divisor", &EnergyForm::divisor, "of an engine that keeps its lights without 1/π"}};

template <>
struct Description<NamedCrossing> {
  static constexpr auto fields() {
    using C = NamedCrossing;
    return FieldList{
        field("form", "", if_there(&C::form), ""),
        field("material", "", if_there(&C::material), ""),
        field(
            "share", "", [](const C& c) { return c.crossing->share; }, "that the loss exceeds"),
        field(
            "mu", "", [](const C& c) { return mu_json(c.crossing->mu); }, mu_meaning),
        field("ranges", "", ranges, "of roughness, from and to"),
        field(
            "error", "",
            [](const C& c) {
              return c.crossing->ranges.empty() ? std::nullopt : std::optional(c.crossing->error);
            },
            "of each end")};
  }
  static std::vector<std::array<double, 2>> ranges(const NamedCrossing& c) {
    std::vector<std::array<double, 2>> out;
    for (const auto& r : c.crossing->ranges) out.push_back({r.from, r.to});
    return out;
  }
};

template <>
inline constexpr auto description<EnergyMaterial> = FieldList{
    Field{"material", &EnergyMaterial::name, ""}, Field{"fresnel", &EnergyMaterial::fresnel, "id"}};

template <>
inline constexpr auto description<TruthRow> =
    FieldList{Field{"material", [](const TruthRow& r) { return r.material->name; }, ""},
              Field{"roughness", [](const TruthRow& r) { return r.at->roughness; }, ""},
              Field{"mu", [](const TruthRow& r) { return mu_json(r.at->mu); }, mu_meaning},
              Field{"albedo", [](const TruthRow& r) { return r.at->truth; }, "of all bounces"},
              Field{"error", [](const TruthRow& r) { return r.at->error; }, "bound of its own"},
              Field{"orders", [](const TruthRow& r) { return r.at->orders; },
                    "albedo by the number of facets met"}};

template <>
inline constexpr auto description<CompensationCost> = FieldList{
    Field{"scattering", &CompensationCost::id, "id"},
    Field{"operations", &CompensationCost::operations, "of its formula, tables aside"},
    Field{"lookups", &CompensationCost::lookups,
          "bilinear, beside those that single scattering needs"},
    Field{"bytes", &CompensationCost::bytes, "of its tables"},
    Field{"without_ns", "ns", &CompensationCost::without_ns, "time of only what is compensated"},
    Field{"without_spread_ns", "ns", &CompensationCost::without_spread_ns,
          "half the distance of the quartiles"},
    Field{"cost_ns", "ns", &CompensationCost::ns, "time of the same compensated"},
    Field{"spread_ns", "ns", &CompensationCost::spread_ns, "half the distance of the quartiles"},
    Field{"worst", &CompensationCost::worst, "error against the truth, of Schlick's Fresnel"},
    Field{"rms", &CompensationCost::rms, "error against the truth, of Schlick's Fresnel"},
    Field{"worst_at", &CompensationCost::worst_at, ""},
    Field{"gold_rms", &CompensationCost::gold_rms, "error on gold; null: not for it"}};
static_assert(describes_every_member<CompensationCost>());

template <>
inline constexpr auto description<SingleLight> = FieldList{
    Field{"scattering", &SingleLight::id, "id"},
    Field{"light", &SingleLight::light, "30° or 120° from the view"},
    Field{"f0", &SingleLight::f0, "of Schlick's Fresnel"},
    Field{"roughness", &SingleLight::roughness, ""},
    Field{"delta_e_2000", &SingleLight::delta_e,
          "from all bounces, by random walks: most over the ball"},
    Field{"delta_e_2000_mean", &SingleLight::delta_e_mean, "mean over the ball"},
    Field{"error", &SingleLight::error, "most ΔE2000 that the walks' standard error is worth"}};
static_assert(describes_every_member<SingleLight>());

template <>
inline constexpr auto description<AlbedoForm> =
    FieldList{Field{"form", &AlbedoForm::id, "id"},
              Field{"worst", &AlbedoForm::worst, "error against quadrature"},
              Field{"rms", &AlbedoForm::rms, "error against quadrature"},
              Field{"worst_at", &AlbedoForm::worst_at, ""},
              Field{"operations", &AlbedoForm::operations, "of one value"},
              Field{"bytes", &AlbedoForm::bytes, "of its table"}};
static_assert(describes_every_member<AlbedoForm>());

template <>
inline constexpr auto description<EstimatorPoint> = FieldList{
    Field{"estimator", &EstimatorPoint::estimator, ""},
    Field{"roughness", &EstimatorPoint::roughness, ""},
    Field{"mu", &EstimatorPoint::mu, "cosine of the angle to the normal"},
    Field{"goal", &EstimatorPoint::goal, "error asked for, or samples"},
    Field{"error", &EstimatorPoint::error, "of the value, RMS over repeats"},
    Field{
        "bound",
        [](const EstimatorPoint& e) { return e.bound > 0 ? std::optional(e.bound) : std::nullopt; },
        "that it says itself; null: none"},
    Field{"evaluations", &EstimatorPoint::evaluations,
          "of the model; null: it is not the model that is evaluated"},
    Field{"cost_ns", "ns", &EstimatorPoint::ns, "time, median"},
    Field{"spread_ns", "ns", &EstimatorPoint::ns_spread, "half the distance of the quartiles"}};

template <>
inline constexpr auto description<TableError> = FieldList{
    Field{"size", &TableError::size, "by size texels"},
    Field{"stored", &TableError::stored, "float, half"},
    Field{"bound", &TableError::bound, "of the quadrature in any texel"},
    Field{"storage_max", &TableError::storage, "most that a texel loses when it is stored"},
    Field{"lookup_max", &TableError::lookup, "most error of a bilinear lookup"},
    Field{"lookup_rms", &TableError::lookup_rms, "RMS error of a bilinear lookup"},
    Field{"between_centres_max", &TableError::between,
          "most between the outermost texels' centres"}};
static_assert(describes_every_member<TableError>());

template <>
inline constexpr auto description<TableSamples> = FieldList{
    Field{"samples", &TableSamples::samples, ""}, Field{"a_max", &TableSamples::a, "error of A"},
    Field{"a_rms", &TableSamples::a_rms, "error of A"},
    Field{"b_max", &TableSamples::b, "error of B"},
    Field{"b_rms", &TableSamples::b_rms, "error of B"}};
static_assert(describes_every_member<TableSamples>());

template <>
inline constexpr auto description<LitError> = FieldList{
    Field{"environment", &LitError::environment, "a sky by formula, or the name of a file"},
    Field{"roughness", &LitError::roughness, ""},
    Field{"nov", &LitError::nov, ""},
    Field{"f0", &LitError::f0, ""},
    Field{"rms", &LitError::rms, "of split sum / integral − 1, over views"},
    Field{"max", &LitError::max, "most of that"},
    Field{"bias", &LitError::bias, "mean of that"},
    Field{"of_mean", &LitError::of_mean, "RMS of split sum − integral, over the integral's mean"},
    Field{"of_mean_spread", &LitError::of_mean_spread,
          "half of what the halves of the views differ by"},
    Field{"truth_error", &LitError::truth, "most that an integral is off by itself"},
    Field{"delta_e_2000", &LitError::delta_e,
          "between both as a display shows them, mean over views"},
    Field{"delta_e_2000_max", &LitError::delta_e_max, "most of that"}};
static_assert(describes_every_member<LitError>());

template <>
inline constexpr auto description<LightCost> = FieldList{
    Field{"way", &LightCost::way, "split sum, quadrature"},
    Field{"cost_ns", "ns", &LightCost::ns, "time of a pixel, median"},
    Field{"spread_ns", "ns", &LightCost::spread_ns, "half the distance of the quartiles"}};
static_assert(describes_every_member<LightCost>());

template <>
inline constexpr auto description<IrradianceRow> = FieldList{
    Field{"light", &IrradianceRow::light, ""},
    Field{"rule", &IrradianceRow::rule, ""},
    Field{"samples", &IrradianceRow::samples, ""},
    Field{"rms", &IrradianceRow::rms, "of sum / exact − 1, over normals"},
    Field{"max", &IrradianceRow::max, "most of that"},
    Field{"bias", &IrradianceRow::bias, "mean of that"},
    Field{"cost_ns", "ns", &IrradianceRow::ns, "time of one normal, median"},
    Field{"spread_ns", "ns", &IrradianceRow::spread_ns, "half the distance of the quartiles"}};
static_assert(describes_every_member<IrradianceRow>());

template <>
struct Description<EnergyReport> {
  static constexpr auto fields() {
    using R = EnergyReport;
    constexpr auto of = [](auto member) { return at(&R::rows, member); };
    constexpr auto of_light = [](auto member) {
      return at(at(&R::rows, &EnergyRows::light), member);
    };
    return FieldList{
        constant_text("schema", "gonio.report.energy/1"),
        field("full", "", &R::full, setting_meaning),
        field("findings", "", at(&R::findings, &Findings::sentences), findings_meaning),
        field("rows", "", rows_of, "a form at a roughness and an angle, each"),
        field("forms", "", of(&EnergyRows::forms), ""),
        field("crossings", "", crossings_of, "roughnesses at which a loss exceeds a share"),
        field("materials", "", of(&EnergyRows::materials), ""),
        field("truth", "", truth_of, "what leaves after all bounces"),
        field("costs", "", of(&EnergyRows::compensations), "of compensations"),
        field("single_lights", "", of(&EnergyRows::single_lights),
              "pictures of a ball under one light"),
        field("albedo_forms", "", of(&EnergyRows::albedo_forms), "E as a shader has it"),
        field("estimators", "", of(&EnergyRows::estimators), "of one E, by time"),
        field("split_sum_tables", "", of_light(&ImageLight::tables), ""),
        field("split_sum_samples", "", of_light(&ImageLight::table_samples), ""),
        field("views", "", of_light(&ImageLight::views), "of each environment"),
        field("split_sum_light", "", of_light(&ImageLight::lit),
              "under skies by formula, and the environments given"),
        field("light_costs", "", of_light(&ImageLight::costs), "of a pixel under such light"),
        field("irradiance", "", of_light(&ImageLight::irradiance), ""),
        inlined(&R::pictures)};
  }
};

std::string to_json(const EnergyReport& r) {
  return page_document(r);
}
std::string rows_csv(const EnergyReport& r) {
  return csv_of(rows_of(r), Digits::six);
}
std::string energy_schema() {
  return schema_text<EnergyReport>("gonio report energy");
}

}  // namespace gonio
