#pragma once
/// \file
/// Directions of a goniometer: 24 incident angles, 35 views of each.

#include <utility>
#include <vector>

#include "tables.h"

namespace gonio::test {

/// Puts a table there, with the values of a model.
inline void put_on_goniometer(Table& t, const BoundModel& truth) {
  DirectionList l;
  for (int in = 3; in < 75; in += 3)
    for (int out = 2; out < 80; out += 12)
      for (int phi = 0; phi <= 180; phi += 45) {
        l.theta_i_deg.push_back(in);
        l.phi_i_deg.push_back(0);
        l.theta_o_deg.push_back(out);
        l.phi_o_deg.push_back(phi);
      }
  t.where = std::move(l);
  put_values(t, truth);
}

}  // namespace gonio::test
