#pragma once
/// \file
/// Whether normals belong to a surface: slopes of a height have no curl, which finds azimuths that are taken for others.

#include <array>
#include <cstddef>
#include <vector>

#include "fitting/map/sample.h"

namespace gonio {

/// What is known of an azimuth that the directions may have instead of their own.
enum class AzimuthVerdict { open, excluded, right };

/// Of a turn and its other by half a turn, between which no curl decides.
struct TurnOfNormals {
  std::size_t turn = 0;  ///< into turns: 0, 2 or 4
  AzimuthVerdict verdict = AzimuthVerdict::open;
  double ratio = 1;  ///< median curl under it over that as given, of loops that tell
};

/// Curls of normals around square loops of 1 to 32 texels.  Loops as small as texels know fine bumps, wide ones know gentle slopes, whose curl grows with the
/// area, and the creases between facets.
///
/// A loop tells where one of the two curls is far above what the best azimuth leaves at that size.  An azimuth is right where its curl is less than half of the
/// given one's in nearly all loops that tell, at some size, and it is excluded at none: steps in a surface, as between threads of cloth, make curls of their own.
/// Few loops decide where all agree by far, at two sizes.
/// \param sample   pieces of a map, TexelSample::block texels each, TexelSample::block_width of them side by side
/// \param normals  [3][texel]
std::array<TurnOfNormals, 3> turns_of_normals(const TexelSample& sample,
                                              const std::vector<float>& normals);

}  // namespace gonio
