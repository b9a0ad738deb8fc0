#include "table/format/column_names.h"

#include <algorithm>
#include <numbers>

#include "table/format/delimited.h"

#include <fmt/format.h>

namespace gonio::column_names {
namespace {

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
constexpr std::array reflection{
    Words("aor"),       Words("reflection"),         Words("reflectionangle"),
    Words("aov"),       Words("angleofreflection"),  Words("angleofview"),
    Words("viewangle"), Words("angleofobservation"), Words("observationangle"),
    Words("emergence"), Words("emergenceangle"),     Words("angleofemergence")};
/// Reflectance of the light, times π what a white surface sends: radiance factors.
constexpr std::array factors{Words("radiancefactor"),
                             Words("reflectancefactor"),
                             Words("bidirectionalreflectancefactor"),
                             Words("brf"),
                             Words("hdrf"),
                             Words("reflectance"),
                             Words("reflectivity"),
                             Words("remission"),
                             Words("reflexionsgrad"),
                             Words("strahldichtefaktor")};
constexpr std::array values{
    Words("f"),    Words("brdf"),      Words("bsdf"),  Words("fr"),       Words("fr11"),
    Words("f11"),  Words("brdfvalue"), Words("value"), Words("measured"), Words("ccbrdf"),
    Words("wert"), Words("messwert"),  Words("valeur")};
constexpr std::array wavelengths{Words("lambda"),      Words("wavelength"),   Words("wl"),
                                 Words("lambdanm"),    Words("wavelengthnm"), Words("nm"),
                                 Words("wellenlaenge")};

constexpr std::array per_solid_angle{Words("1sr"), Words("sr1"), Words("persr"), Words("sr")};
constexpr std::array halves{Words("h"), Words("half")};
constexpr std::array differences{Words("d"), Words("diff"), Words("difference")};
constexpr std::array words_of_doubt{Words("u"),
                                    Words("uf"),
                                    Words("ufr"),
                                    Words("sigma"),
                                    Words("std"),
                                    Words("stdev"),
                                    Words("sd"),
                                    Words("stddev"),
                                    Words("unc"),
                                    Words("uncert"),
                                    Words("sem"),
                                    Words("err"),
                                    Words("uncertainty"),
                                    Words("fstd"),
                                    Words("funcertainty"),
                                    Words("fstdev"),
                                    Words("fsigma"),
                                    Words("stderr"),
                                    Words("error"),
                                    Words("ferr"),
                                    Words("func"),
                                    Words("se"),
                                    Words("deviation"),
                                    Words("unsicherheit"),
                                    Words("abweichung"),
                                    Words("messunsicherheit")};
/// Words that a number before them multiplies: "2 sigma".
constexpr std::array spreads{Words("sigma"), Words("std"), Words("sd")};
constexpr std::array words_of_expansion{Words("expanded"), Words("erweiterte")};
constexpr std::array words_of_percent{Words("percent"), Words("prozent")};
constexpr std::array words_of_relation{Words("relative"), Words("relativ"), Words("rel")};
constexpr std::array words_of_angles{Words("theta"),   Words("zenith"), Words("polar"),
                                     Words("phi"),     Words("azi"),    Words("angle"),
                                     Words("angular"), Words("winkel"), Words("wavelength")};
/// Units that no role has.
constexpr std::array small_units{Words("ppm"),      Words("ppb"),      Words("‰"),
                                 Words("permille"), Words("promille"), Words("db")};
/// Words that change nothing.
constexpr std::array fillers{Words("in"),       Words("of"),          Words("the"),
                             Words("values"),   Words("abs"),         Words("absolute"),
                             Words("combined"), Words("measurement"), Words("total")};

/// Words and numbers of a name: "U (k=2.0) [%]" is U, k, 2.0 and %; a number keeps the % behind it.
std::vector<std::string> words_of(std::string_view name) {
  const auto is_digit = [](char c) { return '0' <= c && c <= '9'; };
  const auto is_letter = [](char c) { return ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z'); };
  std::vector<std::string> words;
  for (std::size_t k = 0; k < name.size();) {
    const auto from = name.substr(k);
    std::size_t size = 0;
    while (size < from.size() && is_letter(from[size])) ++size;
    if (size == 0 && is_digit(from[0])) {
      size = std::min(from.find_first_not_of("0123456789.,"), from.size());
      while (!is_digit(from[size - 1])) --size;
      words.emplace_back(from.substr(0, size));
      if (const auto next = from.find_first_not_of(' ', size);
          next != from.npos && from[next] == '%')
        words.back() += '%', size = next + 1;
    } else if (size > 0) {
      words.emplace_back(from.substr(0, size));
    } else {
      size = 1;
      for (const auto& [letter, word] :
           {std::pair<Words, Words>("σ", "sigma"), {"‰", "‰"}, {"%", "%"}})
        if (from.starts_with(letter)) words.emplace_back(word), size = letter.size();
    }
    k += size;
  }
  return words;
}

}  // namespace

std::string plain_name(std::string_view name) {
  std::string s;
  for (std::size_t k = 0; k < name.size(); ++k) {
    const char c = name[k];
    for (const auto& [letter, word] : {std::pair("θ", "theta"), {"φ", "phi"}, {"ϕ", "phi"}})
      if (name.substr(k).starts_with(letter)) s += word;
    if ('A' <= c && c <= 'Z')
      s += static_cast<char>(c - 'A' + 'a');
    else if (('a' <= c && c <= 'z') || ('0' <= c && c <= '9'))
      s += c;
  }
  return s;
}

bool is_angle_unit(std::string_view plain) {
  return is_any(plain, units);
}

Said said_by(const std::string& name) {
  std::string rest = name;
  for (const auto unit : units)
    if (unit.starts_with("deg") || unit.starts_with("rad")) take(rest, unit);
  if (is_any(rest, incidence)) return {theta_i, false, false, false};
  if (is_any(rest, reflection)) return {theta_o, false, false, false};
  for (const auto unit : units) take(rest, unit);
  const bool zenith = take_any(rest, zeniths), azimuth = !zenith && take_any(rest, azimuths);
  if (!zenith && !azimuth) {  // "in" and "out" are enough, "i" and "r" are not
    if (rest.size() > 1 && is_any(rest, light)) return {theta_i, true, false, false};
    if (rest.size() > 1 && is_any(rest, viewer)) return {theta_o, true, false, false};
    return {{}, false, rest.empty() && !name.empty(), false};
  }
  for (const auto& [words, of] : {std::pair(std::span<const Words>(light), theta_i),
                                  {std::span<const Words>(viewer), theta_o},
                                  {std::span<const Words>(halves), theta_h},
                                  {std::span<const Words>(differences), theta_d}})
    if (is_any(rest, words))
      return {static_cast<Angle>(of + (azimuth ? 1 : 0)), false, false, false};
  return {{}, false, zenith && rest.empty(), azimuth};
}

std::optional<std::string> uncertainty_kind(std::string_view name) {
  std::string rest;
  bool expanded = false, percent = false, known = true, looks = false;
  std::optional<double> factor;
  const auto words = words_of(name);
  for (std::size_t k = 0; k < words.size(); ++k) {
    const std::string word = plain_name(words[k]), before = k > 0 ? plain_name(words[k - 1]) : "",
                      next = k + 1 < words.size() ? plain_name(words[k + 1]) : "";
    if (decimal_digits.find(words[k][0]) != decimal_digits.npos) {
      if (before == "sr" || next == "sr") continue;
      if (before == "k" || is_any(next, spreads))
        factor = number_in(words[k]).value_or(0);
      else if (word == "95")  // percent of all cases
        expanded = true;
      else
        known = false;
    } else if (words[k] == "%") {
      percent = true;
    } else if (is_any(words[k], small_units) || is_any(word, small_units)) {
      known = false;
    } else if (!is_any(word, fillers) &&
               !(word == "k" && decimal_digits.find(next[0]) != decimal_digits.npos)) {
      expanded = expanded || words[k] == "U";
      looks = looks || (is_any(word, words_of_doubt) && (rest.empty() || word.size() > 2));
      rest += word;
    }
  }
  expanded = take_any(rest, words_of_expansion) || expanded;
  percent = take_any(rest, words_of_percent) || percent;
  const bool relative = take_any(rest, words_of_relation);
  for (const std::string_view word : {"standard", "bsdf", "brdf", "value", "persr", "sr"})
    take(rest, word);
  if (!is_any(rest, words_of_doubt)) {
    const bool of_angle = std::ranges::any_of(
        words_of_angles, [&](auto word) { return rest.find(word) != rest.npos; });
    return looks && !of_angle ? std::optional(std::string()) : std::nullopt;
  }
  if (!known || (factor && *factor != 1 && *factor != 2)) return "";
  return std::string(factor.value_or(expanded ? 2 : 1) == 2 ? "U_" : "u_") + (percent    ? "percent"
                                                                              : relative ? "rel"
                                                                                         : "f");
}

std::optional<double> factor_scale(std::string_view name) {
  std::string rest;
  bool percent = false;
  for (const auto& word : words_of(name)) {
    percent = percent || word == "%";
    rest += plain_name(word);
  }
  percent = take_any(rest, words_of_percent) || percent;
  if (!is_any(rest, factors) && !(percent && rest == "r")) return {};
  return std::numbers::inv_pi / (percent ? 100 : 1);
}

std::optional<WavelengthName> wavelength_name(std::string_view name) {
  for (auto from = name.find_first_of(decimal_digits); from != name.npos;) {
    const auto end = name.find_first_not_of("0123456789.", from);
    if (end == name.npos) return {};
    const auto unit = name.substr(end), before = name.substr(0, from);
    for (const std::string_view nm : {"nm", " nm"})
      if (unit.starts_with(nm))
        return WavelengthName{fmt::format("{}*{}", before, unit),
                              fmt::format("{} {}", before, unit.substr(nm.size()))};
    from = name.find_first_of(decimal_digits, end);
  }
  return {};
}

namespace {

void keep_first(std::optional<std::size_t>& slot, std::size_t column) {
  if (!slot) slot = column;
}

}  // namespace

Found by_name(std::span<const ColumnSummary> columns) {
  Found found;
  std::array<std::optional<std::size_t>, angle_roles.size()> beside;  // where no name says more
  std::size_t best = values.size();
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const std::string name = plain_name(columns[k].name);
    std::string bare = name;
    take_any(bare, per_solid_angle);
    if (const auto v = std::ranges::find(values, bare); v < values.begin() + best) {
      best = static_cast<std::size_t>(v - values.begin());
      found.value = k;
    } else if (is_any(name, wavelengths)) {
      keep_first(found.channel, k);
    } else if (const auto kind = wavelength_name(columns[k].name)
                                     ? std::nullopt
                                     : uncertainty_kind(columns[k].name);
               kind && !kind->empty()) {
      keep_first(found.uncertainty, k);
    } else if (const Said said = said_by(name); said.angle) {
      keep_first((said.beside ? beside : found.angle)[*said.angle], k);
    } else if (said.azimuth) {
      keep_first(found.azimuth_of_neither, k);
    } else if (said.zenith) {
      keep_first(found.zenith_of_neither, k);
    } else if (kind && !is_role(columns[k].name)) {
      found.unclear.push_back(columns[k].name);
    }
  }
  for (const auto a : {theta_i, theta_o})
    if (beside[a]) keep_first(found.angle[a], *beside[a]);
  // A whole set of half and difference angles stands for all others.
  if (found.angle[theta_h] && found.angle[theta_d]) {
    for (const auto a : {theta_i, phi_i, theta_o, phi_o}) found.angle[a].reset();
    return found;
  }
  for (const auto a : {theta_h, phi_h, theta_d, phi_d}) found.angle[a].reset();
  if (const auto k = found.zenith_of_neither) keep_first(found.angle[theta_o], *k);
  // The one azimuth of a file is that between the two directions; beside the viewer's it is the
  // light's.
  if (const auto k = found.azimuth_of_neither)
    keep_first(found.angle[found.angle[phi_o] ? phi_i : phi_o], *k);
  return found;
}

}  // namespace gonio::column_names
