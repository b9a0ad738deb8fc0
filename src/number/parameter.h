#pragma once
/// \file
/// Facts about a parameter of a formula, and about the formula itself: the registry, the
/// command line, the fit and the tests all read it from here.

#include <string_view>

namespace gonio {

struct Range {
  double low, high;
  constexpr bool holds(double x) const { return low <= x && x <= high; }  // false for NaN
};

struct Parameter {
  std::string_view name;
  Range legal;   ///< where the formula is defined
  Range fit;     ///< where a fit may look
  double start;  ///< where a fit begins that knows nothing better
  bool per_channel = false;
  std::string_view meaning = {};
};

/// Facts about a term, as it says them of itself.
struct About {
  std::string_view id;  ///< the catalogue's name, prefix included
  std::string_view title;
  std::string_view formula;
  std::string_view source;      ///< paper and equation
  std::string_view ships = {};  ///< who ships it
  std::string_view approximates =
      {};                           ///< id of the form that it stands for; empty: it is that form
  std::string_view named_for = {};  ///< id of the form that it is called by and should equal

  /// The form that it is held against; empty where it is that form itself.
  constexpr std::string_view reference() const {
    return named_for.empty() ? approximates : named_for;
  }
};

}  // namespace gonio
