#pragma once
/// \file
/// A paint whose values are changed, and what is said of them.

#include <algorithm>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "table/health/value_warnings.h"
#include "tables.h"

namespace gonio::test {

/// Paint on ten incident angles × ten zenith angles × azimuths to `turn`, or in the plane of incidence.
/// \param first  incident angle: from 4° on no sample has a reciprocal partner
inline Table painted(double turn, double kd = 0.3, double alpha = 0.3, double first = 0) {
  DirectionList l;
  const auto add = [&](double in, double out, double phi) {
    l.theta_i_deg.push_back(in);
    l.phi_i_deg.push_back(0);
    l.theta_o_deg.push_back(out);
    l.phi_o_deg.push_back(phi);
  };
  for (double in = first; in < 80; in += 8)
    for (double out = 0; out < 88; out += 8)
      for (double phi = 0; phi <= turn; phi += turn < 360 ? 180 / 12 : 15)
        if ((out > 0 || phi == 0) && (turn > 0 ? phi < 360 : true)) add(in, out, phi);
  if (turn == 0)
    for (std::size_t i = 0, n = l.theta_i_deg.size(); i < n; ++i)
      if (l.theta_o_deg[i] > 0) add(l.theta_i_deg[i], l.theta_o_deg[i], 180);
  Table t;
  t.format = "csv";
  t.channels = {"f"};
  t.where = std::move(l);
  const auto model = bind_model("lambert+ggx/smith_ggx.correlated/schlick",
                                {{"alpha", {alpha}}, {"f0", {0.05}}, {"kd", {kd}}}, 1);
  test::put_values(t, model);
  return t;
}

/// The sentences after the values were changed.
inline std::vector<ValueWarning> warnings_of(
    Table t, const std::function<double(const Angles<double>&, double)>& change) {
  const SampleAngles at(t);
  for (auto& plane : t.values)
    for (std::size_t i = 0; i < plane.size(); ++i) plane[i] = change(at(i), plane[i]);
  TableFacts facts(t);
  return value_warnings(facts);
}
inline std::vector<std::string> said_of(
    Table t, const std::function<double(const Angles<double>&, double)>& change) {
  std::vector<std::string> all;
  for (auto& w : warnings_of(std::move(t), change)) all.push_back(w.whole());
  return all;
}
inline bool says(const std::vector<std::string>& all, std::string_view words) {
  return std::ranges::any_of(all, [&](const auto& s) { return s.find(words) != s.npos; });
}
inline double as_it_is(const Angles<double>&, double f) {
  return f;
}

/// The directions of painted() with the values of another model.
inline Table as_painted(double turn,
                        double first,
                        const char* model,
                        const std::vector<Setting>& with) {
  Table t = painted(turn, 0.3, 0.3, first);
  test::put_values(t, bind_model(model, with, 1));
  return t;
}

}  // namespace gonio::test
