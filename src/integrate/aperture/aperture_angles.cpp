#include "integrate/aperture/aperture_angles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "geometry/vector.h"

#include <tbb/parallel_for.h>

namespace gonio {
namespace {

constexpr std::size_t points_of_a_ring = 2048, points_far_off = 1024;
constexpr int octaves = 10;  ///< of θ_h, below the largest
constexpr double beside =
    2;  ///< widths of the cones from the peak, beyond which none of them holds it
constexpr std::size_t turns = 24;  ///< parts of a circle about the normal, of an anisotropic lobe
constexpr std::size_t most_slices = 6;  ///< of a cone, by its cosine
constexpr std::size_t parts_of_a_turn = most_slices * most_slices;

/// Points of [0, 1]⁴ by the additive recurrence whose steps are 1/g, 1/g² …, with g⁵ = g + 1: evenly spread [Roberts 2018].
using Point = std::array<double, 4>;
const std::array<Point, points_of_a_ring>& points() {
  static const auto all = [] {
    constexpr double g = 1.1673039782614187;
    std::array<Point, points_of_a_ring> p{};
    for (std::size_t m = 0; m < p.size(); ++m)
      for (std::size_t k = 0; k < 4; ++k) {
        const double x =
            0.5 + static_cast<double>(m + 1) * std::pow(g, -static_cast<double>(k + 1));
        p[m][k] = x - std::floor(x);
      }
    return p;
  }();
  return all;
}

/// Directions of a round cone, evenly spread.
class Cone {
 public:
  /// \param width  full [rad]
  Cone(const Direction& axis, double width)
      : axis_(axis), half_(width / 2), height_(2 * std::pow(std::sin(width / 4), 2)) {
    const Vector a = vector_of(axis),
                 other = std::abs(axis.z) < 0.9 ? Vector{0, 0, 1} : Vector{1, 0, 0};
    x_ = vector_of(direction(cross(other, a)));
    y_ = cross(a, x_);
  }
  Direction at(double u, double v) const {
    if (height_ == 0) return axis_;
    const double z = height_ * u, r = std::sqrt(z * (2 - z)), phi = 2 * std::numbers::pi * v;
    const Vector d =
        (1 - z) * vector_of(axis_) + (r * std::cos(phi)) * x_ + (r * std::sin(phi)) * y_;
    return {d.x, d.y, d.z};
  }
  /// 1 inside, 0 outside; the edge is blurred, so that sums over points converge sooner.
  double covers(const Direction& d) const {
    constexpr double blur = 0.05;
    const double r = std::sqrt(std::max(0.0, 1 - dot(d, axis_)) / height_);
    return std::clamp((1 + blur - r) / (2 * blur), 0.0, 1.0);
  }
  double half() const { return half_; }
  double cos() const { return axis_.z; }

 private:
  Direction axis_;
  double half_, height_;
  Vector x_, y_;
};

/// One pair of directions.
struct Seen {
  double v;  ///< ln sin θ_h
  double weight;
  std::size_t part;  ///< of those that have a rule each
  FrameAngles<double> a;
};
struct Weighted {
  double weight;
  FrameAngles<double> a;
};

/// Roots of the k-th of polynomials p_(j+1) = (x − a_j) p_j − b_j p_(j−1), between those of the one below it.
std::vector<double> roots(std::span<const double> a,
                          std::span<const double> b,
                          double low,
                          double high) {
  std::vector<double> found;
  const auto value = [&](double x, std::size_t k) {
    double before = 0, p = 1;
    for (std::size_t j = 0; j < k; ++j) {
      const double next = (x - a[j]) * p - b[j] * before;
      before = p;
      p = next;
    }
    return p;
  };
  for (std::size_t k = 1; k <= a.size(); ++k) {
    std::vector<double> edges{low};
    edges.insert(edges.end(), found.begin(), found.end());
    edges.push_back(high);
    found.clear();
    for (std::size_t j = 0; j < k; ++j) {
      double from = edges[j], to = edges[j + 1];
      const bool rises = value(to, k) > 0;
      for (int step = 0; step < 50; ++step) {
        const double x = (from + to) / 2;
        (value(x, k) > 0) == rises ? to = x : from = x;
      }
      found.push_back((from + to) / 2);
    }
  }
  return found;
}

/// Gauss rule of so many nodes for the measure of ln sin θ_h, or of fewer where the pairs differ in fewer.
void add_rule(std::span<const Seen> seen,
              std::size_t nodes,
              bool frame,
              std::vector<Weighted>& out) {
  double total = 0, low = seen[0].v, high = low;
  for (const auto& s : seen) {
    total += s.weight;
    low = std::min(low, s.v);
    high = std::max(high, s.v);
  }
  if (!(total > 0)) return;
  std::vector<double> a, b, p(seen.size(), 1), before(seen.size(), 0);
  double norm = total;
  for (std::size_t k = 0; k < nodes; ++k) {
    double first = 0;
    for (std::size_t m = 0; m < seen.size(); ++m) first += seen[m].weight * seen[m].v * p[m] * p[m];
    a.push_back(first / norm);
    b.push_back(0);
    double next_norm = 0;
    for (std::size_t m = 0; m < seen.size(); ++m) {
      const double next = (seen[m].v - a[k]) * p[m] - (k > 0 ? b[k - 1] : 0) * before[m];
      before[m] = p[m];
      p[m] = next;
      next_norm += seen[m].weight * next * next;
    }
    if (!(next_norm > 1e-20 * norm * (high - low) * (high - low))) break;
    b[k] = next_norm / norm;
    norm = next_norm;
  }
  std::vector<double> below{0};  // b_j belongs to the step from j − 1 to j
  below.insert(below.end(), b.begin(), b.end() - 1);
  const auto x = roots(a, below, low, high);
  for (std::size_t j = 0; j < x.size(); ++j) {
    double weight = 0;
    std::array<double, 9> sum{};
    for (const auto& s : seen) {
      double w = s.weight;  // times Lagrange's polynomial of the node
      for (std::size_t i = 0; i < x.size(); ++i)
        if (i != j) w *= (s.v - x[i]) / (x[j] - x[i]);
      weight += w;
      const std::array of{s.a.nol, s.a.nov, s.a.voh, s.a.xoh, s.a.yoh,
                          s.a.xol, s.a.yol, s.a.xov, s.a.yov};
      for (std::size_t k = 0; k < of.size(); ++k) sum[k] += w * of[k];
    }
    if (!(weight > 0)) continue;
    for (double& of : sum) of /= weight;
    constexpr double least = 1e-6;  // a mean by weights of both signs may leave the range
    const double sine = std::min(std::exp(x[j]), 1.0);
    Weighted w{weight,
               {{std::clamp(sum[0], least, 1.0), std::clamp(sum[1], least, 1.0),
                 std::sqrt(1 - sine * sine), std::clamp(sum[2], least, 1.0), sine * sine},
                0,
                0,
                0,
                0,
                0,
                0}};
    if (frame) {
      const double length = std::hypot(sum[3], sum[4]);
      w.a.xoh = length > 0 ? sine * sum[3] / length : sine;
      w.a.yoh = length > 0 ? sine * sum[4] / length : 0;
      w.a.xol = sum[5], w.a.yol = sum[6], w.a.xov = sum[7], w.a.yov = sum[8];
    }
    out.push_back(w);
  }
}

/// A rule for each part.
void add_rules(std::vector<Seen>& seen, std::size_t nodes, bool frame, std::vector<Weighted>& out) {
  std::ranges::stable_sort(seen, {}, &Seen::part);
  for (auto from = seen.begin(); from != seen.end();) {
    const auto to =
        std::find_if(from, seen.end(), [&](const Seen& s) { return s.part != from->part; });
    add_rule({from, to}, nodes, frame, out);
    from = to;
  }
}

/// The angles of one sample.
class Sample {
 public:
  Sample(const DirectionPair& p, const Aperture& aperture, bool frame)
      : light_(p.wi, aperture.light),
        detector_(p.wo, aperture.detector),
        frame_(frame),
        centre_(frame_angles(p)) {
    // In the plane of both h turns by half of what wi and wo do; across it by 1/VoH times as much.
    const double half = light_.half() + detector_.half();
    stretch_ = 1 / std::max(centre_.voh, half);
    reach_ = half / 2;
    const double x = p.wo.x - p.wi.x, y = p.wo.y - p.wi.y, length = std::hypot(x, y);
    if (length > 0) x_ = x / length, y_ = y / length;
    const double slope = 1 / std::max(centre_.noh, 1e-6),
                 along = (centre_.xoh * x_ + centre_.yoh * y_) * slope,
                 across = (centre_.yoh * x_ - centre_.xoh * y_) * slope;
    from_peak_ = std::hypot(along, across / stretch_);
    towards_ = std::atan2(across / stretch_, along);
    for (const auto& [cone, slices] :
         {std::pair(&light_, &of_light_), {&detector_, &of_detector_}}) {
      const double theta = std::acos(std::clamp(cone->cos(), 0.0, 1.0)), own = cone->half();
      slices->from = std::max(std::cos(theta + own), 0.0);
      slices->to = std::cos(std::max(theta - own, 0.0));
      const double spread = (slices->to - slices->from) / std::max(cone->cos(), 1e-3);
      constexpr double little = 0.17, of_one = 0.4;
      slices->count = spread < little
                          ? 1
                          : std::min(most_slices, 2 + static_cast<std::size_t>(spread / of_one));
    }
  }

  std::vector<Weighted> angles() {
    if (reach_ < 0.003 * from_peak_ && of_light_.count * of_detector_.count == 1)
      return {{1, centre_}};
    if (reach_ * beside < from_peak_)
      far_off();
    else
      around_the_peak();
    double total = 0;
    for (const auto& w : out_) total += w.weight;
    if (!(total > 0)) return {{1, centre_}};
    for (auto& w : out_) w.weight /= total;
    return std::move(out_);
  }

 private:
  /// Slices of a cone by its cosine, as many as that changes much in it.
  struct Slices {
    double from = 0, to = 1;
    std::size_t count = 1;
    std::size_t operator()(double cosine) const {
      if (count == 1) return 0;
      const double part = std::max((cosine - from) / (to - from), 0.0) * static_cast<double>(count);
      return std::min(static_cast<std::size_t>(part), count - 1);
    }
  };
  std::size_t slice_of(const DirectionPair& p) const {
    return of_light_.count * of_detector_(p.wo.z) + of_light_(p.wi.z);
  }
  /// Part of the circle about the normal that h is in.
  std::size_t turn_of(const FrameAngles<double>& a) const {
    if (!frame_) return 0;
    const double part = (std::atan2(a.yoh, a.xoh) + std::numbers::pi) / (2 * std::numbers::pi);
    return std::min(static_cast<std::size_t>(part * turns), turns - 1);
  }
  void far_off() {
    std::vector<Seen> seen;
    double low = HUGE_VAL, high = -HUGE_VAL;
    const std::size_t n = frame_ ? points_of_a_ring : points_far_off;
    for (std::size_t m = 0; m < n; ++m) {
      const auto& u = points()[m];
      const DirectionPair p{light_.at(u[0], u[1]), detector_.at(u[2], u[3])};
      if (!(p.wi.z > 0 && p.wo.z > 0)) continue;
      const auto a = frame_angles(p);
      if (!(a.sin2_theta_h > 0)) continue;
      const double v = std::log(a.sin2_theta_h) / 2;
      low = std::min(low, v);
      high = std::max(high, v);
      seen.push_back({v, p.wi.z * p.wo.z, parts_of_a_turn * turn_of(a) + slice_of(p), a});
    }
    if (seen.empty()) return;
    const double range = high - low;
    add_rules(seen, range < 0.02 ? 1 : range < 0.16 ? 2 : range < 0.7 ? 3 : 4, frame_, out_);
  }
  /// h by its slopes in elliptic rings about the normal, one direction in the narrower cone: the other follows, dω = 4 VoH dω_h.
  void around_the_peak() {
    constexpr double margin = 1.15;  // of a reach for small cones
    constexpr double much = 0.12;    // [rad]
    const bool is_wide = 2 * reach_ > much;
    const double largest = is_wide ? 1.03 * farthest() : from_peak_ + margin * reach_,
                 least = is_wide ? 0 : std::max(from_peak_ - margin * reach_, 0.0);
    const double window = least > 0 ? std::asin(margin * reach_ / from_peak_) : std::numbers::pi;
    std::vector<Seen> seen;
    for (int k = 0; k <= octaves; ++k) {
      const double to = std::ldexp(largest, -k);
      const bool innermost = k == octaves;
      const double from = innermost ? 0 : std::max(to / 2, least);
      if (!(from < to)) break;
      ring(from, to, innermost, window, seen);
    }
    if (seen.empty()) return;
    // A rule for each octave of θ_h; what lies below all of them is one angle.
    const double lowest = std::log(std::ldexp(largest, -octaves));
    for (auto& s : seen) {
      const double octave = std::floor((s.v - lowest) / std::numbers::ln2);
      s.part += parts_of_a_turn * turns * static_cast<std::size_t>(std::max(octave, -1.0) + 1);
    }
    add_rules(seen, frame_ ? 2 : 3, frame_, out_);
  }
  /// Largest elliptic slope of h between the cones' edges.
  double farthest() const {
    constexpr int steps = 24;
    double most = 0;
    for (int i = 0; i < steps; ++i)
      for (int k = 0; k < steps; ++k) {
        Direction wi = light_.at(1, static_cast<double>(i) / steps),
                  wo = detector_.at(1, static_cast<double>(k) / steps);
        wi.z = std::max(wi.z, 0.0), wo.z = std::max(wo.z, 0.0);
        const double x = wi.x + wo.x, y = wi.y + wo.y, z = wi.z + wo.z;
        if (z > 0)
          most = std::max(most, std::hypot(x * x_ + y * y_, (y * x_ - x * y_) / stretch_) / z);
      }
    constexpr double grazing = 20;
    return std::min(most, grazing);
  }
  /// \param window  how far from the cones' own azimuth the ring is looked at, to either side
  void ring(double from, double to, bool innermost, double window, std::vector<Seen>& seen) const {
    const bool from_light = light_.half() < detector_.half();
    const Cone &narrow = from_light ? light_ : detector_, &wide = from_light ? detector_ : light_;
    const double octave = innermost ? 0 : std::log(to / from);
    for (const auto& u : points()) {
      const Direction one = narrow.at(u[0], u[1]);
      const double t = innermost ? to * std::sqrt(u[2]) : from * std::exp(octave * u[2]);
      const double phi = towards_ + window * (2 * u[3] - 1);
      const double along = t * std::cos(phi), across = stretch_ * t * std::sin(phi);
      const double z = 1 / std::sqrt(1 + along * along + across * across);
      const Direction h{z * (along * x_ - across * y_), z * (along * y_ + across * x_), z};
      const double voh = dot(one, h);
      const Direction other{2 * voh * h.x - one.x, 2 * voh * h.y - one.y, 2 * voh * h.z - one.z};
      if (!(voh > 0 && one.z > 0 && other.z > 0)) continue;
      const double inside = wide.covers(other);
      if (!(inside > 0)) continue;
      // dω_h = cos³θ_h of the slopes' area, t dt by what u[2] spreads evenly
      const double solid = z * z * z * window * (innermost ? to * to / 2 : t * t * octave);
      const DirectionPair p = from_light ? DirectionPair{one, other} : DirectionPair{other, one};
      const double sin2 = h.x * h.x + h.y * h.y;
      const FrameAngles<double> a{
          {p.wi.z, p.wo.z, h.z, voh, sin2}, h.x, h.y, p.wi.x, p.wi.y, p.wo.x, p.wo.y};
      seen.push_back({std::log(sin2) / 2, inside * solid * voh * p.wi.z * p.wo.z,
                      parts_of_a_turn * turn_of(a) + slice_of(p), a});
    }
  }

  Cone light_, detector_;
  bool frame_;
  Slices of_light_, of_detector_;
  FrameAngles<double> centre_;
  double x_ = 1, y_ = 0;  ///< in the plane of both directions
  double from_peak_ = 0;  ///< slope of h, across the plane over the stretch
  double towards_ = 0;    ///< its azimuth
  double reach_ = 0;      ///< how far from it the cones reach
  double stretch_ = 1;
  std::vector<Weighted> out_;
};

}  // namespace

ApertureAngles::ApertureAngles(std::size_t samples,
                               const std::function<DirectionPair(std::size_t)>& directions,
                               const Aperture& aperture,
                               bool frame) {
  std::vector<std::vector<Weighted>> all(samples);
  tbb::parallel_for(std::size_t{0}, samples, [&](std::size_t i) {
    all[i] = Sample(directions(i), aperture, frame).angles();
  });
  for (auto& own : all) {
    for (const auto& w : own) {
      angles_.push_back(w.a);
      weights_.push_back(w.weight);
    }
    end_.push_back(static_cast<std::uint32_t>(angles_.size()));
    own = {};
  }
}

}  // namespace gonio
