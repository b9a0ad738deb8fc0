#pragma once
/// \file
/// The sample nearest to a pair of directions, on isotropic surfaces.

#include <array>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "geometry/direction.h"

namespace gonio {

DirectionPair swapped(const DirectionPair&);
/// At the plane through the normal and +x.
DirectionPair mirrored(DirectionPair);
/// About the normal, so that the light is at azimuth 0.
DirectionPair turned(const DirectionPair&);
/// Chords between the lights and between the viewers of two pairs, squared.
std::array<double, 2> squared_chords(const DirectionPair&, const DirectionPair&);

/// Finds the sample nearest to a direction pair, within reach in wi and in wo, to a quarter of that.
class NearestSample {
 public:
  /// \param reach  [rad]
  explicit NearestSample(double reach);

  /// Both as they are: what else stands for the same, mirrored or swapped, is to be added, too.
  void add(const DirectionPair&, std::size_t sample);
  std::optional<std::size_t> operator()(const DirectionPair&) const;

 private:
  using Cell = std::array<std::int64_t, 4>;
  static Cell cell_of(const DirectionPair& turned, double size);
  static std::uint64_t key(const Cell&);

  double reach_, size_;  ///< as chords; of a cell
  std::unordered_set<std::uint64_t> taken_;
  std::unordered_map<std::uint64_t, std::vector<std::pair<DirectionPair, std::size_t>>> cells_;
};

}  // namespace gonio
