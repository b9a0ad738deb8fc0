#include "optics/spectrum.h"

#include <algorithm>
#include <cmath>

#include "optics/fresnel.h"

namespace gonio {
namespace {

/// Colour-matching functions of the CIE 1931 2° observer and relative power of the illuminant D65.
struct Observation {
  double x, y, z, d65;
};

// From 360 to 830 nm by 5 nm                                                          [CIE
// 015:2018]
// clang-format off
constexpr std::array<Observation, wavelengths> observations{{
    {0.0001299, 3.917e-06, 0.0006061, 46.638302}, {0.0002321, 6.965e-06, 0.001086, 49.363701},
    {0.0004149, 1.239e-05, 0.001946, 52.0891}, {0.0007416, 2.202e-05, 0.003486, 51.032299},
    {0.001368, 3.9e-05, 0.006450001, 49.975498}, {0.002236, 6.4e-05, 0.01054999, 52.311798},
    {0.004243, 0.00012, 0.02005001, 54.648201}, {0.00765, 0.000217, 0.03621, 68.7015},
    {0.01431, 0.000396, 0.06785001, 82.754898}, {0.02319, 0.00064, 0.1102, 87.120399},
    {0.04351, 0.00121, 0.2074, 91.486}, {0.07763, 0.00218, 0.3713, 92.4589},
    {0.13438, 0.004, 0.6456, 93.431801}, {0.21477, 0.0073, 1.0390501, 90.056999},
    {0.2839, 0.0116, 1.3856, 86.682297}, {0.3285, 0.01684, 1.62296, 95.773598},
    {0.34828, 0.023, 1.74706, 104.864998}, {0.34806, 0.0298, 1.7826, 110.935997},
    {0.3362, 0.038, 1.77211, 117.008003}, {0.3187, 0.048, 1.7441, 117.410004},
    {0.2908, 0.06, 1.6692, 117.811996}, {0.2511, 0.0739, 1.5281, 116.335999},
    {0.19536, 0.09098, 1.28764, 114.861}, {0.1421, 0.1126, 1.0419, 115.391998},
    {0.09564, 0.13902, 0.8129501, 115.922997}, {0.05795001, 0.1693, 0.6162, 112.366997},
    {0.03201, 0.20802, 0.46518, 108.810997}, {0.0147, 0.2586, 0.3533, 109.082001},
    {0.0049, 0.323, 0.272, 109.353996}, {0.0024, 0.4073, 0.2123, 108.578003},
    {0.0093, 0.503, 0.1582, 107.802002}, {0.0291, 0.6082, 0.1117, 106.295998},
    {0.06327, 0.71, 0.07824999, 104.790001}, {0.1096, 0.7932, 0.05725001, 106.238998},
    {0.1655, 0.862, 0.04216, 107.689003}, {0.2257499, 0.9148501, 0.02984, 106.046997},
    {0.2904, 0.954, 0.0203, 104.404999}, {0.3597, 0.9803, 0.0134, 104.224998},
    {0.4334499, 0.9949501, 0.008749999, 104.045998}, {0.5120501, 1, 0.005749999, 102.023003},
    {0.5945, 0.995, 0.0039, 100}, {0.6784, 0.9786, 0.002749999, 98.167099},
    {0.7621, 0.952, 0.0021, 96.334198}, {0.8425, 0.9154, 0.0018, 96.061096},
    {0.9163, 0.87, 0.001650001, 95.788002}, {0.9786, 0.8163, 0.0014, 92.236801},
    {1.0263, 0.757, 0.0011, 88.6856}, {1.0567, 0.6949, 0.001, 89.345901},
    {1.0622, 0.631, 0.0008, 90.006203}, {1.0456, 0.5668, 0.0006, 89.802597},
    {1.0026, 0.503, 0.00034, 89.599098}, {0.9384, 0.4412, 0.00024, 88.648903},
    {0.8544499, 0.381, 0.00019, 87.6987}, {0.7514, 0.321, 0.0001, 85.493599},
    {0.6424, 0.265, 4.999999e-05, 83.288597}, {0.5419, 0.217, 3e-05, 83.493896},
    {0.4479, 0.175, 2e-05, 83.699203}, {0.3608, 0.1382, 1e-05, 81.862999},
    {0.2835, 0.107, 0, 80.026802}, {0.2187, 0.0816, 0, 80.120697}, {0.1649, 0.061, 0, 80.2146},
    {0.1212, 0.04458, 0, 81.246201}, {0.0874, 0.032, 0, 82.277802}, {0.0636, 0.0232, 0, 80.280998},
    {0.04677, 0.017, 0, 78.284203}, {0.0329, 0.01192, 0, 74.002701},
    {0.0227, 0.00821, 0, 69.721298}, {0.01584, 0.005723, 0, 70.665199},
    {0.01135916, 0.004102, 0, 71.6091}, {0.008110916, 0.002929, 0, 72.978996},
    {0.005790346, 0.002091, 0, 74.348999}, {0.004109457, 0.001484, 0, 67.976501},
    {0.002899327, 0.001047, 0, 61.604}, {0.00204919, 0.00074, 0, 65.744797},
    {0.001439971, 0.00052, 0, 69.885597}, {0.0009999493, 0.0003611, 0, 72.486298},
    {0.0006900786, 0.0002492, 0, 75.086998}, {0.0004760213, 0.0001719, 0, 69.339798},
    {0.0003323011, 0.00012, 0, 63.592701}, {0.0002348261, 8.48e-05, 0, 55.005402},
    {0.0001661505, 6e-05, 0, 46.418201}, {0.000117413, 4.24e-05, 0, 56.611801},
    {8.307527e-05, 3e-05, 0, 66.805397}, {5.870652e-05, 2.12e-05, 0, 65.094101},
    {4.150994e-05, 1.499e-05, 0, 63.382801}, {2.935326e-05, 1.06e-05, 0, 63.843399},
    {2.067383e-05, 7.4657e-06, 0, 64.304001}, {1.455977e-05, 5.2578e-06, 0, 61.877899},
    {1.025398e-05, 3.7029e-06, 0, 59.4519}, {7.221456e-06, 2.6078e-06, 0, 55.705399},
    {5.085868e-06, 1.8366e-06, 0, 51.959}, {3.581652e-06, 1.2934e-06, 0, 54.699799},
    {2.522525e-06, 9.1093e-07, 0, 57.440601}, {1.776509e-06, 6.4153e-07, 0, 58.876499},
    {1.251141e-06, 4.5181e-07, 0, 60.3125}}};
// clang-format on

using Vector = std::array<double, 3>;
using Matrix = std::array<Vector, 3>;  // rows

constexpr Vector operator*(const Matrix& m, const Vector& v) {
  Vector r{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) r[i] += m[i][j] * v[j];
  return r;
}
constexpr Matrix inverse(const Matrix& m) {
  const auto minor = [&](std::size_t i, std::size_t j) {
    const std::size_t a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
    return m[a][c] * m[b][d] - m[a][d] * m[b][c];
  };
  const double det = m[0][0] * minor(0, 0) + m[0][1] * minor(0, 1) + m[0][2] * minor(0, 2);
  Matrix r{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) r[i][j] = minor(j, i) / det;
  return r;
}

constexpr Vector sum(auto&& weight) {
  Vector v{};
  double white = 0;
  for (std::size_t i = 0; i < wavelengths; ++i) {
    const auto& o = observations[i];
    const double w = o.d65 * weight(i);
    v[0] += w * o.x, v[1] += w * o.y, v[2] += w * o.z;
    white += o.d65 * o.y;
  }
  return {v[0] / white, v[1] / white, v[2] / white};
}

constexpr Matrix rgb_from_xyz() {
  // One column per primary, of unknown brightness; white says how bright each is.
  constexpr Matrix primaries{{{0.64, 0.30, 0.15}, {0.33, 0.60, 0.06}, {0.03, 0.10, 0.79}}};
  const Vector white = sum([](std::size_t) { return 1.0; });
  Matrix m = inverse(primaries);
  const Vector brightness = m * white;
  for (std::size_t i = 0; i < 3; ++i)
    for (double& x : m[i]) x /= brightness[i];
  return m;
}
constexpr Matrix to_rgb = rgb_from_xyz();

double conductor(const Index& index, double c) {
  const std::array p{index.n, index.k};
  return Conductor<double>(p)({c, c, 1, c, 0}).value();
}

}  // namespace

Vector xyz(const Spectrum& reflectance) {
  return sum([&](std::size_t i) { return reflectance[i]; });
}

Vector linear_srgb(const Spectrum& reflectance) {
  return to_rgb * xyz(reflectance);
}

std::array<Waveband, wavebands> waveband_colours() {
  constexpr double first = 400, step = 20;
  std::array<Waveband, wavebands> all;
  for (std::size_t b = 0; b < wavebands; ++b) {
    all[b].nm = first + step * static_cast<double>(b);
    all[b].rgb = linear_srgb(spectrum([&](double nm) {
      const double within = std::clamp(nm, first, first + step * (wavebands - 1));
      return std::max(0.0, 1 - std::abs(within - all[b].nm) / step);
    }));
  }
  return all;
}

Vector xyz_of_srgb(const Vector& rgb) {
  constexpr Matrix to_xyz = inverse(to_rgb);
  return to_xyz * rgb;
}

Vector reflectance_rgb(const Material& m, double c) {
  return linear_srgb(spectrum([&](double nm) { return conductor(m.at(nm), c); }));
}

Vector reflectance_per_channel(const Material& m, double c) {
  Vector v{};
  for (std::size_t i = 0; i < 3; ++i) v[i] = conductor(m.rgb()[i], c);
  return v;
}

}  // namespace gonio
