#include "table/format/column_proposal.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <string_view>
#include <unordered_map>

#include "base/quantile.h"
#include "table/format/column_names.h"
#include "table/format/delimited.h"

#include <fmt/format.h>

namespace gonio {
namespace {

using namespace column_names;

/// Columns that are named after wavelengths in nm, without the unit; none where a number among the names is another.
std::vector<std::size_t> bare_wavelengths(std::span<const ColumnSummary> columns) {
  std::vector<std::size_t> all;
  double before = 0;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const auto nm = number_in(columns[k].name);
    if (!nm) continue;
    if (!(*nm >= 200 && *nm <= 25'000 && *nm > before)) return {};
    before = *nm;
    all.push_back(k);
  }
  return all.size() > 1 ? all : std::vector<std::size_t>();
}

/// Columns that are named after wavelengths.
struct Bands {
  std::string values;  ///< pattern, as "*nm"; "" where no two columns have one, or where two
                       ///< patterns could be it
  std::string uncertainties, kind;   ///< their pattern, and what it is of the values
  double lowest = 0;                 ///< uncertainty
  std::vector<std::string> unclear;  ///< patterns that look like uncertainties, and are not these
};
Bands bands_by_pattern(std::span<const ColumnSummary> columns) {
  struct Pattern {
    std::string without;
    std::size_t times = 0;
    double lowest = HUGE_VAL;
  };
  std::map<std::string, Pattern> patterns;
  for (const auto& c : columns)
    if (const auto name = wavelength_name(c.name)) {
      auto& p = patterns[name->pattern];
      p.without = name->without;
      ++p.times;
      p.lowest = std::min(p.lowest, c.lowest);
    }
  Bands bands;
  std::size_t of_values = 0;
  bool each_twice = true;
  for (const auto& [pattern, p] : patterns) {
    const auto kind = uncertainty_kind(p.without);
    if (!kind) {
      bands.values = pattern;
      ++of_values;
      each_twice = each_twice && p.times > 1;
    } else if (kind->empty() || p.times < 2 || !bands.kind.empty()) {
      bands.unclear.push_back(pattern);
    } else {
      bands.uncertainties = pattern, bands.kind = *kind, bands.lowest = p.lowest;
    }
  }
  if (of_values != 1 || !each_twice) bands.values.clear();
  return bands;
}

/// A table whose columns, but for the first, are the values at one angle each.
struct Matrix {
  Angle rows, columns;
  std::vector<double> angles;  ///< of the columns
  std::string guess;           ///< "" where the names say which is which
};
std::optional<Matrix> matrix_of(std::span<const ColumnSummary> columns) {
  constexpr std::size_t least = 3;
  if (columns.size() < least) return {};
  const bool named = !columns[1].name.empty();
  if (!named && columns.size() == least) return {};
  Matrix m{theta_o, theta_i, {}, ""};
  std::optional<Angle> of_columns, of_rows;
  for (std::size_t k = 1; k < columns.size(); ++k) {
    const auto& name = columns[k].name;
    const auto number = !named            ? columns[k].first
                        : number_in(name) ? number_in(name)
                                          : only_number(name);
    if (!number || std::abs(*number) > 360 || (k > 1 && *number <= m.angles.back())) return {};
    m.angles.push_back(*number);
    if (!named) continue;
    std::string word = plain_name(name);
    std::erase_if(word, [](char c) { return '0' <= c && c <= '9'; });
    const Said said = said_by(word);
    if (!word.empty() && !said.angle && !said.zenith && !said.azimuth) return {};
    if (said.angle) of_columns = said.angle;
    if (said.azimuth) of_columns = phi_o;
  }
  std::string corner = columns[0].name;  // "theta_o \ theta_i": of rows, then of columns
  if (const auto bar = corner.find_first_of("\\/|"); bar != corner.npos) {
    of_columns = said_by(plain_name(corner.substr(bar + 1))).angle;
    corner.resize(bar);
  }
  of_rows = said_by(plain_name(corner)).angle;
  // Numbers without names are a matrix only where both sides count angles in even steps.
  const double step = m.angles[1] - m.angles[0];
  const auto even = [&](std::size_t k) {
    return std::abs(m.angles[k + 1] - m.angles[k] - step) < 1e-6 * std::abs(step);
  };
  if (!named)
    for (std::size_t k = 0; k + 1 < m.angles.size(); ++k)
      if (!even(k)) return {};
  const double last = m.angles.back();
  if (of_columns > phi_o || of_rows > phi_o) return {};
  if (!of_columns && last > 90) of_columns = phi_o;
  if (of_rows && !of_columns) of_columns = *of_rows == theta_o ? theta_i : theta_o;
  if (of_columns && !of_rows) of_rows = *of_columns == theta_o ? theta_i : theta_o;
  if (!of_rows) {
    const bool across = m.angles.size() > columns[0].numbers || m.angles[0] < 0;
    of_rows = across ? theta_i : theta_o, of_columns = across ? theta_o : theta_i;
    m.guess = fmt::format(
        "rows are read as {}, columns as {}: {}", angle_roles[*of_rows], angle_roles[*of_columns],
        m.angles[0] < 0 || columns[0].lowest < 0 ? "the viewer's angles have signs"
                                                 : "the viewer's angles are more");
  }
  m.rows = *of_rows, m.columns = *of_columns;
  return m.rows == m.columns ? std::nullopt : std::optional(m);
}

/// Incident angle that a text says in words and a number: "thetai30", "Angle of incidence: 30 deg"; "30deg" where `bare` allows.
std::optional<double> incident_angle_in(std::string_view text, bool bare) {
  const auto number = only_number(text);
  if (!number || !(*number >= 0 && *number < 90)) return {};
  const std::string word = plain_name(text.substr(0, text.find_first_of(decimal_digits))),
                    unit = plain_name(text.substr(text.find_last_of(decimal_digits) + 1));
  if (!unit.empty() && !is_angle_unit(unit)) return {};
  if (word.empty()) return bare && !unit.empty() ? number : std::nullopt;
  const Said said = said_by(word);
  const bool plainly = !said.beside || !unit.empty() || word.starts_with("inc") ||
                       word.ends_with("angle") || word.ends_with("winkel");
  return said.angle == theta_i && plainly ? number : std::nullopt;
}

struct Constant {
  double angle;
  std::string from;
};
/// The one incident angle that the lines above the table, or the file's name, say.
std::optional<Constant> incident_angle(const std::string& file, std::string_view head) {
  for (int lines = 0; lines < 100 && !head.empty(); ++lines) {
    const auto line = head.substr(0, head.find_first_of("\r\n"));
    head.remove_prefix(std::min(line.size() + 1, head.size()));
    if (const auto angle = incident_angle_in(line, false))
      return Constant{*angle, fmt::format("by the line '{}'", line)};
  }
  std::string stem = file.substr(file.find_last_of("/\\") + 1);
  if (const auto dot = stem.find_last_of('.'); dot != stem.npos && dot > 0) stem.resize(dot);
  std::optional<double> found;
  // A part between _, - or blanks, or some of them: "aoi_30", "theta_i_30"; "30deg", but not after
  // "phi".
  constexpr std::string_view marks = "_- ";
  std::vector<std::size_t> begins{0};
  for (std::size_t k = 1; k < stem.size(); ++k)
    if (marks.find(stem[k - 1]) != marks.npos) begins.push_back(k);
  begins.push_back(stem.size() + 1);
  const auto part = [&](std::size_t from, std::size_t to) {
    return std::string_view(stem).substr(begins[from], begins[to] - begins[from] - 1);
  };
  for (std::size_t k = 0; k + 1 < begins.size(); ++k) {
    bool bare = true;
    for (std::size_t from = k - std::min<std::size_t>(k, 2); from < k; ++from) {
      const Said before = said_by(plain_name(part(from, k)));
      bare = bare && !before.angle && !before.azimuth && !before.zenith;
    }
    for (std::size_t to = k + 1; to < std::min(k + 4, begins.size()); ++to) {
      const auto angle = incident_angle_in(part(k, to), bare);
      if (angle && found && *found != *angle) return {};
      if (angle) found = angle;
    }
  }
  if (!found) return {};
  return Constant{*found, "by the file's name"};
}

double largest(const ColumnSummary& c) {
  return std::max(std::abs(c.lowest), std::abs(c.highest));
}

/// Columns as --map names them: by a name if no other has that, else by a number.
class References {
 public:
  explicit References(std::span<const ColumnSummary> columns) : columns_(columns) {
    for (const auto& c : columns) ++times_[c.name];
  }
  std::string operator()(std::size_t k) const {
    const auto& name = columns_[k].name;
    const bool alone = times_.at(name) == 1;
    return alone && !name.empty() && name[0] != '#' ? name : fmt::format("#{}", k + 1);
  }

 private:
  std::span<const ColumnSummary> columns_;
  std::unordered_map<std::string_view, std::size_t> times_;
};

}  // namespace

ColumnProposal propose_columns(std::span<const ColumnSummary> columns,
                               const std::string& file,
                               std::string_view head) {
  ColumnProposal p;
  Found found = by_name(columns);
  const auto range = [&](Angle a) {
    return found.angle[a] ? largest(columns[*found.angle[a]]) : 0;
  };
  // A file that calls one azimuth "theta" calls the other so, too, even where that stays small.
  const std::array pairs{std::pair(theta_i, phi_i), std::pair(theta_o, phi_o)};
  if (std::ranges::any_of(pairs, [&](auto pair) { return range(pair.first) > 90; }) &&
      std::ranges::all_of(pairs, [&](auto pair) { return range(pair.second) <= 90; }))
    for (const auto& [zenith, azimuth] : pairs) {
      if (!found.angle[zenith] || !found.angle[azimuth]) continue;
      const auto& named = columns[*found.angle[zenith]];
      p.said.push_back(fmt::format(
          "{} is read as the zenith angle, {} as the azimuth: {}",
          columns[*found.angle[azimuth]].name, named.name,
          largest(named) > 90 ? fmt::format("{} holds {:g}°, which no zenith angle is", named.name,
                                            named.highest > 90 ? named.highest : named.lowest)
                              : "assumed, because the other direction's names are swapped"));
      std::swap(found.angle[zenith], found.angle[azimuth]);
    }

  const References reference(columns);
  ColumnMap map;
  const bool half = found.angle[theta_h].has_value();
  const auto matrix =
      half || found.value.value_or(0) > 0 || (found.angle[theta_i] && found.angle[theta_o])
          ? std::nullopt
          : matrix_of(columns);
  double header = 0;
  if (matrix) {
    found = {};
    found.angle[matrix->rows] = 0;
    header = std::max(std::abs(matrix->angles.front()), std::abs(matrix->angles.back()));
    if (!matrix->guess.empty()) p.said.push_back(matrix->guess);
  }
  const auto in_matrix = [&](Angle a) { return matrix && matrix->columns == a; };
  for (std::size_t a = 0; a < angle_roles.size(); ++a)
    if (in_matrix(static_cast<Angle>(a)))
      map.columns.emplace_back(angle_roles[a], in_header);
    else if (const auto k = found.angle[a])
      map.columns.emplace_back(angle_roles[a], reference(*k));
  bool lacks = false;
  for (const auto a : {theta_i, theta_o}) {
    if (half || found.angle[a] || in_matrix(a)) continue;
    if (const auto constant = a == theta_i ? incident_angle(file, head) : std::nullopt) {
      map.columns.emplace_back(angle_roles[a], fmt::format("{:.9g}", constant->angle));
      p.said.push_back(fmt::format("theta_i is {:.9g}° {} (else --map theta_i=…)", constant->angle,
                                   constant->from));
      continue;
    }
    lacks = true;
    p.said.push_back(fmt::format("no column is called like {}{}", angle_roles[a],
                                 a == theta_i ? "; one angle for all is --map theta_i=30" : ""));
  }
  // Angles without signs that leave out the azimuth are those of the side where the highlight is.
  const bool constant = !half && !matrix && !found.angle[theta_i];
  const auto rises = [&](Angle a) {
    return !found.angle[a] || columns[*found.angle[a]].lowest >= 0;
  };
  if ((constant || matrix) && !found.angle[phi_i] && !found.angle[phi_o] && !in_matrix(phi_o) &&
      rises(theta_i) && rises(theta_o) && (!matrix || matrix->angles.front() >= 0) && !lacks) {
    map.columns.emplace_back("phi_o", "180");
    p.said.emplace_back("no angle has a sign: all are read as on the side of the mirror direction");
  }

  for (std::size_t k = 0; k < columns.size() && !matrix; ++k)
    if (columns[k].name.starts_with("f_") && is_role(columns[k].name) && !found.channel &&
        uncertainty_kind(columns[k].name).value_or("").empty())
      map.columns.emplace_back(columns[k].name, reference(k));
  const bool by_channel =
      std::ranges::any_of(map.columns, [](const auto& c) { return c.first.starts_with("f_"); });
  const auto bands = by_channel || found.channel || matrix ? Bands() : bands_by_pattern(columns);
  if (!bands.values.empty()) {
    map.columns.emplace_back("f_*", bands.values);
    found.value.reset();
  }
  bool bare = false;
  if (!found.value && !by_channel && !found.channel && !matrix && bands.values.empty()) {
    const auto by_wavelength = bare_wavelengths(columns);
    for (const std::size_t k : by_wavelength)
      map.columns.emplace_back("f_" + columns[k].name, reference(k));
    if (bare = !by_wavelength.empty(); bare)
      p.said.push_back(fmt::format("columns {} to {} are read as wavelengths in nm",
                                   columns[by_wavelength.front()].name,
                                   columns[by_wavelength.back()].name));
  }
  if (!found.value && !by_channel && !bare && !matrix && bands.values.empty())
    for (std::size_t k = 0; k < columns.size(); ++k)
      if (const auto scale = factor_scale(columns[k].name); scale && !found.value) {
        found.value = k;
        map.scale = *scale;
        p.said.push_back(fmt::format(
            "{} is read as a radiance factor{}, beside a white that reflects all: --scale {:.9g}",
            columns[k].name, *scale < 0.1 ? " in percent" : "", *scale));
      }
  if (found.value && !by_channel) map.columns.emplace_back("f", reference(*found.value));
  if (found.channel) map.columns.emplace_back("channel", reference(*found.channel));
  const auto take_for_uncertainty = [&](const std::string& name, const std::string& kind,
                                        double lowest, const std::string& role,
                                        const std::string& column) {
    if (!(lowest > 0)) {
      p.said.push_back(fmt::format("{} is not above 0 everywhere: no standard uncertainty", name));
      return;
    }
    map.columns.emplace_back(role, column);
    p.said.push_back(fmt::format("{} is read as the {} uncertainty of the values{}", name,
                                 kind.starts_with("U") ? "expanded (k = 2)" : "standard",
                                 kind.ends_with("percent") ? ", in percent"
                                 : kind.ends_with("rel")   ? ", in parts"
                                                           : ""));
  };
  if (!bands.values.empty() && !bands.kind.empty()) {
    take_for_uncertainty(bands.uncertainties, bands.kind, bands.lowest, bands.kind + "_*",
                         bands.uncertainties);
  } else if (found.uncertainty) {
    const auto& c = columns[*found.uncertainty];
    const auto kind = *uncertainty_kind(c.name);
    if (!uncertainty_role(c.name))  // else its own name says it
      take_for_uncertainty(c.name, kind, c.lowest, kind, reference(*found.uncertainty));
  }
  std::vector<std::string> unclear = found.unclear;
  unclear.insert(unclear.end(), bands.unclear.begin(), bands.unclear.end());
  if (!unclear.empty())
    p.said.push_back(fmt::format(
        "{} and {} not used: --map u_f=… takes a column for the standard one, U_f=… for k = 2 "
        "(u_percent, U_percent in percent); bring other factors and units to these first",
        unclear.size() == 1
            ? unclear[0] + " looks like an uncertainty"
            : fmt::format("{} and {} more look like uncertainties", unclear[0], unclear.size() - 1),
        unclear.size() == 1 ? "is" : "are"));

  const bool has_values = found.value || by_channel || bare || !bands.values.empty() || matrix;
  if (!has_values) p.said.emplace_back("no column is called like a value, f or brdf");
  if (lacks || !has_values) return p;
  if (found.value && plain_name(columns[*found.value].name).starts_with("cc")) {
    map.cosines = {0, 1};
    p.said.push_back(columns[*found.value].name + " is f cos(theta_o)");
  }

  double zenith = 0, any = header;
  for (std::size_t a = 0; a < angle_roles.size(); ++a) {
    const bool is_zenith = angle_roles[a].starts_with("theta_");
    any = std::max(any, range(static_cast<Angle>(a)));
    if (is_zenith) zenith = std::max(zenith, range(static_cast<Angle>(a)));
    if (is_zenith && in_matrix(static_cast<Angle>(a))) zenith = std::max(zenith, header);
  }
  constexpr double slack = 1e-3;
  map.radians = !constant && zenith <= std::numbers::pi / 2 + slack &&
                any <= 2 * std::numbers::pi + slack && any > 0;
  if (map.radians) p.said.push_back(fmt::format("no angle is above {:.4g}: radians", any));
  p.needed = map.radians || map.cosines != CosinePowers{} ||
             std::ranges::any_of(map.columns, [](const auto& c) { return c.first != c.second; });
  if (half) p.needed = true;
  p.map = std::move(map);
  return p;
}

void propose_forward(ColumnProposal& p, const Table& table) {
  if (!p.map || std::ranges::any_of(p.map->columns, [](const auto& c) {
        return c.first.starts_with("phi_") || c.first == "theta_h";
      }))
    return;
  struct Side {
    double sum = 0, count = 0;
    double mean() const { return sum / count; }
  };
  struct Sides {
    Side mirror, light;
  };
  constexpr double least_deg = 5, near_deg = 5, clear = 1.5;
  std::map<double, Sides> around;  // values near ±θ_i, by θ_i to a degree
  const DirectionList& l = *table.list();
  for (std::size_t i = 0; i < table.size(); ++i) {
    const double in = l.theta_i_deg[i];
    if (in < least_deg || std::abs(l.theta_o_deg[i] - in) > std::min(near_deg, in / 2)) continue;
    Sides& sides = around[std::round(in)];
    Side& side =
        std::cos((l.phi_o_deg[i] - l.phi_i_deg[i]) * degree) > 0 ? sides.light : sides.mirror;
    for (const auto& plane : table.values)
      if (plane[i] > 0) side.sum += plane[i], ++side.count;
  }
  std::vector<double> ratios;
  for (const auto& [in, sides] : around)
    if (sides.mirror.count > 0 && sides.light.count > 0)
      ratios.push_back(sides.light.mean() / sides.mirror.mean());
  if (ratios.empty() || median(ratios) < clear) return;
  p.map->forward_deg = 0;
  p.needed = true;
  p.said.push_back(
      fmt::format("values near theta_o = +theta_i are {:.2g} times those near -theta_i: the mirror "
                  "direction is taken to have the light's sign (leave out --forward 0 for a "
                  "retro-reflector)",
                  median(ratios)));
}

}  // namespace gonio
