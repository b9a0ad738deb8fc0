#include "integrate/scattering/half_space.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "brdf/catalogue/registry.h"
#include "integrate/albedo/directional_albedo.h"
#include "integrate/rule/quadrature.h"
#include "integrate/rule/slopes.h"
#include "integrate/scattering/azimuth_integral.h"
#include "integrate/scattering/microsurface.h"

#include <Eigen/Core>
#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace gonio {
namespace {

using Eigen::Index;
using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

/// One lobe, by itself, and those of its channels that differ.
struct LitSurface {
  BoundModel model;
  Facets facets;                      ///< by distinct channel
  std::size_t masking;                ///< a term of catalogue()
  std::vector<std::size_t> channel;   ///< of the model's the first, by distinct channel
  std::vector<std::size_t> distinct;  ///< by channel of the model
};

std::vector<LitSurface> lit_surfaces(const BoundModel& whole) {
  std::vector<LitSurface> surfaces;
  const auto micro = microsurfaces(whole);
  for (std::size_t l = 0; l < micro.size(); ++l) {
    const auto& m = micro[l];
    if (m.alpha_x != m.alpha_y)
      throw wrong_usage(fmt::format(
          "'{}' has the widths {} and {}: the deterministic solution is for isotropic surfaces, a "
          "walk takes both",
          to_text(whole.model.spec), m.alpha_x, m.alpha_y));
    const std::size_t masking =
        find_term(m.slopes == Microsurface::Slopes::ggx ? "masking.smith_ggx.correlated"
                                                        : "masking.smith_beckmann.correlated");
    LitSurface s{whole, {m.slopes, m.alpha_x, m.fresnel.term, {}}, masking, {}, {}};
    s.model.model.diffuse.clear();
    s.model.model.lobes = {whole.model.lobes[l]};
    auto& parameters = s.facets.parameters;
    for (std::size_t c = 0; c < whole.model.channels; ++c) {
      const auto p = term_parameters(whole, m.fresnel, c);
      const auto known = std::ranges::find(parameters, p);
      s.distinct.push_back(static_cast<std::size_t>(known - parameters.begin()));
      if (known != parameters.end()) continue;
      parameters.push_back(p);
      s.channel.push_back(c);
    }
    if (parameters.size() == 1) s.model.model.channels = 1;
    surfaces.push_back(std::move(s));
  }
  return surfaces;
}

/// Width α below which the peak is narrower than nodes far above the horizon are apart.
constexpr double narrow = 0.02;

/// Ends of the panels, elevations from 0 to π/2.  Steps are as long as the way from the horizon until they
/// see the peak, 4 α, and far above it half as long: there is then little left to scatter twice.
std::vector<double> panels(double alpha, std::span<const double> mu) {
  double first = std::min(alpha, 0.001);
  for (const double m : mu) first = std::min(first, std::max(m, 1e-6));
  constexpr double end = std::numbers::pi / 2, longest = 0.4;
  std::vector<double> ends{0};
  for (double s = first; s < end; s += std::min({s, std::max(4 * alpha, s / 2), longest}))
    ends.push_back(s);
  if (end - ends.back() < 0.1) ends.pop_back();
  ends.push_back(end);
  return ends;
}

/// Rows of the equation: first the nodes, panel by panel, then further cosines.
struct Grid {
  std::vector<double> ends;
  std::vector<Node> gauss;
  struct Row {
    Zenith zenith;
    std::size_t panel;
    double x;  ///< within the panel, 0 to 1
  };
  std::vector<Row> rows;
  std::vector<double> length;  ///< ∫ dμ, by node

  Grid(const std::vector<double>& panel_ends, int per_panel, std::span<const double> further)
      : ends(panel_ends), gauss(gauss_legendre(per_panel)) {
    for (std::size_t k = 0; k + 1 < ends.size(); ++k)
      for (const auto& g : gauss) {
        rows.push_back({zenith(k, g.x), k, g.x});
        length.push_back(g.weight * width(k) * rows.back().zenith.sine);
      }
    for (const double mu : further) {
      const double s = std::asin(mu);
      const auto above = std::upper_bound(ends.begin() + 1, ends.end() - 1, s);
      const auto k = static_cast<std::size_t>(above - ends.begin()) - 1;
      rows.push_back({{mu, std::sqrt((1 - mu) * (1 + mu))}, k, (s - ends[k]) / width(k)});
    }
  }
  std::size_t nodes() const { return length.size(); }
  double width(std::size_t panel) const { return ends[panel + 1] - ends[panel]; }
  Zenith zenith(std::size_t panel, double x) const {
    const double s = ends[panel] + width(panel) * x;
    return {std::sin(s), std::cos(s)};
  }
  /// The node's polynomial: 1 there, 0 at the others of its panel.
  double lagrange(std::size_t node, double x) const {
    double product = 1;
    for (std::size_t k = 0; k < gauss.size(); ++k)
      if (k != node) product *= (x - gauss[k].x) / (gauss[node].x - gauss[k].x);
    return product;
  }
};

/// The equation over a grid: a row of each matrix for a row of the grid, a column for a node.
struct Discrete {
  struct Channel {
    Matrix first;  ///< f of the first order
    Matrix turn;   ///< ∫ K(−u, o)/o f(u) du = Σ turn f; u of the same panel and those below
  };
  Matrix g2;
  std::vector<Channel> channels;
  Vector cosine;  ///< ∫ f μ dμ = Σ cosine f
};

/// Writes the rows, one after the other.
class RowWriter {
 public:
  RowWriter(const LitSurface& s, const Grid& grid, int azimuths, Discrete& d)
      : s_(s), grid_(grid), integral_(s.facets, azimuths), d_(d) {}

  void operator()(std::size_t row) {
    write_first(row);
    write_turn(row);
  }

 private:
  static Index index(std::size_t i) { return static_cast<Index>(i); }

  /// Also G₂.  Both are symmetric: of the nodes, half.
  void write_first(std::size_t row) {
    const Zenith& o = grid_.rows[row].zenith;
    const std::size_t n = std::min(row + 1, grid_.nodes());
    const auto x = block_.resize(n);
    for (std::size_t j = 0; j < n; ++j) {
      x[0][j] = grid_.rows[j].zenith.cosine;
      x[1][j] = o.cosine;
    }
    const double* const v = block_.extra(0);
    term_values(s_.masking, {&s_.facets.alpha, 1}, block_.block(), block_.extra(0));
    in_.clear();
    for (std::size_t j = 0; j < n; ++j) in_.push_back(grid_.rows[j].zenith);
    integral_(in_, o, k_);
    for (std::size_t j = 0; j < n; ++j) {
      d_.g2(index(row), index(j)) = 4 * v[j] * in_[j].cosine * o.cosine;
      for (std::size_t c = 0; c < k_.size(); ++c)
        d_.channels[c].first(index(row), index(j)) = 4 * v[j] * k_[c][j];
    }
  }

  void write_turn(std::size_t row) {
    const auto& [o, panel, end] = grid_.rows[row];
    const std::size_t p = grid_.gauss.size(), below = panel * p;
    in_.clear();
    const auto down = [&](const Zenith& u) { in_.push_back({-u.cosine, u.sine}); };
    for (std::size_t j = 0; j < below; ++j) down(grid_.rows[j].zenith);
    for (const auto& g : grid_.gauss) down(grid_.zenith(panel, end * g.x));
    integral_(in_, o, k_);
    for (std::size_t c = 0; c < k_.size(); ++c) {
      auto turn = d_.channels[c].turn.row(index(row));
      for (std::size_t j = 0; j < below; ++j)
        turn[index(j)] = k_[c][j] * grid_.length[j] / o.cosine;
      for (std::size_t q = 0; q < p; ++q) {
        const auto& g = grid_.gauss[q];
        const double length = g.weight * end * grid_.width(panel) * in_[below + q].sine;
        for (std::size_t j = 0; j < p; ++j)
          turn[index(below + j)] +=
              k_[c][below + q] * length / o.cosine * grid_.lagrange(j, end * g.x);
      }
    }
  }

  const LitSurface& s_;
  const Grid& grid_;
  AzimuthIntegral integral_;
  Discrete& d_;
  AngleBlock block_{false};
  std::vector<Zenith> in_;
  std::vector<std::vector<double>> k_;
};

/// The rest of the first order's E, which the nodes miss or see twice, is the peak's: it is taken to lie at o = i.
void put_peak(const Grid& grid, const Vector& single, const Vector& cosine, Matrix& first) {
  const std::size_t p = grid.gauss.size();
  const Vector missed = single - first * cosine;
  for (std::size_t i = 0; i < grid.rows.size(); ++i)
    for (std::size_t j = 0; j < p; ++j) {
      const auto column = static_cast<Index>(grid.rows[i].panel * p + j),
                 row = static_cast<Index>(i);
      first(row, column) += missed[row] / cosine[column] * grid.lagrange(j, grid.rows[i].x);
    }
}

/// E of each order at the further rows of the grid, and its average below them: two at least, which is
/// what those after them are judged by.
///
/// 1. f of half_space.h is the sum of orders fₙ, each the one before put under the integrals:
///
///       fₙ₊₁(o, i) = G₂(o, i) ( ∫₀ᵒ K(−u, o)/o fₙ(u, i) du + ∫₀ⁱ fₙ(o, d) K(−d, i)/i dd )
///
/// 2. Over the nodes, T(o, u) being K(−u, o)/o times the length of node u (Channel::turn), the first integral is
///    Σᵤ T(o, u) Fₙ(u, i) = (T Fₙ)(o, i), the second Σ_d Fₙ(o, d) T(i, d) = (Fₙ Tᵀ)(o, i):
///
///       ┌──────────────────────────────────────────────┐
///       │  Fₙ₊₁ = G₂ ∘ (T Fₙ + Fₙ Tᵀ)   ∘ by elements  │
///       └──────────────────────────────────────────────┘
///
/// 3. Light only climbs: u ≤ o.  T(o, u) is 0 where u's panel lies above o's, so T is triangular in blocks of p
///    nodes, a panel each, and rows [k, k + p) of T Fₙ are T's block of k + p columns times the first k + p rows
///    of Fₙ; columns of Fₙ Tᵀ likewise.  That is half of the multiplications.
///
/// 4. Rows of further cosines are evaluated as the nodes' are, but are no columns: their T Fₙ takes all nodes.
std::vector<Vector> orders(const Grid& grid, const Discrete& d, std::size_t c, double least) {
  const auto p = static_cast<Index>(grid.gauss.size());
  const auto nodes = static_cast<Index>(grid.nodes()), further = d.g2.rows() - nodes;
  const Matrix& turn = d.channels[c].turn;
  Matrix f = d.channels[c].first, next(f.rows(), f.cols());
  std::vector<Vector> all;
  while (true) {
    const Vector e =
        (f * d.cosine).cwiseMax(0);  // where there is nothing, polynomials leave −1e-25
    all.emplace_back(further + 1);
    all.back() << e.tail(further), 2 * d.cosine.dot(e.head(nodes));
    if (all.size() > 1 && !(all.back().maxCoeff() > least)) return all;
    next.bottomRows(further).noalias() = turn.bottomRows(further) * f.topRows(nodes);
    for (Index k = 0; k < nodes; k += p)
      next.middleRows(k, p).noalias() = turn.block(k, 0, p, k + p) * f.topRows(k + p);
    for (Index k = 0; k < nodes; k += p)
      next.middleCols(k, p).noalias() += f.leftCols(k + p) * turn.block(k, 0, p, k + p).transpose();
    f = next.cwiseProduct(d.g2);
  }
}

/// By order, E at the cosines asked for, at the ends of panels, and last the average.
struct Solution {
  std::vector<std::vector<Vector>> orders;  ///< by distinct channel
  double error = 0;                         ///< of the first order

  Vector total(std::size_t channel) const {
    const auto& all = orders[channel];
    Vector sum = Vector::Zero(all.front().size());
    for (const auto& e : all) sum += e;
    return sum;
  }
};

struct Fineness {
  int per_panel, azimuths;
};
constexpr Fineness finenesses[] = {{6, 16}, {8, 24}, {12, 32}, {16, 48}};

Solution solve(const LitSurface& s,
               std::span<const double> mu,
               const std::vector<double>& ends,
               const Fineness& fineness,
               double error) {
  std::vector<double> further(mu.begin(), mu.end());
  for (const double end : std::span(ends).subspan(1)) further.push_back(std::sin(end));
  const Grid grid(ends, fineness.per_panel, further);

  std::vector<double> cosines;
  for (const auto& r : grid.rows) cosines.push_back(r.zenith.cosine);
  const auto single = directional_albedo(s.model, cosines, 0, {error / 10, Goal{}.evaluations});

  const auto rows = static_cast<Index>(grid.rows.size());
  const auto columns = static_cast<Index>(grid.nodes());
  Discrete d{Matrix(rows, columns), {}, Vector(columns)};
  d.channels.assign(s.facets.parameters.size(),
                    {Matrix(rows, columns), Matrix::Zero(rows, columns)});
  for (std::size_t j = 0; j < grid.nodes(); ++j)
    d.cosine[static_cast<Index>(j)] = grid.length[j] * cosines[j];
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, grid.rows.size()), [&](const auto& range) {
    RowWriter write(s, grid, fineness.azimuths, d);
    for (auto r = range.begin(); r < range.end(); ++r) write(r);
  });
  const auto mirror = [&](Matrix& m) {
    for (Index j = 0; j < columns; ++j)
      for (Index i = 0; i < j; ++i) m(i, j) = m(j, i);
  };
  mirror(d.g2);

  Solution solution;
  for (const auto& a : single) solution.error = std::max(solution.error, a.error);
  for (std::size_t c = 0; c < s.facets.parameters.size(); ++c) {
    Matrix& first = d.channels[c].first;
    mirror(first);
    const auto known = [&](Index i) {
      return single[static_cast<std::size_t>(i)].value[s.channel[c]];
    };
    put_peak(grid, Vector::NullaryExpr(rows, known), d.cosine, first);
    solution.orders.push_back(orders(grid, d, c, std::min(error / 100, 1e-3)));
  }
  return solution;
}

/// Sum of a geometric series after its last two; the orders fall faster.
double after(const std::vector<Vector>& orders, Index i) {
  if (orders.size() < 2) return 0;
  const double last = orders.back()[i], before = orders[orders.size() - 2][i];
  const double ratio = last < before ? last / before : 1;
  return last * ratio / std::max(1 - ratio, 0.01);
}

void add(const std::vector<Vector>& orders, Index i, double error, std::size_t c, Scattered& to) {
  const double rest = after(orders, i);
  auto& by_order = to.order[c];
  by_order.resize(std::max(by_order.size(), orders.size()), 0);
  for (std::size_t n = 0; n < orders.size(); ++n) {
    by_order[n] += orders[n][i];
    to.albedo[c] += orders[n][i];
  }
  to.rest[c] += rest;
  to.error[c] += error + rest;
}

void add(const LitSurface& s, std::span<const double> mu, double error, HalfSpace& to) {
  const auto ends = panels(s.facets.alpha, mu);
  Solution finer = solve(s, mu, ends, finenesses[0], error);
  std::vector<double> change(s.facets.parameters.size());
  // A narrow peak lies near a node or between two by chance; of Beckmann, where nothing is
  // scattered twice.
  const bool seen = s.facets.alpha >= narrow || s.facets.slopes == Microsurface::Slopes::beckmann;
  const double least = seen ? 0 : 5e-7;
  for (const auto& fineness : std::span(finenesses).subspan(1)) {
    const Solution coarser = std::move(finer);
    finer = solve(s, mu, ends, fineness, error);
    for (std::size_t c = 0; c < change.size(); ++c)
      change[c] = std::max(2 * (finer.total(c) - coarser.total(c)).cwiseAbs().maxCoeff(), least);
    if (std::ranges::max(change) < 0.8 * error) break;
  }
  for (std::size_t c = 0; c < s.distinct.size(); ++c) {
    const auto& orders = finer.orders[s.distinct[c]];
    const double e = change[s.distinct[c]] + finer.error;
    for (std::size_t i = 0; i < mu.size(); ++i) add(orders, static_cast<Index>(i), e, c, to.at[i]);
    add(orders, orders.front().size() - 1, e, c, to.average);
  }
}

}  // namespace

HalfSpace half_space(const BoundModel& model, std::span<const double> mu, double error) {
  const auto surfaces = lit_surfaces(model);
  const std::size_t n = model.model.channels;
  const std::vector<double> zero(n);
  const Scattered none{zero, zero, std::vector<std::vector<double>>(n), zero, {}, 0};
  HalfSpace result{std::vector<Scattered>(mu.size(), none), none};
  for (const auto& s : surfaces) add(s, mu, error / static_cast<double>(surfaces.size()), result);
  return result;
}

}  // namespace gonio
