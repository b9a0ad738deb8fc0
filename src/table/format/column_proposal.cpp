#include "table/format/column_proposal.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>
#include <unordered_map>

#include <fmt/format.h>

namespace gonio {
namespace {

/// Letters and digits alone, small: "Theta_i [deg]" is "thetaideg".
std::string plain(std::string_view name) {
  std::string s;
  for (const char c : name)
    if ('A' <= c && c <= 'Z')
      s += static_cast<char>(c - 'A' + 'a');
    else if (('a' <= c && c <= 'z') || ('0' <= c && c <= '9'))
      s += c;
  return s;
}

bool take(std::string& s, std::string_view word) {
  const auto at = s.find(word);
  if (at == s.npos) return false;
  s.erase(at, word.size());
  return true;
}
bool take_any(std::string& s, std::span<const std::string_view> words) {
  return std::ranges::any_of(words, [&](auto word) { return take(s, word); });
}
bool is_any(std::string_view s, std::span<const std::string_view> words) {
  return std::ranges::find(words, s) != words.end();
}

using Words = std::string_view;
/// What says nothing of the direction.
constexpr std::array units{Words("angle"), Words("winkel"),  Words("degrees"), Words("degree"),
                           Words("deg"),   Words("radians"), Words("radian"),  Words("rad")};
constexpr std::array zeniths{Words("theta"), Words("zenith"), Words("polar")};
constexpr std::array azimuths{Words("phi"), Words("azimuth"), Words("azimut"), Words("azi")};
constexpr std::array light{Words("i"),        Words("in"),       Words("inc"),   Words("incident"),
                           Words("incoming"), Words("source"),   Words("light"), Words("l"),
                           Words("illum"),    Words("einfalls"), Words("ein")};
constexpr std::array viewer{
    Words("o"),       Words("out"),          Words("outgoing"),  Words("r"),
    Words("refl"),    Words("ref"),          Words("reflected"), Words("s"),
    Words("scatter"), Words("scattered"),    Words("v"),         Words("view"),
    Words("viewing"), Words("detector"),     Words("det"),       Words("e"),
    Words("measure"), Words("measurement"),  Words("observer"),  Words("ausfalls"),
    Words("streu"),   Words("beobachtungs"), Words("aus"),       Words("observation")};
constexpr std::array incidence{Words("aoi"), Words("incidence"), Words("incidenceangle"),
                               Words("angleofincidence")};
constexpr std::array values{
    Words("f"),    Words("brdf"),      Words("bsdf"),  Words("fr"),       Words("fr11"),
    Words("f11"),  Words("brdfvalue"), Words("value"), Words("measured"), Words("ccbrdf"),
    Words("wert"), Words("messwert"),  Words("valeur")};
constexpr std::array wavelengths{Words("lambda"),      Words("wavelength"),   Words("wl"),
                                 Words("lambdanm"),    Words("wavelengthnm"), Words("nm"),
                                 Words("wellenlaenge")};

constexpr std::array per_solid_angle{Words("1sr"), Words("sr1"), Words("persr")};

enum Angle { theta_i, phi_i, theta_o, phi_o };
constexpr std::array<std::string_view, 4> angle_names{"theta_i", "phi_i", "theta_o", "phi_o"};

struct Found {
  std::array<std::optional<std::size_t>, 4> angle;
  std::optional<std::size_t> zenith_of_neither, azimuth_of_neither, value, channel;
};

void keep_first(std::optional<std::size_t>& slot, std::size_t column) {
  if (!slot) slot = column;
}

Found by_name(std::span<const ColumnSummary> columns) {
  Found found;
  std::array<std::optional<std::size_t>, 4> beside;  // where no name says more
  std::size_t best = values.size();
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const std::string name = plain(columns[k].name);
    std::string rest = name, bare = name;
    take_any(bare, per_solid_angle);
    if (const auto v = std::ranges::find(values, bare); v < values.begin() + best) {
      best = static_cast<std::size_t>(v - values.begin());
      found.value = k;
    } else if (is_any(name, wavelengths)) {
      keep_first(found.channel, k);
    } else if (is_any(name, incidence)) {
      keep_first(found.angle[theta_i], k);
    } else {
      for (const auto unit : units) take(rest, unit);
      const bool zenith = take_any(rest, zeniths), azimuth = !zenith && take_any(rest, azimuths);
      if (!zenith && !azimuth) {  // "in" and "out" are enough, "i" and "r" are not
        if (rest.size() > 1 && is_any(rest, light)) keep_first(beside[theta_i], k);
        if (rest.size() > 1 && is_any(rest, viewer)) keep_first(beside[theta_o], k);
        continue;
      }
      if (is_any(rest, light))
        keep_first(found.angle[zenith ? theta_i : phi_i], k);
      else if (is_any(rest, viewer))
        keep_first(found.angle[zenith ? theta_o : phi_o], k);
      else if (azimuth)
        keep_first(found.azimuth_of_neither, k);
      else if (rest.empty())
        keep_first(found.zenith_of_neither, k);
    }
  }
  for (const auto a : {theta_i, theta_o})
    if (beside[a]) keep_first(found.angle[a], *beside[a]);
  if (const auto k = found.zenith_of_neither) keep_first(found.angle[theta_o], *k);
  // The one azimuth of a file is that between the two directions; beside the viewer's it is the
  // light's.
  if (const auto k = found.azimuth_of_neither)
    keep_first(found.angle[found.angle[phi_o] ? phi_i : phi_o], *k);
  return found;
}

/// Pattern of the columns that are named after a wavelength, as "*nm"; where fewer than two are, none.
std::optional<std::string> wavelength_pattern(std::span<const ColumnSummary> columns) {
  std::optional<std::string> pattern;
  std::size_t count = 0;
  for (const auto& c : columns) {
    const auto digit = c.name.find_first_of("0123456789");
    const auto end = c.name.find_first_not_of("0123456789.", digit);
    if (digit == c.name.npos || end == c.name.npos) continue;
    const std::string unit = c.name.substr(end), of = c.name.substr(0, digit) + "*" + unit;
    if (!unit.starts_with("nm") && !unit.starts_with(" nm")) continue;
    if (pattern && *pattern != of) return {};
    pattern = of;
    ++count;
  }
  return count >= 2 ? pattern : std::nullopt;
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

ColumnProposal propose_columns(std::span<const ColumnSummary> columns) {
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
      p.said.push_back(
          fmt::format("{} is taken for the zenith angle, {} for the azimuth: one that is "
                      "called a zenith angle exceeds 90°",
                      columns[*found.angle[azimuth]].name, columns[*found.angle[zenith]].name));
      std::swap(found.angle[zenith], found.angle[azimuth]);
    }

  const References reference(columns);
  ColumnMap map;
  for (const auto a : {theta_i, phi_i, theta_o, phi_o})
    if (const auto k = found.angle[a]) map.columns.emplace_back(angle_names[a], reference(*k));
  for (std::size_t k = 0; k < columns.size(); ++k)
    if (columns[k].name.starts_with("f_") && is_role(columns[k].name) && !found.channel)
      map.columns.emplace_back(columns[k].name, reference(k));
  const bool by_channel =
      std::ranges::any_of(map.columns, [](const auto& c) { return c.first.starts_with("f_"); });
  const auto bands = by_channel || found.channel ? std::nullopt : wavelength_pattern(columns);
  if (bands) {
    map.columns.emplace_back("f_*", *bands);
    found.value.reset();
  }
  if (found.value && !by_channel) map.columns.emplace_back("f", reference(*found.value));
  if (found.channel) map.columns.emplace_back("channel", reference(*found.channel));

  for (const auto a : {theta_i, theta_o})
    if (!found.angle[a])
      p.said.push_back(fmt::format("no column is called like {}", angle_names[a]));
  if (!found.value && !by_channel && !bands)
    p.said.emplace_back("no column is called like a value, f or brdf");
  if (!p.said.empty() && (!found.angle[theta_i] || !found.angle[theta_o])) return p;
  if (!found.value && !by_channel && !bands) return p;
  if (found.value && plain(columns[*found.value].name).starts_with("cc")) {
    map.cosine = true;
    p.said.push_back(columns[*found.value].name + " is f cos(theta_o)");
  }

  const double zenith = std::max(range(theta_i), range(theta_o));
  const double any = std::max({zenith, range(phi_i), range(phi_o)});
  constexpr double slack = 1e-3;
  map.radians =
      zenith <= std::numbers::pi / 2 + slack && any <= 2 * std::numbers::pi + slack && any > 0;
  if (map.radians) p.said.push_back(fmt::format("no angle is above {:.4g}: radians", any));
  p.needed = map.radians || map.cosine ||
             std::ranges::any_of(map.columns, [](const auto& c) { return c.first != c.second; });
  p.map = std::move(map);
  return p;
}

}  // namespace gonio
