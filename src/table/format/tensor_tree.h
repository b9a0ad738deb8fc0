#pragma once
/// \file
/// Radiance's tensor trees: a BSDF whose cells are as small as its values ask for.

#include <string>
#include <string_view>

#include "table/table.h"

namespace gonio {

/// Point of the unit square that a point of the unit disc is mapped to, areas kept.
/// [Shirley and Chiu 1997, A Low Distortion Map Between Disk and Square]
struct SquarePoint {
  double x, y;
};
SquarePoint square_of_disc(double x, double y);
/// The inverse: the point (x, y) of the disc.
SquarePoint disc_of_square(double x, double y);

/// Table of a tree's nested braces.  A node in braces has 2ⁿ nodes, bit k of whose number is the upper half along axis k, or (2ⁿ)ᵏ
/// values, the last axis fastest, each of which holds for its whole cell.
///
/// n = 3, isotropic: the first coordinate is (1 − sin θ_i)/2, the others are those of wo, turned so that the mirror direction lies at
/// +x.  n = 4: the first two are those of −wi, the others those of wo.  Directions enter the square by their x and y.  Each leaf is one
/// sample, in its middle; Table::between is the leaf's value.  Table::patch_deg is the side of the smallest leaf near the normal.
/// \param back  the values are of the back: seen from there, turned about x
/// \throws Error  bad_input, with the value's number
/// [Ward, Kurt and Bonneel 2014, Reducing Anisotropic BSDF Measurement to Common Practice; Radiance, bsdf_t.c]
Table tensor_tree_table(const std::string& path,
                        std::string_view braces,
                        std::size_t axes,
                        bool back);

}  // namespace gonio
