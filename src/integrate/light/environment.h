#pragma once
/// \file
/// ∫ L(ω) g(ω) dω over a hemisphere: what a lobe, or any other weight of directions, gathers from an environment.

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "geometry/direction.h"
#include "image/environment.h"

namespace gonio {

/// An environment with the sums over its rectangles at hand.
class SummedEnvironment {
 public:
  explicit SummedEnvironment(Environment);
  const Environment& map() const { return map_; }

  /// Rectangle of texels, from (x0, y0) up to (x1, y1); parts of texels where it lies within one, or within a row.
  struct Rectangle {
    double x0, x1, y0, y1;
  };
  struct Light {
    Rgb flux;          ///< ∫ L dω
    Direction centre;  ///< where it comes from: the mean of ω, weighted by R + G + B
    double spread;     ///< and the mean of |ω − centre|², weighted alike [rad²]
  };
  Light light(const Rectangle&) const;

 private:
  Environment map_;
  /// Along each row, of everything to the left: flux by channel, then Σ (R + G + B) ω Δω.  Not over rows
  /// too: in sums of all, a texel at a pole would be lost.
  std::vector<std::array<double, 6>> sums_;
};

/// Functions of directions: out[function] is as long as the directions.
using Gather = std::function<void(std::span<const Direction>, std::span<double* const> out)>;

/// Place where the functions change, as far as it is known.
struct Focus {
  Direction normal;  ///< they are gathered over its hemisphere
  Direction at;      ///< where they change most
  double width = 1;  ///< and within how much of it [rad]
};

/// When to stop: at an error relative to each integral, or after so many evaluations.
struct RelativeGoal {
  double error = 1e-3;
  std::size_t evaluations = 2'000'000;
};

struct Gathered {
  std::vector<Rgb> value;  ///< by function
  double error = 0;        ///< relative to each value, the largest
  std::size_t evaluations = 0;
};

/// Integrals of L times each function, exact in L: rectangles of texels, and of parts of a texel, are halved where
/// the functions change most for the light there.  A rectangle gives ∫L dω times the function at the centre of its
/// light; one across the horizon gives its part above, at that part's middle.  The error is twice the sum of the
/// differences between a rectangle and its two halves.  This holds while light within the halves is spread at most
/// half as far as their centres are apart.  Where it is spread further, as with a sun in one texel among many, at
/// whose centre both halves have theirs, the error is
///
///   8 ∫L g dω (spread − ½ centres' spread)/s²,   s the way to where the functions change most, and its width
///
/// twice what it is in the tail of a lobe of GGX, which falls as s⁻⁴: ∇²g/4 = 4 g/s².
///
/// Seen with lobes of GGX in three real maps at 1e-3, against 1e-4: none of 1944 values off by more than 2.2e-4;
/// with suns of one texel, alone or in dim light: none of 2700 off by more than its error.
Gathered gather(const SummedEnvironment&,
                const Gather&,
                std::size_t functions,
                const Focus&,
                const RelativeGoal& = {});

}  // namespace gonio
