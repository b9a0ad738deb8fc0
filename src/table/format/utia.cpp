#include "table/format/utia.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "base/error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gonio {
namespace {

constexpr std::size_t kThetas = 6, kPhis = 48, kRow = kThetas * kPhis, kUtiaChannels = 3;
constexpr std::size_t kDirections = 1 + (kThetas - 1) * kPhis;  ///< the pole is one
constexpr double kThetaStep = 15, kPhiStep = 7.5;               ///< [degrees]

/// Number of the direction that a file's row, or column, is of.
constexpr std::size_t direction_of(std::size_t row) {
  return row < kPhis ? 0 : row - kPhis + 1;
}

/// The two angles of a direction that lie around it, and the part of the second.
struct Place {
  std::array<std::size_t, 2> theta, phi;
  double theta_part, phi_part;

  std::size_t direction(unsigned bits) const {
    return direction_of(kPhis * theta[bits & 1U] + phi[bits >> 1U & 1U]);
  }
  double weight(unsigned bits) const {
    return (bits & 1U ? theta_part : 1 - theta_part) * (bits & 2U ? phi_part : 1 - phi_part);
  }
};

/// Nothing below the last ring.
std::optional<Place> place(const Direction& d, std::size_t step) {
  const double theta = theta_of(d) / degree / kThetaStep;
  if (!(theta <= kThetas - 1 + 1e-9)) return {};
  const auto t = std::min(static_cast<std::size_t>(theta), kThetas - 2) / step * step;
  const std::size_t above = std::min(t + step, kThetas - 1);
  const double turns = phi_of(d) / degree / 360, phi = (turns - std::floor(turns)) * kPhis;
  const std::size_t before = std::min(static_cast<std::size_t>(phi), kPhis - 1),
                    p = before / step * step;
  return Place{{t, above},
               {p, (p + step) % kPhis},
               std::min((theta - static_cast<double>(t)) / static_cast<double>(above - t), 1.0),
               std::min((phi - static_cast<double>(p)) / static_cast<double>(step), 1.0)};
}

double between(const std::vector<Values>& values,
               const DirectionPair& p,
               std::size_t channel,
               std::size_t step) {
  const auto in = place(p.wi, step), out = place(p.wo, step);
  double sum = 0, weight = 0;
  for (unsigned bits = 0; in && out && bits < 16; ++bits) {
    const double w = in->weight(bits & 3U) * out->weight(bits >> 2U);
    const double v =
        values[channel][kDirections * in->direction(bits & 3U) + out->direction(bits >> 2U)];
    if (w == 0 || !(std::isfinite(v) && v >= 0)) continue;
    sum += w * v;
    weight += w;
  }
  return weight > 0.5 ? sum / weight : std::numeric_limits<double>::quiet_NaN();
}

/// f_r of a number in sRGB's transfer function.  \param bend  where its line ends
double linear(double v, double bend) {
  return v > bend ? std::pow((v + 0.055) / 1.055, 2.4) : v / 12.92;
}

}  // namespace

DirectionList utia_directions() {
  std::vector<std::array<double, 2>> directions{{0, 0}};
  for (std::size_t t = 1; t < kThetas; ++t)
    for (std::size_t p = 0; p < kPhis; ++p)
      directions.push_back(
          {kThetaStep * static_cast<double>(t), kPhiStep * static_cast<double>(p)});
  DirectionList l;
  for (const auto& [theta_i, phi_i] : directions)
    for (const auto& [theta_o, phi_o] : directions) {
      l.theta_i_deg.push_back(theta_i);
      l.phi_i_deg.push_back(phi_i);
      l.theta_o_deg.push_back(theta_o);
      l.phi_o_deg.push_back(phi_o);
    }
  return l;
}

bool has_utia_directions(const Table& t) {
  const auto* const l = t.list();
  if (!l || t.size() != kDirections * kDirections) return false;
  const DirectionList expected = utia_directions();
  const auto same = [](const std::vector<double>& a, const std::vector<double>& b) {
    return std::ranges::equal(a, b, [](double x, double y) { return std::abs(x - y) <= 1e-9; });
  };
  return same(l->theta_i_deg, expected.theta_i_deg) && same(l->phi_i_deg, expected.phi_i_deg) &&
         same(l->theta_o_deg, expected.theta_o_deg) && same(l->phi_o_deg, expected.phi_o_deg);
}

bool is_utia(std::uint64_t size) {
  return size == kUtiaChannels * kRow * kRow * sizeof(double);
}

Table read_utia(InputFile& in) {
  if (!is_utia(in.size()))
    throw bad_input(in.path(), "size", fmt::format("{} bytes", in.size()),
                    fmt::format("{} bytes", kUtiaChannels * kRow * kRow * sizeof(double)));
  Table t;
  t.format = "utia";
  t.channels = {"r", "g", "b"};
  t.where = utia_directions();
  std::vector<double> plane(kRow * kRow);
  for (std::size_t c = 0; c < kUtiaChannels; ++c) {
    in.read(plane.data(), plane.size() * sizeof(double));
    // Of values that are all the same the mean is that value, to the last digit.
    Values first(kDirections * kDirections);
    std::vector<double> more(first.size());
    std::vector<std::size_t> count(first.size());
    for (std::size_t k = 0; k < plane.size(); ++k) {
      const std::size_t i = kDirections * direction_of(k / kRow) + direction_of(k % kRow);
      if (count[i]++ == 0)
        first[i] = plane[k];
      else
        more[i] += plane[k] - first[i];
    }
    for (std::size_t i = 0; i < first.size(); ++i)
      if (count[i] > 1) first[i] += more[i] / static_cast<double>(count[i]);
    t.values.push_back(std::move(first));
  }
  t.warnings.push_back(
      fmt::format("a file of UTIA does not say what its numbers are: they were taken as f_r in "
                  "1/sr; if they are not, \"values\" in its side file "
                  "says so: {}",
                  fmt::join(names_of<UtiaValues>, ", ")));
  interpolate_utia(t);
  return t;
}

void interpret_utia(Table& t, UtiaValues meaning) {
  t.warnings.clear();
  if (meaning == UtiaValues::xyz) t.channels = {"x", "y", "z"};
  for (auto& plane : t.values)
    for (double& v : plane) {
      if (meaning == UtiaValues::srgb) v = linear(v, 0.04045);
      if (meaning == UtiaValues::dj_brdf) v = 100 * linear(v / 140, 0.0375);
    }
  interpolate_utia(t);
}

void interpolate_utia(Table& t, std::size_t step) {
  t.between = [values = std::make_shared<const std::vector<Values>>(t.values), step](
                  const DirectionPair& p, std::size_t channel) {
    return between(*values, p, channel, step);
  };
}

void write_utia(const Table& t, OutputFile& out, const std::string& path) {
  if (!has_utia_directions(t) || (t.values.size() != 1 && t.values.size() != kUtiaChannels))
    throw bad_input(path, "writing", "a table of another shape",
                    "one or three channels on UTIA's 241 × 241 directions");
  std::vector<double> row(kRow);
  for (std::size_t c = 0; c < kUtiaChannels; ++c) {
    const auto& values = t.values[t.values.size() == 1 ? 0 : c];
    for (std::size_t in = 0; in < kRow; ++in) {
      for (std::size_t k = 0; k < kRow; ++k)
        row[k] = values[kDirections * direction_of(in) + direction_of(k)];
      out.write({reinterpret_cast<const char*>(row.data()), row.size() * sizeof(double)});
    }
  }
}

}  // namespace gonio
