#pragma once
/// \file
/// Gauss–Legendre quadrature, and the hemisphere by it.

#include <vector>

#include "geometry/direction.h"

namespace gonio {

struct Node {
  double x, weight;
};

/// n nodes on [0, 1], exact for polynomials up to degree 2n − 1; ascending.
std::vector<Node> gauss_legendre(int n);

struct HemisphereNode {
  Direction direction;
  double weight;  ///< solid angle times cos θ; the weights sum to π
};

/// Gauss in cos²θ, equal steps in azimuth (half a step from 0): ∫ f(ω) cos θ dω ≈ Σ weight f.
std::vector<HemisphereNode> cosine_hemisphere(int n_theta, int n_phi);

}  // namespace gonio
