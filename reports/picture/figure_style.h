#pragma once
/// \file
/// Looks of curves and the colours of pictures, by names that pages and files share.  For this room only.

#include <span>
#include <string>
#include <string_view>

#include "reports/picture/figure.h"

namespace gonio {

/// Look of a curve: a colour by its name in page.css, dashes "on off …" [px].
struct CurveLook {
  std::string_view colour, dash;
  double width;
};
/// References in ink and dashed, the others each in a colour, then each in a colour and a dash.
CurveLook look_of(const FigureCurve&, const CurveStyles&);

/// Class of its look: "k3", of references "r0".
std::string look_class(const FigureCurve&, const CurveStyles&);
/// Style sheet of that look in the colours of paper.
std::string paper_look(const FigureCurve&, const CurveStyles&);

/// Colours of a map from its least value to its largest, by their names in page.css.
std::span<const std::string_view> colours_of(const FigureMap&);

/// Colour of that name on paper, as page.css has it: "#0b5fa5".
std::string_view paper_colour(std::string_view name);

}  // namespace gonio
