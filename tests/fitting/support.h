#pragma once
/// \file
/// Tables and models that several tests of fitting look at.

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "data_synth/synth.h"
#include "fitting/judge/assess.h"
#include "fitting/result/document.h"
#include "fitting/sample/sampling.h"
#include "fitting/solve/accumulate.h"
#include "table/format/formats.h"

namespace gonio::test {

inline const FittedParameter& parameter(const FitDocument& d, const std::string& name) {
  for (const auto& p : d.parameters)
    if (p.name == name) return p;
  throw std::out_of_range(name);
}

inline BoundModel bind(const char* model, const std::string& settings, std::size_t channels) {
  return bind_model(model, parse_settings(std::vector<std::string>{settings}), channels);
}

/// Meat of a sandwich, whether of values or of clusters.
inline double meat(const Sandwich& s, std::size_t i, std::size_t k) {
  double sum = s.meat(i, k);
  for (const auto& g : s.clusters) sum += g.score[i] * g.score[k];
  return sum;
}

/// A list of one channel, seen from one place on.
inline Table list_of(std::vector<double> values) {
  Table t;
  t.format = "csv";
  t.channels = {"f"};
  DirectionList l;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double part = static_cast<double>(i) / static_cast<double>(values.size());
    l.theta_i_deg.push_back(10 + 60 * part);
    l.phi_i_deg.push_back(0);
    l.theta_o_deg.push_back(70 - 60 * part);
    l.phi_o_deg.push_back(180 * part);
  }
  t.where = std::move(l);
  t.values.emplace_back(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) t.values[0][i] = values[i];
  return t;
}

inline BoundModel paint() {
  return bind_model(
      "lambert.coupled+gtr/smith_ggx.correlated/schlick",
      parse_settings(std::vector<std::string>{"alpha=0.2,gamma=1.7,f0=0.05,kd=0.2,0.1,0.05"}), 3);
}

/// A table with masked values and weights, and values away from the optimum.
struct Case {
  BoundModel model = paint();
  Table table;
  FreeSlots free{std::vector<bool>(8, true)};
  std::vector<double> off;
  explicit Case(const SynthOptions& o = {.layout = Layout::random, .samples = 3000, .noise = 0.1}) {
    table = synthesize(model, o);
    for (std::size_t i = 0; i < table.size(); i += 11)
      table.values[i % 3][i] = i % 2 ? -1 : std::nan("");
    table.weights.assign(table.size(), 1);
    for (std::size_t i = 0; i < table.size(); i += 7)
      table.weights[i] = 0.5 * static_cast<double>(i % 5);
    off = model.values;
    for (auto& v : off) v *= 1.1;
  }
  Sampling sampling(Metric m, bool fold = false) const {
    return Sampling(table, table.bins(), m, 0, fold);
  }
  BoundModel at_off() const { return {model.model, off, {}}; }
};

inline Case small() {
  return Case({.layout = Layout::random, .samples = 500, .noise = 0.1});
}

/// MERL's two ways, mirrored and exchanged, and the two halves of an in/out grid.
inline std::vector<Case> layouts_that_fold() {
  std::vector<Case> all;
  const auto add = [&](Grid grid) {
    for (auto& axis : grid.axes) axis.size = axis.name.starts_with("phi") ? 2 * axis.size / 15 : 18;
    Case c({.layout = Layout::random, .samples = grid.size(), .noise = 0.1});
    Table t = std::move(c.table);
    t.where = grid;  // the values are noise to the angles: nothing is met by luck
    c.table = std::move(t);
    all.push_back(std::move(c));
  };
  add(merl_grid(Bins::centre));
  add(merl_grid(Bins::edge));
  add(merl_grid(Bins::centre, false));
  add(mbsdf_grid(18, 90, Bins::centre));
  return all;
}

}  // namespace gonio::test
