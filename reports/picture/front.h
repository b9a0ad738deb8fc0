#pragma once
/// \file
/// Front of time and error: which of several forms are neither slower nor less exact than another, and their picture.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "reports/picture/figure.h"
#include "timing/timing.h"

namespace gonio {

/// Two ways to write one formula differ by rounding: so small a part of an error makes neither more exact.
inline constexpr double same_error = 1e-4;

/// Time and error of a form.
struct TimedError {
  Timing time;
  double error;  ///< a number: one that is not known has no place
  std::vector<double>
      each{};  ///< times in each of the processes that measured all rivals, in order
};

/// Place of a form among its rivals.  Errors within same_error of each other are as exact.
struct FrontPlace {
  /// No rival that is at least as exact is faster by a difference that survives (timing.h).
  bool front = true;
  /// The time of a rival that is at least as exact differs by nothing that survives: another run may mark the one or the other.
  bool tie = false;
  /// The line through the front goes through it: no rival that is at least as exact took less time here, none that is more exact as
  /// little.  A reader of the picture sees this, whatever the spreads.
  bool on_line = true;
};
/// \param rivals  the form itself among them
FrontPlace front_place(std::span<const TimedError> rivals, std::size_t form);

/// A form in a picture of time against error.
struct FrontDot {
  std::string name;  ///< label of its point
  TimedError at;
  bool front = false;  ///< the line through the front goes through it
};
/// Sets `front` of each by the others.
void mark_front(std::span<FrontDot>);
/// Points, with the spread of their times.
FigureCurve front_points(std::string name, std::span<const FrontDot>);
/// Dashed line through those on the front, from the fast to the slow; none through fewer than two.
std::optional<FigureCurve> front_line(std::string name, std::span<const FrontDot>);

}  // namespace gonio
