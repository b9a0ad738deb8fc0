#include "fitting/judge/regression.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/quantile.h"
#include "fitting/judge/gains.h"
#include "fitting/solve/matrix.h"
#include "number/distributions.h"

namespace gonio::misfit {
namespace {

constexpr double many = 50;  ///< samples for each function

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

/// Values that share their errors: those of one unit, or of one angle.
class Clusters {
 public:
  Clusters(const Left& left, std::optional<SharedAngle> axis) : left_(left), axis_(axis) {
    counts_.resize(axis ? left.angles[static_cast<std::size_t>(*axis)] : left.units.size());
    for (const auto& v : left.values) counts_[of(v)] = axis ? 1 : left.units[v.unit].count;
  }
  std::size_t of(const Value& v) const {
    return axis_ ? left_.units[v.unit].angle[static_cast<std::size_t>(*axis_)] : v.unit;
  }
  std::size_t size() const { return counts_.size(); }
  /// Samples that one counts as: each has that part of its score; 0 of those without values.
  double count(std::size_t k) const { return counts_[k]; }
  double count() const { return std::accumulate(counts_.begin(), counts_.end(), 0.0); }

 private:
  const Left& left_;
  std::optional<SharedAngle> axis_;
  std::vector<double> counts_;
};

/// Residuals, and other columns of one number per value, less the part that unknowns and gains explain: their least-squares fit
/// to the column.
class Projected {
 public:
  Projected(const Left& left, const std::vector<SharedAngle>& axes)
      : left_(left), gains_(left, axes) {
    const auto n = index(left.slots.size());
    find_derivatives();
    Columns a = Columns::Zero(n, n);
    VectorXd g = VectorXd::Zero(n);
    for (std::size_t i = 0; i < left.values.size(); ++i) {
      const auto& v = left.values[i];
      each(i, [&](Eigen::Index k, double j) {
        g[k] += j * v.r;
        if (v.active > 0)
          each(i, [&](Eigen::Index l, double other) { a(k, l) += v.active * j * other; });
      });
    }
    products_ = a, scores_ = g;
    Inverse solved(a);
    rank_ = solved.rank + gains_.count();
    inverse_ = std::move(solved.inverse);
    taken_up_.resize(left.values.size());
    if (!gains_.empty()) {
      for (std::size_t i = 0; i < left.values.size(); ++i) taken_up_[i] = left.values[i].r;
      taken_up_ = gains_.taken_up(taken_up_);
    }
    step_ = inverse_ * g;
    for (std::size_t i = 0; i < left.values.size(); ++i)
      each(i, [&](Eigen::Index k, double j) { taken_up_[i] += j * step_[k]; });
  }
  std::size_t rank() const { return rank_; }
  /// Part of a residual that unknowns and gains explain.
  double taken_up(std::size_t i) const { return taken_up_[i]; }
  double residual(std::size_t i) const {
    const auto& v = left_.values[i];
    return v.active > 0 ? v.r - taken_up_[i] : v.r;
  }
  /// Residual less what the gains explain without the unknowns.
  double beside_gains(std::size_t i) const {
    double r = residual(i);
    if (left_.values[i].active > 0) each(i, [&](Eigen::Index k, double j) { r += j * step_[k]; });
    return r;
  }
  /// Least-squares fit to a column: the unknowns' moves, and each value's change by the gains, empty without gains.
  struct Part {
    VectorXd step;
    std::vector<double> of_gains;
  };
  Part part_of(const std::vector<double>& column) const {
    VectorXd products = VectorXd::Zero(inverse_.rows());
    std::vector<double> scores(gains_.empty() ? 0 : column.size());
    for (std::size_t i = 0; i < column.size(); ++i) {
      const double score = left_.values[i].active * column[i];
      if (score == 0) continue;
      each(i, [&](Eigen::Index k, double j) { products[k] += j * score; });
      if (!gains_.empty()) scores[i] = score;
    }
    return {inverse_ * products, gains_.empty() ? scores : gains_.taken_up(scores)};
  }
  /// That fit at one value.
  double taken(const Part& part, std::size_t i) const {
    double sum = part.of_gains.empty() ? 0 : part.of_gains[i];
    each(i, [&](Eigen::Index k, double j) { sum += j * part.step[k]; });
    return sum;
  }
  /// Takes the fit out of a column.
  void project(std::vector<double>& column) const {
    const Part part = part_of(column);
    for (std::size_t i = 0; i < column.size(); ++i) column[i] -= taken(part, i);
  }
  /// Σ j r of each cluster.
  Columns moves(const std::vector<double>& r, const Clusters& clusters) const {
    Columns all = Columns::Zero(inverse_.rows(), index(clusters.size()));
    for (std::size_t i = 0; i < r.size(); ++i)
      each(i, [&, of = index(clusters.of(left_.values[i]))](Eigen::Index k, double j) {
        all(k, of) += j * r[i];
      });
    return all;
  }
  /// Logarithms of the factors, see Gains::taken_up().
  std::vector<std::vector<double>> factors() const {
    std::vector<double> scores;
    for (std::size_t i = 0; i < left_.values.size(); ++i) {
      const auto& v = left_.values[i];
      const auto& unknowns = left_.unknowns[v.channel];
      scores.push_back(v.r);
      for (std::size_t k = 0; k < unknowns.size(); ++k)
        scores.back() -= v.active * v.j[k] * step_[index(unknowns[k])];
    }
    std::vector<std::vector<double>> all;
    gains_.taken_up(scores, &all);
    return all;
  }
  /// Standard error that noise of the values makes of each channel's mean factor along the last axis, through the unknowns.
  std::vector<double> errors_of_means() const {
    double squares = 0, freedom = -static_cast<double>(rank_);
    for (std::size_t i = 0; i < left_.values.size(); ++i) {
      squares += residual(i) * residual(i);
      freedom += left_.values[i].root_count * left_.values[i].root_count;
    }
    const double variance = squares / std::max(freedom, 1.0);
    const std::size_t channels = left_.unknowns.size();
    Columns means = Columns::Zero(inverse_.rows(), index(channels));
    std::vector<double> scores(left_.values.size());
    std::vector<std::vector<double>> factors;
    for (std::size_t k = 0; k < j_.size(); ++k) {
      for (std::size_t i = 0; i < scores.size(); ++i)
        scores[i] = left_.values[i].active * left_.values[i].j[k];
      gains_.taken_up(scores, &factors);
      const auto& last = factors.back();
      for (std::size_t c = 0; c < channels; ++c) {
        if (k >= left_.unknowns[c].size()) continue;
        for (std::size_t g = c; g < last.size(); g += channels)
          means(index(left_.unknowns[c][k]), index(c)) +=
              last[g] * static_cast<double>(channels) / static_cast<double>(last.size());
      }
    }
    std::vector<double> all;
    for (Eigen::Index c = 0; c < means.cols(); ++c) {
      const VectorXd of = means.col(c);
      all.push_back(std::sqrt(std::max(0.0, variance * of.dot(times(inverse_, of)))));
    }
    return all;
  }
  const Columns& products() const { return products_; }
  /// Σ j r of the unknowns, downhill.
  VectorXd descent() const { return -scores_; }
  /// Changes of the unknowns by one value's residual.
  VectorXd influence(std::size_t i) const {
    VectorXd j = VectorXd::Zero(inverse_.rows());
    each(i, [&](Eigen::Index k, double x) { j[k] = x; });
    return inverse_ * j;
  }

 private:
  /// Unknowns of a value's channel, and its derivatives by them less the part that gains explain.
  template <class Visit>
  void each(std::size_t i, Visit&& visit) const {
    const auto& unknowns = left_.unknowns[left_.values[i].channel];
    for (std::size_t k = 0; k < unknowns.size(); ++k) visit(index(unknowns[k]), j_[k][i]);
  }
  void find_derivatives() {
    std::size_t most = 0;
    for (const auto& of : left_.unknowns) most = std::max(most, of.size());
    std::vector<double> before(left_.slots.size()), after(before), scores(left_.values.size());
    for (std::size_t k = 0; k < most; ++k) {
      auto& column = j_.emplace_back();
      for (const auto& v : left_.values) column.push_back(v.j[k]);
      if (gains_.empty()) continue;
      for (std::size_t i = 0; i < column.size(); ++i)
        scores[i] = left_.values[i].active * column[i];
      const auto taken = gains_.taken_up(scores);
      for (std::size_t i = 0; i < column.size(); ++i) {
        const auto& v = left_.values[i];
        const auto& unknowns = left_.unknowns[v.channel];
        if (k >= unknowns.size()) continue;
        before[unknowns[k]] += v.active * column[i] * column[i];
        column[i] -= taken[i];
        after[unknowns[k]] += v.active * column[i] * column[i];
      }
    }
    constexpr double rounding = 1e-12;  // of squares: such an unknown is one of the gains
    for (std::size_t i = 0; i < left_.values.size(); ++i) {
      const auto& unknowns = left_.unknowns[left_.values[i].channel];
      for (std::size_t k = 0; k < unknowns.size(); ++k)
        if (after[unknowns[k]] < rounding * before[unknowns[k]]) j_[k][i] = 0;
    }
  }

  const Left& left_;
  Gains gains_;
  std::size_t rank_ = 0;
  Columns products_, inverse_;          // of the derivatives beside the gains
  std::vector<std::vector<double>> j_;  ///< [unknown of a channel][value]
  std::vector<double> taken_up_;
  VectorXd scores_, step_;
};

/// Cells, each one function of its own: 1 in it and 0 elsewhere, projected as the smooth ones are.
void judge_cells(const Left& left,
                 const Projected& projected,
                 const std::vector<double>& r,
                 const Clusters& clusters,
                 Regression& out) {
  constexpr double few = 3, enough = 20;
  std::vector<std::vector<std::size_t>> cells(rows * columns);  // their values
  for (std::size_t i = 0; i < left.values.size(); ++i)
    cells[left.units[left.values[i].unit].cell].push_back(i);
  const Columns moves = projected.moves(r, clusters);
  double tested = 0, least = 1, squares = 0, weights = 0;
  std::vector<double> column(left.values.size());
  for (const auto& own : cells) {
    VectorXd score = VectorXd::Zero(index(clusters.size()));
    std::vector<bool> met(clusters.size());
    double whole = 0, scores = 0, before = 0;
    for (const std::size_t i : own) {
      const auto& v = left.values[i];
      const std::size_t of = clusters.of(v);
      column[i] = v.change / v.variance;
      whole += v.active * column[i] * v.change;
      score[index(of)] += column[i] * r[i];
      if (!met[of]) scores += clusters.count(of);
      met[of] = true;
    }
    if (scores < few) {
      for (const std::size_t i : own) column[i] = 0;
      continue;
    }
    for (std::size_t k = 0; k < met.size(); ++k)
      if (met[k]) before += score[index(k)] * score[index(k)] / clusters.count(k);
    const auto part = projected.part_of(column);
    double weight = 0, noise = 0;
    for (const std::size_t i : own) {
      const auto& v = left.values[i];
      weight += v.active * (column[i] - projected.taken(part, i)) * v.change;
      column[i] = 0;
    }
    score -= transposed_times(moves, part.step);
    for (std::size_t i = 0; i < part.of_gains.size(); ++i)
      score[index(clusters.of(left.values[i]))] -= part.of_gains[i] * r[i];
    for (std::size_t k = 0; k < met.size(); ++k)
      if (clusters.count(k) > 0) noise += score[index(k)] * score[index(k)] / clusters.count(k);
    const double sum = score.sum();
    if (!(weight > 0.05 * whole) || !(noise > 1e-9 * before)) continue;
    const double square = sum * sum;
    if (scores >= enough) {
      ++tested;
      least = std::min(least, luck_of_scores(square / noise, 1, scores));
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
  constexpr std::size_t few = 12;
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
void settle(Left& left, const std::vector<SharedAngle>& gains) {
  constexpr double settled = 0.01;
  int rounds = 20;
  double before = HUGE_VAL;
  for (int round = 0; round <= rounds; ++round) {
    std::vector<double> sizes;
    for (const auto& v : left.values) sizes.push_back(std::abs(v.whole));
    const double huber = huber_of(std::move(sizes));
    if (std::abs(huber - std::exchange(before, huber)) < settled * huber) rounds = round;
    for (auto& v : left.values) {
      v.r = std::clamp(v.whole, -huber, huber);
      const double part = huber / std::max(std::abs(v.whole), huber);
      v.active = round < rounds ? part : std::floor(part);
    }
    if (round == rounds) break;
    const Projected projected(left, gains);
    for (std::size_t i = 0; i < left.values.size(); ++i)
      left.values[i].whole -= projected.taken_up(i);
  }
}

/// Residuals of values and units, once unknowns and gains have taken up what they can.
struct Scatter {
  double chi = 0;     ///< squares
  double common = 1;  ///< values that say what one would if their errors were its own
};
Scatter scatter_of(const Left& left, const std::vector<double>& r) {
  Scatter s;
  std::vector<double> of_unit(left.units.size());
  for (std::size_t i = 0; i < r.size(); ++i) {
    const auto& v = left.values[i];
    s.chi += r[i] * r[i] / v.variance;
    of_unit[v.unit] += r[i] / std::sqrt(v.variance);
  }
  double common = 0;  // channels of a sample that share their errors count less
  for (const double x : of_unit) common += x * x;
  s.common = std::max(1.0, common / s.chi);
  return s;
}

}  // namespace

double luck_of_scales(const Regression& r, const Regression& open) {
  const double of = r.freedom - open.freedom;
  if (!(of > 0) || !(open.freedom > 0)) return 1;
  return luck((r.squares - open.squares) / of / (open.squares / open.freedom), of / open.common,
              open.freedom / open.common);
}

bool has_room(const Left& left, SharedAngle axis) {
  const std::size_t angles = left.angles[static_cast<std::size_t>(axis)];
  return angles >= 2 && 4 * static_cast<double>(angles) <= left.directions;
}

Regression regress(const Left& found,
                   const std::vector<SharedAngle>& gains,
                   std::optional<SharedAngle> clustered,
                   bool only_scatter,
                   std::optional<std::size_t> apart,
                   const std::optional<Harmonics>& harmonics) {
  Regression out;
  std::optional<Left> settled;
  if (!gains.empty() && found.robust) settle(settled.emplace(found), gains);
  const Left& left = settled ? *settled : found;
  const double n = left.samples;
  std::vector<double> r(left.values.size());
  double rounded = 0, changes = 0;
  for (const auto& v : left.values) {
    rounded += v.rounding * v.rounding;
    changes += v.change * v.change;
  }
  out.rounding = std::sqrt(rounded / changes);
  for (std::size_t i = 0; i < left.values.size(); ++i) r[i] = left.values[i].r;
  out.rounded = only_rounded(left.values, r);
  if (out.rounded) return out;

  const Projected projected(left, gains);
  for (std::size_t i = 0; i < r.size(); ++i) r[i] = projected.residual(i);
  const auto [chi, common] = scatter_of(left, r);
  out.squares = chi;
  out.freedom = n - static_cast<double>(projected.rank());
  out.common = common;
  for (std::size_t i = 0; i < r.size(); ++i) {
    const auto& v = left.values[i];
    if (v.change > 0) out.left += std::pow(v.root_count * r[i] / v.change, 2) / n;
  }
  out.scales = Gains(left, gains).count();
  if (only_scatter) return out;

  const auto functions_of = [&](const Unit& unit) {
    if (harmonics) return values_of(*harmonics, unit);
    return std::vector(unit.functions.begin(),
                       unit.functions.begin() + (left.directions >= 500 ? fine : smooth));
  };
  std::vector<std::vector<double>> of_unit;
  for (const auto& unit : left.units) of_unit.push_back(functions_of(unit));
  const std::size_t width = of_unit.front().size();
  const auto q = index(width);
  const Clusters clusters(left, clustered);
  std::vector<std::vector<double>> functions(width, std::vector<double>(r.size()));
  VectorXd length = VectorXd::Zero(q);  // of each function before its projection
  double weight = 0;
  for (std::size_t i = 0; i < r.size(); ++i) {
    const auto& v = left.values[i];
    const auto& own = of_unit[v.unit];
    const double side = !apart                ? 1
                        : v.channel == *apart ? 1
                                              : -1 / static_cast<double>(left.unknowns.size() - 1);
    const double whole = v.change * v.change / v.variance * side * side;
    for (std::size_t k = 0; k < width; ++k) {
      functions[k][i] = v.change / v.variance * own[k] * side;
      length[index(k)] += whole * own[k] * own[k];
    }
    weight += v.active * whole;
  }
  for (auto& f : functions) projected.project(f);
  Columns scores = Columns::Zero(q, index(clusters.size()));
  Columns noise = Columns::Zero(q, q);  // of the scores, if the variances are right
  VectorXd z(q);
  for (std::size_t i = 0; i < r.size(); ++i) {
    for (std::size_t k = 0; k < width; ++k) z[index(k)] = functions[k][i];
    scores.col(index(clusters.of(left.values[i]))) += z * r[i];
    noise.selfadjointView<Eigen::Lower>().rankUpdate(z, left.values[i].variance);
  }
  noise = Columns(noise.selfadjointView<Eigen::Lower>());
  const double freedom = n / common - static_cast<double>(projected.rank());
  const double independent = clusters.count();
  const double most = clustered ? (independent - 2) / 3 : freedom / 4;
  if (!(most >= 1)) return out;
  compare_with_noise(left, r, out);
  if (!gains.empty() && only_rounded(left.values, r)) {  // all that was left is scales of angles
    out.tested = true;
    return out;
  }
  const double variance = chi / out.freedom;

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
  const VectorXd sum = scores.rowwise().sum(), u = transposed_times(t, sum);
  Columns squares = Columns::Zero(q, q);
  for (std::size_t k = 0; k < clusters.size(); ++k)
    if (clusters.count(k) > 0)
      squares.selfadjointView<Eigen::Lower>().rankUpdate(scores.col(index(k)),
                                                         1 / clusters.count(k));
  squares = Columns(squares.selfadjointView<Eigen::Lower>());
  const double of = static_cast<double>(kept);
  const Columns meat = product(transposed_product(t, squares), t);
  out.tested = true;
  if (clustered || independent >= many * of) {
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
    for (std::size_t k = 0; !harmonics && k < width; ++k)
      if (static_cast<std::size_t>(belongs[k]) == g) own.push_back(index(k));
    out.follows[g] = sum(own).dot(Inverse(noise(own, own)).inverse * VectorXd(sum(own)));
  }
  if (harmonics)
    out.follows[static_cast<std::size_t>(Follows::azimuth)] = out.excess;
  else
    judge_cells(left, projected, r, clusters, out);
  return out;
}

namespace {

/// Residuals where a robust fit's values are clipped beside gains.
Left settled_beside(Left left, const std::vector<SharedAngle>& gains) {
  if (left.robust) settle(left, gains);
  return left;
}

}  // namespace

bool are_smooth(const Left& left, const std::vector<SharedAngle>& gains) {
  const Left settled = settled_beside(left, gains);
  const auto factors = Projected(settled, gains).factors().back();
  const auto& places = left.places[static_cast<std::size_t>(gains.back())];
  const std::size_t channels = left.unknowns.size();
  std::vector<std::size_t> order(places.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t k) { return places[k]; });
  double differences = 0, squares = 0, pairs = 0;
  for (std::size_t c = 0; c < channels; ++c) {
    double mean = 0, own = 0;
    for (const std::size_t k : order) mean += factors[k * channels + c];
    mean /= static_cast<double>(order.size());
    for (std::size_t n = 0; n < order.size(); ++n) {
      const double here = factors[order[n] * channels + c];
      own += (here - mean) * (here - mean);
      if (n == 0 || places[order[n]][0] != places[order[n - 1]][0]) continue;
      differences += std::pow(here - factors[order[n - 1] * channels + c], 2);
      if (c == 0) ++pairs;
    }
    squares += own / static_cast<double>(order.size());
  }
  constexpr double few = 6, surely = 2.326;  // standard deviations: one in a hundred
  return pairs >= few && squares > 0 &&
         differences / pairs < squares * (2 - surely * 2 / std::sqrt(pairs + 2));
}

double common_factor(const Left& left, const std::vector<SharedAngle>& gains) {
  const Left settled = settled_beside(left, gains);
  const Projected projected(settled, gains);
  const auto factors = projected.factors().back();
  const auto errors = projected.errors_of_means();
  const std::size_t channels = left.unknowns.size(), angles = factors.size() / channels;
  constexpr double surely = 3;  // standard errors
  double largest = 0;
  for (std::size_t c = 0; c < channels; ++c) {
    double sum = 0;
    for (std::size_t k = 0; k < angles; ++k) sum += factors[k * channels + c];
    largest = std::max(largest, std::abs(sum) / static_cast<double>(angles) - surely * errors[c]);
  }
  return largest;
}

StepBeside step_beside(const Left& left, const std::vector<SharedAngle>& gains) {
  const Left settled = settled_beside(left, gains);
  const Projected projected(settled, gains);
  StepBeside step{0, projected.products(), projected.descent()};
  for (std::size_t i = 0; i < left.values.size(); ++i)
    step.squares += std::pow(projected.beside_gains(i), 2);
  return step;
}

std::vector<double> StepBeside::damped(double by) const {
  Columns a = products;
  for (Eigen::Index k = 0; k < a.rows(); ++k) a(k, k) *= 1 + by;
  const VectorXd step = Inverse(a).inverse * descent;
  return {step.begin(), step.end()};
}

std::vector<double> moved_by_rounding(const Left& left) {
  constexpr double arithmetic = 1e-6;  // of f: below it digits are no table's
  double squares = 0, rounded = 0;
  for (const auto& v : left.values) {
    squares += v.r * v.r;
    if (v.rounding > arithmetic * v.change) rounded += v.rounding * v.rounding;
  }
  if (!(squares < rounded)) return {};
  const Projected projected(left, {});
  VectorXd moves = VectorXd::Zero(index(left.slots.size()));
  for (std::size_t i = 0; i < left.values.size(); ++i)
    if (const auto& v = left.values[i]; v.active > 0) moves += v.rounding * projected.influence(i);
  moves = moves.cwiseAbs() * std::sqrt(1 - squares / rounded);
  return {moves.begin(), moves.end()};
}

std::vector<double> moved_by_gains(const Left& left, SharedAngle axis) {
  const Projected projected(left, {});
  const Clusters angles(left, axis);
  Columns moves = Columns::Zero(index(left.slots.size()), index(angles.size()));
  for (std::size_t i = 0; i < left.values.size(); ++i) {
    const auto& v = left.values[i];
    if (v.active > 0) moves.col(index(angles.of(v))) += v.change * projected.influence(i);
  }
  std::vector<double> all;
  for (Eigen::Index k = 0; k < moves.rows(); ++k) all.push_back(moves.row(k).norm());
  return all;
}

}  // namespace gonio::misfit
