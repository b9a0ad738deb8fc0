#pragma once
/// \file
/// Samples that are in memory already, as arrays of another program.

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "table/table.h"

namespace gonio {

/// Directions as columns that are the caller's, all as long [°].
struct DirectionColumns {
  std::span<const double> theta_i, phi_i, theta_o, phi_o;
  std::size_t size() const { return theta_i.size(); }
};
DirectionColumns columns_of(const DirectionList&);
/// theta_i, phi_i, theta_o and phi_o of a sample [°]: as a list has them, of a grid computed.
/// \param at  of the same table
std::array<double, 4> angles_deg(const Table&, const SampleAngles& at, std::size_t i);

/// Refuses what no direction has: zenith angles outside [0, 180], azimuths outside [−360, 360], NaN.
/// \param name  of the columns' owner, in the error
void check_directions(const std::string& name, const DirectionColumns&);

/// Table of samples in memory, judged as those of a CSV file are; its arrays are copied.
/// \param name      stands for a path
/// \param values    a column per channel, f_r [1/sr, no cosine]; any value, also NaN (see mask())
/// \param channels  names of the values; without them "f" of one, "r", "g", "b" of three, else "0", "1" …
/// \param weights   per sample; none: all 1
/// \throws Error  bad_input of directions that are none, of weights below 0 or not finite, of more than a reader takes
Table table_of(const std::string& name,
               const DirectionColumns&,
               std::span<const std::span<const double>> values,
               std::vector<std::string> channels = {},
               std::span<const double> weights = {});

/// "f" of one channel, "r", "g", "b" of three, else "0", "1" …
std::vector<std::string> usual_channels(std::size_t count);

}  // namespace gonio
