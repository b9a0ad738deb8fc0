#pragma once
/// \file
/// Facts: figures of a report's rows by which one form is shipped before another.  A report fills in what it knows; what is
/// decided by them stands in reports/index/decisions.h.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace gonio {

/// Least cosine at which the light that diffuse terms give back is looked at: nearer to grazing it may be more.
inline constexpr double least_diffuse_cosine = 0.02;
/// Colours of diffuse forms are compared where light and view have this cosine or more.
inline constexpr double least_colour_cosine = 0.1;

struct Facts {
  /// Machine, and the columns that times are of.
  struct Setting {
    std::string cpu;  ///< as it calls itself; may be empty
    std::size_t threads;
    std::string isa;  ///< the best instruction set that runs
    /// Processors that other programs kept busy while times were taken; no value: not known
    std::optional<double> others{};
    /// Time of a sample of GGX under correlated Smith and Schlick, fused, in float, in columns that stay in cache [ns]; no value: not
    /// measured
    std::optional<double> model_ns{};
  };
  std::optional<Setting> setting{};
  /// Time of a sample in float, in columns that stay in cache [ns]: of a term; of a whole model, composed of its terms.
  struct Time {
    std::string id;  ///< of the term, or the model's spec
    double ns, spread;
    std::vector<double>
        each{};  ///< in each process that measured, in their order; empty: one alone
  };
  std::vector<Time> in_cache{}, whole{};
  /// RMS distance of a masking form's G₂ from height-correlated Smith's for GGX, over directions and roughness.
  struct Masking {
    std::string form;
    double rms;
  };
  std::vector<Masking> masking{};
  /// Greatest ΔE2000 of a rough surface with a form in place of exact Fresnel: over roughness and views, and seen head on.
  struct Fresnel {
    std::string form, kind, material;  ///< kind: "dielectric", "metal"
    double delta_e, head_on;
  };
  std::vector<Fresnel> fresnel{};
  /// Greatest ΔE2000 of one way to scatter from all bounces, by roughness: over views under even light, or over the pictures of a ball
  /// under single lights.
  struct Scattering {
    std::string id;  ///< "single", "turquin" …
    double f0;       ///< under Schlick's Fresnel
    bool of_image_light;
    std::vector<double> roughness, delta_e;
    std::vector<double> error{};  ///< in delta_e, of random walks; empty: none
  };
  std::vector<Scattering> scattering{};
  /// Time of a compensation over that of single scattering, one light and view at a time in float.
  struct Compensation {
    std::string id;
    bool of_image_light;  ///< else of a single light
    double ns, spread;    ///< [ns]
    std::size_t bytes;    ///< of tables beyond those that single scattering needs
    double without_ns;    ///< of single scattering, in the same run
  };
  std::vector<Compensation> compensations{};
  struct Diffuse {
    std::string id;
    double most_albedo;     ///< of a direction, at kd = 1, over roughness
    bool with_interface;    ///< it is none of a matte surface
    double most_with_lobe;  ///< as most_albedo, with a lobe of F0 = 0.04 on top
    /// Greatest ΔE2000 at equal albedo: of matte surfaces to EON, and below a lobe to EON coupled by albedos.
    std::optional<double> matte{}, below_lobe{};
  };
  std::vector<Diffuse> diffuse{};
  /// Least alpha from which on a distribution, or a lobe times NoL, keeps a relative error in few bits.
  struct Precision {
    std::string id, form, number;  ///< form: how its angles are given, "cross" or "cosine"
    double tolerance;
    std::optional<double> safe_from;
    double zenith_deg = 0;  ///< of a lobe: up to which of light and view
    double least_f0 = 0;    ///< of a lobe
  };
  std::vector<Precision> precision{};
  /// Measured materials by the tail of their highlight, (1 + …)^−γ, as others published it, each fitted with GGX and with GTR, either
  /// with its own height-correlated Smith.
  struct Tails {
    std::size_t determined,
        longer;  ///< materials that determine γ, and those of them with one below 2, which is GGX's
    double gamma;                     ///< that GTR finds, median of those that it determines
    double ggx_log_rms, gtr_log_rms;  ///< RMS of ln f that the fits leave, medians
  };
  std::optional<Tails> tails{};
  /// Table of the split sum that people ship: RMS error of its lookup, over NoV and roughness.
  struct SplitSum {
    std::size_t size, bytes;
    double rms;
    std::size_t skies = 0;  ///< by formula, and environments that were given
    /// Greatest ΔE2000 of the split itself on white metal, mean over the views of one environment and roughness: head on, at cosine
    /// 0.5 and at cosine 0.1.
    std::optional<double> head_on{}, from_side{}, grazing{};
    std::optional<double> ns{};  ///< of a pixel
  };
  std::optional<SplitSum> split_sum{};
};

/// Least roughness from which on a way to scatter is nearer than another, at every one looked at; none: not even at the largest.
/// \param other  under the same light, of the same F0 and at the same roughnesses
std::optional<double> nearer_from(const Facts::Scattering& way, const Facts::Scattering& other);

/// Adds what another report knows.
void join(Facts& to, const Facts& from);

}  // namespace gonio
