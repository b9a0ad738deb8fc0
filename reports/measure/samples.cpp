#include "reports/measure/samples.h"

#include <algorithm>
#include <cmath>

#include "geometry/half_difference.h"

#include <fmt/format.h>

namespace gonio::auditing {

Values looked_at(const Parameter& p) {
  Values v{p.legal.low, p.legal.high};
  if (p.name.starts_with("alpha"))
    v.insert(v.end(), {0.01, 0.1, 0.25, 0.5, 0.75, 1});
  else if (p.name == "gamma")
    v.insert(v.end(), {1, 1.5, 2, 4});
  else if (p.name == "eta")
    v.insert(v.end(), {1.05, 1.33, 1.5, 2, 3});
  else
    v.insert(v.end(), {p.start, 0.5 * (p.legal.low + p.legal.high)});
  std::ranges::sort(v);
  const auto twice = std::ranges::unique(v);
  v.erase(twice.begin(), twice.end());
  std::erase_if(v, [&](double x) { return !p.legal.holds(x); });
  return v;
}

std::vector<Values> combinations(std::span<const Parameter> parameters,
                                 const std::function<Values(const Parameter&)>& at) {
  std::vector<Values> all{{}};
  for (const auto& p : parameters) {
    const Values values = at(p);
    std::vector<Values> more;
    for (const auto& row : all)
      for (const double v : values) {
        more.push_back(row);
        more.back().push_back(v);
      }
    all = std::move(more);
  }
  return all;
}

Values defaults(std::span<const Parameter> parameters) {
  Values v;
  for (const auto& p : parameters) v.push_back(p.start);
  return v;
}

std::string text(std::span<const Parameter> parameters, std::span<const double> values) {
  std::string s;
  for (std::size_t k = 0; k < parameters.size(); ++k)
    s += fmt::format("{}{} {:.4g}", k ? ", " : "", parameters[k].name, values[k]);
  return s;
}
std::string joined(const std::string& a, const std::string& b) {
  return a.empty() || b.empty() ? a + b : a + ", " + b;
}

Row row(double theta_i, double phi_i, double theta_o, double phi_o) {
  Row r = frame_angles({direction(theta_i, phi_i), direction(theta_o, phi_o)});
  for (double* c : {&r.nol, &r.nov, &r.noh, &r.voh}) *c = std::min(*c, 1.0);  // but for rounding
  return r;
}
Row exchanged(Row r) {
  std::swap(r.nol, r.nov);
  std::swap(r.xol, r.xov);
  std::swap(r.yol, r.yov);
  return r;
}
std::string text(const Row& r) {
  return fmt::format("NoL {:.3g}, NoV {:.3g}, NoH {:.4g}, VoH {:.3g}", r.nol, r.nov, r.noh, r.voh);
}

const std::vector<Row>& pairs() {
  static const std::vector<Row> rows = [] {
    std::vector<Row> r;
    for (int i = 0; i < 20; ++i)
      for (int o = 0; o < 20; ++o)
        for (const double phi : {0.0, 50.0, 130.0, 180.0})
          for (const double turned : {0.0, 35.0}) {
            const auto theta = [](int k) { return std::acos(0.05 + 0.05 * k); };
            r.push_back(row(theta(i), turned * degree, theta(o), (turned + phi) * degree));
          }
    return r;
  }();
  return rows;
}
const std::vector<Row>& half_vectors() {
  static const std::vector<Row> rows = [] {
    std::vector<Row> r;
    for (int i = 0; i <= 200; ++i)
      for (const double phi : {0.0, 45.0, 90.0}) {
        const double t = i / 200.0, theta = 90 * degree * t * t * t;
        r.push_back(row(theta, phi * degree, theta, phi * degree));
        if (i == 200)
          r.back().nol = r.back().nov = r.back().noh = 0;  // not what cos(π/2) rounds to
      }
    return r;
  }();
  return rows;
}
const std::vector<Row>& rows_of(Role role) {
  return role == Role::ndf ? half_vectors() : role == Role::fresnel ? cosines() : pairs();
}

const std::vector<Row>& cosines() {
  static const std::vector<Row> rows = [] {
    std::vector<Row> r;
    for (int i = 0; i <= 200; ++i) {
      const double theta = 90 * degree * i / 200.0, c = i == 200 ? 0 : std::cos(theta);
      r.push_back({{c, c, 1, c, 0}, 0, 0, std::sin(theta), 0, -std::sin(theta), 0});
    }
    return r;
  }();
  return rows;
}
const std::vector<Row>& ends() {
  static const std::vector<Row> rows = [] {
    std::vector<Row> r;
    for (const double nol : {0.0, 1e-8, 0.5, 1.0})
      for (const double nov : {0.0, 1e-8, 0.5, 1.0})
        for (const double voh : {0.0, 1e-8, 0.5, 1.0})
          for (const auto& [noh, sin2] :
               {std::pair{1.0, 0.0}, {1.0, 1e-16}, {0.6, 0.64}, {1e-8, 1.0}, {0.0, 1.0}}) {
            const double h = std::sqrt(sin2);
            if (nol + nov > 0)
              r.push_back({{nol, nov, noh, voh, sin2},
                           h,
                           0,
                           std::sqrt((1 - nol) * (1 + nol)),
                           0,
                           std::sqrt((1 - nov) * (1 + nov)),
                           0});
          }
    return r;
  }();
  return rows;
}

}  // namespace gonio::auditing
