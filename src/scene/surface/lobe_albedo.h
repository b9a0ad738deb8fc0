#pragma once
/// \file
/// Albedo of a lobe by the cosine, without its Fresnel term.

#include "brdf/model/model.h"
#include "scene/kernel/albedo_curve.h"

namespace gonio::scene {

/// Curve of a lobe, and its average over the hemisphere, 2 ∫ E μ dμ.
struct LobeAlbedo {
  AlbedoCurve<double> curve{};
  double average = 1;
};

/// Albedo of the model's first lobe at F = 1; over azimuths, where it is anisotropic, the mean of four.
LobeAlbedo lobe_albedo(const BoundModel&);

}  // namespace gonio::scene
