#pragma once
/// \file
/// Guards and clamps of shaders that take light where they need not: from a narrow peak, and towards the horizon.

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "number/parameter.h"
#include "reports/measure/samples.h"

namespace gonio {

/// A guard or a clamp that holds a narrow peak down.
struct Bite {
  double from = 0;                 ///< the width where a tenth of the peak is lost
  double narrowest = 0, left = 0;  ///< the narrowest, and what is left of the peak there
  bool is_little = false;          ///< only where lobes are narrower than materials are
};
/// \param left  part of the peak by width
std::optional<Bite> bite_of(const Parameter& width,
                            double power,
                            const std::function<double(double)>& left);
std::string text_of(const Bite&, const Parameter& width, double power);

/// What holds V down towards the horizon.
struct HorizonGuard {
  enum class Kind { sum, floor, sum_of_v, cap };
  Kind kind;
  double amount;

  /// Part of V that is left.
  double left(const auditing::Row&, double v) const;
};
/// The guard that makes values of V of a form's, at some widths: none where they are no more and no less than such.
std::optional<HorizonGuard> guard_of(std::span<const auditing::Row>,
                                     const std::vector<auditing::Values>& own,
                                     const std::vector<auditing::Values>& form);

/// A loss towards the horizon.
struct Drop {
  double from_deg;   ///< zenith angle of light and view, mirrored, from which a tenth is lost
  std::string what;  ///< "0.01 is added to 4 NoL NoV", or "a guard below"
  bool is_of_sheen = false;  ///< V of a sheen held below 1, as Khronos's

  bool is_little() const;  ///< beyond what is seen of materials, or as it is shipped
};
/// \param left  part that is left of a highlight
std::optional<Drop> drop_of(const std::function<double(const auditing::Row&)>& left,
                            const std::optional<HorizonGuard>&);
std::string text_of(const Drop&);

}  // namespace gonio
