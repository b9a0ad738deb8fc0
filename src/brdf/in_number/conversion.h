#pragma once
/// \file
/// Terms and maps over a number T, from doubles to doubles.

#include <span>
#include <vector>

#include "brdf/catalogue/registry.h"
#include "brdf/function/any_function.h"
#include "brdf/function/map_functions.h"
#include "number/half.h"
#include "number/mixed.h"

namespace gonio {

/// Conversions of doubles to a T, and back.
template <class T>
struct Conversion {
  static T parameter(double x) { return static_cast<T>(x); }
  static T angle(double x) { return static_cast<T>(x); }
  static double out(const T& x) { return static_cast<double>(x); }
};

template <>
struct Conversion<Mixed> {
  static Mixed parameter(double x) { return Mixed(Half(x)); }
  static Mixed angle(double x) { return Mixed(static_cast<float>(x)); }
  static double out(const Mixed& x) { return x.value(); }
};

template <class T>
FrameAngles<T> angles_in(const FrameAngles<double>& a) {
  const auto in = [](double x) { return Conversion<T>::angle(x); };
  return {{in(a.nol), in(a.nov), in(a.noh), in(a.voh), in(a.sin2_theta_h)},
          in(a.xoh),
          in(a.yoh),
          in(a.xol),
          in(a.yol),
          in(a.xov),
          in(a.yov)};
}

template <class T>
std::vector<T> numbers_in(std::span<const double> parameters) {
  std::vector<T> p;
  for (const double x : parameters) p.push_back(Conversion<T>::parameter(x));
  return p;
}

/// A term at rows, or its G2.
template <class T>
std::vector<double> values_over(std::size_t term,
                                bool g2,
                                std::span<const double> parameters,
                                std::span<const FrameAngles<double>> rows) {
  std::vector<FrameAngles<T>> angles;
  for (const auto& row : rows) angles.push_back(angles_in<T>(row));
  std::vector<Quotient<T>> found(rows.size());
  any_function<T>(term).rows(numbers_in<T>(parameters), angles, found.data());
  std::vector<double> out;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const T v = found[i].value(), cosines = 4 * angles[i].nol * angles[i].nov;
    out.push_back(Conversion<T>::out(g2 ? T(select<T>(T(0) < cosines, cosines * v, T(0))) : v));
  }
  return out;
}
template <class T>
std::vector<double> map_over(std::size_t map, std::span<const double> parameters) {
  std::vector<double> out;
  for (const T& x : map_functions<T>()[map](numbers_in<T>(parameters)))
    out.push_back(Conversion<T>::out(x));
  return out;
}

/// The same in fifty digits.
std::vector<double> values_over_wide(std::size_t term,
                                     bool g2,
                                     std::span<const double> parameters,
                                     std::span<const FrameAngles<double>> rows);
std::vector<double> map_over_wide(std::size_t map, std::span<const double> parameters);

}  // namespace gonio
