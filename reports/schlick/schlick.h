#pragma once
/// \file
/// Errors of every approximate Fresnel term of the catalogue: dielectrics from both
/// sides, measured metals, spectra; and what that does to the albedo of a rough surface.

#include <array>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "reports/finding/report.h"
#include "reports/measure/fresnel_error.h"

namespace gonio {

namespace page {
struct Page;
}

/// F − exact of a form by index and angle: [index][angle].
struct FresnelMap {
  std::string form, kind;
  std::vector<double> error;
};
struct FresnelMaps {
  std::vector<double> ior, theta_deg;
  std::vector<FresnelMap> maps;  ///< the exact values among them, as the form "exact"
};

/// F of a named material by angle.
struct FresnelCurve {
  std::string form;  ///< "exact" too
  std::string kind, material, channel;
  std::vector<double> value;
};
struct FresnelCurves {
  std::vector<double> theta_deg;
  std::vector<FresnelCurve> curves;
};

/// Cosines of the view at which albedos and colours are shown.
inline constexpr std::array albedo_mus{0.1, 0.5, 1.0};
/// Cosines of the view over which the greatest ΔE2000 is sought: 0.1 to 1 by 0.05.
std::vector<double> colour_mus();

/// Albedo of GGX under Smith masking, correlated, with a form as F, by roughness.
struct FresnelAlbedo {
  std::string form, material, channel;
  double mu;
  std::vector<double> albedo, exact;
  double bound;  ///< of all of them
};
/// Colours of albedos at colour_mus() under D65 against the exact ones', by roughness.
struct FresnelColour {
  std::string form, material;
  double mu;
  std::vector<double> delta_e;  ///< CIEDE2000
};
struct RoughFresnel {
  std::vector<double> roughness;
  std::vector<FresnelAlbedo> albedos;
  std::vector<FresnelColour> colours;
};

/// Greatest ΔE2000, over roughness and views, of a rough surface under Unreal's joint masking, the nearest of the cheap ones, from
/// one under exact Smith; both with the exact Fresnel term.
struct MaskingColour {
  std::string material, kind;  ///< as of a FresnelSurface
  double delta_e;
};

/// Everything that the report measures.
struct SchlickRows {
  std::vector<FresnelRow> smooth;
  FresnelMaps maps;
  FresnelCurves curves;
  RoughFresnel rough;
  std::vector<MaskingColour> masked{};
};

/// Places where everything is measured.
struct SchlickOptions {
  bool full = false;
  std::vector<double> ior;        ///< ascending
  std::size_t angles;             ///< equal steps of θ
  std::vector<double> roughness;  ///< ascending
};
/// Standard: IOR by 0.02, θ by 0.1°; full: by 0.01 and 0.01°.
SchlickOptions schlick_options(bool full);

std::vector<FresnelRow> smooth_rows(const SchlickOptions&, const std::function<void(double)>& done);
FresnelMaps fresnel_maps();
FresnelCurves fresnel_curves();
RoughFresnel rough_rows(const SchlickOptions&, const std::function<void(double)>& done);
std::vector<MaskingColour> masked_rows(const SchlickOptions&,
                                       const std::function<void(double)>& done);
/// All of these.
SchlickRows schlick_rows(const SchlickOptions&, const ReportProgress& done = {});

Findings findings(const SchlickRows&);
Facts facts(const SchlickRows&);
/// Pictures of the page, by family: maps exact_reflectance, error_by_angle, relative_error_by_angle of form and side; figures
/// error_by_index of the same, reflectance and reflectance_error of material, kind and channel, albedo_error,
/// albedo_relative_error and colour_difference of material, channel and mu.
Pictures pictures(const SchlickRows&);

using SchlickReport = Report<SchlickRows>;
SchlickReport schlick_report(const SchlickOptions&, const ReportProgress& done = {});

/// Document {"rows": […], …}: flat objects; what is not known is null.
std::string to_json(const SchlickReport&);
/// Its rows as CSV.
std::string rows_csv(const SchlickReport&);
/// JSON Schema of the document.
std::string schlick_schema();
/// Its page.
page::Page report_page(const SchlickReport&);

}  // namespace gonio
