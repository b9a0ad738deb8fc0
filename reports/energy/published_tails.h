#pragma once
/// \file
/// Tails of measured materials, as published fits have them.

#include <array>

namespace gonio {

/// Exponents C of D ∝ (1 + B (1 − cos θ_h))^−C, fitted to the hundred materials of MERL: the "microfacet" fits of error E2 of Löw,
/// Kronander, Ynnerman and Unger 2012, BRDF models for accurate and efficient rendering of glossy surfaces, as collected in BBM
/// (Peers 2023).  GGX's tail is that of C = 2; a lower one is longer.
inline constexpr std::array published_exponents{
    0.817, 1.39,  1.09,   1.11,  0.0832, 0.292, 1.2,    1.87,  1.52,  0.619, 1.08,  0.138,  1.7,
    1.12,  1.57,  1.14,   1.5,   1.49,   1.91,  2.12,   1.39,  1.33,  1.44,  1.41,  1.02,   0.976,
    0.931, 1.57,  1.51,   0.622, 0.97,   1.76,  1.02,   1.17,  1.41,  0.158, 0.23,  2.17,   0.98,
    1.16,  1.01,  1.85,   0.155, 2.14,   1.18,  1.15,   1.7,   1.95,  0.887, 1.97,  1.94,   1.63,
    0.146, 0.194, 0.344,  0.934, 0.217,  0.119, 0.0731, 0.983, 1.78,  1.2,   0.287, 0.0841, 1.02,
    1.05,  1.53,  1.27,   1.15,  1.72,   1.14,  1.97,   2.67,  1.25,  1.2,   1.22,  1.23,   1.19,
    1.21,  1.25,  1.32,   1.22,  1.55,   1.4,   2.07,   1.7,   0.631, 0.598, 0.752, 0.647,  1.15,
    1.94,  0.104, 0.0235, 1.15,  1.81,   1.15,  2.14,   1.01,  0.523};
inline constexpr double exponent_of_ggx = 2;

}  // namespace gonio
