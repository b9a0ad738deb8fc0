#pragma once
/// \file
/// Tables sampled from the models, with noise: what a perfect or an imperfect instrument would have
/// measured.

#include <array>
#include <cstdint>

#include "base/describe.h"
#include "base/names.h"
#include "brdf/model/model.h"
#include "table/table.h"

namespace gonio {

/// Where the samples are taken, and the file format that goes with it.
enum class Layout {
  merl,   ///< 90 × 90 × 180 over theta_h, theta_d, phi_d; MERL binary, three channels
  mbsdf,  ///< 45 × 45 × 90 over theta_i, theta_o, phi; NVIDIA MBSDF
  utia,  ///< 241 × 241 directions, θ by 15° to 75° and φ by 7.5°, of anisotropic models too; UTIA
         ///< binary, three channels
  in_plane,  ///< 5 incident angles × theta_o −85° to 85° by 1° in the plane of incidence; CSV
  rgl,       ///< at the 32 × 64 × 64 points that rgl_table() chooses; RGL tensor file, r g b
  image_slice,  ///< 90 × 90 (or `slice`) over theta_h, theta_d at phi_d = 90°; OpenEXR
  hemisphere,   ///< 6 incident angles × theta_o by 5° × phi_o by 10°; CSV
  random        ///< half uniform over both hemispheres, half with theta_h log-uniform; CSV
};
template <>
inline constexpr std::array<std::string_view, 8> names_of<Layout>{
    "merl", "mbsdf", "utia", "in_plane", "rgl", "image_slice", "hemisphere", "random"};

/// From its description follow options of `gonio synth` and keywords of Python's `synth`.
struct SynthOptions {
  Layout layout = Layout::merl;
  Bins bins = Bins::centre;
  std::size_t samples = 2000;
  std::size_t slice = 90;  ///< bins of an image slice along each axis
  double noise = 0;
  double floor = 0;
  double outliers = 0;  ///< share of samples multiplied by 10^u, u uniform in [−2, 2]
  std::uint64_t seed = 1;
  bool uncertainty = false;  ///< whether the table states noise × value as uncertainty
};
template <>
inline constexpr auto description<SynthOptions> = FieldList{
    Field{"bins", &SynthOptions::bins, "where samples sit in their bins, of layouts with bins"},
    Field{"samples", &SynthOptions::samples, "number of samples of the random layout",
          Numbers{1, 1e7}},
    Field{"noise", &SynthOptions::noise,
          "multiplies each value by exp(NOISE · z), z standard normal", Numbers{0, 5}},
    Field{"floor", "1/sr", &SynthOptions::floor, "added to every value before the noise",
          Numbers{0, 1e6}},
    Field{"outliers", &SynthOptions::outliers, "share of samples thrown off by up to 100 times",
          Numbers{0, 1}},
    Field{"seed", &SynthOptions::seed, "the same table for the same seed, whatever the threads"},
    Field{"uncertainty", &SynthOptions::uncertainty,
          "states each value's standard uncertainty, NOISE × value, in a CSV table"}};

/// Directions of the random layout, less than 87° from the normal.
DirectionList random_pairs(std::size_t n, std::uint64_t seed);

/// Values below the horizon are 0 in the table (a format's writer marks them its way).  The same for
/// a seed whatever the threads: every draw is a hash of seed, sample and channel.
/// An RGL table is what renderers draw from and takes no noise: wrong_usage.
/// \param aperture  what each value is the mean over, of layouts that are direction lists; wrong_usage of others
Table synthesize(const BoundModel&, const SynthOptions&, const Aperture& aperture = {});

}  // namespace gonio
