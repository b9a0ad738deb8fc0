#pragma once
/// \file
/// Pictures as data: made once, by a report, then drawn on its page and written beside it as SVG, CSV and OpenEXR.

#include <array>
#include <limits>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/names.h"

namespace gonio {

/// A value that is not known: no point, no cell, null.
inline constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

struct FigureAxis {
  std::string label;  ///< with its unit at the end: "time of one evaluation [ns]"
  bool log = false;   ///< at first; a page lets the reader choose
  /// Ends, where they are not the data's.
  double from = no_value, to = no_value;
};

/// Axis from 0 to 1.
inline FigureAxis over_roughness() {
  return {"roughness", false, 0, 1};
}

struct FigureCurve {
  enum class Kind { line, points, both };
  std::string name;
  std::vector<double> x,
      y;  ///< as many; lines go by ascending x; a y that is not finite: no point, and lines break
  Kind kind = Kind::line;
  bool dashed = false;                       ///< a reference or a bound
  std::vector<std::string> labels{};         ///< of each point, or none
  std::vector<double> x_error{}, y_error{};  ///< half widths of each point, or none
  std::string
      look{};  ///< the name that it looks like, of several that came to the same; empty: its own
  std::string label{};  ///< what a picture calls it, of one whose name is an id; empty: its name
  /// On a page, the colour of each point, "#a0522d", or none; the curve's own is its rim.
  std::vector<std::string> colours{};
};
/// What a picture calls it.
inline const std::string& label_of(const FigureCurve& c) {
  return c.label.empty() ? c.name : c.label;
}

template <>
inline constexpr std::array<std::string_view, 3> names_of<FigureCurve::Kind>{"line", "points",
                                                                             "both"};

/// Choices that tell pictures of a family apart: {{"material", "gold"}, {"angle", "0.5"}}.
using FigureChoices = std::vector<std::pair<std::string, std::string>>;

struct Figure {
  std::string id;  ///< the name of its files: [a-z0-9_]
  std::string title, note;
  FigureAxis x, y;
  std::vector<FigureCurve> curves;
  std::string family{};  ///< of pictures that differ by their choices; empty: one alone
  FigureChoices choices{};
};

/// Cells over two axes.
struct FigureMap {
  struct Axis {
    std::string label;
    std::vector<double> at;  ///< ascending; cells reach half way to the next
    bool log = false;
    bool root = false;  ///< grows as the square root
    /// Names of places that have no numbers; `at` is then not looked at.
    std::vector<std::string> names{};
    double from = std::numeric_limits<double>::quiet_NaN(),
           to = std::numeric_limits<double>::quiet_NaN();  ///< ends, where they are not the cells'
    std::size_t size() const { return names.empty() ? at.size() : names.size(); }
  };
  /// Course of colours over values: of a root, small errors are seen beside great ones; log: decades, of values above 0, diverging
  /// about 1.
  enum class Scale { linear, root, log };

  std::string id;  ///< as a figure's
  std::string title, note;
  Axis x, y;
  std::string value;           ///< what a cell is, with its unit
  std::vector<double> values;  ///< x by x: values[i * y.size() + j]; not finite: no cell
  bool diverging = false;      ///< about 0; else from 0
  Scale scale = Scale::linear;
  /// The value at the end of the colours, so that maps can be compared; else as the values ask for.
  double limit = std::numeric_limits<double>::quiet_NaN();
  /// Of logarithmic colours, the value at their beginning; else a round one below all values.
  double begin = std::numeric_limits<double>::quiet_NaN();
  /// Colours of the cells, where they show more than the value; none otherwise.
  std::vector<std::array<unsigned char, 3>> colours{};
  /// Value that a line is drawn at, between cells above it and the others; not finite: no line.
  double line = std::numeric_limits<double>::quiet_NaN();
  std::string family{};  ///< as a figure's
  FigureChoices choices{};
  /// Names of several maps over the same axes, "roughness 0.3"; their values one map after the other.
  std::vector<std::string> slices{};
};

template <>
inline constexpr std::array<std::string_view, 3> names_of<FigureMap::Scale>{"linear", "root",
                                                                            "log"};

/// Id of a family and what is chosen: in small letters and digits, all else a single '_'.
std::string picture_id(std::string_view family, const FigureChoices&);
/// An empty one with its id.
Figure make_figure(std::string family, FigureChoices choices = {});
FigureMap make_map(std::string family, FigureChoices choices = {});

/// Curve of that name in a figure, added where there is none yet.
FigureCurve& curve_named(Figure&,
                         std::string_view name,
                         FigureCurve::Kind = FigureCurve::Kind::line);

/// Everything that a report shows.
struct Pictures {
  std::vector<Figure> figures;
  std::vector<FigureMap> maps;
};

/// Looks of the curves of a report: a name alike in all of its pictures, names that share a picture each differently,
/// and those of a family of pictures too where they are not too many.  The same for the same pictures.
class CurveStyles {
 public:
  using Numbers = std::map<std::string, std::size_t>;
  explicit CurveStyles(std::span<const Figure>);
  /// Number of a curve of these: its place among the looks of lines, or of references if it is dashed.
  std::size_t of(const FigureCurve&) const;

 private:
  Numbers lines_, references_;
};

/// A line for each point, after one of names: curve, the axes' labels; labels and errors where a curve has some.
/// RFC 4180, six digits, lines end as on Unix.
std::string to_csv(const Figure&);
/// A line for each cell that has a value, of slices the slice first.
std::string to_csv(const FigureMap&);

/// A picture on its own: no script, no font, nothing fetched.
/// \param styles  of the report's figures
std::string to_svg(const Figure&, const CurveStyles& styles);
std::string to_svg(const FigureMap&);

/// What draws the same pictures on a page: as wide as there is room, in the page's colours, with what its script
/// (page/pictures.js) needs to read and to zoom it.
/// \param height  of the box that curves are drawn in [px]   \param first  whether each curve is shown at first
std::string page_svg(const Figure&,
                     const CurveStyles& styles,
                     double height,
                     const std::vector<bool>& first);
/// Its curves without axes, in a box of that size: how it looks from afar.
std::string page_small(const Figure&, double width, double height);
/// \param slice  the one of them that is drawn   \param cells  false: the page's script fills them in when it is chosen, a third of the
/// bytes
std::string page_svg(const FigureMap&, std::size_t slice, bool cells);
/// What its colours mean, below it.
std::string page_scale(const FigureMap&);
/// Style sheet of the looks of these curves on a page.
std::string page_looks(const CurveStyles& styles, std::span<const Figure>);
/// The same for the cells of these maps; empty where there are none.
std::string page_shades(std::span<const FigureMap>);
/// A curve's look beside its name, on a page.
std::string page_key(const FigureCurve&, const CurveStyles& styles);

/// The file of an image with one channel of floats, named after the value, or one a slice, named after it: x to the
/// right, y upwards; where there is no cell, NaN.  String attributes say what the axes and the value are.
std::string to_exr(const FigureMap&);

/// Names of the files of a report's pictures in its folder, as its document names the pictures.
/// \param json  untrusted; of what is not whole, or no document of this report, there are none
/// \return plain names: [a-z0-9_] and one of the endings .svg, .csv, .exr
std::vector<std::string> picture_files(std::string_view json, std::string_view report);

}  // namespace gonio
