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
struct Description<EnergyRow> {
  static constexpr auto fields() {
    using R = EnergyRow;
    return std::tuple{
        field(
            "form", "", [](const R& r) { return r.form->name; },
            "name that tells it from the others"),
        field(
            "ndf", "", [](const R& r) { return r.form->ndf; }, "id"),
        field(
            "masking", "", [](const R& r) { return r.form->masking; }, "id"),
        field(
            "roughness", "", [](const R& r) { return r.at->roughness; }, ""),
        field(
            "mu", "", [](const R& r) { return r.at->mu; }, "cosine of the angle to the normal"),
        field(
            "albedo", "", [](const R& r) { return r.at->albedo; }, "directional, at F = 1"),
        field(
            "loss", "", [](const R& r) { return 1 - r.at->albedo; }, "1 − albedo"),
        field(
            "error", "", [](const R& r) { return r.at->error; }, "bound of the albedo's own"),
        field(
            "average", "", [](const R& r) { return r.average->albedo; },
            "2 ∫ E μ dμ at this roughness"),
        field(
            "average_error", "", [](const R& r) { return r.average->error; }, "bound of its own")};
  }
};

template <>
struct Description<EnergyForm> {
  static constexpr auto fields() {
    using F = EnergyForm;
    return std::tuple{
        field("form", "", &F::name, "name that tells it from the others"),
        field("ndf", "", &F::ndf, "id"),
        field("masking", "", &F::masking, "id"),
        field("model", "", &F::model, "id of a whole model, else empty"),
        field(
            "gamma", "",
            [](const F& f) { return f.gamma > 0 ? std::optional(f.gamma) : std::nullopt; },
            "of GTR"),
        field("divisor", "", &F::divisor, "of an engine that keeps its lights without 1/π")};
  }
};

template <>
struct Description<NamedCrossing> {
  static constexpr auto fields() {
    using C = NamedCrossing;
    return std::tuple{
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
struct Description<EnergyMaterial> {
  static constexpr auto fields() {
    using M = EnergyMaterial;
    return std::tuple{field("material", "", &M::name, ""), field("fresnel", "", &M::fresnel, "id")};
  }
};

template <>
struct Description<TruthRow> {
  static constexpr auto fields() {
    using R = TruthRow;
    return std::tuple{field(
                          "material", "", [](const R& r) { return r.material->name; }, ""),
                      field(
                          "roughness", "", [](const R& r) { return r.at->roughness; }, ""),
                      field(
                          "mu", "", [](const R& r) { return mu_json(r.at->mu); }, mu_meaning),
                      field(
                          "albedo", "", [](const R& r) { return r.at->truth; }, "of all bounces"),
                      field(
                          "error", "", [](const R& r) { return r.at->error; }, "bound of its own"),
                      field(
                          "orders", "", [](const R& r) { return r.at->orders; },
                          "albedo by the number of facets met")};
  }
};

template <>
struct Description<CompensationCost> {
  static constexpr auto fields() {
    using C = CompensationCost;
    return std::tuple{
        field("scattering", "", &C::id, "id"),
        field("operations", "", &C::operations, "of its formula, tables aside"),
        field("lookups", "", &C::lookups, "bilinear, beside those that single scattering needs"),
        field("bytes", "", &C::bytes, "of its tables"),
        field("without_ns", "ns", &C::without_ns, "time of what is compensated, alone"),
        field("without_spread_ns", "ns", &C::without_spread_ns,
              "half the distance of the quartiles"),
        field("cost_ns", "ns", &C::ns, "time of the same compensated"),
        field("spread_ns", "ns", &C::spread_ns, "half the distance of the quartiles"),
        field("worst", "", &C::worst, "error against the truth, of Schlick's Fresnel"),
        field("rms", "", &C::rms, "error against the truth, of Schlick's Fresnel"),
        field("worst_at", "", &C::worst_at, ""),
        field("gold_rms", "", &C::gold_rms, "error on gold; null: not for it")};
  }
};
static_assert(describes_every_member<CompensationCost>());

template <>
struct Description<AlbedoForm> {
  static constexpr auto fields() {
    using A = AlbedoForm;
    return std::tuple{field("form", "", &A::id, "id"),
                      field("worst", "", &A::worst, "error against quadrature"),
                      field("rms", "", &A::rms, "error against quadrature"),
                      field("worst_at", "", &A::worst_at, ""),
                      field("operations", "", &A::operations, "of one value"),
                      field("bytes", "", &A::bytes, "of its table")};
  }
};
static_assert(describes_every_member<AlbedoForm>());

template <>
struct Description<EstimatorPoint> {
  static constexpr auto fields() {
    using E = EstimatorPoint;
    return std::tuple{
        field("estimator", "", &E::estimator, ""),
        field("roughness", "", &E::roughness, ""),
        field("mu", "", &E::mu, "cosine of the angle to the normal"),
        field("goal", "", &E::goal, "error asked for, or samples"),
        field("error", "", &E::error, "of the value, RMS over repeats"),
        field(
            "bound", "",
            [](const E& e) { return e.bound > 0 ? std::optional(e.bound) : std::nullopt; },
            "that it says itself; null: none"),
        field("evaluations", "", &E::evaluations,
              "of the model; null: it is not the model that is evaluated"),
        field("cost_ns", "ns", &E::ns, "time, median"),
        field("spread_ns", "ns", &E::ns_spread, "half the distance of the quartiles")};
  }
};

template <>
struct Description<TableError> {
  static constexpr auto fields() {
    using T = TableError;
    return std::tuple{
        field("size", "", &T::size, "by size texels"),
        field("stored", "", &T::stored, "float, half"),
        field("bound", "", &T::bound, "of the quadrature in any texel"),
        field("storage_max", "", &T::storage, "most that a texel loses when it is stored"),
        field("lookup_max", "", &T::lookup, "most error of a bilinear lookup"),
        field("lookup_rms", "", &T::lookup_rms, "RMS error of a bilinear lookup"),
        field("between_centres_max", "", &T::between,
              "most between the outermost texels' centres")};
  }
};
static_assert(describes_every_member<TableError>());

template <>
struct Description<TableSamples> {
  static constexpr auto fields() {
    using T = TableSamples;
    return std::tuple{
        field("samples", "", &T::samples, ""), field("a_max", "", &T::a, "error of A"),
        field("a_rms", "", &T::a_rms, "error of A"), field("b_max", "", &T::b, "error of B"),
        field("b_rms", "", &T::b_rms, "error of B")};
  }
};
static_assert(describes_every_member<TableSamples>());

template <>
struct Description<LitError> {
  static constexpr auto fields() {
    using L = LitError;
    return std::tuple{
        field("environment", "", &L::environment, "a sky by formula, or the name of a file"),
        field("roughness", "", &L::roughness, ""),
        field("nov", "", &L::nov, ""),
        field("f0", "", &L::f0, ""),
        field("rms", "", &L::rms, "of split sum / integral − 1, over views"),
        field("max", "", &L::max, "most of that"),
        field("bias", "", &L::bias, "mean of that"),
        field("of_mean", "", &L::of_mean, "RMS of split sum − integral, over the integral's mean"),
        field("of_mean_spread", "", &L::of_mean_spread,
              "half of what the halves of the views differ by"),
        field("truth_error", "", &L::truth, "most that an integral is off by itself"),
        field("delta_e_2000", "", &L::delta_e,
              "between both as a display shows them, mean over views"),
        field("delta_e_2000_max", "", &L::delta_e_max, "most of that")};
  }
};
static_assert(describes_every_member<LitError>());

template <>
struct Description<LightCost> {
  static constexpr auto fields() {
    using C = LightCost;
    return std::tuple{
        field("way", "", &C::way, "split sum, quadrature"),
        field("cost_ns", "ns", &C::ns, "time of a pixel, median"),
        field("spread_ns", "ns", &C::spread_ns, "half the distance of the quartiles")};
  }
};
static_assert(describes_every_member<LightCost>());

template <>
struct Description<IrradianceRow> {
  static constexpr auto fields() {
    using I = IrradianceRow;
    return std::tuple{
        field("light", "", &I::light, ""),
        field("rule", "", &I::rule, ""),
        field("samples", "", &I::samples, ""),
        field("rms", "", &I::rms, "of sum / exact − 1, over normals"),
        field("max", "", &I::max, "most of that"),
        field("bias", "", &I::bias, "mean of that"),
        field("cost_ns", "ns", &I::ns, "time of one normal, median"),
        field("spread_ns", "ns", &I::spread_ns, "half the distance of the quartiles")};
  }
};
static_assert(describes_every_member<IrradianceRow>());

template <>
struct Description<EnergyReport> {
  static constexpr auto fields() {
    using R = EnergyReport;
    constexpr auto of = [](auto member) { return at(&R::rows, member); };
    constexpr auto of_light = [](auto member) {
      return at(at(&R::rows, &EnergyRows::light), member);
    };
    return std::tuple{
        constant_text("schema", "gonio.report.energy/1"),
        field("full", "", &R::full, setting_meaning),
        field("findings", "", at(&R::findings, &Findings::sentences), findings_meaning),
        field("rows", "", rows_of, "a form at a roughness and an angle, each"),
        field("forms", "", of(&EnergyRows::forms), ""),
        field("crossings", "", crossings_of, "roughnesses at which a loss exceeds a share"),
        field("materials", "", of(&EnergyRows::materials), ""),
        field("truth", "", truth_of, "what leaves after all bounces"),
        field("costs", "", of(&EnergyRows::compensations), "of compensations"),
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
