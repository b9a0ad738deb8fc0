#pragma once
/// \file
/// How far every approximate Fresnel term of the catalogue is from the exact one: dielectrics from both
/// sides, measured metals, spectra; and what that does to the albedo of a rough surface.

#include <string>
#include <string_view>
#include <vector>

#include "reports/finding/report.h"

namespace gonio {

/// A form on a surface, over θ from 0 to 90°, against the exact F.
struct FresnelRow {
  std::string form;  ///< id, with what tells a variant from it
  /// "dielectric", "dielectric_inside": light in the denser medium; "metal"; "spectral": linear RGB
  std::string kind;
  std::string name;               ///< "IOR 1.5", "gold, red"
  std::string material, channel;  ///< of the name; the channel of a grey surface is empty
  double eta, k;  ///< transmitted over incident; not a number where it is a spectrum
  double max_abs, max_abs_theta_deg;
  double max_rel, max_rel_theta_deg;
  double rms;         ///< of the error, mean over θ
  double bias;        ///< 2 ∫ (F − exact) c dc: of light from everywhere
  double within_deg;  ///< up to which angle the error is at most 0.01
};

/// F − exact by index and angle: [index][angle].
struct FresnelMap {
  std::string form, kind;
  std::vector<double> error;
};
/// F of a named material by angle.
struct FresnelCurve {
  std::string form;  ///< "exact" too
  std::string kind, material, channel;
  std::vector<double> value;
};
/// The albedo of GGX under Smith masking, correlated, with a form as F, by roughness.
struct FresnelAlbedo {
  std::string form, material, channel;
  double mu;
  std::vector<double> albedo, exact;
  double bound;  ///< of all of them
};

/// The colours of those albedos under D65 against the exact ones', by roughness.
struct FresnelColour {
  std::string form, material;
  double mu;
  std::vector<double> delta_e;  ///< CIEDE2000
};

struct SchlickReport {
  std::vector<FresnelRow> rows;
  std::vector<double> map_ior, map_theta_deg;
  std::vector<FresnelMap> maps;  ///< the exact values among them, as the form "exact"
  std::vector<double> curve_theta_deg;
  std::vector<FresnelCurve> curves;
  std::vector<double> roughness;
  std::vector<FresnelAlbedo> albedos;
  std::vector<FresnelColour> colours;
  std::vector<std::string> findings;  ///< sentences
  std::vector<Claim> claims;
  bool full = false;
};

/// Where everything is measured.
struct SchlickOptions {
  bool full = false;
  std::vector<double> ior;        ///< ascending
  std::size_t angles;             ///< equal steps of θ
  std::vector<double> roughness;  ///< ascending
};
/// Quick: IOR by 0.02, θ by 0.1°; full: by 0.01 and 0.01°.
SchlickOptions schlick_options(bool full);

SchlickReport schlick_report(const SchlickOptions&, const ReportProgress& done = {});

/// What its page shows, by family: maps exact_reflectance, error_by_angle, relative_error_by_angle of form and side; figures
/// error_by_index of the same, reflectance and reflectance_error of material, kind and channel, albedo_error,
/// albedo_relative_error and colour_difference of material, channel and mu.
Pictures pictures(const SchlickReport&);

/// {"rows": […], …}: flat objects; what is not known is null.
std::string to_json(const SchlickReport&);
/// \param data  of to_json() above
std::string schlick_page_html(std::string_view data);

}  // namespace gonio
