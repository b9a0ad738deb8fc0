#pragma once
/// \file
/// Search of a choice's domain for the worst: a grid, then steps around the worst of it.

#include <cmath>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "integrate/rule/cubature.h"
#include "validate/choice.h"

namespace gonio::validating {

/// Point of the domain: mu is a cosine of a direction and the normal.
struct Point {
  Substance substance;
  double part = 0;  ///< of the substances' range, where there is one
  double roughness = 1, mu = 1;
};
struct Found {
  double value = 0;
  Point at;
};

/// Albedos that choices of one search share, by what they are of.
using KnownAlbedos = std::map<std::string, std::vector<std::vector<double>>>;

/// Effort of a search: a coarse one finds most of what is broken, and establishes nothing.
struct Effort {
  int roughness_steps = 9, cosine_steps = 8;
  bool refined = true;       ///< looks around the worst of the grid
  Goal goal{1e-5, 200'000};  ///< of albedos
  KnownAlbedos* known = nullptr;
};
/// \param known  of the same search only
inline Effort coarse(KnownAlbedos* known = nullptr) {
  return {3, 3, false, {1e-3, 20'000}, known};
}

/// Larger one of two errors; what is no number is worse than all.
inline double worse(double a, double b) {
  return std::isnan(a) || b <= a ? a : b;
}

/// Even steps from one end to the other; one where they are the same.
std::vector<double> steps(const Choice::Ends&, int n);
std::vector<double> roughnesses(const Choice&, const Effort& = {});
std::vector<double> cosines(const Choice&, const Effort& = {});

/// Errors at cosines, of one substance and roughness.
using ErrorAt = std::function<std::vector<double>(
    const Substance&, double roughness, std::span<const double> mu)>;

/// Errors on the grid, substance by substance.
std::vector<Found> on_grid(const Choice&,
                           const Effort&,
                           const ErrorAt&,
                           const std::function<void(double)>& done);
/// Worst of these, and what is worse between its neighbours: by golden section, one input after the other.
Found worst(const Choice&, const Effort&, const std::vector<Found>& grid, const ErrorAt&);

}  // namespace gonio::validating
