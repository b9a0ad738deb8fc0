#pragma once
/// \file
/// What the tests of the catalogue share: a term evaluated on its own, its parameters' legal values
/// as a grid, angles of random direction pairs, and differences.

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "brdf/catalogue/registry.h"
#include "brdf/kernel/kernels.h"
#include "brdf/model/evaluate.h"
#include "geometry/half_difference.h"

namespace gonio::test {

using Parameters = std::vector<double>;

inline std::vector<std::size_t> terms_of(Role role) {
  std::vector<std::size_t> terms;
  for (std::size_t i = 0; i < catalogue().size(); ++i)
    if (role_of(catalogue()[i].about->id) == role) terms.push_back(i);
  return terms;
}

using Row = FrameAngles<double>;

/// A frame for angles that have none: h in the plane of the tangent, and l and v about where they
/// must be.
inline Row framed(const Angles<double>& a) {
  const double h = std::sqrt(a.sin2_theta_h);
  return {
      a, h, 0, std::sqrt((1 - a.nol) * (1 + a.nol)), 0, 0, std::sqrt((1 - a.nov) * (1 + a.nov))};
}
inline std::vector<Row> framed(std::span<const Angles<double>> rows) {
  std::vector<Row> r;
  for (const auto& a : rows) r.push_back(framed(a));
  return r;
}

template <class F>
AngleColumns<F> columns(std::span<const Row> rows) {
  AngleColumns<F> x(rows.size(), true);
  for (std::size_t i = 0; i < rows.size(); ++i) x.set(i, rows[i]);
  return x;
}

template <class F = double>
std::vector<F> values_of(std::size_t term,
                         const Parameters& parameters,
                         std::span<const Row> rows,
                         const Kernels<F>& k = kernels<F>("scalar")) {
  const auto x = columns<F>(rows);
  const std::vector<F> p(parameters.begin(), parameters.end());
  const Column<F> ones(x.padded(), 1), zeros(x.padded(), 0);
  Column<F> out(x.padded());
  k.terms[term].add_product(x.block(), p.data(),
                            {ones.data(), nullptr, zeros.data(), out.data(), nullptr});
  return {out.data(), out.data() + rows.size()};
}
inline double value_at(std::size_t term, const Parameters& parameters, const Row& row) {
  return values_of(term, parameters, {&row, 1})[0];
}
inline double value_of(std::size_t term, const Parameters& parameters, const Angles<double>& at) {
  return value_at(term, parameters, framed(at));
}

/// [0]: the value; [1 + k]: its derivative by the k-th parameter; last, of an anisotropic term, by its turn.
template <class F = double>
std::vector<std::vector<F>> derivatives_of(std::size_t term,
                                           const Parameters& parameters,
                                           std::span<const Row> rows,
                                           const Kernels<F>& k = kernels<F>("scalar")) {
  const auto x = columns<F>(rows);
  const std::vector<F> p(parameters.begin(), parameters.end());
  std::vector<Column<F>> out;
  std::vector<F*> d;
  for (std::size_t i = 0; i <= p.size() + catalogue()[term].anisotropic; ++i) {
    out.emplace_back(x.padded());
    if (i > 0) d.push_back(out.back().data());
  }
  k.terms[term].derivatives(x.block(), p.data(), out[0].data(), d.data());
  std::vector<std::vector<F>> result;
  for (const auto& c : out) result.emplace_back(c.data(), c.data() + rows.size());
  return result;
}

/// `steps` + 1 values of a range with both its ends; by equal factors where it spans decades.
inline Parameters spread(const Range& r, int steps) {
  const bool decades = r.low > 0 && r.high / r.low > 100;
  Parameters p;
  for (int i = 0; i <= steps; ++i) {
    const double t = static_cast<double>(i) / steps;
    p.push_back(decades ? r.low * std::pow(r.high / r.low, t) : r.low + (r.high - r.low) * t);
  }
  p.back() = r.high;
  return p;
}
/// All combinations of legal values of a term's parameters; 1 among them, where formulas have
/// holes.
inline std::vector<Parameters> legal_grid(std::span<const Parameter> parameters, int steps) {
  std::vector<Parameters> grid{{}};
  for (const auto& p : parameters) {
    Parameters values = spread(p.legal, steps);
    if (p.legal.holds(1) && p.legal.high > 1) values.push_back(1);
    std::vector<Parameters> more;
    for (const auto& row : grid)
      for (const double v : values) {
        more.push_back(row);
        more.back().push_back(v);
      }
    grid = std::move(more);
  }
  return grid;
}

inline std::string text(const Parameters& p) {
  return testing::PrintToString(p);
}
inline std::string text(const Angles<double>& a) {
  return testing::PrintToString(Parameters{a.nol, a.nov, a.noh, a.voh, a.sin2_theta_h});
}

/// Directions above the surface: their half vectors from the peak outwards, some of them grazing.
inline std::vector<Row> random_angles(std::size_t n, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto uniform = [&](double a, double b) {
    return std::uniform_real_distribution(a, b)(random);
  };
  std::vector<Row> rows;
  while (rows.size() < n) {
    const double h = rows.size() % 2 ? uniform(0, 1.5) : std::exp(uniform(std::log(1e-5), 0));
    const double d =
        rows.size() % 3 ? uniform(0, 1.5) : 1.5707 - std::exp(uniform(std::log(1e-3), 0));
    const double phi_d = uniform(0, 3.1416);
    const auto a = angles(SinCos(h), SinCos(d), std::cos(phi_d));
    Row row = frame_angles(directions(HalfDifference{h, uniform(-3.1416, 3.1416), d, phi_d}));
    static_cast<Angles<double>&>(row) = a;  // near the peak the directions have lost sin² θ_h
    if (a.nol > 1e-4 && a.nov > 1e-4) rows.push_back(row);
  }
  return rows;
}

/// ∂f/∂x by central differences of two steps, the error's h² taken out.
double slope(auto&& f, double x, double h) {
  const auto central = [&](double step) { return (f(x + step) - f(x - step)) / (2 * step); };
  return (4 * central(h / 2) - central(h)) / 3;
}

}  // namespace gonio::test
