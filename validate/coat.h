#pragma once
/// \file
/// A clear layer on all else of a choice's model.

#include <span>
#include <string>
#include <vector>

#include "brdf/model/model.h"
#include "geometry/angles.h"
#include "validate/choice.h"

namespace gonio::validating {

/// Lobe of a coated model, and the diffuse terms below it.
///
///   f(l, v) = f_coat + (1 − E(v)) f_below                    Coating::view
///   f(l, v) = f_coat + (1 − E(l)) (1 − E(v)) f_below         Coating::both
///
/// with E the coat's directional albedo.  The first has the albedo E + (1 − E) E_below, so that on white all light comes back, and
/// changes where light and view change places.  The second does not change, and keeps back what E takes of the light again.
class Coated {
 public:
  /// \param coated  of Shipped::spec()
  Coated(const BoundModel& coated, Coating);

  /// [cosine][channel]
  std::vector<std::vector<double>> albedos(std::span<const double> mu) const;
  /// 1 − E(v) or (1 − E(l)) (1 − E(v)) at cosines of light and view, by channel.
  std::vector<double> left_below(double light, double view) const;
  /// f over directions that share the cosines of light and view: [channel][direction].
  std::vector<std::vector<double>> values(const std::vector<FrameAngles<double>>&) const;

 private:
  BoundModel coat_, below_;
  Coating coating_;
};

}  // namespace gonio::validating
