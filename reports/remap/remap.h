#pragma once
/// \file
/// Masking forms of shaders beside exact Smith: how far G₂ and E are off, and which roughness
/// of exact Smith each of them behaves like.

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "reports/finding/report.h"

namespace gonio {

namespace page {
struct Page;
}

/// Cosines at which E is computed, and where directions are compared, are at least this.
inline constexpr double remap_least_cosine = 0.05;

/// A masking form at one roughness, under the distribution it is for.
struct RemapForm {
  std::string form, ndf;       ///< ids
  std::string formula, ships;  ///< of the catalogue
  std::size_t operations = 0;  ///< of one sample, all kinds alike
  std::size_t roots = 0;       ///< square roots among them
  bool reads_half = false;     ///< VoH or NoH; its G2 is averaged over azimuths

  struct At {
    double roughness;
    std::vector<double> albedo;  ///< at RemapOptions::mu, F = 1
    double error;                ///< of each of them, at most
    std::vector<double> g2;  ///< over RemapOptions::cosines × same, NoL by NoL; empty: not kept
  };
  std::vector<At> at;  ///< roughness by roughness
};

/// Least squares over a roughness.
struct NearestRoughness {
  double roughness;
  double left;  ///< RMS of what differs there
  bool at_end;  ///< the best lies at the end of what was looked at: it may be beyond
};

/// A form against a reference at one roughness.
struct RemapRow {
  std::string form, reference;
  double roughness;
  /// Errors of G2 − reference over NoL, NoV in [0.05, 1]², uniform in cosine.
  double rms, rms_error, bias;
  double max_rel, max_rel_nol, max_rel_nov;       ///< of |G2 / reference − 1|
  double albedo, albedo_reference, albedo_error;  ///< at mu = 0.5, F = 1; error: of both together
  NearestRoughness by_g2;                         ///< of the reference's masking alone
  NearestRoughness by_albedo;                     ///< of its distribution and masking, over all mu
};

/// A k of Schlick's form in either use, beside exact Smith.
struct RemapUse {
  std::string form;
  std::string_view light;  ///< "even": E of an even environment, F = 1; "single": G2, l mirroring v
  double mu, roughness;
  double value, separable, correlated;
};

/// Schlick's G1 where the seeds say what it is.
struct RemapG1 {
  double k, nov, claimed, value;
  double roughness;  ///< that this k is meant for there
  double smith;      ///< exact G1 of that roughness
};

/// A form that stands in place of V F, over V F of Smith (correlated) and an exact Fresnel term.
struct RemapVf {
  std::string form, fresnel;
  std::string_view over;  ///< "all": NoL, NoV in [0.05, 1]², azimuths even; "mirror": h = n
  double roughness;
  double bias, factor;  ///< exp of the mean, of the RMS of ln(ratio)
  double least, most;   ///< of the ratio
};

/// Everything that the report measures.
struct RemapRows {
  std::vector<double> mu, cosines;
  std::vector<RemapForm> forms;
  std::vector<RemapRow> rows;
  std::vector<RemapUse> uses;
  std::vector<RemapG1> g1;
  std::vector<RemapVf> vf;
};

/// Places where everything is measured.
struct RemapOptions {
  bool full = false;
  std::vector<double> roughness;     ///< ascending, up to 1
  std::vector<double> shown;         ///< of them, those whose G2 is kept for pictures
  std::size_t azimuths = 32;         ///< over which forms of the half vector are averaged
  double step = 0.0125;              ///< in roughness, of the references' E; between, E is a line
  std::vector<std::string> forms{};  ///< ids; empty: all
};
/// Standard: by 0.05 in roughness; full: by 0.025, and more azimuths.
RemapOptions remap_options(bool full);

RemapRows remap_rows(const RemapOptions&, const ReportProgress& done = {});
Findings findings(const RemapRows&);
Facts facts(const RemapRows&);
/// Pictures of the page, by family: maps g2 of form, masking_error of form and reference, both in slices of roughness; figures rms
/// of distribution and reference, behaves_like of these and by what, furnace of distribution and roughness, each_k of light and
/// mu, in_place_of_vf of form, fresnel and over.
Pictures pictures(const RemapRows&);

using RemapReport = Report<RemapRows>;
RemapReport remap_report(const RemapOptions&, const ReportProgress& done = {});

/// "smith_ggx.separable" or "correlated", or Beckmann's, as ids.
std::array<std::string, 2> references_of(std::string_view ndf);
/// Last part of an id: "correlated".
std::string last_word(std::string_view id);
/// RMS of G2 − reference over directions and roughness; no value where they were not compared.
std::optional<double> overall_rms(const RemapRows&,
                                  std::string_view form,
                                  std::string_view reference);
/// The form of that id; nullptr if it was not looked at.
const RemapForm* find_form(const std::vector<RemapForm>&, std::string_view id);

/// Document {"rows": […], …}: flat objects; what is not known is null.
std::string to_json(const RemapReport&);
/// Its rows as CSV.
std::string rows_csv(const RemapReport&);
/// JSON Schema of the document.
std::string remap_schema();
/// Its page.
page::Page report_page(const RemapReport&);

}  // namespace gonio
