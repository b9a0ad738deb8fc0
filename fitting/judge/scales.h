#pragma once
/// \file
/// Axes whose angles may each have a scale of their own, as instruments put on all values of an angle.

#include <cstddef>
#include <initializer_list>
#include <vector>

#include "fitting/judge/left_over.h"
#include "fitting/judge/regression.h"

namespace gonio::misfit {

inline constexpr double most_of_a_scale =
    0.15;  ///< RMS error of an angle's scale that instruments may have

/// Number of a table's angles along an axis.
std::size_t number_of_angles(const Left&, SharedAngle);

/// Axes whose angles may each have a scale: what scatters between them more than values do within them, and but for
/// incident angles from one to the next.  Places of light and detector follow, where these scatter more than their angles do.
class Scales {
 public:
  struct Scaled {
    SharedAngle of;
    double square;                     ///< mean square of the scales
    std::vector<SharedAngle> coarser;  ///< axes that it took the place of
  };
  /// \param by_incident  whether those of incident angles are open whatever the values show
  Scales(const Left& all_values, bool by_incident);

  std::vector<Scaled> all;
  double luck = 1;  ///< probability of one of them by chance
  /// Whether those of incident angles run smoothly from one to the next, as a wrong Fresnel term's do and an instrument's seldom.
  bool follows_incident = false;
  /// Whether so few angles that none can run smoothly differ by more than an instrument's.
  bool between_few = false;
  bool of_all =
      false;  ///< whether they have one factor in common that is more than an instrument's

  std::vector<SharedAngle> axes() const;

 private:
  bool is_open(SharedAngle) const;
  std::vector<SharedAngle> axes_with(SharedAngle) const;
  /// Open axes, `last` the last of them.
  std::vector<SharedAngle> axes_up_to(SharedAngle last) const;
  Regression with(SharedAngle) const;
  void open(SharedAngle);
  void open(Scaled, Regression there);
  bool open_best(std::initializer_list<SharedAngle> among);
  void refine(SharedAngle, std::initializer_list<SharedAngle> coarser);

  const Left left_;
  Regression now_;
};

}  // namespace gonio::misfit
