#pragma once
/// \file
/// Diffuse forms: what each gives back by roughness and angle, what it breaks, how it looks beside a reference, what it costs.

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "reports/finding/report.h"

namespace gonio {

namespace page {
struct Page;
}

/// A form, and what it is over all that it is looked at in, at kd = 1.
struct DiffuseForm {
  std::string id, name;   ///< name: "Disney"
  std::string parameter;  ///< its own, by the roughness r that a renderer's slider sets: "α = r²";
                          ///< empty: it has none
  bool coupled;  ///< it reflects what a lobe's interface leaves: looked at below one of F0 = 0.04
  bool with_interface;  ///< an interface is in it, or above it: it is no matte surface
  double most_albedo, most_roughness,
      most_mu;                   ///< largest share that a direction's light leaves by
  double least_average;          ///< least share on average over the hemisphere
  double reciprocity;            ///< most |f(l, v) − f(v, l)| over the larger of them
  double most_with_lobe;         ///< largest albedo together with a GGX lobe of F0 = 0.04
  std::size_t operations;        ///< of one sample
  double ns = 0, spread_ns = 0;  ///< of a sample, in float, in columns that stay in cache
};

/// Albedo at kd = 1.
struct DiffuseRow {
  std::string form;  ///< id
  double roughness, mu;
  double albedo, error;
  double average;  ///< 2 ∫ E μ dμ at this roughness
};

/// ΔE2000 of a ball, or of a plane under even light, to the reference in the same light.  What a form gives back on average over
/// the hemisphere is the reference's: its kd is so chosen, up to 1.
struct DiffuseColour {
  std::string form;      ///< id
  std::string surface;   ///< "matte", "plastic"
  std::string material;  ///< "chalk", "grey", "terracotta"
  std::string light;     ///< "front light", "side light", "rim light", "even light"
  double roughness;
  double delta_e;       ///< most over the points lit
  double delta_e_mean;  ///< over the points lit
  double given_back;  ///< on average, over the reference's: below 1 where kd would have to exceed 1
};

struct DiffuseRows {
  std::vector<DiffuseForm> forms;
  std::vector<DiffuseRow> rows;
  std::vector<DiffuseColour> colours;
};

struct DiffuseOptions {
  bool full = false;
  std::vector<double> roughness, mu;  ///< ascending
  std::size_t pixels = 48;            ///< along the picture of a ball
  std::vector<std::string> forms{};   ///< ids; empty: all
};
/// Standard: by 0.1 in roughness and mu; full: by 0.05.
DiffuseOptions diffuse_options(bool full);

DiffuseRows diffuse_rows(const DiffuseOptions&, const ReportProgress& done = {});
/// Colours of the forms against their references.
///
/// matte: EON.  plastic: a GGX lobe of F0 = 0.04 and of the same roughness on all, below it in the reference EON coupled by albedos
/// [Kelemen & Szirmay-Kalos 2001], which gives back all that the lobe leaves:
///
///   f = f_EON (1 − E(l)) (1 − E(v))/(1 − E_avg),   E of the lobe
std::vector<DiffuseColour> diffuse_colours(const DiffuseOptions&,
                                           const std::vector<DiffuseForm>&,
                                           const std::function<void(double)>& done);

Findings findings(const DiffuseRows&);
Facts facts(const DiffuseRows&);
/// Pictures of the page, by family: figures average, delta_e of surface, material and light, albedo of form; maps loss of form.
Pictures pictures(const DiffuseRows&);

using DiffuseReport = Report<DiffuseRows>;
DiffuseReport diffuse_report(const DiffuseOptions&, const ReportProgress& done = {});

/// The form of that id; nullptr if it was not looked at.
const DiffuseForm* find_form(const std::vector<DiffuseForm>&, std::string_view id);
/// The largest ΔE2000 of a form over lights and materials, at a roughness or over all of them; no value where it was not compared.
std::optional<double> largest_difference(const std::vector<DiffuseColour>&,
                                         std::string_view form,
                                         std::string_view surface,
                                         std::optional<double> roughness = {});

/// Document {"rows": […], …}: flat objects; what is not known is null.
std::string to_json(const DiffuseReport&);
/// Its rows as CSV.
std::string rows_csv(const DiffuseReport&);
/// JSON Schema of the document.
std::string diffuse_schema();
/// Its page.
page::Page report_page(const DiffuseReport&);

}  // namespace gonio
