#pragma once
/// \file
/// Small tables whose every value is a known model's.

#include <numbers>
#include <utility>

#include "brdf/model/evaluate.h"
#include "brdf/model/model.h"
#include "table/table.h"

namespace gonio::test {

inline BoundModel glossy(double kd = 0.2) {
  return bind_model("lambert+ggx/smith_ggx.correlated/schlick",
                    {{"kd", {kd, kd / 2, kd / 4}}, {"alpha", {0.3}}, {"f0", {0.04, 0.05, 0.06}}});
}

/// Gives a table the values of a model at its directions.
inline void put_values(Table& t, const BoundModel& m) {
  const std::size_t n = t.grid() ? t.grid()->size() : t.list()->theta_i_deg.size();
  const SampleAngles at(t);
  std::vector<Angles<double>> x;
  for (std::size_t i = 0; i < n; ++i) x.push_back(at(i));
  t.values.clear();
  for (const auto& f : evaluate(m, x)) t.values.emplace_back(f.begin(), f.end());
}

inline Table filled(std::variant<Grid, DirectionList> where, const BoundModel& m) {
  Table t;
  t.path = "table.csv";
  t.format = "csv";
  t.channels = {"r", "g", "b"};
  t.where = std::move(where);
  put_values(t, m);
  return t;
}

inline constexpr double right_angle = std::numbers::pi / 2;

/// The layout of MERL, smaller.
inline Grid half_difference_grid(std::size_t size = 45) {
  using enum Axis::Spacing;
  return {
      Grid::Kind::half_difference,
      {Axis{"theta_h", quadratic, size, right_angle}, Axis{"theta_d", uniform, size, right_angle},
       Axis{"phi_d", uniform, 2 * size, 2 * right_angle}}};
}

/// Every 10° of theta_i, every 5° of theta_o, phi from 0 to π.
inline Grid in_out_grid() {
  using enum Axis::Spacing;
  return {Grid::Kind::in_out,
          {Axis{"theta_i", inclusive, 9, 80 * degree}, Axis{"theta_o", inclusive, 17, 80 * degree},
           Axis{"phi", inclusive, 13, 2 * right_angle}}};
}

}  // namespace gonio::test
