// The remap report as JSON.
#include <algorithm>

#include "reports/picture/document.h"
#include "reports/remap/remap.h"

namespace gonio {

template <>
struct Description<RemapRow> {
  static constexpr auto fields() {
    using R = RemapRow;
    using Nearest = NearestRoughness;
    return std::tuple{
        field("form", "", &R::form, "id of the masking term"),
        field("reference", "", &R::reference, "id of the exact one"),
        field("roughness", "", &R::roughness, ""),
        field("rms", "", &R::rms,
              "RMS of G2 − reference over NoL, NoV in [0.05, 1]², uniform in cosine"),
        field("max_rel", "", &R::max_rel, "greatest |G2/reference − 1|"),
        field("albedo_mu_0_5", "", &R::albedo, "E at mu = 0.5, F = 1"),
        field("rms_error", "", &R::rms_error, "numerical error of rms"),
        field("bias", "", &R::bias, "mean of G2 − reference"),
        field("max_rel_nol", "", &R::max_rel_nol, "NoL where max_rel is"),
        field("max_rel_nov", "", &R::max_rel_nov, "NoV where max_rel is"),
        field("albedo_reference", "", &R::albedo_reference, "E of the reference at mu = 0.5"),
        field("albedo_error", "", &R::albedo_error, "numerical error of both albedos together"),
        field("like_by_g2", "", at(&R::by_g2, &Nearest::roughness),
              "roughness of exact Smith whose masking is nearest"),
        field("like_by_g2_left", "", at(&R::by_g2, &Nearest::left), "RMS that is left there"),
        field("like_by_g2_at_end", "", at(&R::by_g2, &Nearest::at_end),
              "true: the nearest may lie beyond the roughnesses tried"),
        field("like_by_albedo", "", at(&R::by_albedo, &Nearest::roughness),
              "roughness of exact Smith whose albedo is nearest, over all mu"),
        field("like_by_albedo_left", "", at(&R::by_albedo, &Nearest::left),
              "RMS that is left there"),
        field("like_by_albedo_at_end", "", at(&R::by_albedo, &Nearest::at_end),
              "true: the nearest may lie beyond the roughnesses tried")};
  }
};

template <>
struct Description<RemapForm> {
  static constexpr auto fields() {
    using F = RemapForm;
    return std::tuple{field("form", "", &F::form, "id"),
                      field("ndf", "", &F::ndf, "id of the distribution that it is for"),
                      field("formula", "", &F::formula, ""),
                      field("ships", "", &F::ships, "where"),
                      field("operations", "", &F::operations, "of one sample"),
                      field("roots", "", &F::roots, "square roots among them"),
                      field("reads_half", "", &F::reads_half,
                            "reads VoH or NoH; its G2 is averaged over azimuths")};
  }
};

template <>
struct Description<RemapG1> {
  static constexpr auto fields() {
    using G = RemapG1;
    return std::tuple{field("k", "", &G::k, "of Schlick's G1"),
                      field("nov", "", &G::nov, ""),
                      field("claimed", "", &G::claimed, "G1 as the source says"),
                      field("value", "", &G::value, "G1 as the form gives it"),
                      field("roughness", "", &G::roughness, "that this k is meant for"),
                      field("smith", "", &G::smith, "exact G1 of that roughness")};
  }
};
static_assert(describes_every_member<RemapG1>());

template <>
struct Description<RemapVf> {
  static constexpr auto fields() {
    using V = RemapVf;
    return std::tuple{field("form", "", &V::form, "id of what stands in place of V F"),
                      field("fresnel", "", &V::fresnel, "interface"),
                      field("over", "", &V::over, "all: directions evenly; mirror: h = n"),
                      field("roughness", "", &V::roughness, ""),
                      field("bias", "", &V::bias, "geometric mean of the ratio to exact V F"),
                      field("factor", "", &V::factor, "exp of the RMS of the ratio's logarithm"),
                      field("least", "", &V::least, "ratio"),
                      field("most", "", &V::most, "ratio")};
  }
};
static_assert(describes_every_member<RemapVf>());

template <>
struct Description<RemapReport> {
  static constexpr auto fields() {
    using R = RemapReport;
    return std::tuple{
        constant_text("schema", "gonio.report.remap/1"),
        field("full", "", &R::full, setting_meaning),
        field("findings", "", at(&R::findings, &Findings::sentences), findings_meaning),
        field("rows", "", at(&R::rows, &RemapRows::rows),
              "one for each form, reference and roughness"),
        field("forms", "", at(&R::rows, &RemapRows::forms), ""),
        field("albedo_error", "", albedo_error, "numerical error of every albedo"),
        field("g1", "", at(&R::rows, &RemapRows::g1), ""),
        field("vf", "", at(&R::rows, &RemapRows::vf), ""),
        inlined(&R::pictures)};
  }
  static double albedo_error(const RemapReport& r) {
    double most = 0;
    for (const auto& f : r.rows.forms)
      for (const auto& at : f.at) most = std::max(most, at.error);
    return most;
  }
};

std::string to_json(const RemapReport& r) {
  return page_document(r);
}
std::string rows_csv(const RemapReport& r) {
  return csv_of(r.rows.rows, Digits::six);
}
std::string remap_schema() {
  return schema_text<RemapReport>("gonio report remap");
}

}  // namespace gonio
