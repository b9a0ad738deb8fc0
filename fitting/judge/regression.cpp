#include "fitting/judge/regression.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/quantile.h"
#include "fitting/solve/matrix.h"
#include "number/distributions.h"

namespace gonio::misfit {
namespace {

constexpr double many = 50;  ///< samples for each function
constexpr std::size_t most_gains = 128;

/// Unknowns of their own for the scale of each channel under each incident angle, where there is room.
std::size_t add_gains(Left& left) {
  const std::size_t channels = left.unknowns.size(), gains = left.angles * channels;
  if (left.angles < 2 || 4 * static_cast<double>(left.angles) > left.directions ||
      left.count + gains > most_gains)
    return 0;
  for (auto& v : left.values) v.gain = left.count + left.units[v.unit].angle * channels + v.channel;
  left.count += gains;
  return gains;
}

/// Pseudoinverse of a positive semidefinite matrix, and its rank.
struct Inverse {
  Columns inverse;
  std::size_t rank = 0;
  explicit Inverse(const Columns& a) : inverse(a) {
    if (a.size() == 0) return;  // nothing is free
    const VectorXd scale =
        a.diagonal().unaryExpr([](double d) { return d > 0 ? 1 / std::sqrt(d) : 0; });
    const auto eigen = eigenpairs(scaled(scale, a, scale));
    const VectorXd roots =
        eigen.values.unaryExpr([](double l) { return l > 1e-10 ? 1 / std::sqrt(l) : 0; });
    inverse = times_transposed(scaled(scale, eigen.vectors, roots));
    rank = static_cast<std::size_t>((roots.array() > 0).count());
  }
};

/// Probability of so large an F by luck.
double luck(double f, double of, double freedom) {
  if (!(f > 0)) return 1;
  if (std::isinf(f)) return 0;  // beside values without any noise
  return fisher_f_tail(f, of, freedom);
}
/// That of W = Uᵀ(Σ z zᵀ)⁻¹U over `units` independent scores z with the sum U (Hotelling), which is at
/// most their number.
double luck_of_scores(double w, double of, double units) {
  const double rest = std::max(units - w, 1e-12 * units);
  return luck(w / of / (rest / (units - of)), of, units - of);
}

/// Sums of scores over units, or over incident angles.
class Scores {
 public:
  Scores(std::size_t units, std::size_t width)
      : width_(width), sums_(units * width), counts_(units) {}
  /// \param count  samples that the unit counts as: each has that part of its score
  double* of(std::size_t unit, double count) {
    counts_[unit] = count;
    return sums_.data() + unit * width_;
  }
  double count() const { return std::accumulate(counts_.begin(), counts_.end(), 0.0); }
  Eigen::Map<const VectorXd> at(std::size_t k) const {
    return Eigen::Map<const VectorXd>(sums_.data() + k * width_, index(width_));
  }
  VectorXd sum() const {
    VectorXd u = VectorXd::Zero(index(width_));
    for (std::size_t k = 0; k < counts_.size(); ++k) u += at(k);
    return u;
  }
  Columns squares() const {
    Columns m = Columns::Zero(index(width_), index(width_));
    for (std::size_t k = 0; k < counts_.size(); ++k)
      if (counts_[k] > 0) m.selfadjointView<Eigen::Lower>().rankUpdate(at(k), 1 / counts_[k]);
    return m.selfadjointView<Eigen::Lower>();
  }

 private:
  std::size_t width_;
  std::vector<double> sums_;
  std::vector<double> counts_;  ///< 0 of those without a score
};

/// Residuals projected: what is left when the unknowns are moved to where these scores are 0, and the
/// functions without what unknowns could take up.
class Projected {
 public:
  Projected(const Left& left, std::size_t width, bool gains)
      : left_(left), width_(width), gains_(gains) {
    const auto n = index(left.count), q = index(width);
    Columns a = Columns::Zero(n, n), c = Columns::Zero(n, q);
    VectorXd g = VectorXd::Zero(n);
    for (const auto& v : left.values) {
      const auto& functions = left.units[v.unit].functions;
      const double weighted = v.active * v.change / v.variance;
      each(v, [&](Eigen::Index i, double j) {
        g[i] += j * v.r;
        if (v.active == 0) return;
        for (Eigen::Index k = 0; k < q; ++k)
          c(i, k) += j * weighted * functions[static_cast<std::size_t>(k)];
        each(v, [&](Eigen::Index l, double other) { a(i, l) += v.active * j * other; });
      });
    }
    Inverse solved(a);
    rank_ = solved.rank;
    inverse_ = std::move(solved.inverse);
    functions_ = product(inverse_, c).transpose();
    step_ = inverse_ * g;
  }
  std::size_t rank() const { return rank_; }
  const Columns& inverse() const { return inverse_; }
  /// Residual that the unknowns take up.
  double taken_up(const Value& v) const {
    double sum = 0;
    each(v, [&](Eigen::Index i, double j) { sum += j * step_[i]; });
    return sum;
  }
  double residual(const Value& v) const { return v.active > 0 ? v.r - taken_up(v) : v.r; }
  void functions(const Value& v, double* out) const {
    const auto& own = left_.units[v.unit].functions;
    const double weighted = v.change / v.variance;
    for (std::size_t k = 0; k < width_; ++k) out[k] = weighted * own[k];
    each(v, [&](Eigen::Index i, double j) {
      for (std::size_t k = 0; k < width_; ++k) out[k] -= j * functions_(index(k), i);
    });
  }

  /// Unknowns that a value knows, and its derivatives by them.
  template <class Visit>
  void each(const Value& v, Visit&& visit) const {
    const auto& unknowns = left_.unknowns[v.channel];
    for (std::size_t k = 0; k < unknowns.size(); ++k) visit(index(unknowns[k]), v.j[k]);
    if (gains_) visit(index(v.gain), v.change);
  }

 private:
  const Left& left_;
  std::size_t width_, rank_ = 0;
  bool gains_;
  Columns inverse_, functions_;
  VectorXd step_;
};

/// Cells, each one function of its own: 1 in it and 0 elsewhere, projected as the smooth ones are.
void judge_cells(const Left& left,
                 const Projected& projected,
                 const std::vector<double>& r,
                 bool shared,
                 Regression& out) {
  constexpr std::size_t cells = rows * columns;
  const auto n = index(left.count);
  struct Cell {
    double sum = 0, weight = 0, squares = 0;
    VectorXd with_function, with_change, with_score;  ///< products with the derivatives
    double scores = 0;
  };
  std::array<Cell, cells> all;
  for (auto& c : all) c.with_function = c.with_change = c.with_score = VectorXd::Zero(n);
  const std::size_t units = shared ? left.angles : left.units.size();
  Scores moves(units, left.count);                                              // Σ j r
  std::vector<std::pair<double, double>> scores(units * (shared ? cells : 1));  // count, score
  for (std::size_t i = 0; i < left.values.size(); ++i) {
    const auto& v = left.values[i];
    const auto& unit = left.units[v.unit];
    auto& cell = all[unit.cell];
    const double function = v.change / v.variance;
    cell.sum += function * r[i];
    cell.weight += v.active * function * v.change;
    const std::size_t of = shared ? unit.angle : v.unit;
    auto& [count, score] = scores[shared ? of * cells + unit.cell : of];
    count = shared ? 1 : unit.count;
    score += function * r[i];
    double* const move = moves.of(of, count);
    projected.each(v, [&](Eigen::Index k, double j) {
      move[k] += j * r[i];
      cell.with_function[k] += v.active * function * j;
      cell.with_change[k] += v.active * v.change * j;
    });
  }
  for (std::size_t k = 0; k < scores.size(); ++k) {
    const auto& [count, score] = scores[k];
    if (count == 0) continue;
    const std::size_t of = shared ? k / cells : k;
    auto& cell = all[shared ? k % cells : left.units[k].cell];
    cell.squares += score * score / count;
    cell.with_score += score / count * moves.at(of);
    cell.scores += count;
  }
  const Columns move_squares = moves.squares();
  constexpr double few = 3, enough = 20;
  double tested = 0, least = 1, squares = 0, weights = 0;
  for (std::size_t k = 0; k < cells; ++k) {
    const Cell& c = all[k];
    const VectorXd taken_up = projected.inverse() * c.with_function;
    const double weight = c.weight - taken_up.dot(c.with_change);
    const double noise =
        c.squares - 2 * taken_up.dot(c.with_score) + taken_up.dot(move_squares * taken_up);
    if (c.scores < few || !(weight > 0.05 * c.weight) || !(noise > 1e-9 * c.squares)) continue;
    const double square = c.sum * c.sum;
    if (c.scores >= enough) {
      ++tested;
      least = std::min(least, luck_of_scores(square / noise, 1, c.scores));
    }
    squares += std::max(0.0, (square - noise) / weight);
    weights += weight;
  }
  if (tested > 0) out.p = std::min(1.0, 2 * std::min(out.p, least * tested));
  if (weights > 0) out.size = std::max(out.size, std::sqrt(squares / weights));
}

/// Compares what is left with what neighbours differ by, at the same values: by their squares, and by
/// their medians, which no sharp highlight between neighbours moves.
void compare_with_noise(const Left& left, const std::vector<double>& r, Regression& out) {
  std::vector<double> residuals, noises;
  double squares = 0, noise = 0;
  for (std::size_t i = 0; i < r.size(); ++i) {
    const auto& v = left.values[i];
    if (std::isnan(v.noise) || !(v.change > 0)) continue;
    const double rounded = v.rounding / v.change, off = r[i] / v.change;
    residuals.push_back(std::abs(off));
    noises.push_back(std::hypot(v.noise, rounded));
    squares += off * off;
    noise += v.noise * v.noise + rounded * rounded;
  }
  constexpr std::size_t few = 20;
  if (residuals.size() < few) return;
  // Each difference is of nine values, and those of neighbours say half the same.
  const double n = static_cast<double>(residuals.size()), freedom = n * out.freedom / left.samples;
  const auto compare = [&](double ratio, double efficiency) {
    const double alike = efficiency / out.common;
    const double p = luck(ratio, std::max(alike * freedom, 1.0), alike * n / 4);
    if (p < out.p_beside_noise) out.p_beside_noise = p;
    out.beside_noise = std::max(out.beside_noise, ratio);
  };
  if (!left.robust) compare(squares / noise * n / std::max(freedom, 1.0), 1);
  const double ratio = median(residuals) / median(noises);
  compare(ratio * ratio * n / std::max(freedom, 1.0), 0.37);  // of the median, beside the RMS
}

/// Takes each angle's own scale out of what a robust fit leaves, which then clips other values: else one
/// whose values are clipped all alike could take nothing up.
void settle(Left& left) {
  constexpr int rounds = 20;
  for (int round = 0; round <= rounds; ++round) {
    std::vector<double> sizes;
    for (const auto& v : left.values) sizes.push_back(std::abs(v.whole));
    const double huber = huber_of(std::move(sizes));
    for (auto& v : left.values) {
      v.r = std::clamp(v.whole, -huber, huber);
      const double part = huber / std::max(std::abs(v.whole), huber);
      v.active = round < rounds ? part : std::floor(part);
    }
    if (round == rounds) break;
    const Projected projected(left, 0, true);
    for (auto& v : left.values) v.whole -= projected.taken_up(v);
  }
}

}  // namespace

double luck_of_scales(const Regression& r, const Regression& open) {
  const double of = r.freedom - open.freedom;
  if (!(of > 0) || !(open.freedom > 0)) return 1;
  return luck((r.squares - open.squares) / of / (open.squares / open.freedom), of / open.common,
              open.freedom / open.common);
}

Regression regress(Left left, Errors errors) {
  Regression out;
  const bool shared = errors == Errors::any;
  find_variances(left);
  if (errors == Errors::scale) {
    out.scales = add_gains(left);
    if (out.scales == 0) return out;
    if (left.robust) settle(left);
  }
  const bool gains = out.scales > 0;
  const std::size_t units = left.units.size();
  const double n = left.samples;
  double rounded = 0, changes = 0;
  for (const auto& v : left.values) {
    rounded += v.rounding * v.rounding;
    changes += v.change * v.change;
  }
  out.rounding = std::sqrt(rounded / changes);
  out.rounded = only_rounded(left.values);
  if (out.rounded) return out;

  const std::size_t width = left.directions >= 500 ? fine : smooth;
  const Projected projected(left, width, gains);
  const auto q = index(width);
  Scores scores(shared ? left.angles : units, width);
  std::vector<double> r(left.values.size()), of_unit(units), z(width);
  Columns noise = Columns::Zero(q, q);  // of the scores, if the variances are right
  VectorXd length = VectorXd::Zero(q);  // of each function before its projection
  double chi = 0, weight = 0;
  for (std::size_t i = 0; i < left.values.size(); ++i) {
    const auto& v = left.values[i];
    const auto& unit = left.units[v.unit];
    r[i] = projected.residual(v);
    projected.functions(v, z.data());
    double* const sum = scores.of(shared ? unit.angle : v.unit, shared ? 1 : unit.count);
    for (std::size_t k = 0; k < width; ++k) sum[k] += z[k] * r[i];
    const Eigen::Map<const VectorXd> of(z.data(), q);
    noise.selfadjointView<Eigen::Lower>().rankUpdate(of, v.variance);
    const double whole = v.change * v.change / v.variance;
    for (std::size_t k = 0; k < width; ++k)
      length[index(k)] += whole * unit.functions[k] * unit.functions[k];
    chi += r[i] * r[i] / v.variance;
    of_unit[v.unit] += r[i] / std::sqrt(v.variance);
    weight += v.active * whole;
  }
  noise = Columns(noise.selfadjointView<Eigen::Lower>());
  double common = 0;  // channels of a sample that share their errors count less
  for (const double x : of_unit) common += x * x;
  common = std::max(1.0, common / chi);
  const double freedom = n / common - static_cast<double>(projected.rank());
  const double independent = scores.count();
  const double most = shared ? (independent - 2) / 3 : freedom / 4;
  out.squares = chi;
  out.freedom = n - static_cast<double>(projected.rank());
  out.common = common;
  for (std::size_t i = 0; i < r.size(); ++i) {
    auto& v = left.values[i];
    v.r = r[i];
    if (v.change > 0)
      out.left += r[i] * r[i] / (v.change * v.change) / static_cast<double>(r.size());
  }
  if (!(most >= 1)) return out;
  compare_with_noise(left, r, out);
  if (gains && only_rounded(left.values)) {  // all that was left is scales of angles
    out.tested = true;
    return out;
  }
  const double variance = chi / (n - static_cast<double>(projected.rank()));

  // Functions of unit variance, the best visible ones first.
  const VectorXd scale = length.unaryExpr([](double l) { return l > 0 ? 1 / std::sqrt(l) : 0; });
  const auto eigen = eigenpairs(scaled(scale, noise, scale));
  Eigen::Index kept = 0;
  while (kept < q && static_cast<double>(kept + 1) <= most && eigen.values[q - 1 - kept] > 1e-6)
    ++kept;
  if (kept == 0) return out;
  out.limited = kept < q && eigen.values[q - 1 - kept] > 1e-6;
  const Columns t = scaled(scale, eigen.vectors.rightCols(kept),
                           eigen.values.tail(kept).cwiseSqrt().cwiseInverse());
  const VectorXd sum = scores.sum(), u = transposed_times(t, sum);
  const double of = static_cast<double>(kept);
  const Columns meat = product(transposed_product(t, scores.squares()), t);
  out.tested = true;
  if (shared || independent >= many * of) {
    out.p = luck_of_scores(u.dot(times(Inverse(meat).inverse, u)), of, independent);
    out.noise = meat.trace();
  } else {
    const double w = u.squaredNorm() / (variance * common);
    out.p = luck_of_scores(w, of, freedom);
    out.noise = of * variance * common;
  }
  out.excess = std::max(0.0, u.squaredNorm() - out.noise);
  out.size = std::sqrt(out.excess / weight);
  for (std::size_t g = 1; g < names.size(); ++g) {
    std::vector<Eigen::Index> own;
    for (std::size_t k = 0; k < width; ++k)
      if (static_cast<std::size_t>(belongs[k]) == g) own.push_back(index(k));
    out.follows[g] = sum(own).dot(Inverse(noise(own, own)).inverse * VectorXd(sum(own)));
  }
  judge_cells(left, projected, r, shared, out);
  return out;
}

}  // namespace gonio::misfit
