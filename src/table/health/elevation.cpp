#include "table/health/elevation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "base/quantile.h"
#include "table/format/columns_command.h"
#include "table/health/cosine.h"

#include <fmt/format.h>

namespace gonio {
namespace {

using std::numbers::pi;

/// The table with zenith angles counted from the surface.
Table with_elevations(const Table& t, bool incident, bool outgoing) {
  Table turned = t;
  auto& l = std::get<DirectionList>(turned.where);
  for (auto& [theta, turns] : {std::pair(&l.theta_i_deg, incident), {&l.theta_o_deg, outgoing}})
    if (turns)
      for (double& deg : *theta) deg = 90 - deg;
  return turned;
}

double theta_h_of(const Angles<double>& a) {
  return std::asin(std::sqrt(std::clamp(a.sin2_theta_h, 0.0, 1.0)));
}
double theta_d_of(const Angles<double>& a) {
  return std::acos(std::clamp(a.voh, 0.0, 1.0));
}

/// True where the highlight falls towards grazing, where those of all surfaces rise: samples at the same θ_h are compared.
bool highlight_falls(TableFacts& facts) {
  const auto& peak = facts.peak().peak;
  if (!peak) return false;
  const Table& t = facts.table();
  const SampleAngles at(t);
  constexpr double falls = 2.5, apart_deg = 20, alike_deg = 0.1;
  std::map<long, std::vector<std::pair<double, double>>> ridge;  // by θ_h: θ_d [°] and f
  for (std::size_t i = 0; i < t.size(); ++i) {
    const auto a = at(i);
    const double theta_h_deg = theta_h_of(a) / degree;
    if (!(theta_h_deg < peak->half_width_deg)) continue;
    if (const double f = value_of_all(t, a, i); f > 0)
      ridge[std::lround(theta_h_deg / alike_deg)].emplace_back(theta_d_of(a) / degree, f);
  }
  std::vector<double> ratios;
  std::size_t compared = 0;
  for (auto& [theta_h, samples] : ridge) {
    std::ranges::sort(samples);
    const std::size_t third = samples.size() / 3, upper = samples.size() - third;
    if (third == 0 || samples[upper].first - samples[third - 1].first < apart_deg) continue;
    std::vector<double> low, high;
    for (std::size_t k = 0; k < third; ++k)
      low.push_back(samples[k].second), high.push_back(samples[upper + k].second);
    compared += third;
    ratios.push_back(median(low) / median(high));
  }
  constexpr std::size_t few = 3;
  return compared >= few && median(ratios) > falls;
}

/// Standard deviation of ln f within cells of θ_h and θ_d, over which surfaces change little beside what they do over wrong
/// angles.  NaN of few.
double scatter(const Table& t) {
  constexpr std::size_t rows = 8, columns = 6, least = 3, few = 10;
  const double grazing = std::cos(85 * degree);
  const SampleAngles at(t);
  std::array<std::vector<double>, rows * columns> cells;
  for (std::size_t i = 0; i < t.size(); ++i) {
    const auto a = at(i);
    const double f = value_of_all(t, a, i);
    if (!(f > 0) || !(std::min(a.nol, a.nov) > grazing)) continue;
    const auto place = [](double part, std::size_t n) {
      return std::min(static_cast<std::size_t>(part * static_cast<double>(n)), n - 1);
    };
    cells[place(std::sqrt(theta_h_of(a) / (pi / 2)), rows) * columns +
          place(theta_d_of(a) / (pi / 2), columns)]
        .push_back(std::log(f));
  }
  double squares = 0, freedom = 0;
  for (const auto& cell : cells) {
    if (cell.size() < least) continue;
    double mean = 0;
    for (const double x : cell) mean += x / static_cast<double>(cell.size());
    for (const double x : cell) squares += (x - mean) * (x - mean);
    freedom += static_cast<double>(cell.size() - 1);
  }
  return freedom > few ? std::sqrt(squares / freedom) : std::nan("");
}

/// Command after which zenith angles are read as elevations, or no longer so.
std::string turned_by(const Table& t, std::initializer_list<const char*> roles) {
  return reading_command(t, [&](ColumnMap& map) {
    for (const char* role : roles) {
      const std::string column = column_of(map, role);
      put_column(map, role,
                 column.starts_with(elevation_mark) ? column.substr(elevation_mark.size())
                                                    : std::string(elevation_mark) + column);
    }
  });
}

/// The table without both cosines.
Table without_cosines(const Table& t) {
  Table divided = t;
  const SampleAngles at(t);
  for (auto& plane : divided.values)
    for (std::size_t i = 0; i < t.size(); ++i) plane[i] /= at(i).nol * at(i).nov;
  return divided;
}

}  // namespace

bool warn_of_elevation(TableFacts& facts, std::vector<std::string>& all) {
  const Table& t = facts.table();
  constexpr std::size_t large = 100'000;
  if (t.format != "csv" || !t.list() || t.size() > large) return false;
  if (highlight_falls(facts)) {
    // Matte surfaces times both cosines do so, too.
    constexpr Cosines both{{1, 1}, "f cos(theta_i) cos(theta_o)"};
    constexpr double clearly = 1.5;
    const double turned = scatter(with_elevations(t, true, true)),
                 divided = scatter(without_cosines(t));
    const std::string turn = turned_by(t, {"theta_i", "theta_o"}), divide = divided_by(t, both);
    all.push_back("the highlight falls towards grazing, where those of surfaces rise: " +
                  (clearly * turned < divided
                       ? fmt::format("are zenith angles elevations? ({})", turn)
                   : clearly * divided < turned
                       ? fmt::format("probably values are {} ({})", both.in_words, divide)
                       : fmt::format("elevations ({}), or {}? ({})", turn, both.in_words, divide)));
    return true;
  }
  constexpr double less = 1.6, shows = 0.05, widest_deg = 20;
  const double here = scatter(t);
  if (!(here > shows)) return false;
  const char* name = nullptr;
  double least = HUGE_VAL;
  for (const auto& [of, incident] : {std::pair("theta_i", true), {"theta_o", false}}) {
    const Table turned = with_elevations(t, incident, !incident);
    const double there = scatter(turned);
    TableFacts of_turned(turned);
    const auto& peak = of_turned.peak().peak;
    if (!(less * there < here) || !peak || peak->half_width_deg > widest_deg) continue;
    // With the wrong one turned both are elevations.
    const double score = highlight_falls(of_turned) ? here : there;
    if (score < least) least = score, name = of;
  }
  if (!name) return false;
  all.push_back(fmt::format(
      "values follow the half vector far better with 90° less {} in its place: is {} an "
      "elevation? ({})",
      name, name, turned_by(t, {name})));
  return true;
}

}  // namespace gonio
