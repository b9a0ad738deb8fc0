#pragma once
/// \file
/// The half vector of two directions and its cosines, whatever these are computed in.

#include "geometry/angles.h"
#include "number/real.h"

namespace gonio::inline GONIO_ARCH {

/// Coordinates of a unit vector away from the surface: along the tangent, the bitangent and the normal.
template <class B>
struct Coordinates {
  B x, y, z;
};

/// Angles between a light's direction, a view's and their half vector h = (l + v)/|l + v|.
///
///   VoH = |l + v|/2,   sin²θ_h = |n × (l + v)|²/|l + v|²
///
/// Opposite directions have no half vector: there NoH and VoH are 0.  Of almost opposite ones l + v is exact but
/// small, its square smaller: it is computed of 64 (l + v), so that in half angles of 0.1° are left to tell.
template <Real B>
FrameAngles<B> angles_between(const Coordinates<B>& l, const Coordinates<B>& v) {
  constexpr int scale = 64;  // whose greatest square, (2 · 64)², half holds
  const B x = scale * (l.x + v.x), y = scale * (l.y + v.y), z = scale * (l.z + v.z);
  const B across = x * x + y * y, length2 = across + z * z;
  const auto exists = B(0) < length2;
  const B safe = select<B>(exists, length2, B(1)), length = sqrt(safe);
  const auto only = [&](const B& value) { return select<B>(exists, value, B(0)); };
  return {{l.z, v.z, only(z / length), only(length / (2 * scale)),
           select<B>(exists, across / safe, B(1))},
          only(x / length),
          only(y / length),
          l.x,
          l.y,
          v.x,
          v.y};
}

}  // namespace gonio::inline GONIO_ARCH
