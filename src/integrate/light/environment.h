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

  /// Of texels, from (x0, y0) up to (x1, y1); parts of texels where it lies within one, or within a row.
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

/// What is known of the functions.
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

/// Exact in L: rectangles of texels, and of parts of a texel, are halved where the functions change most for
/// the light that comes from there.  A rectangle gives ∫L dω times the function where its light comes from;
/// across the horizon the part of it that lies above, in the middle of that.  It is judged by what its parts
/// give, and twice the sum of these differences is the error.  That speaks for light within the parts as far
/// as it is spread no more than half of what their centres are.  Of what is spread more, as of a sun in one
/// texel of many, whose centre its parts share, the error is
///
///   8 ∫L g dω (spread − ½ centres' spread)/s²,   s the way to where the functions change most, and its width
///
/// twice what it is in the tail of a lobe of GGX, which falls as s⁻⁴: ∇²g/4 = 4 g/s².
///
/// Of lobes of GGX in three real maps at 1e-3, against 1e-4: none of 1944 values off by more than 2.2e-4.
/// Of suns of one texel, alone or in dim light, none of 2700 off by more than its error.
Gathered gather(const SummedEnvironment&,
                const Gather&,
                std::size_t functions,
                const Focus&,
                const RelativeGoal& = {});

}  // namespace gonio
