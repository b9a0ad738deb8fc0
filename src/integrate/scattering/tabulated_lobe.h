#pragma once
/// \file
/// Light that leaves a rough surface after two facets or more, tabulated from random walks (walk.h).

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "brdf/kernel/kernels.h"
#include "brdf/model/model.h"
#include "geometry/angles.h"
#include "geometry/direction.h"

namespace gonio {

/// Red, green and blue of a channel of a lobe.
using ColourOfChannel = std::array<double, 3>;
/// Channels that are red, green and blue themselves.
inline constexpr std::array<ColourOfChannel, 3> red_green_blue{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

struct TabulationGoal {
  std::uint64_t seed = 1;
  /// Facets after the first to which walks from one direction lead; a quarter of it on an anisotropic surface.
  std::size_t facets = 2048;
  std::size_t walks = 1 << 18;  ///< at most, from one direction
};

/// f of two bounces and more [1/sr]: a table over the zenith angles of l and v and the azimuth between them, on an anisotropic surface
/// over that of v too, with cubics between its nodes.
///
/// From each v walks start, and at each facet after the first they ask for the light that goes from there along every l of the table:
/// the sum of walk_value() without its first order, whose walks all l share.  Walks from l find the same ways in the other direction.
/// Each way counts by the part that the walks from one end have of all that are drawn along it,
///
///   p_v/(p_v + p_l),   p_v = D(h₁)/(4σ(v)),   p_l = D(h_n)/(4σ(l))              the balance heuristic [Veach & Guibas 1995]
///
/// h₁ and h_n being its first and last facets.  So no way that a walk seldom takes counts for much.  A walk's first depth, facet and
/// second depth are a point of a lattice.
///
/// The table holds f (μ_l + μ_v), which is finite at the horizon; of an anisotropic surface times 1 + (t_x² + t_y²)/2, with t the
/// slopes of the half vector over α, which it follows there.  Steps are even in asinh(e/α) of the elevation e, and in asinh(ψ/w) of
/// the azimuth ψ from where light goes straight on:
///
///   w = α (μ_l + μ_v)/√(s_l s_v),   s the sines; α across the plane of v            as AzimuthIntegral has it
///
/// `error` is √(σ² + b² + (0.01 f)²): σ of eight batches of walks, b what cubics differ by from straight lines, and an allowance.  At
/// 100 pairs of directions, half of them near the mirror, walks of their own were off by 0.7 to 1.2 of their error and this one
/// together, in root mean square, and at 3.2 % of the pairs by more than two: GGX of α = 0.05 to 1, Beckmann, and anisotropic GGX
/// down to 0.23 by 0.065.
///
/// One thread takes 0.4 s for a round lobe of three channels, 3 s for an anisotropic one.
class TabulatedLobe {
 public:
  /// \param m       one lobe, of microsurfaces(): else wrong usage
  /// \param colour  of each channel of m
  explicit TabulatedLobe(const BoundModel& m,
                         std::span<const ColourOfChannel> colour = red_green_blue,
                         const TabulationGoal& = {});

  bool anisotropic() const { return views_ > 1; }
  struct Value {
    std::array<double, 3> f, error;  ///< red, green and blue, and the standard error
  };
  /// At two directions; the frame is read of an anisotropic lobe.
  Value at(const FrameAngles<double>&) const;
  /// f += value, and off += value + errors · standard error where there is such.  An anisotropic lobe reads the frame.
  template <class F>
  void add(const Block<F>& x,
           const std::array<F*, 3>& f,
           double errors = 0,
           const std::array<F*, 3>& off = {}) const;

 private:
  /// Four nodes, their shares in a cubic and in a straight line, and whether they stand in a mirror.
  struct Taps {
    std::array<std::size_t, 4> at{};
    std::array<double, 4> share{0, 1}, line{0, 1};
    std::array<bool, 4> beyond{};
  };
  enum class Ends { open, mirrored, around };
  static Taps taps(double x, std::size_t nodes, Ends);
  double zenith(double mu) const;  ///< 0 at the horizon, 1 at the normal
  double cosine(std::size_t node) const;
  double width(double mu_l, double mu_v, double phi_v) const;
  std::size_t node(std::size_t v, std::size_t view, std::size_t l, std::size_t azimuth) const {
    return 3 * (((v * views_ + view) * zeniths + l) * azimuths_ + azimuth);
  }
  double shape(double x, double y, double z) const;
  void fill(const BoundModel&, std::span<const ColourOfChannel>, const TabulationGoal&);
  void add_other_way();
  struct Pair {
    Direction l, v;
  };
  Pair directions_of(std::size_t v, std::size_t view, std::size_t l, std::size_t azimuth) const;

  static constexpr std::size_t zeniths = 20;
  double alpha_x_, alpha_y_, layer_;
  std::size_t views_, azimuths_;
  std::vector<float> f_, error_;  ///< times μ_l + μ_v
};

}  // namespace gonio
