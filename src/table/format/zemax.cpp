#include "table/format/zemax.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <set>

#include "base/blanks.h"
#include "base/error.h"
#include "base/letters.h"
#include "base/numbers.h"
#include "base/text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gonio {
namespace {

constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();
constexpr std::string_view kZerosAreGaps = "# gonio: 0 above the horizon is no data";

struct ZemaxWord {
  std::string_view key;
  std::array<std::string_view, 3> choices;
};
constexpr std::array kWords{
    ZemaxWord{"Source", {"Measured", "Generated"}},
    ZemaxWord{"Symmetry", {"PlaneSymmetrical", "ASymmetrical", "ASymmetrical4D"}},
    ZemaxWord{"SpectralContent", {"Monochrome", "XYZ"}},
    ZemaxWord{"ScatterType", {"BRDF", "BTDF"}}};

struct ZemaxAxis {
  std::string_view key;
  std::vector<double> ZemaxAxes::*values;
  double least, most;
};
const std::array kAxes{ZemaxAxis{"SampleRotation", &ZemaxAxes::rotation, -360, 360},
                       ZemaxAxis{"AngleOfIncidence", &ZemaxAxes::incident, 0, 89.9},
                       ZemaxAxis{"ScatterAzimuth", &ZemaxAxes::azimuth, -360, 360},
                       ZemaxAxis{"ScatterRadial", &ZemaxAxes::radius, 0, 180}};

constexpr std::array<std::string_view, 3> kTristimulus{"TristimulusX", "TristimulusY",
                                                       "TristimulusZ"};

/// Values of one channel on the axes.
struct ZemaxFunction {
  ZemaxAxes axes;
  bool mirrored = false;       ///< azimuths are those of one half
  std::vector<double> values;  ///< [rotation][incident][azimuth][radius]; NaN where there is none

  double value(std::size_t r, std::size_t i, std::size_t a, std::size_t s) const {
    return values[((r * axes.incident.size() + i) * axes.azimuth.size() + a) * axes.radius.size() +
                  s];
  }
  bool turns_round() const {
    const auto& a = axes.azimuth;
    return !mirrored && a.size() > 2 &&
           360 + a.front() - a.back() <= 1.5 * (a.back() - a.front()) / double(a.size() - 1);
  }

  struct Between {
    std::size_t low, high;
    double share;  ///< of high
  };
  static std::optional<Between> between(const std::vector<double>& axis, double x, bool round) {
    constexpr double rounding = 1e-9;
    if (axis.size() == 1) return Between{0, 0, 0};
    if (round) {
      x = axis.front() + std::fmod(std::fmod(x - axis.front(), 360) + 360, 360);
      if (x > axis.back())
        return Between{axis.size() - 1, 0, (x - axis.back()) / (360 + axis.front() - axis.back())};
    }
    if (!(x >= axis.front() - rounding && x <= axis.back() + rounding)) return {};
    const auto above = std::clamp<std::ptrdiff_t>(std::ranges::upper_bound(axis, x) - axis.begin(),
                                                  1, std::ssize(axis) - 1);
    const auto high = static_cast<std::size_t>(above);
    return Between{high - 1, high,
                   std::clamp((x - axis[high - 1]) / (axis[high] - axis[high - 1]), 0.0, 1.0)};
  }
  /// Mean of the values around that are there, if they carry more than `least` of the weight.
  double mean(
      std::size_t r, std::size_t i, const Between& a, const Between& s, double least) const {
    double sum = 0, weight = 0;
    for (const auto& [at_a, wa] : {std::pair{a.low, 1 - a.share}, std::pair{a.high, a.share}})
      for (const auto& [at_s, ws] : {std::pair{s.low, 1 - s.share}, std::pair{s.high, s.share}}) {
        const double v = value(r, i, at_a, at_s);
        if (wa * ws > 0 && std::isfinite(v)) sum += wa * ws * v, weight += wa * ws;
      }
    return weight > least ? sum / weight : kNoValue;
  }

  double operator()(const DirectionPair& p) const {
    const double theta = theta_of(p.wi), phi = phi_of(p.wi);
    const double c = std::cos(phi), s = std::sin(phi);
    const Direction wo{c * p.wo.x + s * p.wo.y, c * p.wo.y - s * p.wo.x, p.wo.z};
    const double along = wo.x * std::cos(theta) + wo.z * std::sin(theta);
    const Direction mirror{-std::sin(theta), 0, std::cos(theta)};
    const double radius = std::atan2(std::hypot(along, wo.y), dot(mirror, wo)) / degree;
    const double turned = std::atan2(wo.y, along) / degree;
    const auto a = between(axes.azimuth, mirrored ? std::abs(turned) : turned, turns_round());
    const auto at_s = between(axes.radius, radius, false);
    const auto i = axes.incident.size() == 1 && std::abs(axes.incident[0] - theta / degree) > 1e-6
                       ? std::nullopt
                       : between(axes.incident, theta / degree, false);
    const auto r = between(axes.rotation, -phi / degree, axes.rotation.size() > 2);
    if (!a || !at_s || !i || !r) return kNoValue;
    double sum = 0, weight = 0;
    for (const auto& [at_r, wr] : {std::pair{r->low, 1 - r->share}, std::pair{r->high, r->share}})
      for (const auto& [at_i, wi] :
           {std::pair{i->low, 1 - i->share}, std::pair{i->high, i->share}}) {
        if (wr * wi == 0) continue;
        const double v = mean(at_r, at_i, *a, *at_s, 0.5);
        if (std::isfinite(v)) sum += wr * wi * v, weight += wr * wi;
      }
    return weight > 0.5 ? sum / weight : kNoValue;
  }

  /// ∫ f cos θ_o dω_o of what lies between the values: Gauss' two points along each side of a cell.
  double integral(std::size_t rotation, std::size_t incident) const {
    static const std::array<double, 2> gauss{0.5 - std::sqrt(1.0 / 12), 0.5 + std::sqrt(1.0 / 12)};
    const auto& azimuth = axes.azimuth;
    const auto& radius = axes.radius;
    const double theta = axes.incident[incident] * degree;
    double sum = 0;
    for (std::size_t a = 0; a + (turns_round() ? 0 : 1) < azimuth.size(); ++a) {
      const std::size_t next = (a + 1) % azimuth.size();
      const double width = (next ? azimuth[next] : azimuth[0] + 360) - azimuth[a];
      for (std::size_t s = 0; s + 1 < radius.size(); ++s)
        for (const double u : gauss)
          for (const double v : gauss) {
            const double at = (azimuth[a] + u * width) * degree,
                         r = (radius[s] + v * (radius[s + 1] - radius[s])) * degree;
            const double cosine =
                std::cos(r) * std::cos(theta) + std::sin(r) * std::cos(at) * std::sin(theta);
            const double f = mean(rotation, incident, {a, next, u}, {s, s + 1, v}, 0);
            if (cosine > 0 && std::isfinite(f))
              sum += f * cosine * std::sin(r) * width * (radius[s + 1] - radius[s]) / 4;
          }
    }
    return sum * degree * degree * (mirrored ? 2 : 1);
  }
};

/// A value of a file that lies above the horizon.
struct ZemaxPlace {
  std::size_t at;  ///< in the file
  double theta_i_deg, phi_i_deg;
  Direction wo;  ///< for light from azimuth 0
  bool repeats;  ///< another value's direction
};
std::vector<ZemaxPlace> places_above_the_horizon(const ZemaxAxes& axes) {
  std::vector<ZemaxPlace> all;
  std::size_t at = 0;
  for (const double turn : axes.rotation)
    for (const double theta : axes.incident)
      for (std::size_t a = 0; a < axes.azimuth.size(); ++a)
        for (const double radius : axes.radius) {
          const auto wo = zemax_direction(theta, axes.azimuth[a], radius);
          const bool repeats = a > 0 && (radius == 0 || axes.azimuth[a] == axes.azimuth[0] + 360);
          if (wo.z > horizon_cosine) all.push_back({at, theta, turn == 0 ? 0 : -turn, wo, repeats});
          ++at;
        }
  return all;
}
DirectionList directions_of(const std::vector<ZemaxPlace>& places) {
  DirectionList l;
  for (const auto& p : places) {
    if (p.repeats) continue;
    l.theta_i_deg.push_back(p.theta_i_deg);
    l.phi_i_deg.push_back(p.phi_i_deg);
    l.theta_o_deg.push_back(theta_of(p.wo) / degree);
    const double phi_o = p.phi_i_deg + phi_of(p.wo) / degree;
    l.phi_o_deg.push_back(phi_o < 0 ? phi_o + 360 : phi_o);
  }
  return l;
}

class ZemaxReader {
 public:
  explicit ZemaxReader(InputFile& in)
      : path_(in.path()), text_(in.read_rest(std::uint64_t{1} << 30)), rest_(without_mark(text_)) {}

  Table table() {
    header();
    const ZemaxAxes& axes = f_.axes;
    const std::size_t blocks = axes.rotation.size() * axes.incident.size(),
                      in_block = axes.azimuth.size() * axes.radius.size();
    Table t;
    t.format = "zemax";
    t.channels = xyz_ ? std::vector<std::string>{"X", "Y", "Z"} : std::vector<std::string>{"f"};
    t.notes = notes_;
    if (xyz_) t.notes.emplace_back("channels", "CIE tristimulus values X, Y, Z: no r, g, b");
    const auto places = places_above_the_horizon(axes);
    t.where = directions_of(places);
    std::vector<double> told;
    double largest = 0;
    std::string worst;
    for (std::size_t c = 0; c < t.channels.size(); ++c) {
      if (c > 0) expect_word(next_said(std::string(kTristimulus[c])), kTristimulus[c]);
      expect_word(next_said("DataBegin"), "DataBegin");
      std::vector<double> read;
      for (std::size_t b = 0; b < blocks; ++b) {
        told.push_back(total());
        for (std::size_t k = 0; k < in_block; ++k) read.push_back(number("a value", -1e30, 1e30));
        expect_end_of_line();
      }
      expect_word(next_said("DataEnd"), "DataEnd");
      ZemaxFunction f = f_;
      f.values.assign(read.size(), kNoValue);
      Values plane;
      for (const auto& p : places) {
        if (!(zeros_are_gaps_ && read[p.at] == 0)) f.values[p.at] = read[p.at];
        if (!p.repeats) plane.push_back(f.values[p.at]);
      }
      t.values.push_back(std::move(plane));
      compare(f, told, t.channels[c], t.notes, largest, worst);
      told.clear();
      functions_.push_back(std::move(f));
    }
    while (next_line())
      if (const auto more = next_word(line_); !more.empty()) fail(more, "the end of the file");
    if (largest > 0.1) t.warnings.push_back(worst);
    t.between = [all = std::make_shared<std::vector<ZemaxFunction>>(std::move(functions_))](
                    const DirectionPair& p, std::size_t c) { return (*all)[c](p); };
    return t;
  }

 private:
  [[noreturn]] void fail(std::string_view found, const std::string& expected) const {
    throw bad_input(path_, fmt::format("line {}", line_number_),
                    fmt::format("'{}'", found.substr(0, 60)), expected);
  }
  /// The next line that says something, comments passed over.
  bool next_line() {
    while (!rest_.empty()) {
      ++line_number_;
      const auto end = std::min(rest_.find_first_of("\r\n"), rest_.size());
      line_ = trimmed(rest_.substr(0, end));
      const bool two = rest_.substr(end).starts_with("\r\n");
      rest_.remove_prefix(std::min(end + (two ? 2 : 1), rest_.size()));
      if (line_ == kZerosAreGaps) zeros_are_gaps_ = true;
      if (!line_.empty() && line_[0] != '#') return true;
    }
    line_ = {};
    return false;
  }
  std::string_view next_said(const std::string& expected) {
    if (!next_line()) fail("the end of the file", expected);
    return line_;
  }
  void expect_word(std::string_view line, std::string_view word) const {
    if (!same_letters(line, word)) fail(line, std::string(word));
  }
  double number(const std::string& what, double least, double most) {
    auto word = next_word(line_);
    if (word.empty()) {
      next_said(what);
      word = next_word(line_);
    }
    const auto v = number_from<double>(word);
    if (!v || !(*v >= least && *v <= most))
      fail(word, std::abs(most) < 1e30 ? fmt::format("{} in [{}, {}]", what, least, most) : what);
    return *v;
  }
  void expect_end_of_line() {
    if (const auto more = next_word(line_); !more.empty()) fail(more, "the end of the line");
  }
  /// TIS of the next block.
  double total() {
    next_said("TIS and a number");
    const auto key = next_word(line_);
    if (!same_letters(key, "TIS")) fail(key, "TIS and a number");
    const double v = number("an integral", 0, 1e30);
    expect_end_of_line();
    return v;
  }

  void header() {
    std::set<std::string_view> seen;
    for (;;) {
      next_said("a header");
      const auto line = line_;
      const auto key = next_word(line_);
      const auto is = [&](const auto& known) { return same_letters(key, known.key); };
      const auto once = [&](std::string_view known) {
        if (!seen.insert(known).second) fail(key, "each keyword once");
      };
      if (const auto word = std::ranges::find_if(kWords, is); word != kWords.end()) {
        const auto said = trimmed(line_);
        const auto chosen = std::ranges::find_if(
            word->choices, [&](auto c) { return !c.empty() && same_letters(said, c); });
        if (chosen == word->choices.end())
          fail(said, fmt::format("{} {} or {}", word->key, word->choices[0], word->choices[1]));
        if (*chosen == "BTDF") fail(said, "BRDF: gonio fits reflection");
        xyz_ |= *chosen == "XYZ";
        f_.mirrored |= *chosen == "PlaneSymmetrical";
        once(word->key);
        notes_.emplace_back(word->key, *chosen);
      } else if (const auto axis = std::ranges::find_if(kAxes, is); axis != kAxes.end()) {
        once(axis->key);
        read_axis(*axis);
      } else {
        const std::string_view first = xyz_ ? kTristimulus[0] : "Monochrome";
        if (!same_letters(line, first))
          fail(line, fmt::format("a keyword of the header, or {}", first));
        break;
      }
    }
    const auto expect = [&](std::string_view key) {
      if (!seen.contains(key)) fail("no " + std::string(key), "one in the header");
    };
    for (const auto& w : kWords) expect(w.key);
    for (const auto& a : kAxes) expect(a.key);
    const auto& x = f_.axes;
    const double numbers = double(x.rotation.size()) * double(x.incident.size()) *
                           double(x.azimuth.size()) * double(x.radius.size());
    if (numbers * (xyz_ ? 7 : 5) > static_cast<double>(most_values))
      fail(fmt::format("{:g} values", numbers),
           fmt::format("at most {} numbers, directions included", most_values));
    // A digit and a blank each: counts that lie would take memory for directions before a value is
    // missed.
    if (numbers * (xyz_ ? 3 : 1) > static_cast<double>(rest_.size() / 2 + 1))
      fail(fmt::format("{:g} values", numbers * (xyz_ ? 3 : 1)),
           fmt::format("as many as {} bytes can hold", rest_.size()));
    if (f_.mirrored && (x.azimuth.front() < 0 || x.azimuth.back() > 180))
      fail(fmt::format("ScatterAzimuth to {:g}", x.azimuth.back()),
           "0 to 180, as it is PlaneSymmetrical");
  }
  void read_axis(const ZemaxAxis& axis) {
    const auto word = next_word(line_);
    const auto count = number_from<std::size_t>(word);
    if (!count || *count < 1 || *count > 100'000)
      fail(word, fmt::format("a number of angles after {}", axis.key));
    expect_end_of_line();
    auto& values = f_.axes.*axis.values;
    values.clear();
    while (values.size() < *count) {
      values.push_back(
          number(fmt::format("{} angles of {}", *count, axis.key), axis.least, axis.most));
      if (values.size() > 1 && !(values.back() > values[values.size() - 2]))
        fail(fmt::format("{:g} after {:g}", values.back(), values[values.size() - 2]),
             fmt::format("{} in ascending order", axis.key));
    }
    expect_end_of_line();
  }

  /// The file's own integrals beside those of its values.
  static void compare(const ZemaxFunction& f,
                      const std::vector<double>& told,
                      const std::string& channel,
                      std::vector<std::pair<std::string, std::string>>& notes,
                      double& largest,
                      std::string& worst) {
    constexpr std::size_t most_shown = 20;
    const auto& incident = f.axes.incident;
    std::vector<std::string> all;
    for (std::size_t k = 0; k < told.size(); ++k) {
      const double own = f.integral(k / incident.size(), k % incident.size());
      const double off = std::abs(told[k] - own) / std::max(told[k], own);
      const double theta = incident[k % incident.size()];
      if (all.size() < most_shown)
        all.push_back(fmt::format("{:g}°: {:.4g} ({:.4g})", theta, told[k], own));
      if (!(off > largest)) continue;
      largest = off;
      worst = fmt::format(
          "theta_i {:g}°: the file says that {:.4g} of the light leaves (TIS), its values "
          "integrate to "
          "{:.4g}; a scale, or values that are missing, would explain it",
          theta, told[k], own);
    }
    if (told.size() > most_shown) all.push_back("…");
    notes.emplace_back(
        channel == "f" ? "TIS" : "TIS of " + channel,
        fmt::format("{}; in brackets the integral of the values", fmt::join(all, ", ")));
  }

  std::string path_, text_;
  std::string_view rest_, line_;
  std::size_t line_number_ = 0;
  bool xyz_ = false, zeros_are_gaps_ = false;
  ZemaxFunction f_;  ///< axes alone
  std::vector<ZemaxFunction> functions_;
  std::vector<std::pair<std::string, std::string>> notes_;
};

}  // namespace

bool is_zemax(std::string_view head) {
  head = without_mark(head);
  while (!head.empty()) {
    const auto end = std::min(head.find_first_of("\r\n"), head.size());
    auto line = trimmed(head.substr(0, end));
    head.remove_prefix(std::min(end + 1, head.size()));
    if (line.empty() || line[0] == '#') continue;
    const auto key = next_word(line);
    const auto said = trimmed(line);
    return std::ranges::any_of(kWords, [&](const ZemaxWord& w) {
      return same_letters(key, w.key) && std::ranges::any_of(w.choices, [&](auto c) {
               return !c.empty() && same_letters(said, c);
             });
    });
  }
  return false;
}

Direction zemax_direction(double incident_deg, double azimuth_deg, double radius_deg) {
  const double theta = incident_deg * degree, a = azimuth_deg * degree, r = radius_deg * degree;
  const double along = std::sin(r) * std::cos(a);  // towards the normal
  return {along * std::cos(theta) - std::cos(r) * std::sin(theta), std::sin(r) * std::sin(a),
          std::cos(r) * std::cos(theta) + along * std::sin(theta)};
}

DirectionList zemax_directions(const ZemaxAxes& axes) {
  return directions_of(places_above_the_horizon(axes));
}

Table read_zemax(InputFile& in) {
  return ZemaxReader(in).table();
}

ZemaxAxes zemax_axes(const Table& t) {
  ZemaxAxes axes;
  if (const auto* l = t.list()) {
    std::set<double> incident;
    for (const double theta : l->theta_i_deg) {
      const double rounded = std::round(theta * 1e6) / 1e6;
      if (rounded <= 89) incident.insert(rounded);
      if (incident.size() > 64) break;
    }
    if (incident.size() <= 64) axes.incident.assign(incident.begin(), incident.end());
  }
  if (axes.incident.empty()) axes.incident = {0, 10, 20, 30, 40, 50, 60, 70, 80};
  for (int a = 0; a <= 180; a += 10) axes.azimuth.push_back(a);
  axes.radius = {0, 0.1, 0.2, 0.3, 0.5, 0.7, 1, 1.5, 2, 3, 4, 5, 6, 8, 10, 12, 15, 18, 21, 25};
  for (int r = 30; r <= 170; r += r < 60 ? 5 : 10) axes.radius.push_back(r);
  return axes;
}

/// The values of such a table on the axes, channel by channel.
static std::vector<ZemaxFunction> zemax_functions(const Table& t) {
  const ZemaxAxes axes = zemax_axes(t);
  const auto places = places_above_the_horizon(axes);
  std::vector<ZemaxFunction> all;
  for (const auto& plane : t.values) {
    ZemaxFunction f{axes, true,
                    std::vector<double>(
                        axes.incident.size() * axes.azimuth.size() * axes.radius.size(), kNoValue)};
    std::size_t sample = 0;
    // What repeats is the mirror direction, which stands in each row, first.
    for (const auto& p : places)
      f.values[p.at] = p.repeats ? f.values[p.at - axes.radius.size()] : plane[sample++];
    all.push_back(std::move(f));
  }
  return all;
}

void interpolate_zemax(Table& t) {
  t.between = [all = std::make_shared<std::vector<ZemaxFunction>>(zemax_functions(t))](
                  const DirectionPair& p, std::size_t c) { return (*all)[c](p); };
}

void write_zemax(const Table& t, OutputFile& out, const std::string&) {
  const ZemaxAxes axes = zemax_axes(t);
  if (t.size() != zemax_directions(axes).theta_i_deg.size())
    throw wrong_usage("a table of other directions than those of a Zemax file: convert it");
  const bool one = t.channels.size() == 1,
             gaps = std::ranges::any_of(t.values, [](const Values&plane) {
               return !std::ranges::all_of(plane, [](double v) { return std::isfinite(v); });
             });
  std::string text = "# written by gonio\n";
  if (gaps) text += std::string(kZerosAreGaps) + "\n";
  text += fmt::format(
      "Source\t{}\nSymmetry\tPlaneSymmetrical\nSpectralContent\t{}\nScatterType\tBRDF\n",
      t.truth ? "Generated" : "Measured", one ? "Monochrome" : "XYZ");
  for (const auto& axis : kAxes)
    text += fmt::format("{}\t{}\n{:.9g}\n", axis.key, (axes.*axis.values).size(),
                        fmt::join(axes.*axis.values, "\t"));
  const auto functions = zemax_functions(t);
  for (std::size_t c = 0; c < functions.size(); ++c) {
    text += fmt::format("\n{}\nDataBegin\n", one ? "Monochrome" : kTristimulus[c]);
    const auto& values = functions[c].values;
    const std::size_t in_row = axes.radius.size(), in_block = axes.azimuth.size() * in_row;
    for (std::size_t k = 0; k < values.size(); ++k) {
      if (k % in_block == 0)
        text += fmt::format("TIS {:.6g}\n", functions[c].integral(0, k / in_block));
      text += fmt::format("{:.9g}{}", std::isfinite(values[k]) ? values[k] : 0,
                          (k + 1) % in_row ? '\t' : '\n');
    }
    text += "DataEnd\n";
  }
  out.write(text);
}

}  // namespace gonio
