#pragma once
/// \file
/// Places for the names of points in a picture.  For this room only.

#include <optional>
#include <vector>

namespace gonio::svg {

/// Place in a picture, from its upper left corner [px].
struct Spot {
  double x, y;
};
/// Rectangle of a picture [px].
struct Area {
  double left, top, right, bottom;
};

/// Where a name stands, from its point [px].
struct LabelPlace {
  Spot text;                ///< left end of its baseline
  std::optional<Spot> end;  ///< of the line to it; none where it stands beside its point
};

/// Finds places for names of points one after the other: beside the point, where a name hides no other and lies on no line and on no
/// bar of an error; where there is no such place, farther off at the end of a line.
class LabelPlacer {
 public:
  LabelPlacer(double width, double height) : width_(width), height_(height) {}

  // All of these before the first name is placed.
  void add_point(const Spot& p) { points_.push_back(p); }
  void add_bar(const Area& bar) { bars_.push_back(bar); }
  void add_line(const Spot& from, const Spot& to);

  /// \param text_width  of the name, 11 px high
  /// \return  no value: there is no room
  std::optional<LabelPlace> place(const Spot& point, double text_width);

 private:
  bool is_free(const Area& name, const Spot& own, double from_others) const;
  bool leads(const Spot& own, const Spot& end) const;

  double width_, height_;
  std::vector<Spot> points_;
  std::vector<Area> lines_, bars_, names_;
};

}  // namespace gonio::svg
