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

namespace gonio {

/// What a channel of a lobe adds to red, green and blue.
using ColourOfChannel = std::array<double, 3>;
/// Channels that are red, green and blue themselves.
inline constexpr std::array<ColourOfChannel, 3> red_green_blue{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

struct TabulationGoal {
  std::uint64_t seed = 1;
  /// Facets after the first to which walks from one direction lead; a sixteenth of it on an anisotropic surface.
  std::size_t facets = 2048;
  std::size_t walks = 1 << 14;  ///< at most, from one direction
};

/// f of two bounces and more [1/sr]: a table over the zenith angles of l and v and the azimuth between them, on an anisotropic surface
/// over that of v too, with what lies between its nodes in straight lines.
///
/// From each v walks start, and at each facet after the first they ask for the light that goes from there along every l of the table:
/// the sum of walk_value() without its first order, whose walks all l share.  The table holds f (μ_l + μ_v), which is finite at the
/// horizon; of an anisotropic surface times 1 + (t_x² + t_y²)/2, with t the slopes of the half vector over α, which it follows
/// there.  Steps are even in asinh(μ/α), and in asinh(ψ/w) of the azimuth ψ from where light goes straight on:
///
///   w = α (μ_l + μ_v)/√(s_l s_v),   s the sines; α across the plane of v            as AzimuthIntegral has it
///
/// f of a round surface is the mean of both directions' walks, for it is the same with l and v in each other's place; each node of an
/// anisotropic one takes a quarter from each neighbour.
///
/// `error` is √(σ² + (ρ f)²): σ of eight batches of walks, ρ of the straight lines.  Of round GGX ρ is 0.01 + 0.0015/α², at most 0.4:
/// what tables of 16 384 facets were off by at 40 pairs of directions, 0.02 at α = 0.2 and 0.01 at 0.6, and more below.  Of others it is
/// from 64 pairs of directions, half of them near the mirror, that have walks of their own: what the table is further off there than
/// the errors of both, by medians, with the standard error added.
///
/// One thread takes 0.3 s for a round lobe of three channels, 0.9 s for an anisotropic one.
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
  /// f += value + errors · standard error.  An anisotropic lobe reads the frame.
  template <class F>
  void add(const Block<F>& x, double errors, const std::array<F*, 3>& f) const;

 private:
  struct Place {
    std::size_t at;
    double share;  ///< of the node after it
  };
  static Place place(double x, std::size_t nodes);
  double zenith(double mu) const;  ///< 0 at the horizon, 1 at the normal
  double cosine(std::size_t node) const;
  double width(double mu_l, double mu_v, double phi_v) const;
  std::size_t node(std::size_t v, std::size_t view, std::size_t l, std::size_t azimuth) const {
    return 3 * (((v * views_ + view) * zeniths + l) * azimuths_ + azimuth);
  }
  double shape(double x, double y, double z) const;
  void fill(const BoundModel&, std::span<const ColourOfChannel>, const TabulationGoal&);
  void swap_directions();
  double error_between_nodes(const BoundModel&,
                             std::span<const ColourOfChannel>,
                             const TabulationGoal&) const;
  void smooth(std::size_t step, std::size_t nodes);

  static constexpr std::size_t zeniths = 24;
  double alpha_x_, alpha_y_, layer_;
  std::size_t views_, azimuths_;
  std::vector<float> f_, error_;  ///< times μ_l + μ_v
};

}  // namespace gonio
