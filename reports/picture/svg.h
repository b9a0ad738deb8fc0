#pragma once
/// \file
/// Marks of a picture in SVG, in the colours of the pages on paper.  For this room only.

#include <string>
#include <string_view>
#include <vector>

namespace gonio::svg {

inline constexpr std::string_view ground = "#fcfcfa", ink = "#1c1f23", muted = "#5d646b",
                                  rule = "#dddcd5", faint = "#efeee9";
inline constexpr double text_size = 12;  ///< [px]

/// [px], about: fonts differ.
double text_width(std::string_view, double size = text_size);
/// Text in lines that are about so wide.
std::vector<std::string> wrapped(std::string_view, double width, double size = text_size);

enum class Anchor { start, middle, end };
struct TextStyle {
  Anchor anchor = Anchor::start;
  std::string_view fill = muted;
  double size = text_size;
  bool bold = false;
  double turned = 0;  ///< [°], clockwise, about where it stands
};
/// \param y  of the baseline
std::string text(double x, double y, std::string_view what, const TextStyle& = {});
std::string line(double x1,
                 double y1,
                 double x2,
                 double y2,
                 std::string_view stroke,
                 double width = 1,
                 std::string_view dash = "");
/// A number of a coordinate: two decimals at most.
std::string number(double);

/// Marks above a picture: title and note.
struct Heading {
  std::string marks;
  double height;
};
Heading heading(std::string_view title, std::string_view note, double width);
/// The whole file.
std::string document(double width, double height, std::string_view title, std::string_view marks);

}  // namespace gonio::svg
