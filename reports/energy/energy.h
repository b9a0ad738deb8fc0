#pragma once
/// \file
/// Energy that single scattering loses, per masking, roughness, angle and material, and what gives it back:
/// every figure a distance to a truth, with the error of both and the cost.

#include <cstdint>
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

/// Roughnesses at which the loss exceeds a share.
struct Crossing {
  double share;  ///< 0.01, 0.05, 0.1
  double mu;     ///< 0: on average over the hemisphere
  struct Range {
    double from, to;  ///< the least or the largest roughness looked at: from or up to there and
                      ///< perhaps beyond
  };
  std::vector<Range> ranges;  ///< none: nowhere
  double error;               ///< of each end that is no end of what was looked at
};

/// A distribution under a masking at F = 1, or a whole model in white.
struct EnergyForm {
  std::string name;           ///< what tells it from the others
  std::string ndf, masking;   ///< ids
  std::string model{};        ///< id of a whole model, else empty
  double gamma = 0;           ///< of GTR, else 0
  double most_roughness = 1;  ///< that it is meant for
  /// Divisor of an engine: π where a shipped formula leaves out 1/π.
  double divisor = 1;

  struct Average {
    double roughness, albedo, error;
  };
  struct At {
    double roughness, mu, albedo, error;
  };
  std::vector<At> rows{};             ///< roughness by roughness
  std::vector<Average> averages{};    ///< 2 ∫ E μ dμ
  std::vector<Crossing> crossings{};  ///< of the loss 1 − E
};

/// Colours of one microsurface (GGX, Smith correlated), each with its truth.
struct EnergyMaterial {
  /// "F0 = 0.04"; "gold, red" is a channel of the linear sRGB in which gold's spectrum is seen under D65.
  std::string name;
  std::string fresnel;  ///< id

  struct At {
    double roughness, mu;  ///< mu 0: the average
    double truth, error;   ///< all bounces, deterministic, and its bound
    std::vector<double> orders;
    struct Scattering {
      std::string_view id;  ///< "single", "kulla_conty", …
      double albedo;
    };
    std::vector<Scattering> scattering;
  };
  std::vector<At> rows;
  /// Crossings of the loss as a share of what should leave: 1 − E_single / E, E between the roughnesses of the rows
  /// by the polynomial through the four nearest.
  std::vector<Crossing> crossings;
  double normal = 0;           ///< reflectance at normal incidence, in [0, 1]
  std::optional<double> f0{};  ///< of Schlick's Fresnel; none of another
};

/// An estimator of E by how long it takes.
struct EstimatorPoint {
  std::string_view estimator;
  double roughness, mu;
  double goal;  ///< error asked for, or samples
  double error,
      bound;  ///< of the value, RMS over repeats; bound: what it says itself, 0 if it says none
  double evaluations;    ///< of the model; not a number where it is not the model that is evaluated
  double ns, ns_spread;  ///< median, and half the distance of the quartiles
};

/// Error of the albedo that a compensation gives, against the truth, with E, E_avg, A and B as a shader looks them up: in half, 32 × 32
/// texels and 32, bilinear.
struct CompensationError {
  std::string_view id;
  double worst, rms;  ///< over the materials of Schlick's Fresnel in compensation_domain()
  std::string worst_at;
  double gold_rms;  ///< not a number: not for it, or not looked at
};

/// Work of a compensation in a shader, beside that of single scattering.
struct CompensationWork {
  std::string_view id;
  std::size_t operations;  ///< of its formula, tables aside
  std::size_t lookups;     ///< bilinear
  std::size_t bytes;       ///< of its tables, 32 × 32 in half
};

/// Cost of a compensation where a shader evaluates it.
struct CompensationCost {
  std::string_view id;
  std::size_t operations, lookups, bytes;  ///< as its CompensationWork
  /// D V F of one light and view, or the split sum's F0 A + B
  double without_ns, without_spread_ns;
  double ns, spread_ns;  ///< the same compensated, one at a time in float
  double worst, rms;     ///< as its CompensationError
  std::string worst_at;
  double gold_rms;
};

/// Picture of a ball under one light: how far a compensation is from all bounces, by random walks at each point.
struct SingleLight {
  std::string_view id;  ///< "single", with nothing, "turquin", "kulla_conty"; their tables exact
  std::string light;    ///< "front light", "rim light"
  double f0, roughness;
  /// ΔE2000 over points with NoL and NoV of 0.1 or more, a white diffuser that faces the light being white: most, and mean
  double delta_e, delta_e_mean;
  double error;  ///< most ΔE2000 that the standard error of the table of walks is worth
};

/// E(α, NoV) at F = 1 as a shader has it, against quadrature, from roughness 0.05 on.
struct AlbedoForm {
  std::string_view id;
  double worst, rms;
  std::string worst_at;
  std::size_t operations, bytes;
};

/// The split sum's table against quadrature, of A + B.
struct TableError {
  std::size_t size;           ///< by size texels
  std::string_view stored;    ///< "float", "half"
  double bound;               ///< of the quadrature in any texel
  double storage;             ///< most that a texel loses when it is stored
  double lookup, lookup_rms;  ///< bilinear, most and RMS over all NoV and roughness
  double between;             ///< most between the outermost texels' centres
};
/// A and B by importance sampling against quadrature.
struct TableSamples {
  std::size_t samples;
  double a, a_rms, b, b_rms;
};
/// Split sum over the integral it stands for − 1, of luminance, over views in an environment.
struct LitError {
  std::string environment;  ///< a sky by formula, or the name of a map given
  double roughness, nov, f0;
  double rms, max, bias;
  double of_mean;  ///< RMS of split − exact, over the mean of exact
  double
      of_mean_spread;  ///< half of what it differs by between one half of the views and the other
  double truth;        ///< what each is off by itself, at most
  /// ΔE2000 between both as a display shows them, a white ball in that light at half of its white: mean over views, and most.
  double delta_e, delta_e_max;
};
/// Time of a pixel under image-based light, on one thread.
struct LightCost {
  std::string_view way;  ///< "split sum", "quadrature"
  double ns, spread_ns;
};
/// Irradiance by a sum over its exact value − 1, over normals.
struct IrradianceRow {
  std::string light;
  std::string_view rule;
  std::size_t samples;
  double rms, max, bias;
  double ns, spread_ns;  ///< of one normal
};

/// Image-based light: the split sum's table, its samples, the split itself, and irradiance by sums.
struct ImageLight {
  std::vector<TableError> tables;
  std::vector<TableSamples> table_samples;
  std::vector<LitError> lit;  ///< under skies by formula, and of the environments given
  std::size_t views = 0;      ///< of each
  std::vector<LightCost> costs;
  std::vector<IrradianceRow> irradiance;
};

/// Roughness from which on the mobile D's clamp at 2048 is not reached, about.
inline constexpr double unclamped_roughness = 0.15;
/// Integrals by which claims in circulation are judged, beside the other rows.
struct ClaimRows {
  /// Share that the mobile D's clamp at 2048 takes from the light reflected at normal incidence.
  struct Clamped {
    double roughness, lost;
  };
  std::vector<Clamped> clamped;
  /// Reflectance of the simple mobile form where its colour is furthest from GGX's.
  struct Look {
    double f0, mu, roughness, shipped, exact, delta_e;
  };
  std::vector<Look> simple_form;
  /// Standard deviation along an axis of slopes up to `most` α, over α.
  struct Slopes {
    double most, deviation;
  };
  std::vector<Slopes> ggx_slopes;
  double beckmann_deviation = 0;
  /// Solid angle of the half vector times 4 VoH over that of the light, less 1: the most.
  struct HalfAngle {
    std::size_t pairs;  ///< of directions
    double step;        ///< of the light, by which it is told [rad]
    double off;
  };
  std::optional<HalfAngle> half_angle;
  /// Share of the facets' projected area that two distributions put at different angles: ½ ∫ |D₁ − D₂| cos θ dω.
  struct Apart {
    double roughness, share;
  };
  std::vector<Apart> phong_from_beckmann{};  ///< by ascending roughness
};

/// Everything that the report measures.
struct EnergyRows {
  std::vector<EnergyForm> forms;
  std::vector<EnergyMaterial> materials;
  std::vector<CompensationCost> compensations;
  std::vector<SingleLight> single_lights;
  std::vector<AlbedoForm> albedo_forms;
  std::vector<EstimatorPoint> estimators;
  ImageLight light;
  ClaimRows claims;
};

/// Places where everything is measured.
struct EnergyOptions {
  bool full = false;
  std::vector<double> roughness, mu;  ///< ascending, up to 1
  std::size_t samples;                ///< of estimators by chance, at most
  std::vector<std::string> forms{};   ///< names; empty: all
  bool gold = true;                   ///< among the materials
  std::vector<ReportOptions::Light> environments{};
  std::size_t views = 16;        ///< in each light
  std::size_t lit_points = 256;  ///< of a ball under a single light
};
/// Standard: by 0.05 in roughness and mu; full: by 0.025.
EnergyOptions energy_options(bool full);

std::vector<EnergyForm> energy_forms(const EnergyOptions&, const std::function<void(double)>& done);
std::vector<EnergyMaterial> energy_materials(const EnergyOptions&,
                                             const std::function<void(double)>& done);
/// Domain over which every report compares compensations: roughness and mu from 0.1 to 1 by 0.1, F0 of 0.04, 0.5, 0.9 and 1.
EnergyOptions compensation_domain();
/// Errors over those of the rows that lie in that domain.
std::vector<CompensationError> compensation_errors(const std::vector<EnergyMaterial>&);
/// "single", with nothing, "kulla_conty", "turquin" and "fdez_aguera".
std::vector<CompensationWork> compensation_work();
/// Costs of the compensations beside those errors; times are measured once in a process.
std::vector<CompensationCost> compensation_costs(const std::vector<EnergyMaterial>&);
std::vector<SingleLight> single_lights(const EnergyOptions&,
                                       const std::function<void(double)>& done);
std::vector<AlbedoForm> albedo_form_errors();
std::vector<EstimatorPoint> estimator_points(const EnergyOptions&,
                                             const std::function<void(double)>& done);
ImageLight image_light(const EnergyOptions&, const std::function<void(double)>& done);
ClaimRows claim_rows(const std::vector<EnergyForm>&);
/// All of these.
EnergyRows energy_rows(const EnergyOptions&, const ReportProgress& done = {});

Findings findings(const EnergyRows&);
Facts facts(const EnergyRows&);
/// Pictures of the page, by family: maps loss of form; figures albedo of form, average_loss, bounces, beyond and compensation of material
/// and angle, compensation_by_angle of material, estimators of roughness and mu, split_sum_samples, irradiance_by_samples and
/// irradiance_by_time of light.
Pictures pictures(const EnergyRows&);

using EnergyReport = Report<EnergyRows>;
EnergyReport energy_report(const EnergyOptions&, const ReportProgress& done = {});

/// The form of that name; nullptr if it was not looked at.
const EnergyForm* find_form(const std::vector<EnergyForm>&, std::string_view name);

/// Document {"rows": […], …}: flat objects; what is not known is null.
std::string to_json(const EnergyReport&);
/// Its rows as CSV.
std::string rows_csv(const EnergyReport&);
/// JSON Schema of the document.
std::string energy_schema();
/// Its page.
page::Page report_page(const EnergyReport&);

}  // namespace gonio
