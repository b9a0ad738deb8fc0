#pragma once
/// \file
/// Marks of a picture in SVG, the same on a page and on paper.  For this room only.

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gonio::svg {

inline constexpr std::string_view ground = "#fcfcfa";
inline constexpr double text_size = 12, file_width = 760;  ///< [px]

/// [px], about: fonts differ.
double text_width(std::string_view, double size = text_size);
/// Text in lines that are about so wide.
std::vector<std::string> wrapped(std::string_view, double width, double size = text_size);
/// A coordinate to a tenth of a pixel.
std::string number(double);

/// A path of straight lines, each point relative to the one before: a third of the bytes.
class Path {
 public:
  void move(double x, double y);
  void line(double x, double y);
  /// Straight up or down to there.
  void up(double y);
  /// A point as large as the line is wide.
  void dot(double x, double y);
  const std::string& text() const { return text_; }

 private:
  void step(double x, double y);
  std::string text_;
  long x_ = 0, y_ = 0;  ///< in tenths, as they are written
  char last_ = 0;
};

/// Box that a picture is drawn in, from its upper left corner.  On a page it is as wide as it has room for: places across are then
/// parts of its width.  A file has its width in pixels.
struct Box {
  bool page;
  double width, height;

  /// Attribute of a place across: x="25%", x="12".
  std::string x(double x, std::string_view attribute = "x") const;
  /// \param more  attributes
  std::string text(double x, double y, std::string_view what, std::string_view more = "") const;
  /// What is cut off at the edges of the box, and grows with it.
  std::string inside(std::string_view marks, std::string_view more = "") const;
};

/// Ticks of an axis: place in the box, text.
using Ticks = std::vector<std::pair<double, std::string>>;
/// Texts of both axes.  \param left  room for those of y   \param turned  those of x are longer than the room between them
std::string axis_texts(const Box&, const Ticks& x, const Ticks& y, bool turned = false);
/// The names of the axes; on a page that of x is no part of the drawing, so that it can wrap.
std::string axis_names(
    const Box&, std::string_view x, std::string_view y, double left, double below);

/// Marks above a picture in a file: title and note.
struct Heading {
  std::string marks;
  double height;
};
Heading heading(std::string_view title, std::string_view note, double width);
/// A box at its place in a file.
std::string placed(double left, double top, const Box&, std::string_view marks);
/// The whole file.  \param looks  style sheet of its curves
std::string document(double width,
                     double height,
                     std::string_view title,
                     std::string_view looks,
                     std::string_view marks);

}  // namespace gonio::svg
