#pragma once
/// \file
/// What an instrument averages over: round cones about the directions of light and viewer.

namespace gonio {

/// Full widths of the cones of light and detector [rad]; 0: one direction.
struct Aperture {
  double light = 0, detector = 0;

  explicit operator bool() const { return light > 0 || detector > 0; }
  bool operator==(const Aperture&) const = default;
};

}  // namespace gonio
