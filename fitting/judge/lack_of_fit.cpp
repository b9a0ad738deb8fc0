#include "fitting/judge/lack_of_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <utility>

#include "base/quantile.h"
#include "brdf/model/derivatives.h"
#include "table/health/rounding.h"

#include <Eigen/Eigenvalues>
#include <boost/math/distributions/fisher_f.hpp>

namespace gonio {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double significant = 0.01;          ///< probability below which a misfit is one
constexpr double worth_telling = 0.01;        ///< of f
constexpr double of_an_interval = 1;          ///< squares beyond noise, of those of noise
constexpr double arithmetic = 1e-7;           ///< of f: below it is rounding of our own
constexpr double faintest = 1e-30;            ///< that the logarithm tells apart [1/sr]
constexpr double many = 50;                   ///< samples for each function
constexpr std::size_t most_values = 1 << 15;  ///< looked at
constexpr std::size_t none = static_cast<std::size_t>(-1);
constexpr std::size_t most_channels = 16, most_gains = 64;

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

Eigen::Index index(std::size_t n) {
  return static_cast<Eigen::Index>(n);
}

// ---- smooth functions of the angles -------------------------------------------------------------

/// Directions of misfit: what usually follows an angle, and the functions that tell it.
enum class Follows { nothing, theta_h, theta_d, grazing };
constexpr std::array<std::string_view, 4> names{"", "theta_h", "theta_d", "grazing angles"};

constexpr std::size_t smooth = 10, fine = 12;
constexpr std::array<Follows, fine> belongs{Follows::nothing, Follows::theta_h, Follows::theta_d,
                                            Follows::nothing, Follows::theta_h, Follows::theta_d,
                                            Follows::theta_d, Follows::grazing, Follows::grazing,
                                            Follows::grazing, Follows::theta_h, Follows::theta_h};

/// Values of these functions.  θ_h counts by its logarithm above 2°: highlights are narrow.
std::array<double, fine> functions(const Angles<double>& a) {
  const double theta_d = std::acos(std::clamp(a.voh, -1.0, 1.0));
  const double theta_h = std::asin(std::sqrt(std::clamp(a.sin2_theta_h, 0.0, 1.0)));
  const double h = std::log1p(theta_h / (2 * degree)) / 2;
  return {1,
          h,
          theta_d,
          h * theta_d,
          h * h,
          theta_d * theta_d,
          theta_d * theta_d * theta_d,
          a.nol + a.nov,
          a.nol * a.nov,
          1 / ((a.nol + 0.1) * (a.nov + 0.1)),
          h * h * h,
          h * h * h * h};
}

// ---- cells --------------------------------------------------------------------------------------

/// Cells of the residual map: five of the page's along each angle.
constexpr std::size_t rows = 9, columns = 6;
double row_edge(std::size_t k) {
  const double part = static_cast<double>(k) / rows;
  return 90 * part * part;
}
double column_edge(std::size_t k) {
  return 90.0 * static_cast<double>(k) / columns;
}
std::size_t cell_of(const Angles<double>& a) {
  const double theta_d = std::acos(std::clamp(a.voh, 0.0, 1.0)) / degree;
  const double theta_h = std::asin(std::sqrt(std::clamp(a.sin2_theta_h, 0.0, 1.0))) / degree;
  const auto place = [](double x, std::size_t n) {
    return std::min(static_cast<std::size_t>(x), n - 1);
  };
  return place(rows * std::sqrt(theta_h / 90), rows) * columns +
         place(columns * theta_d / 90, columns);
}

// ---- what is left of each value -----------------------------------------------------------------

/// One value of a thinned table, as a fit compares it.
struct Value {
  std::size_t unit, channel;
  double r;             ///< residual, clipped as the robust loss does
  double whole;         ///< before that
  double active;        ///< 1, or 0 where it is clipped; its weight while that settles
  double change;        ///< of the residual, by a relative change of f
  double slope;         ///< of the residual, by f, without the table's weights
  double rounding;      ///< of the residual, by what the datum's digits leave out
  double f;             ///< [1/sr]
  double variance = 0;  ///< of the residual, up to a factor
  std::array<double, max_columns> j{};  ///< derivatives by the unknowns of its channel
  std::size_t gain = 0;  ///< unknown of its incident angle's own scale, where there are such
};
/// One sample, or one incident angle of one cell: its values share their errors.
struct Unit {
  std::array<double, fine> functions;
  std::size_t cell, angle;
};

struct Left {
  std::vector<Value> values;
  std::vector<Unit> units;
  std::vector<std::vector<std::size_t>> unknowns;  ///< of each channel looked at
  std::size_t count = 0;                           ///< of the unknowns
  std::size_t angles = 0;
  std::size_t without_logarithm = 0;  ///< values of 0 where f is not
  bool robust = false;
};

Left left_over(const Sampling& s, const Problem& p, const Fitted& f) {
  const std::size_t stride = (s.channels() + most_channels - 1) / most_channels;
  const std::size_t looked_at = (s.channels() + stride - 1) / stride;
  Left all;
  ModelDerivatives<double> model(f.model.model, p.free.mask(), kernels<double>());
  model.set(f.model.values);
  double *const link = model.fresh(), *const slope = model.fresh();

  std::vector<std::vector<const double*>> derivatives;
  std::map<std::size_t, std::size_t> numbers;  // of the unknowns met
  for (std::size_t c = 0; c < s.channels(); c += stride) {
    auto& unknowns = all.unknowns.emplace_back();
    auto& of = derivatives.emplace_back();
    for (const auto& [slot, column] : model.channel(c).d) {
      unknowns.push_back(numbers.emplace(slot, numbers.size()).first->second);
      of.push_back(column);
    }
  }
  all.count = numbers.size();

  const bool grid_of_halves =
      s.table().grid() && s.table().grid()->kind == Grid::Kind::half_difference;
  const double finest = grid_of_halves ? 1 : 1000;  // angles of incidence told apart, in a degree
  std::map<long, std::size_t> angles;
  const auto offset = s.link_offset();
  const FileRounding rounding = rounding_of(s.table());
  const std::size_t members = s.groups().widest();
  const Tasks tasks(s, std::max<std::size_t>(most_values / (members * looked_at), 64),
                    BlockReader<double>::block);
  std::vector<std::size_t> unit_of;
  for (std::size_t k = 0; k < tasks.count; ++k) {
    BlockReader<double> in(s, tasks.first(k), tasks.last(k), tasks.step);
    while (in.next()) {
      const auto x = in.angles();
      unit_of.assign(members * in.size(), none);
      model.run(x, [&](std::size_t c) {
        if (c % stride != 0) return;
        const double* const value = model.channel(c).value;
        kernels<double>().link[static_cast<std::size_t>(link_of(s.metric()))](x.n, value, offset,
                                                                              link, slope);
        for (std::size_t m = 0; m < members; ++m) {
          const auto& data = in.values(m, c);
          for (std::size_t i = 0; i < in.size(); ++i) {
            const double w = data.weight[i];
            if (!(w > 0)) continue;
            const double weight = s.root_weight(in.sample(m)[i]);
            const double r = w * (link[i] - data.target[i]);
            // Below what the link tells apart f is as large as that; such a datum says nothing of
            // it.
            const bool faint = slope[i] == 0;
            const double f_seen = faint ? faintest : value[i],
                         slope_seen = faint ? 1 / faintest : slope[i];
            if (!std::isfinite(r) || !std::isfinite(slope_seen) || (faint && r == 0)) continue;
            auto& unit = unit_of[m * in.size() + i];
            if (unit == none) {
              unit = all.units.size();
              const Angles<double> a{x.nol[i], x.nov[i], x.noh[i], x.voh[i], x.sin2_theta_h[i]};
              const double theta_i = std::acos(std::clamp(in.nol(m)[i], 0.0, 1.0)) / degree;
              const long key = std::lround(theta_i * finest);
              all.units.push_back(
                  {functions(a), cell_of(a), angles.emplace(key, angles.size()).first->second});
            }
            auto& v = all.values.emplace_back();
            v.unit = unit;
            v.channel = c / stride;
            v.whole = r;
            v.r = std::clamp(r, -f.huber, f.huber);
            v.active = std::abs(r) <= f.huber ? 1 : 0;
            // By f where the metric divides by y: noise in both would follow itself.
            v.slope = s.metric() == Metric::relative ? 1 / (f_seen + s.offset())
                                                     : w / weight * slope_seen;
            v.change = w * slope_seen * f_seen;
            v.f = f_seen;
            all.without_logarithm += !(data.y[i] > 0) && value[i] > faintest;
            const double rounded = std::hypot(rounding.of(data.y[i]), arithmetic * data.y[i]);
            v.rounding =
                w * (link_of(s.metric()) == Link::log ? std::log1p(rounded / (data.y[i] + offset))
                                                      : rounded);
            const auto& of = derivatives[v.channel];
            for (std::size_t q = 0; q < of.size(); ++q) v.j[q] = w * slope[i] * of[q][i];
          }
        }
      });
    }
  }
  all.angles = angles.size();
  all.robust = p.options.robust;
  return all;
}

// ---- noise --------------------------------------------------------------------------------------

/// Noise is taken as the likelier of two: of one size in f, or in proportion to f; normal, or Cauchy's
/// for a robust fit, before anything is clipped.
/// \return  whether in proportion
bool find_variances(Left& left) {
  static constexpr double largest =
      1e150;  // whose square is finite: f may be next to nothing, or 0
  const auto sigma = [](const Value& v, std::size_t relative) {
    return std::clamp(v.slope * (relative ? v.f : 1), 1 / largest, largest);
  };
  const double n = static_cast<double>(left.values.size());
  const auto badness = [&](std::size_t relative) {
    double logs = 0, squares = 0;
    std::vector<double> sizes;
    for (const auto& v : left.values) {
      const double root = v.whole / sigma(v, relative);
      logs += 2 * std::log(sigma(v, relative));
      squares += root * root;
      if (left.robust) sizes.push_back(std::abs(root));
    }
    if (!left.robust) return logs + n * std::log(squares);
    if (sizes.empty()) return 0.0;
    const double scale = median(sizes);
    for (const double size : sizes) logs += 2 * std::log(scale + size / scale * size);
    return logs - n * std::log(scale * scale);
  };
  const bool relative = !(badness(0) < badness(1));
  for (auto& v : left.values) v.variance = sigma(v, relative) * sigma(v, relative);
  return relative;
}

/// Unknowns of their own for the scale of each channel under each incident angle, where there is room.
std::size_t add_gains(Left& left) {
  const std::size_t channels = left.unknowns.size(), gains = left.angles * channels;
  if (left.angles < 2 || 4 * left.angles > left.units.size() || left.count + gains > most_gains)
    return 0;
  for (auto& v : left.values) v.gain = left.count + left.units[v.unit].angle * channels + v.channel;
  left.count += gains;
  return gains;
}

/// Pseudoinverse of a positive semidefinite matrix, and its rank.
struct Inverse {
  Matrix inverse;
  std::size_t rank = 0;
  explicit Inverse(const Matrix& a) : inverse(a) {
    if (a.size() == 0) return;  // nothing is free
    const Vector scale =
        a.diagonal().unaryExpr([](double d) { return d > 0 ? 1 / std::sqrt(d) : 0; });
    const Eigen::SelfAdjointEigenSolver<Matrix> eigen(scale.asDiagonal() * a * scale.asDiagonal());
    const Vector roots =
        eigen.eigenvalues().unaryExpr([](double l) { return l > 1e-10 ? 1 / std::sqrt(l) : 0; });
    const Matrix half = scale.asDiagonal() * eigen.eigenvectors() * roots.asDiagonal();
    inverse = half * half.transpose();
    rank = static_cast<std::size_t>((roots.array() > 0).count());
  }
};

// ---- regression ---------------------------------------------------------------------------------

/// Probability of so large an F by luck.
double luck(double f, double of, double freedom) {
  if (!(f > 0)) return 1;
  return boost::math::cdf(boost::math::complement(boost::math::fisher_f(of, freedom), f));
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
      : width_(width), sums_(units * width), seen_(units) {}
  double* of(std::size_t unit) {
    seen_[unit] = true;
    return sums_.data() + unit * width_;
  }
  std::size_t count() const { return static_cast<std::size_t>(std::ranges::count(seen_, true)); }
  Eigen::Map<const Vector> at(std::size_t k) const {
    return Eigen::Map<const Vector>(sums_.data() + k * width_, index(width_));
  }
  Vector sum() const {
    Vector u = Vector::Zero(index(width_));
    for (std::size_t k = 0; k < seen_.size(); ++k) u += at(k);
    return u;
  }
  Matrix squares() const {
    Matrix m = Matrix::Zero(index(width_), index(width_));
    for (std::size_t k = 0; k < seen_.size(); ++k)
      if (seen_[k]) m.selfadjointView<Eigen::Lower>().rankUpdate(at(k));
    return m.selfadjointView<Eigen::Lower>();
  }

 private:
  std::size_t width_;
  std::vector<double> sums_;
  std::vector<bool> seen_;
};

/// What the regressions find, in units of the values' own variance.
struct Regression {
  bool tested = false;
  double p = 1;
  double excess = 0;                           ///< squares of the misfit beyond noise
  double noise = 0;                            ///< squares that noise makes in as many directions
  double functions = 0;                        ///< these directions
  double size = 0;                             ///< RMS of the misfit, of f
  double rounding = 0;                         ///< RMS of what rounding leaves, of f
  bool rounded = false;                        ///< whether little else is left
  std::array<double, names.size()> follows{};  ///< squares that each angle's functions explain
  std::optional<MisfitCell> worst;
};

/// Residuals projected: what is left when the unknowns are moved to where these scores are 0, and the
/// functions without what unknowns could take up.
class Projected {
 public:
  Projected(const Left& left, std::size_t width, bool gains)
      : left_(left), width_(width), gains_(gains) {
    const auto n = index(left.count), q = index(width);
    Matrix a = Matrix::Zero(n, n), c = Matrix::Zero(n, q);
    Vector g = Vector::Zero(n);
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
    functions_ = (inverse_ * c).transpose();
    step_ = inverse_ * g;
  }
  std::size_t rank() const { return rank_; }
  const Matrix& inverse() const { return inverse_; }
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
  Matrix inverse_, functions_;
  Vector step_;
};

/// Cells, each one function of its own: 1 in it and 0 elsewhere, projected as the smooth ones are.  The
/// worst is the one that is furthest off for what noise does to it.
void find_worst_cell(const Left& left,
                     const Projected& projected,
                     const std::vector<double>& r,
                     bool shared,
                     double variance,
                     Regression& out) {
  constexpr std::size_t cells = rows * columns;
  const auto n = index(left.count);
  struct Cell {
    double sum = 0, weight = 0, squares = 0;
    Vector with_function, with_change, with_score;  ///< products with the derivatives
    std::size_t values = 0, scores = 0;
  };
  std::array<Cell, cells> all;
  for (auto& c : all) c.with_function = c.with_change = c.with_score = Vector::Zero(n);
  const std::size_t units = shared ? left.angles : left.units.size();
  Scores moves(units, left.count);  // Σ j r
  std::vector<std::pair<std::size_t, double>> scores(units * (shared ? cells : 1));
  for (std::size_t i = 0; i < left.values.size(); ++i) {
    const auto& v = left.values[i];
    const auto& unit = left.units[v.unit];
    auto& cell = all[unit.cell];
    const double function = v.change / v.variance;
    cell.sum += function * r[i];
    cell.weight += v.active * function * v.change;
    ++cell.values;
    const std::size_t of = shared ? unit.angle : v.unit;
    auto& [count, score] = scores[shared ? of * cells + unit.cell : of];
    ++count;
    score += function * r[i];
    double* const move = moves.of(of);
    projected.each(v, [&](Eigen::Index k, double j) {
      move[k] += j * r[i];
      cell.with_function[k] += v.active * function * j;
      cell.with_change[k] += v.active * v.change * j;
    });
  }
  for (std::size_t k = 0; k < scores.size(); ++k) {
    if (scores[k].first == 0) continue;
    const std::size_t of = shared ? k / cells : k;
    auto& cell = all[shared ? k % cells : left.units[k].cell];
    cell.squares += scores[k].second * scores[k].second;
    cell.with_score += scores[k].second * moves.at(of);
    ++cell.scores;
  }
  const Matrix move_squares = moves.squares();
  constexpr std::size_t few = 3, enough = 20;
  double tested = 0, least = 1, furthest = 0, squares = 0, weights = 0;
  for (std::size_t k = 0; k < cells; ++k) {
    const Cell& c = all[k];
    const Vector taken_up = projected.inverse() * c.with_function;
    const double weight = c.weight - taken_up.dot(c.with_change);
    const double noise =
        c.squares - 2 * taken_up.dot(c.with_score) + taken_up.dot(move_squares * taken_up);
    if (c.scores < few || !(weight > 0.05 * c.weight) || !(noise > 1e-9 * c.squares)) continue;
    const double square = c.sum * c.sum, scored = static_cast<double>(c.scores);
    if (c.scores >= enough) {
      ++tested;
      least = std::min(least, luck_of_scores(square / noise, 1, scored));
    }
    squares += std::max(0.0, (square - noise) / weight);
    weights += weight;
    const double distance = square / std::max(noise, weight * variance);
    if (distance <= furthest) continue;
    furthest = distance;
    out.worst = {row_edge(k / columns),
                 row_edge(k / columns + 1),
                 column_edge(k % columns),
                 column_edge(k % columns + 1),
                 c.values,
                 c.sum / weight};
  }
  if (tested > 0) out.p = std::min(1.0, 2 * std::min(out.p, least * tested));
  if (weights > 0) out.size = std::max(out.size, std::sqrt(squares / weights));
}

/// True where little else is left than rounding: of all values together, and of each by its own, lest one
/// whose digits say little hides what others miss by far.
bool only_rounded(const std::vector<Value>& values) {
  constexpr double most = 4;  // squares, of those of rounding
  constexpr double clipped = 100;
  double squares = 0, rounded = 0, own = 0;
  for (const auto& v : values) {
    const double square = v.r * v.r, by_rounding = v.rounding * v.rounding;
    squares += square;
    rounded += by_rounding;
    own += square > clipped * by_rounding ? clipped : square > 0 ? square / by_rounding : 0;
  }
  return squares <= most * rounded && own <= most * static_cast<double>(values.size());
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

Regression regress(Left& left, bool shared, bool gains) {
  Regression out;
  find_variances(left);
  if (gains) gains = add_gains(left) > 0;
  if (gains && left.robust) settle(left);
  const std::size_t units = left.units.size();
  const double n = static_cast<double>(left.values.size());
  double rounded = 0, changes = 0;
  for (const auto& v : left.values) {
    rounded += v.rounding * v.rounding;
    changes += v.change * v.change;
  }
  out.rounding = std::sqrt(rounded / changes);
  out.rounded = only_rounded(left.values);
  if (out.rounded) return out;

  const std::size_t width = units >= 500 ? fine : smooth;
  const Projected projected(left, width, gains);
  const auto q = index(width);
  Scores scores(shared ? left.angles : units, width);
  std::vector<double> r(left.values.size()), of_unit(units), z(width);
  Matrix noise = Matrix::Zero(q, q);  // of the scores, if the variances are right
  Vector length = Vector::Zero(q);    // of each function before its projection
  double chi = 0, weight = 0;
  for (std::size_t i = 0; i < left.values.size(); ++i) {
    const auto& v = left.values[i];
    const auto& unit = left.units[v.unit];
    r[i] = projected.residual(v);
    projected.functions(v, z.data());
    double* const sum = scores.of(shared ? unit.angle : v.unit);
    for (std::size_t k = 0; k < width; ++k) sum[k] += z[k] * r[i];
    const Eigen::Map<const Vector> of(z.data(), q);
    noise.selfadjointView<Eigen::Lower>().rankUpdate(of, v.variance);
    const double whole = v.change * v.change / v.variance;
    for (std::size_t k = 0; k < width; ++k)
      length[index(k)] += whole * unit.functions[k] * unit.functions[k];
    chi += r[i] * r[i] / v.variance;
    of_unit[v.unit] += r[i] / std::sqrt(v.variance);
    weight += v.active * whole;
  }
  noise = Matrix(noise.selfadjointView<Eigen::Lower>());
  double common = 0;  // channels of a sample that share their errors count less
  for (const double x : of_unit) common += x * x;
  common = std::max(1.0, common / chi);
  const double freedom = n / common - static_cast<double>(projected.rank());
  const double independent = static_cast<double>(scores.count());
  const double most = shared ? (independent - 2) / 3 : freedom / 4;
  if (!(most >= 1)) return out;
  const double variance = chi / (n - static_cast<double>(projected.rank()));

  // Functions of unit variance, the best visible ones first.
  const Vector scale = length.unaryExpr([](double l) { return l > 0 ? 1 / std::sqrt(l) : 0; });
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(scale.asDiagonal() * noise *
                                                    scale.asDiagonal());
  Eigen::Index kept = 0;
  while (kept < q && static_cast<double>(kept + 1) <= most &&
         eigen.eigenvalues()[q - 1 - kept] > 1e-6)
    ++kept;
  if (kept == 0) return out;
  const Matrix t = scale.asDiagonal() * eigen.eigenvectors().rightCols(kept) *
                   eigen.eigenvalues().tail(kept).cwiseSqrt().cwiseInverse().asDiagonal();
  const Vector sum = scores.sum(), u = t.transpose() * sum;
  const double of = static_cast<double>(kept);
  const Matrix meat = t.transpose() * scores.squares() * t;
  out.tested = true;
  out.functions = of;
  if (shared || independent >= many * of) {
    out.p = luck_of_scores(u.dot(Inverse(meat).inverse * u), of, independent);
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
    out.follows[g] = sum(own).dot(Inverse(noise(own, own)).inverse * Vector(sum(own)));
  }
  find_worst_cell(left, projected, r, shared, variance, out);
  return out;
}

}  // namespace

LackOfFit lack_of_fit(
    const Sampling& s, const Problem& p, const Fitted& f, std::size_t values_used, bool shared) {
  LackOfFit found;
  Misfit& m = found.misfit;
  bool by_logarithms = s.metric() == Metric::log;
  Left left = left_over(s, p, f);
  if (!by_logarithms && p.free.size() > 0 && !only_rounded(left.values) && find_variances(left) &&
      100 * left.without_logarithm <= left.values.size()) {
    // Whose squares weigh such noise unequally the highlight alone determines the parameters, whose
    // errors move faint values by far more than these are wrong: and none of that is a misfit.
    const Sampling logs = s.by(Metric::log, p.offset);
    left = left_over(logs, p, compared_by(logs, p, scan_samples, f));
    by_logarithms = true;
  }
  const std::size_t looked_at = left.values.size();
  const bool measured = !s.table().truth && p.options.intervals != Intervals::independent &&
                        p.options.intervals != Intervals::by_angle;
  const Regression r = regress(left, shared, measured && !shared);
  if (!r.tested) {
    m.note = r.rounded ? "what is left is no more than the values' own rounding"
             : shared  ? "the incident angles, whose values share errors, are too few to tell"
                       : "the values are too few to tell";
    return found;
  }
  m.tested = true;
  m.p = r.p;
  m.worst_cell = r.worst;
  if (auto& cell = m.worst_cell) {  // of the data, where it was of f
    const double off = cell->difference;
    cell->difference = by_logarithms ? std::expm1(off) : off / (1 - std::min(off, 0.99));
  }
  m.size = r.size;
  const double most = std::ranges::max(r.follows);
  for (std::size_t g = 1; g < names.size(); ++g)
    if (r.follows[g] > 0.5 * most) m.follows.emplace_back(names[g]);
  // Of all values, noise is as much less as there are more of them than were looked at; what values
  // share is not.
  const double more =
      shared ? 1 : std::max(1.0, static_cast<double>(values_used) / static_cast<double>(looked_at));
  const double excess = r.excess / r.noise * more;
  m.told = r.p < significant && r.size > r.rounding &&
           (r.size > worth_telling || excess > of_an_interval);
  if (m.told) found.widening = std::sqrt(1 + 16 * excess);
  return found;
}

void widen(Uncertainty& u, const LackOfFit& l, std::span<const double> seen_against) {
  for (std::size_t i = 0; i < u.std_error.size(); ++i) {
    double& e = u.std_error[i];
    const double base = std::isnan(seen_against[i]) ? e : seen_against[i];
    const double wider = std::hypot(e, std::sqrt(l.widening * l.widening - 1) * base);
    u.variance[i] *= wider * wider / (e * e);
    e = wider;
  }
}

}  // namespace gonio
