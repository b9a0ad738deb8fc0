#include "table/cut/cuts.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "brdf/model/evaluate.h"
#include "integrate/aperture/mean_values.h"

namespace gonio {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr double near_deg = 1.5;  // what still counts as in the plane, or at an angle
constexpr std::size_t most_cuts = 6;
constexpr std::array wanted_deg{10.0, 30.0, 45.0, 60.0, 75.0};

/// A place on a cut, and its data per channel where there are some.
struct Point {
  double deg;
  std::vector<double> data;
  std::vector<double> uncertainty{}, left_out{};  ///< per channel, or empty
};

/// theta_o positive on the mirror side, as its direction for a wi at azimuth 0.
DirectionPair in_plane(double theta_i_deg, double theta_o_deg) {
  return {direction(theta_i_deg * degree, 0),
          direction(std::abs(theta_o_deg) * degree, theta_o_deg > 0 ? std::numbers::pi : 0)};
}

DirectionPair place(const Cut& cut, double phi_d, double deg) {
  if (cut.at == "theta_i") return in_plane(cut.at_deg, deg);
  return directions(HalfDifference{deg * degree, 0, cut.at_deg * degree, phi_d});
}

/// Fills in the data where they are and, if there is one, the model there and over steps of half a
/// degree, finer around `peak`.  False if no data are valid.
bool finish(Cut& cut,
            std::vector<Point> points,
            double peak_deg,
            double from_deg,
            double phi_d,
            const Aperture& aperture,
            const BoundModel* fitted) {
  std::size_t channels = 0;
  for (const Point& p : points) channels = std::max(channels, p.data.size());
  const bool any = std::ranges::any_of(points, [](const Point& p) {
    return std::ranges::any_of(p.data, [](double v) { return std::isfinite(v); });
  });
  if (!any) return false;
  const auto add = [&](double deg) {
    if (deg >= from_deg && deg < 90) points.push_back({deg, {}});
  };
  if (fitted) {
    for (double deg = from_deg; deg < 90; deg += 0.5) add(deg);
    add(peak_deg);
    for (double d = 0.01; d < 15; d *= 1.15) {
      add(peak_deg - d);
      add(peak_deg + d);
    }
  }
  std::ranges::stable_sort(points, {}, &Point::deg);

  std::vector<FrameAngles<double>> x;
  cut.data.assign(channels, {});
  for (const Point& p : points) {
    cut.deg.push_back(p.deg);
    x.push_back(frame_angles(place(cut, phi_d, p.deg)));
    for (std::size_t c = 0; c < channels; ++c)
      cut.data[c].push_back(p.data.empty() ? none : p.data[c]);
  }
  for (const auto& [of, to] : {std::pair(&Point::uncertainty, &cut.uncertainty),
                               std::pair(&Point::left_out, &cut.left_out)}) {
    if (std::ranges::all_of(points, [&](const Point& p) { return (p.*of).empty(); })) continue;
    to->resize(channels);
    for (const Point& p : points)
      for (std::size_t c = 0; c < channels; ++c)
        (*to)[c].push_back((p.*of).empty() ? none : (p.*of)[c]);
  }
  if (!fitted) return true;
  const auto at = [&](std::size_t i) { return place(cut, phi_d, points[i].deg); };
  cut.model = aperture ? mean_values(*fitted, x.size(), at, aperture) : evaluate(*fitted, x);
  for (auto& channel : cut.model)
    for (std::size_t i = 0; i < x.size(); ++i)
      if (!(x[i].nol > 0 && x[i].nov > 0)) channel[i] = none;
  return true;
}

/// True where a grid of one phi (or phi_d) says something about this pair.
bool at_its_azimuth(const Grid& g, const DirectionPair& p) {
  const Axis& axis = g.axes[2];
  if (axis.size > 1) return true;
  const double phi =
      g.kind == Grid::Kind::in_out ? phi_of(p.wo) - phi_of(p.wi) : half_difference(p).phi_d;
  const double period = g.kind == Grid::Kind::in_out ? 2 * std::numbers::pi : std::numbers::pi;
  const double span = axis.angle(0, g.bins);
  return std::min(std::abs(std::remainder(phi - span, period)),
                  std::abs(std::remainder(phi + span, period))) < near_deg * degree;
}

std::vector<double> nodes_deg(const Axis& axis, Bins bins) {
  std::vector<double> out;
  for (std::size_t i = 0; i < axis.size; ++i)
    out.push_back(axis.angle(static_cast<double>(i), bins) / degree);
  return out;
}

/// All nodes if they are few, else those next to the wanted angles.
std::vector<double> choose(const std::vector<double>& nodes) {
  if (nodes.size() <= most_cuts) return nodes;
  std::vector<double> out;
  for (const double w : wanted_deg) {
    const double next =
        *std::ranges::min_element(nodes, {}, [&](double a) { return std::abs(a - w); });
    if (out.empty() || next != out.back()) out.push_back(next);
  }
  return out;
}

std::vector<Cut> grid_cuts(const Table& table, const BoundModel* fitted) {
  const Grid& g = *table.grid();
  const Interpolator between(table);
  std::optional<Interpolator> left_out;
  if (table.left_out) left_out.emplace(*table.left_out);
  const auto nodes = [&](std::size_t axis) { return nodes_deg(g.axes[axis], g.bins); };
  const bool half = g.kind == Grid::Kind::half_difference;
  const double phi_d = half && g.axes[2].size == 1 ? g.axes[2].angle(0, g.bins) : 0;
  const bool slice = half && std::abs(std::sin(phi_d)) > std::sin(near_deg * degree);

  std::vector<double> at;
  if (slice)
    at = choose(nodes(1));
  else if (half)
    at.assign(wanted_deg.begin(), wanted_deg.end());
  else
    at = choose(nodes(0));

  std::vector<Cut> cuts;
  for (const double at_deg : at) {
    Cut cut{slice ? "theta_d" : "theta_i", at_deg, 0, slice ? "theta_h" : "theta_o", {}, {}, {}};
    std::vector<double> places;
    if (slice) {
      places = nodes(0);
    } else {
      for (const double a : nodes(half ? 0 : 1)) {  // in the plane theta_o = theta_i ± 2 theta_h
        places.push_back(half ? at_deg + 2 * a : a);
        if (a > 0) places.push_back(half ? at_deg - 2 * a : -a);
      }
    }
    std::vector<Point> points;
    for (const double deg : places) {
      if (!(std::abs(deg) < 90)) continue;
      const DirectionPair p = place(cut, phi_d, deg);
      Point point{deg, std::vector<double>(table.values.size(), none)};
      if (p.wi.z > 0 && p.wo.z > 0 && at_its_azimuth(g, p))
        for (std::size_t c = 0; c < point.data.size(); ++c) {
          point.data[c] = between(p, c);
          if (left_out)
            point.left_out.push_back(std::isnan(point.data[c]) ? (*left_out)(p, c) : none);
        }
      points.push_back(std::move(point));
    }
    if (finish(cut, std::move(points), slice ? 0 : at_deg, slice ? 0 : -89.5, phi_d, table.aperture,
               fitted))
      cuts.push_back(std::move(cut));
  }
  return cuts;
}

/// The incident angles of samples in the plane of incidence, and which samples those are.
struct InPlane {
  std::size_t sample;
  double theta_i_deg, theta_o_deg;
};

std::vector<InPlane> in_plane_samples(const Table& table) {
  const SampleAngles at(table);
  const DirectionList& list = *table.list();
  std::vector<InPlane> out;
  for (std::size_t i = 0; i < table.size(); ++i) {
    const DirectionPair p = at.directions(i);
    const double phi_i = list.phi_i_deg[i] * degree;
    const double along = p.wo.x * std::cos(phi_i) + p.wo.y * std::sin(phi_i);
    const double across = p.wo.y * std::cos(phi_i) - p.wo.x * std::sin(phi_i);
    if (std::abs(across) <= std::sin(near_deg * degree))
      out.push_back(
          {i, list.theta_i_deg[i], along > 0 ? -list.theta_o_deg[i] : list.theta_o_deg[i]});
  }
  return out;
}

/// Adds the samples at an incident angle.
void add_points(const Table& table,
                const std::vector<InPlane>& samples,
                double from_deg,
                double to_deg,
                bool left_out,
                std::vector<Point>& points) {
  const SampleAngles angles_of(table);
  for (const auto& s : samples) {
    if (s.theta_i_deg < from_deg || s.theta_i_deg > to_deg) continue;
    const auto a = angles_of(s.sample);
    Point point{s.theta_o_deg, {}};
    for (const auto& channel : table.values)
      (left_out ? point.left_out : point.data)
          .push_back(mask(a, channel[s.sample]) == Mask::valid ? channel[s.sample] : none);
    for (const auto& channel : table.errors)
      if (!left_out) point.uncertainty.push_back(channel[s.sample]);
    points.push_back(std::move(point));
  }
}

std::vector<Cut> list_cuts(const Table& table, const BoundModel* fitted) {
  const auto samples_of = [&](const Table& t) {
    auto all = in_plane_samples(t);
    if (fitted && fitted->model.anisotropic)
      std::erase_if(all, [&](const InPlane& s) {
        return std::abs(std::remainder(t.list()->phi_i_deg[s.sample], 180)) > near_deg;
      });
    return all;
  };
  auto samples = samples_of(table);
  const auto left_out = table.left_out ? samples_of(*table.left_out) : std::vector<InPlane>();
  std::ranges::stable_sort(samples, {}, &InPlane::theta_i_deg);
  // Incident angles closer than 0.1° are one; a table with hardly two samples at each has
  // directions at random.
  std::vector<double> distinct;
  for (const auto& s : samples)
    if (distinct.empty() || s.theta_i_deg - distinct.back() > 0.1)
      distinct.push_back(s.theta_i_deg);
  const bool random = samples.size() < 3 * distinct.size();
  const double within = random ? near_deg : 0;
  const std::vector<double> at =
      random ? std::vector(wanted_deg.begin(), wanted_deg.end()) : choose(distinct);

  std::vector<Cut> cuts;
  for (const double at_deg : at) {
    Cut cut{"theta_i", at_deg, within, "theta_o", {}, {}, {}};
    std::vector<Point> points;
    const double from = at_deg - within, to = at_deg + (random ? within : 0.1);
    add_points(table, samples, from, to, false, points);
    if (table.left_out) add_points(*table.left_out, left_out, from, to, true, points);
    if (finish(cut, std::move(points), at_deg, -89.5, 0, table.aperture, fitted))
      cuts.push_back(std::move(cut));
  }
  return cuts;
}

}  // namespace

std::vector<Cut> make_cuts(const Table& table, const BoundModel& fitted) {
  assert(fitted.model.channels == table.values.size());
  return table.grid() ? grid_cuts(table, &fitted) : list_cuts(table, &fitted);
}

std::vector<Cut> make_cuts(const Table& table) {
  return table.grid() ? grid_cuts(table, nullptr) : list_cuts(table, nullptr);
}

}  // namespace gonio
