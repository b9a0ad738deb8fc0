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
    return FieldList{
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
inline constexpr auto description<RemapForm> =
    FieldList{Field{"form", &RemapForm::form, "id"},
              Field{"ndf", &RemapForm::ndf, "id of the distribution that it is for"},
              Field{"formula", &RemapForm::formula, ""},
              Field{"ships", &RemapForm::ships, "where"},
              Field{"operations", &RemapForm::operations, "of one sample"},
              Field{"roots", &RemapForm::roots, "square roots among them"},
              Field{"reads_half", &RemapForm::reads_half,
                    "reads VoH or NoH; its G2 is averaged over azimuths"}};

template <>
inline constexpr auto description<RemapG1> =
    FieldList{Field{"k", &RemapG1::k, "of Schlick's G1"},
              Field{"nov", &RemapG1::nov, ""},
              Field{"claimed", &RemapG1::claimed, "G1 as the source says"},
              Field{"value", &RemapG1::value, "G1 as the form gives it"},
              Field{"roughness", &RemapG1::roughness, "that this k is meant for"},
              Field{"smith", &RemapG1::smith, "exact G1 of that roughness"}};
static_assert(describes_every_member<RemapG1>());

template <>
inline constexpr auto description<RemapVf> =
    FieldList{Field{"form", &RemapVf::form, "id of what stands in place of V F"},
              Field{"fresnel", &RemapVf::fresnel, "interface"},
              Field{"over", &RemapVf::over, "all: directions evenly; mirror: h = n"},
              Field{"roughness", &RemapVf::roughness, ""},
              Field{"bias", &RemapVf::bias, "geometric mean of the ratio to exact V F"},
              Field{"factor", &RemapVf::factor, "exp of the RMS of the ratio's logarithm"},
              Field{"least", &RemapVf::least, "ratio"},
              Field{"most", &RemapVf::most, "ratio"}};
static_assert(describes_every_member<RemapVf>());

template <>
struct Description<RemapReport> {
  static constexpr auto fields() {
    using R = RemapReport;
    return FieldList{
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
