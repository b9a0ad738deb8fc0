#include "table/format/measured_by.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <numbers>

#include "base/error.h"
#include "base/numbers.h"
#include "base/quantile.h"
#include "base/text.h"
#include "optics/spectrum.h"
#include "table/format/wavelengths.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gonio {
namespace {

constexpr double widest = 60;  // [°]

bool is_width(double radians) {
  return radians >= 0 && radians < widest * degree;
}

}  // namespace

double width_of_cone(double solid_angle) {
  // Of small ones 1 − cos loses the digits:  Ω = 4π sin²(d/4)
  return 4 * std::asin(std::min(1.0, std::sqrt(solid_angle / (4 * std::numbers::pi))));
}

Aperture aperture_from(std::string_view words) {
  const auto refuse = [&](std::string_view found) {
    throw wrong_usage(
        fmt::format("aperture: found {}, expected LIGHT,DETECTOR, each a full width from 0 to "
                    "below {:g} [°] or a solid "
                    "angle with sr, and one of them above 0",
                    found, widest));
  };
  std::array<double, 2> width{};
  const auto comma = words.find(',');
  if (comma == words.npos) refuse(words);
  const std::array parts{words.substr(0, comma), words.substr(comma + 1)};
  for (std::size_t k = 0; k < 2; ++k) {
    std::string_view part = parts[k];
    const bool is_solid = part.ends_with("sr");
    if (is_solid) part.remove_suffix(2);
    const auto v = number_from<double>(part);
    if (!v || !(*v >= 0)) refuse(parts[k]);
    width[k] = is_solid ? width_of_cone(*v) : *v * degree;
    if (!is_width(width[k])) refuse(parts[k]);
  }
  const Aperture a{width[0], width[1]};
  if (!a) refuse(words);
  return a;
}

void check_aperture(const std::string& path, const Aperture& a) {
  for (const auto& [name, width] : {std::pair{"light", a.light}, std::pair{"detector", a.detector}})
    if (!is_width(width))
      throw bad_input(path, fmt::format("aperture of the {}", name),
                      fmt::format("{:g}°", width / degree),
                      fmt::format("a full width from 0 to below {:g}°", widest));
}

void scale_values(Table& t, double factor) {
  for (auto* planes : {&t.values, &t.errors})
    for (auto& plane : *planes)
      for (double& v : plane) v *= factor;
  if (const auto between = t.between)
    t.between = [between, factor](const DirectionPair& p, std::size_t c) {
      return factor * between(p, c);
    };
}

std::optional<double> typical_value(const Values& plane) {
  std::vector<double> sizes;
  for (const double v : plane)
    if (v > 0 && std::isfinite(v)) sizes.push_back(v);
  return sizes.empty() ? std::nullopt : std::optional(median(sizes));
}

double least_sure_value(const Values& plane) {
  constexpr double of_typical = 1e-3;
  return of_typical * typical_value(plane).value_or(1);
}

void make_absolute(Values& uncertainties, const Values& of) {
  const double least = least_sure_value(of);
  for (std::size_t i = 0; i < uncertainties.size(); ++i)
    uncertainties[i] *= std::max(std::abs(of[i]), least);
}

void take_reference(Table& t, double reflectance) {
  if (!(reflectance > 0 && reflectance <= 2))
    throw wrong_usage(fmt::format(
        "reference: found {:g}, expected a reflectance above 0, 2 at most", reflectance));
  scale_values(t, reflectance / std::numbers::pi);
  t.truth.reset();  // is that of other values
  t.notes.emplace_back("reference", fmt::format("values × {:g}/π", reflectance));
}

namespace {

std::map<double, std::size_t> bands_of(const Table& t) {
  std::map<double, std::size_t> bands;
  for (std::size_t k = 0; k < t.channels.size(); ++k)
    if (const auto nm = wavelength_with_unit(t.channels[k])) bands.emplace(*nm, k);
  return bands;
}

/// Replaces the channels: value and uncertainty of each are Σ weight of the old ones, whose errors are independent.
void mix(Table& t,
         std::vector<std::string> names,
         const std::vector<std::vector<double>>& weights) {
  const auto mixed = [&](const std::vector<Values>& planes, bool squares) {
    std::vector<Values> all(planes.empty() ? 0 : names.size(), Values(t.size(), 0.0));
    for (std::size_t c = 0; c < all.size(); ++c) {
      for (std::size_t k = 0; k < planes.size(); ++k)
        if (const double w = weights[c][k]; w != 0)
          for (std::size_t i = 0; i < t.size(); ++i)
            all[c][i] += squares ? w * w * planes[k][i] * planes[k][i]
                         : planes[k][i] < 0 && !t.negative_is_noise  // no data
                             ? std::numeric_limits<double>::quiet_NaN()
                             : w * planes[k][i];
      if (squares)
        for (double& v : all[c]) v = std::sqrt(v);
    }
    return all;
  };
  auto values = mixed(t.values, false), errors = mixed(t.errors, true);
  if (const auto between = t.between)
    t.between = [between, weights](const DirectionPair& p, std::size_t c) {
      double sum = 0;
      for (std::size_t k = 0; k < weights[c].size(); ++k)
        if (const double w = weights[c][k]; w != 0) sum += w * between(p, k);
      return sum;
    };
  t.channels = std::move(names);
  t.values = std::move(values);
  t.errors = std::move(errors);
}

}  // namespace

std::size_t channel_named(const Table& t, const std::string& name) {
  if (const auto at = std::ranges::find(t.channels, name); at != t.channels.end())
    return static_cast<std::size_t>(at - t.channels.begin());
  if (const auto asked = name.ends_with("nm") ? wavelength_with_unit(name) : std::nullopt) {
    const auto bands = bands_of(t);
    const auto nearest = std::ranges::min_element(
        bands, {}, [&](const auto& b) { return std::abs(b.first - *asked); });
    if (nearest != bands.end()) {  // half of the way to the next band, on that side or the other
      double gap = nearest == bands.begin() ? 0 : nearest->first - std::prev(nearest)->first;
      if (std::next(nearest) != bands.end())
        gap = std::max(gap, std::next(nearest)->first - nearest->first);
      constexpr double least = 2;  // [nm]
      if (std::abs(nearest->first - *asked) <= std::max(gap / 2, least)) return nearest->second;
    }
  }
  throw wrong_usage(fmt::format("no channel '{}' among {}", name, fmt::join(t.channels, ", ")));
}

void pick_channels(Table& t, const std::vector<std::string>& names) {
  std::vector<std::vector<double>> weights;
  std::vector<std::string> picked, nearest;
  for (const auto& name : names) {
    const std::size_t k = channel_named(t, name);
    if (std::ranges::find(picked, t.channels[k]) != picked.end())
      throw wrong_usage(fmt::format("channel '{}' twice", name));
    picked.push_back(t.channels[k]);
    const auto asked = wavelength_with_unit(name), taken = wavelength_with_unit(t.channels[k]);
    if (asked && taken && *asked != *taken)
      nearest.push_back(fmt::format("{} is the nearest to {}", t.channels[k], name));
    weights.emplace_back(t.channels.size())[k] = 1;
  }
  if (!nearest.empty())
    t.notes.emplace_back("channels", fmt::format("{}", fmt::join(nearest, ", ")));
  mix(t, std::move(picked), weights);
}

void take_rgb(Table& t) {
  const auto bands = bands_of(t);
  constexpr double low = 400, high = 700, apart = 50;
  bool covered = bands.size() == t.channels.size() && bands.size() > 1 &&
                 bands.begin()->first <= low && std::prev(bands.end())->first >= high;
  for (auto b = bands.begin(); covered && std::next(b) != bands.end(); ++b)
    covered =
        std::next(b)->first - b->first <= apart || std::next(b)->first <= low || b->first >= high;
  if (!covered)
    throw wrong_usage(
        fmt::format("rgb: found channels {}, expected wavelengths that cover {:g} to {:g} nm by "
                    "{:g} nm or less",
                    fmt::join(t.channels, ", "), low, high, apart));
  std::vector<std::vector<double>> weights(3, std::vector<double>(t.channels.size()));
  for (auto b = bands.begin(); b != bands.end(); ++b) {
    // 1 at the band, 0 at its neighbours, linear between; the first and the last hold for all
    // beyond.
    const auto part = linear_srgb(spectrum([&](double nm) {
      if (nm == b->first) return 1.0;
      const bool below = nm < b->first;
      if (below ? b == bands.begin() : std::next(b) == bands.end()) return 1.0;
      const double other = (below ? std::prev(b) : std::next(b))->first;
      return std::max(0.0, 1 - (nm - b->first) / (other - b->first));
    }));
    for (std::size_t c = 0; c < 3; ++c) weights[c][b->second] = part[c];
  }
  mix(t, {"r", "g", "b"}, weights);
}

std::vector<std::string> AsMeasured::channel_names() const {
  std::vector<std::string> names;
  for (const auto& words : channels)
    for (auto& name : split(words, ',')) names.push_back(std::move(name));
  return names;
}

void take(Table& t, const AsMeasured& how) {
  if (how.aperture) t.aperture = aperture_from(*how.aperture);
  if (how.reference) take_reference(t, *how.reference);
  if (how.rgb && !how.channels.empty()) throw wrong_usage("channels or rgb: one of them");
  if (!how.channels.empty()) pick_channels(t, how.channel_names());
  if (how.rgb) take_rgb(t);
  if (how.mask) leave_out(t, *how.mask);
}

}  // namespace gonio
