#include "table/health/value_warnings.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <set>
#include <span>
#include <utility>

#include "base/few.h"
#include "base/quantile.h"
#include "base/text.h"
#include "table/format/columns_command.h"
#include "table/format/measured_by.h"
#include "table/health/fills.h"
#include "table/health/health.h"
#include "table/health/rounding.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gonio {
namespace {

using std::numbers::pi;
constexpr double too_much = 1.05;  ///< light that goes out, over what comes in

std::string divided_by(const Table& t, const CosinePowers& c) {
  return reading_command(t, [&](ColumnMap& map) {
    map.cosines = {map.cosines.incident + c.incident, map.cosines.outgoing + c.outgoing};
  });
}

std::string scaled_by(const Table& t, const char* what, double scale) {
  return fmt::format(": {}? ({})", what,
                     reading_command(t, [&](ColumnMap& map) { map.scale *= scale; }));
}
/// What values may be that return so many times the light.
std::string unit_of(const Table& t, double light) {
  constexpr double slack = 1.1;
  if (const auto note =
          std::ranges::find(t.notes, "reference", [](const auto& n) { return n.first; });
      note != t.notes.end()) {  // values × R/π
    const double reflectance = only_number(note->second).value_or(1);
    return light < slack * 100
               ? fmt::format(": in percent of the target? (gonio fit {} --reference {:.4g})",
                             file_word(t), reflectance / 100)
               : "";
  }
  if (light < slack * pi) return scaled_by(t, "a radiance factor", 1 / pi);
  constexpr double dark = 0.03;  // albedo of what is hardly ever measured in percent
  if (light > dark * 100 * pi && light < slack * 100 * pi)
    return scaled_by(t, "a radiance factor in percent", 0.01 / pi);
  return fmt::format(": counts? (gonio fit {} --scale free, or a white standard by --reference)",
                     file_word(t));
}

/// Least value of each incident direction whose samples all are above 1/π, as a share of the light: no
/// proof, since the samples may lie in one plane.  Of directions that are all apart, those of 10° of θ_i are
/// taken together.  Values of the highlight are left out.
std::optional<std::pair<double, double>> bright_everywhere(const Table& t) {
  const DirectionList* l = t.list();
  if (!l) return {};
  constexpr std::size_t few = 8, large = 100'000;
  if (t.size() > large) return {};
  const SampleAngles at(t);
  const auto values_by = [&](auto&& direction_of) {
    constexpr double highlight = 20 * degree;  // which says nothing of what is around it
    std::map<std::pair<double, double>, std::vector<double>> by;
    for (std::size_t i = 0; i < t.size(); ++i) {
      if (at.half_difference(i).theta_h < highlight) continue;
      for (const auto& plane : t.values)
        if (mask(at(i), plane[i]) == Mask::valid) by[direction_of(i)].push_back(plane[i]);
    }
    return by;
  };
  auto of = values_by([&](std::size_t i) { return std::pair{l->theta_i_deg[i], l->phi_i_deg[i]}; });
  if (std::ranges::all_of(of, [](const auto& d) { return d.second.size() < few; })) {
    constexpr double band = 10;
    of = values_by([&](std::size_t i) {
      return std::pair{band * (std::floor(l->theta_i_deg[i] / band) + 0.5), 0.0};
    });
  }
  std::optional<std::pair<double, double>> most;  // light, θ_i
  for (auto& [direction, values] : of) {
    if (values.size() < few) continue;
    const double light = pi * quantile(values, 0.05);
    if (light > too_much && (!most || light > most->first)) most = {light, direction.first};
  }
  return most;
}

/// Command that leaves a channel out.
std::string without_channel(const Table& t, std::size_t channel) {
  if (t.channels.size() > 2 * most_listed) return "";
  std::string others;
  for (std::size_t c = 0; c < t.channels.size(); ++c)
    if (c != channel) others += " " + shell_word(t.channels[c]);
  return fmt::format(" (gonio fit {} --channels{} leaves it out)", file_word(t), others);
}

/// \param divided  by a cosine: a scale says nothing then
void warn_of_light(TableFacts& facts, bool divided, std::vector<std::string>& all) {
  const Table& t = facts.table();
  const auto unit = [&](double light) { return divided ? "" : unit_of(t, light); };
  constexpr double rounding = 1e-9;
  double most = 0, at = 0, whole = 0, shown = 0;
  std::size_t brightest = 0;
  std::vector<double> of_channel(t.channels.size());
  const auto look_at = [&](const AlbedoSample& a) {
    for (std::size_t c = 0; c < a.albedo.size(); ++c) {
      const double v = a.albedo[c];
      if (std::isnan(v)) continue;
      whole = std::max(whole, v);
      of_channel[c] = std::max(of_channel[c], v);
      const double sure = (v - a.error) * a.coverage;
      if (sure > most * (1 + rounding)) most = sure, at = a.theta_i_deg, shown = v, brightest = c;
    }
  };
  std::ranges::for_each(facts.albedo().known, look_at);
  std::ranges::for_each(facts.albedo().at_least, look_at);
  double others = 0;
  for (std::size_t c = 0; c < of_channel.size(); ++c)
    if (c != brightest) others = std::max(others, of_channel[c]);
  constexpr double of_its_own = 30;  // times as bright as all others: no colour
  if (most > too_much && others > 0 && others < 1 && shown > of_its_own * others) {
    all.push_back(fmt::format(
        "channel {} returns {:.3g} times the light at theta_i {:.3g}°, the others at most {:.2g}: "
        "a scale of its own?{}",
        t.channels[brightest], shown, at, others, without_channel(t, brightest)));
    return;
  }
  if (most > too_much) {
    all.push_back(fmt::format("the table returns {:.3g} times the light at theta_i {:.3g}°{}",
                              shown, at, unit(shown)));
    return;
  }
  constexpr double next_to_nothing = 5e-4;
  if (whole > 0 && whole < next_to_nothing)
    all.push_back(
        fmt::format("the table returns {:.2g} of the light: a relative scale? (gonio fit {} "
                    "--scale free fits that, too)",
                    whole, file_word(t)));
  if (const auto bright = bright_everywhere(t))
    all.push_back(fmt::format(
        "values at theta_i {:.3g}° are above 1/pi: probably {:.3g} times the light or more{}",
        bright->second, bright->first, unit(bright->first)));
}

/// Cosines that values may be multiplied by.
struct Cosines : CosinePowers {
  const char* in_words;
};
/// The first two, and the next two, keep what exchanging the directions changes, and so do the pairs of their squares; the two
/// after these change nothing by it.
constexpr std::array cosines{Cosines{{0, 1}, "f cos(theta_o)"},
                             Cosines{{-1, 0}, "f/cos(theta_i)"},
                             Cosines{{1, 0}, "f cos(theta_i)"},
                             Cosines{{0, -1}, "f/cos(theta_o)"},
                             Cosines{{0, 2}, "f cos(theta_o)^2"},
                             Cosines{{-2, 0}, "f/cos(theta_i)^2"},
                             Cosines{{2, 0}, "f cos(theta_i)^2"},
                             Cosines{{0, -2}, "f/cos(theta_o)^2"},
                             Cosines{{1, 1}, "f cos(theta_i) cos(theta_o)"},
                             Cosines{{-1, -1}, "f/(cos(theta_i) cos(theta_o))"}};

/// Sum of the channels' valid values.
double value_of_all(const Table& t, const Angles<double>& a, std::size_t i) {
  double f = 0;
  for (const auto& plane : t.values)
    if (mask(a, plane[i]) == Mask::valid) f += plane[i];
  return f;
}

/// Slopes of ln f over the logarithms of both cosines, away from the highlight, and the spread of ln f before and
/// after they are taken out.  Of a cosine that hardly changes the slope is 0.
struct Trend {
  double incident = 0, outgoing = 0, before = 0, after = 0;

  double distance(const Cosines& c) const {
    return std::max(std::abs(incident - c.incident), std::abs(outgoing - c.outgoing));
  }
};
std::optional<Trend> trend_of(const Table& t) {
  const SampleAngles at(t);
  const double off_specular = std::sin(25 * degree);
  double n = 0;
  std::array<double, 3> sum{};                    // of the logarithms: both cosines, and f
  std::array<std::array<double, 3>, 3> square{};  // of their products
  const std::size_t step = t.size() / 30'000 + 1;
  for (std::size_t i = 0; i < t.size(); i += step) {
    const auto a = at(i);
    if (!(std::min(a.nol, a.nov) > 0.17) || a.sin2_theta_h < off_specular * off_specular) continue;
    const double f = value_of_all(t, a, i);  // the channels' colours are no trend
    if (!(f > 0)) continue;
    const std::array x{std::log(a.nol), std::log(a.nov), std::log(f)};
    ++n;
    for (std::size_t p = 0; p < 3; ++p) {
      sum[p] += x[p];
      for (std::size_t q = 0; q < 3; ++q) square[p][q] += x[p] * x[q];
    }
  }
  constexpr double few = 12, changes = 0.03, tied = 0.7;  // squared correlation
  if (n < few) return {};
  const auto v = [&](std::size_t p, std::size_t q) {
    return square[p][q] / n - sum[p] / n * (sum[q] / n);
  };
  const bool in = v(0, 0) > changes, out = v(1, 1) > changes;
  if ((!in && !out) || (in && out && v(0, 1) * v(0, 1) > tied * v(0, 0) * v(1, 1))) return {};
  Trend trend{0, 0, std::sqrt(std::max(v(2, 2), 0.0)), 0};
  if (in && out) {
    const double det = v(0, 0) * v(1, 1) - v(0, 1) * v(0, 1);
    trend.incident = (v(0, 2) * v(1, 1) - v(1, 2) * v(0, 1)) / det;
    trend.outgoing = (v(1, 2) * v(0, 0) - v(0, 2) * v(0, 1)) / det;
  } else if (in) {
    trend.incident = v(0, 2) / v(0, 0);
  } else {
    trend.outgoing = v(1, 2) / v(1, 1);
  }
  trend.after =
      std::sqrt(std::max(v(2, 2) - trend.incident * v(0, 2) - trend.outgoing * v(1, 2), 0.0));
  return trend;
}

/// True where partners are those of an isotropic surface, since the light always comes from one azimuth.
bool takes_as_isotropic(const Table& t) {
  if (t.grid()) return t.grid()->kind == Grid::Kind::in_out;
  const auto& phi = t.list()->phi_i_deg;
  return std::ranges::all_of(phi, [&](double p) { return p == phi[0]; });
}

/// Samples of a list whose light comes from one azimuth against f at the exchanged zenith angles, where four samples of the same
/// azimuth lie around these: away from the highlight logarithms are interpolated.
void for_each_between(const Table& t, const ReciprocalVisitor& visit) {
  const DirectionList& l = *t.list();
  constexpr std::size_t large = 100'000;
  constexpr double farthest_deg = 12, off_specular = 0.35;  // between samples; sin θ_h
  if (t.size() > large || !takes_as_isotropic(t)) return;
  const SampleAngles at(t);
  using Row = std::map<double, std::size_t>;  // by θ_o
  std::map<long, std::map<double, Row>> rows;
  const auto azimuth_of = [&](std::size_t i) {
    return std::lround(1000 * std::abs(std::remainder(l.phi_o_deg[i] - l.phi_i_deg[i], 360)));
  };
  for (std::size_t i = 0; i < t.size(); ++i)
    rows[azimuth_of(i)][l.theta_i_deg[i]][l.theta_o_deg[i]] = i;
  const auto around = [&](const auto& of, double deg) {
    const auto above = of.lower_bound(deg);
    if (above == of.end() || (above == of.begin() && above->first != deg))
      return std::pair{of.end(), of.end()};
    const auto below = above->first == deg ? above : std::prev(above);
    return above->first - below->first > farthest_deg ? std::pair{of.end(), of.end()}
                                                      : std::pair{below, above};
  };
  const auto between = [](double x, double from, double to, double there, double here) {
    return to > from ? std::lerp(there, here, (x - from) / (to - from)) : there;
  };
  const auto log_of = [&](std::size_t i) { return std::log(value_of_all(t, at(i), i)); };
  for (std::size_t i = 0; i < t.size(); ++i) {
    const double a = value_of_all(t, at(i), i), wanted = l.theta_i_deg[i];
    if (!(a > 0) || at(i).sin2_theta_h < off_specular * off_specular) continue;
    const auto& plane = rows[azimuth_of(i)];
    const auto [low, high] = around(plane, l.theta_o_deg[i]);
    if (low == plane.end()) continue;
    const auto along = [&](const Row& row) {
      const auto [below, above] = around(row, wanted);
      return below == row.end() ? std::nan("")
                                : between(wanted, below->first, above->first, log_of(below->second),
                                          log_of(above->second));
    };
    const double b = std::exp(between(l.theta_o_deg[i], low->first, high->first, along(low->second),
                                      along(high->second)));
    if (std::isfinite(b)) visit(i, 0, a, b);
  }
}

/// A cosine breaks reciprocity, and what is reciprocal without it had it; of the two that do so the one that values follow
/// more nearly away from the highlight.  Both cosines keep it, and a table may hold no reciprocal pairs: only that values
/// fall by them tells.
/// \return  the cosines, where there are any
const Cosines* warn_of_cosine(TableFacts& facts, std::vector<std::string>& all) {
  const Table& t = facts.table();
  const auto sigma = [&] { return facts.noise().sigma.value_or(0); };
  constexpr std::size_t few = 8;
  std::vector<double> raw;
  std::array<std::vector<double>, 4>
      without;  // of f cos θ_o or f/cos θ_i; of the others; of their squares
  const SampleAngles at(t);
  const auto compare = [&](std::size_t i, std::size_t, double a, double b) {
    const auto x = at(i);
    const double low = std::min(x.nol, x.nov), high = std::max(x.nol, x.nov);
    // Elsewhere the two cannot be told apart.
    if (!(low >= least_cosine && high > 1.2 * low && a + b > 0)) return;
    raw.push_back(reciprocity_error(a, b));
    without[0].push_back(reciprocity_error(a / x.nov, b / x.nol));
    without[1].push_back(reciprocity_error(a / x.nol, b / x.nov));
    without[2].push_back(reciprocity_error(a / (x.nov * x.nov), b / (x.nol * x.nol)));
    without[3].push_back(reciprocity_error(a / (x.nol * x.nol), b / (x.nov * x.nov)));
  };
  if (facts.reciprocity().error) for_each_reciprocal(t, compare);
  const bool between = raw.size() < few && t.list();
  if (between) for_each_between(t, compare);
  const auto trend = trend_of(t);
  std::size_t first = 0;  // of those that the trend decides between
  if (raw.size() >= few) {
    const double with = median(raw);
    for (std::size_t k = 0; k < without.size(); ++k) {
      const double rest = median(without[k]);
      if (!(with > 0.1 && 3 * rest < with && rest < 0.05 + 2 * sigma())) continue;
      constexpr double clearly = 0.5;  // of the power
      const Cosines *one = &cosines[2 * k], *other = one + 1;
      const double nearer =
          trend ? trend->distance(*other) - trend->distance(*one) : 0;  // to the first one
      if (nearer < 0) std::swap(one, other);
      const bool decides =
          std::abs(nearer) > clearly && 2 * trend->after < trend->before;  // which it explains
      all.push_back(fmt::format(
          "exchanging the directions changes values by {:.2g} %, without a cosine by {:.2g} %: "
          "they look like {}{} ({}{})",
          100 * with, 100 * rest, one->in_words,
          decides ? "" : fmt::format(" or {}", other->in_words), divided_by(t, *one),
          decides ? "" : fmt::format(", or --cosines={},{}", other->incident, other->outgoing)));
      return one;
    }
    if (!between && with > std::max(0.1, 5 * sigma())) {
      if (!takes_as_isotropic(t))
        all.push_back(fmt::format(
            "exchanging the directions changes values by {:.3g} %: they are no f, or the "
            "directions are not what they seem",
            100 * with));
      return nullptr;
    }
    if (!between) first = 2 * without.size();
  }
  if (!trend || !(3 * trend->after < trend->before && trend->after < 0.1 + 2 * sigma()))
    return nullptr;
  for (const auto& c : std::span(cosines).subspan(first))
    if (std::abs(c.incident) < 2 && std::abs(c.outgoing) < 2 && trend->distance(c) < 0.15) {
      all.push_back(fmt::format(
          "away from the highlight values change like a cosine: probably they are {} ({})",
          c.in_words, divided_by(t, c)));
      return &c;
    }
  return nullptr;
}

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

/// Angles counted from the surface put highlights elsewhere, or let them fall towards grazing.
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

void warn_of_dark_channels(const Table& t, std::vector<std::string>& all) {
  std::vector<std::string> dark;
  for (std::size_t c = 0; c < t.values.size(); ++c)
    if (std::ranges::none_of(t.values[c], [](double v) { return v > 0; }))
      dark.push_back(t.channels[c]);
  if (!dark.empty())
    all.push_back(
        fmt::format("no value of channel {} is above 0: nothing is known of it", few_of(dark)));
}

constexpr double digits_of_one = 20;  ///< standard deviations of rounding in six steps

/// True where rounding to 0 or to one digit shifts many values.  A table all of whose values are short numbers may have been
/// written so, but for zeros.
bool is_coarse(std::size_t zeros, std::size_t coarse, std::size_t values) {
  const auto many = [&](std::size_t n, double part) {
    return static_cast<double>(n) > part * static_cast<double>(values);
  };
  return many(zeros + coarse, 0.05) && (many(zeros, 0.02) || !many(zeros + coarse, 0.95));
}

void warn_of_zeros(TableFacts& facts, std::vector<std::string>& all) {
  // Numbers that somebody typed may be as short.
  constexpr std::size_t most_by_hand = 50, few_values = 8;
  constexpr double small_loss = 0.015;  // standard deviation
  const Table& t = facts.table();
  const SampleAngles at(t);
  const FileRounding rounding = rounding_of(t);
  const double one_digit = digits_of_one * rounding.absolute;
  std::size_t zeros = 0, coarse = 0, values = 0, negative = 0;
  std::vector<double> lost;  // by rounding, of each value
  std::set<double> different;
  const std::size_t step = t.size() / 60'000 + 1;
  for (const auto& plane : t.values) {
    std::size_t none = 0, some = 0;
    for (std::size_t i = 0; i < t.size(); i += step) {
      const Mask m = plane[i] <= 0 ? mask(at(i), plane[i]) : Mask::valid;
      none += m == Mask::valid && plane[i] == 0;
      negative += m == Mask::negative;
      some += plane[i] > 0;
      coarse += plane[i] > 0 && plane[i] < one_digit;
      if (!(plane[i] > 0) || mask(at(i), plane[i]) != Mask::valid) continue;
      lost.push_back(rounding.of(plane[i]) / plane[i]);
      if (different.size() < few_values) different.insert(plane[i]);
    }
    if (some == 0) continue;  // of a channel of zeros something else is said
    zeros += none;
    values += none + some;
  }
  const auto many = [&](std::size_t n, double part) {
    return static_cast<double>(n) > part * static_cast<double>(values);
  };
  if (rounding.absolute > 0 && is_coarse(zeros, coarse, values))
    all.push_back(fmt::format(
        "{} of {} values are rounded to one digit or to 0: dark places get upper limits",
        zeros + coarse, values));
  else if (negative == 0 && many(zeros, 0.005))
    all.push_back(
        fmt::format("{} of {} values are 0, clipped noise or shadow: logarithms leave them out "
                    "(--metric l2_cosine counts them)",
                    zeros, values));
  else if (const double typical = lost.empty() ? 0 : median(lost);
           lost.size() >= most_by_hand && different.size() == few_values && typical > small_loss)
    all.push_back(fmt::format(
        "values are rounded to {}, typically {:.2g} % of a value: parameters may be off by more "
        "than their intervals",
        rounding.digits > 0
            ? fmt::format("{} significant digit{}", rounding.digits, rounding.digits > 1 ? "s" : "")
            : fmt::format("steps of {:.3g} 1/sr", rounding.absolute * std::sqrt(12)),
        100 * typical));
}

/// Number of values at the end of a range, where many share the last one, as they share no other near it.
/// \param values  of a channel or of several with one end, sorted from that end on
/// \param is_near  whether a value is near the last one
template <class Near>
std::size_t shared_end(const std::vector<double>& values, const Near& is_near) {
  std::size_t run = 0, last = 0, longest = 0;  // of equal values: this, at the end, and elsewhere
  for (std::size_t k = 0; k < values.size() && is_near(values[k]); ++k) {
    run = k > 0 && values[k] == values[k - 1] ? run + 1 : 1;
    (values[k] == values[0] ? last : longest) =
        std::max(values[k] == values[0] ? last : longest, run);
  }
  constexpr std::size_t few = 8, others = 4;
  return last < few || longest == 0 || last < others * longest || 500 * last < values.size() ? 0
                                                                                             : last;
}

/// Last value that many samples share, of a channel or of several that end there.
struct SharedEnd {
  double value;
  std::size_t sharers, values;
  std::vector<std::string> channels;
};
std::vector<SharedEnd> shared_ends(const Table& t, bool greatest) {
  const SampleAngles at(t);
  const std::size_t step = t.size() / 60'000 + 1;
  std::map<double, std::pair<std::vector<double>, std::vector<std::string>>> with_end;
  for (std::size_t c = 0; c < t.values.size(); ++c) {
    std::vector<double> values;
    for (std::size_t i = 0; i < t.size(); i += step)
      if (const double v = t.values[c][i]; v > 0 && mask(at(i), v) == Mask::valid)
        values.push_back(v);
    if (values.empty()) continue;
    const auto [low, high] = std::ranges::minmax(values);
    auto& [together, channels] = with_end[greatest ? high : low];
    together.insert(together.end(), values.begin(), values.end());
    channels.push_back(t.channels[c]);
  }
  std::vector<SharedEnd> all;
  for (auto& [end, found] : with_end) {
    auto& [values, channels] = found;
    std::ranges::sort(values);
    if (greatest) std::ranges::reverse(values);
    const auto is_near = [&, last = end](double v) {
      return greatest ? v > last / 2 : v < 2 * last;
    };
    if (const std::size_t n = shared_end(values, is_near))
      all.push_back({end, n, values.size(), std::move(channels)});
  }
  return all;
}

/// Name of a channel's values in a mask.
std::string in_mask(const std::string& channel) {
  return channel == "f" ? channel : "f_" + channel;
}

void warn_of_fill(const Table& t, const Fill& fill, std::vector<std::string>& all) {
  std::vector<std::string> channels, conditions;
  for (const std::size_t c : fill.channels) {
    channels.push_back(t.channels[c]);
    conditions.push_back(
        fmt::format("{0} >= {1} and {0} <= {1}", in_mask(t.channels[c]), fill.value));
  }
  all.push_back(
      fmt::format("{} of {} values of channel {} are {}, unlike those beside them: a mark for "
                  "missing data? (--mask '{}' leaves {} out)",
                  fill.sharers, fill.values, few_of(channels), fill.value, conditions[0],
                  conditions.size() > 1 ? "their samples" : "them"));
}

/// A greatest value that many samples share is where a detector was full; a least one, where noise was clipped; any other, where
/// somebody filled a gap.
void warn_of_shared_ends(TableFacts& facts, std::vector<std::string>& all) {
  const auto found = [](const SharedEnd& e) {
    return fmt::format("{} of {} values of channel {} are {}", e.sharers, e.values,
                       few_of(e.channels), e.value);
  };
  const Table& t = facts.table();
  const auto full = shared_ends(t, true);
  if (!full.empty()) {
    std::vector<std::string> conditions;
    for (const auto& e : full)
      for (const auto& channel : e.channels)
        conditions.push_back(fmt::format("{} >= {}", in_mask(channel), e.value));
    const bool few = conditions.size() <= most_listed;
    all.push_back(fmt::format(
        "{}, and none is more: a full detector? (--mask {} {})", found(full[0]),
        few ? fmt::format("'{}'", fmt::join(conditions, " or ")) : few_of(conditions, " or "),
        few ? "leaves them out" : "leave them out"));
  }
  for (const auto& e : shared_ends(t, false)) {
    // A computed base is shared, too; clipped noise goes on above.
    std::vector<double> above;
    for (const auto& d : facts.noise_samples().all)
      if (const double v = t.values[d.channel][d.sample]; v > e.value && v < 10 * e.value)
        above.push_back(std::abs(d.more));
    constexpr std::size_t few = 8;
    constexpr double noisy = 0.1;
    if (above.size() < few || !(median(above) > noisy)) continue;
    all.push_back(found(e) +
                  ", and none is less: clipped noise? (--metric l2_cosine minds it less)");
    return;
  }
  if (full.empty())
    if (const auto fill = fill_of(t)) warn_of_fill(t, *fill, all);
}

/// Noise lets neighbours change sides; what was taken off too much does not.
void warn_of_offset(TableFacts& facts, std::vector<std::string>& all) {
  if (facts.negative_channel() || facts.negative_offset() == 0) return;
  all.push_back(
      fmt::format("negative values, typically -{:.2g} 1/sr, follow their neighbours: rather an "
                  "offset than noise, "
                  "perhaps too much dark signal taken off (--metric l2_cosine minds it less)",
                  facts.negative_offset()));
}

void warn_of_negative_channel(TableFacts& facts, std::vector<std::string>& all) {
  const auto of = facts.negative_channel();
  if (!of) return;
  const Table& t = facts.table();
  all.push_back(fmt::format(
      "all negative values are of channel {}: a colour outside the gamut, or an offset; noise "
      "would show in all channels{}",
      t.channels[*of], without_channel(t, *of)));
}

/// A value that is said to be far surer than the others, which a fit then goes through.
void warn_of_sure_values(const Table& t, std::vector<std::string>& all) {
  constexpr double far = 30;  // below both the typical uncertainty and the typical part of a value
  const double part = typical_uncertainty(t);
  for (std::size_t c = 0; c < t.errors.size(); ++c) {
    const Values &u = t.errors[c], &f = t.values[c];
    const double typical = typical_value(u).value_or(0);
    std::optional<std::size_t> surest;
    std::size_t sure = 0;
    for (std::size_t i = 0; i < t.size(); ++i)
      if (u[i] > 0 && f[i] > 0 && far * u[i] < typical && far * u[i] < part * f[i]) {
        ++sure;
        if (!surest || u[i] < u[*surest]) surest = i;
      }
    if (!surest) continue;
    all.push_back(fmt::format(
        "{} of {} stated uncertainties {} far below the others (sample {}: {:.2g} % of its value, "
        "typically {:.2g} %): a fit passes through such values",
        sure, t.size(), sure == 1 ? "is" : "are", *surest + 1, 100 * u[*surest] / f[*surest],
        100 * part));
    return;
  }
}

}  // namespace

std::optional<std::size_t> negative_channel(TableFacts& facts) {
  const Table& t = facts.table();
  if (!t.negative_is_noise || t.values.size() < 2) return {};
  std::optional<std::size_t> of;
  std::vector<double> sizes;
  const SampleAngles at(t);
  for (std::size_t c = 0; c < t.values.size(); ++c)
    for (std::size_t i = 0; i < t.size(); ++i)
      if (t.values[c][i] < 0 && mask(at(i), t.values[c][i]) == Mask::negative) {
        if (of && *of != c) return {};
        of = c;
        sizes.push_back(-t.values[c][i]);
      }
  constexpr std::size_t few = 8;
  if (sizes.size() < few) return {};
  // What neighbours differ by, in the other channels: far less than such a floor.
  std::vector<double> noise;
  for (const auto& d : facts.noise_samples().all)
    if (d.channel != *of) noise.push_back(std::abs(d.more) * t.values[d.channel][d.sample]);
  if (noise.empty() || 3 * median(noise) > median(sizes)) return {};
  return of;
}

/// What measured tables have that are f all the same.
void warn_of_reciprocity(TableFacts& facts, std::vector<std::string>& all) {
  constexpr double much = 0.05, no_instruments = 0.1, beside_noise = 5;
  const double error = facts.reciprocity().error.value_or(0);
  if (!(error > std::max(much, beside_noise * facts.noise().sigma.value_or(0)))) return;
  if (error > no_instruments && takes_as_isotropic(facts.table()))
    all.push_back(fmt::format(
        "exchanging the directions changes values by {:.3g} %: no f, other directions, or "
        "an anisotropic surface",
        100 * error));
  else
    all.push_back(fmt::format(
        "exchanging the directions changes values by {:.2g} %, far more than noise: errors of the "
        "instrument, which no model follows",
        100 * error));
}

double lost_below(TableFacts& facts) {
  const Table& t = facts.table();
  constexpr double many = 0.02;       // of the values
  constexpr double of_half = 1.4826;  // the standard deviation of noise, of its typical size
  if (facts.noise_floor() > 0) return facts.noise_floor();
  const SampleAngles at(t);
  const double rounding = rounding_of(t).absolute;
  std::size_t zeros = 0, coarse = 0, values = 0;
  const std::size_t step = t.size() / 60'000 + 1;
  std::vector<double> beside;
  for (const auto& plane : t.values) {
    if (std::ranges::none_of(plane, [](double v) { return v > 0; })) continue;
    for (std::size_t i = 0; i < t.size(); i += step) {
      values += plane[i] >= 0;
      coarse += plane[i] > 0 && plane[i] < digits_of_one * rounding;
      if (plane[i] != 0 || mask(at(i), 0) != Mask::valid) continue;
      ++zeros;
      for (const std::size_t k : {i - 1, i + 1})
        if (k < t.size() && plane[k] > 0) beside.push_back(plane[k]);
    }
  }
  if (rounding > 0 && is_coarse(zeros, coarse, values)) return std::sqrt(12) * rounding / 2;
  if (!(static_cast<double>(zeros) > many * static_cast<double>(values)) || beside.empty())
    return 0;
  return of_half * median(beside);
}

std::vector<ValueWarning> value_warnings(TableFacts& facts) {
  std::vector<std::string> texts, cosine;
  const auto* c = warn_of_cosine(facts, cosine);
  warn_of_light(facts, c && c->incident + c->outgoing < 0, texts);
  const std::size_t of_scale = texts.size();
  if (!c && warn_of_elevation(facts, texts))
    cosine.clear();  // of exchanged directions there is nothing more to say
  const bool is_told = !cosine.empty();
  texts.insert(texts.end(), cosine.begin(), cosine.end());
  warn_of_negative_channel(facts, texts);
  warn_of_offset(facts, texts);
  warn_of_shared_ends(facts, texts);
  const std::size_t of_unit = texts.size();
  if (!is_told) warn_of_reciprocity(facts, texts);
  warn_of_dark_channels(facts.table(), texts);
  warn_of_zeros(facts, texts);
  warn_of_sure_values(facts.table(), texts);
  std::vector<ValueWarning> all;
  for (auto& text : texts)
    all.push_back({std::move(text), all.size() < of_unit, all.size() < of_scale});
  return all;
}

}  // namespace gonio
