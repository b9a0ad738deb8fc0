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

/// Lobe of a coated model on the diffuse terms below it, by view or by both as brdf/formula/coat.h has it, R the coat's directional
/// albedo.
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
