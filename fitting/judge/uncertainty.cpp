#include "fitting/judge/uncertainty.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>
#include <string>

#include "fitting/judge/arrow_inverse.h"
#include "number/distributions.h"

#include <fmt/format.h>

namespace gonio {
namespace {

constexpr double singular = 1e-11;  ///< eigenvalues of the scaled bread below it are rounding

/// Unknowns of a singular direction of the bread: those that have a part of it worth mentioning.
std::vector<bool> in_singular_directions(const ArrowRoot& root,
                                         const ArrowLayout& layout,
                                         double least) {
  std::vector<bool> lost(layout.size());
  const auto mark = [&](const std::vector<std::size_t>& unknowns, const Eigen::VectorXd& direction,
                        double largest) {
    for (std::size_t k = 0; k < unknowns.size(); ++k)
      if (std::abs(direction[static_cast<Eigen::Index>(k)]) > 0.1 * largest)
        lost[unknowns[k]] = true;
  };
  for (std::size_t a = 0; a < root.arms().size(); ++a) {
    const auto& arm = root.arms()[a];
    for (Eigen::Index e = 0; e < arm.eigenvalues.size(); ++e)
      if (arm.eigenvalues[e] < least)
        mark(layout.arms()[a], arm.eigenvectors.col(e),
             arm.eigenvectors.col(e).cwiseAbs().maxCoeff());
  }
  // A direction w of the head takes the arms along, −D_c⁻¹ B_c w of them.
  for (Eigen::Index e = 0; e < root.head().values.size(); ++e) {
    const Eigen::VectorXd w = root.head().vectors.col(e);
    double squares = 1, largest = w.cwiseAbs().maxCoeff();
    std::vector<Eigen::VectorXd> along;
    for (const auto& arm : root.arms()) {
      along.push_back(times(arm.eigenvectors, arm.root.cwiseProduct(times(arm.w, w))));
      squares += along.back().squaredNorm();
      largest = std::max(largest, along.back().cwiseAbs().maxCoeff());
    }
    if (!(root.head().values[e] / squares < least)) continue;
    mark(layout.head(), w, largest);
    for (std::size_t a = 0; a < along.size(); ++a) mark(layout.arms()[a], along[a], largest);
  }
  return lost;
}

/// Covariances of the determined unknowns, and the degrees of freedom of each; NaN where there is none.
class Covariance {
 public:
  double operator()(std::size_t i, std::size_t j) const {
    if (sandwich_) return (*sandwich_)(i, j);
    double sum = 0;
    for (const auto& m : moves_) sum += m[i] * m[j];
    return sum;
  }
  double freedom(std::size_t i) const { return freedom_[i]; }

  // Values that are independent, the sandwich.
  //
  // 1. A value's score is s = ρ' r ∂r/∂x; the best x makes Σ s = 0.
  // 2. About the true x*, Σ s(x) = S + B (x − x*) but for squares, with S = Σ s(x*) and the bread
  //    B = Σ j jᵀ over what is not clipped: x − x* = −B⁻¹ S.
  // 3. The mean of S is 0, so the covariance of x is B⁻¹ ⟨S Sᵀ⟩ B⁻¹, and ⟨S Sᵀ⟩ is Σ ⟨s sᵀ⟩.
  // 4. Residuals of the best x are smaller than those of x*, the more so the higher the value's
  //    leverage h = jᵀ B⁻¹ j is: a fit without the value leaves r/(1 − h) there.  With that the
  //    covariance is the jackknife's, the sum over x's moves when one value is left out.
  //
  //    ┌──────────────────────────────────────────┐
  //    │  cov x = B⁻¹ (Σ s sᵀ/(1 − h)²) B⁻¹  (HC3) │
  //    └──────────────────────────────────────────┘
  //
  // Its degrees of freedom, one unknown x_k.
  //
  // 5. If all errors were alike the variance of x_k would be (B⁻¹)_kk = Σ b², b = (B⁻¹ j)_k over
  // the
  //    values: share β² = b²/(B⁻¹)_kk is from one value, and the shares add up to 1.
  // 6. The estimate is V = Σ β² e² of normal errors e, whose mean is 1 and whose variance is 2 Σ
  // β⁴.
  //    χ²_ν/ν has the mean 1 and the variance 2/ν [Satterthwaite 1946].
  //
  // 7. Errors are not alike, and few values may make most of V whatever their shares: v = β² e²
  // itself
  //    tells.  Of normal errors Σ v² is about 3 Σ β⁴ ⟨e²⟩², so 3 (Σ v)²/Σ v² is an estimate of ν
  //    too, and knows of errors that the shares do not.
  //
  //    ┌──────────────────────────────────────────────────┐
  //    │  ν_k = min(1/Σ β⁴, 3 (Σ v)²/Σ v²), at most N − p │
  //    └──────────────────────────────────────────────────┘
  //
  //    It is N where all values have the same share, and 1 where one has all of it.
  Covariance(const Sandwich& s,
             const std::vector<std::size_t>& unknowns,
             std::shared_ptr<const ArrowLayout> layout,
             const ArrowInverse& bread,
             double values) {
    const double left = values - static_cast<double>(unknowns.size());
    for (const std::size_t i : unknowns) {
      constexpr double some = 0.01;  // of the variance
      const bool alone = !s.alone.empty() && s.alone[i] > some;
      freedom_.push_back(alone || left < 1 ? not_known : left);
    }
    sandwich_.emplace(bread, s.meat.part(std::move(layout), unknowns));
    for (std::size_t k = 0; k < s.fourth.size() && k < unknowns.size(); ++k) {
      const double variance = (*sandwich_)(k, k) / bread(k, k);
      bound(k, s.fourth[unknowns[k]], variance * variance, s.moves[unknowns[k]]);
    }
  }

  // Clusters, within which nothing is assumed of the errors.
  //
  // 8. A cluster g has the score S_g = Σ s and the part B_g = Σ j jᵀ of the bread.  Without it the
  //    bread is B − B_g and the gradient −S_g: x moves by d_g = (B − B_g)⁻¹ S_g.
  //
  //    ┌─────────────────────────────────────┐
  //    │  cov x = Σ d_g d_gᵀ,                │
  //    │  β_g² = (B⁻¹ B_g B⁻¹)_kk/(B⁻¹)_kk,  │
  //    │  v_g = (d_g)_k²,  ν_k ≤ G − 1       │
  //    └─────────────────────────────────────┘
  //
  //    One value a cluster makes this what stands above.
  Covariance(const Sandwich& s,
             const std::vector<std::size_t>& unknowns,
             const std::shared_ptr<const ArrowLayout>& layout,
             const ArrowInverse& bread) {
    const std::size_t n = unknowns.size();
    std::vector<double> shares(n);
    std::vector<bool> alone(n);
    const ArrowMatrix all = s.bread.part(layout, unknowns);
    for (const auto& g : s.clusters) {
      const ArrowMatrix own = g.bread.part(layout, unknowns);
      const ArrowInverse::Sandwich product(bread, own);
      for (std::size_t k = 0; k < n; ++k) {
        const double share = product(k, k) / bread(k, k);
        shares[k] += share * share;
      }
      ArrowMatrix rest = own;
      rest *= -1;
      rest += all;
      const auto known = known_to(rest, all, alone);
      if (known.empty()) continue;
      const auto part = std::make_shared<const ArrowLayout>(layout->part(known));
      std::vector<double> score;
      for (const std::size_t k : known) score.push_back(g.score[unknowns[k]]);
      const auto moved = ArrowInverse(rest.part(part, known)).times(score);
      auto& move = moves_.emplace_back(n);
      for (std::size_t k = 0; k < known.size(); ++k) move[known[k]] = moved[k];
    }
    const double left = static_cast<double>(s.clusters.size()) - 1;
    for (std::size_t k = 0; k < n; ++k) {
      freedom_.push_back(alone[k] || left < 1 ? not_known : left);
      double squares = 0, fourth = 0;
      for (const auto& move : moves_) {
        squares += move[k] * move[k];
        fourth += std::pow(move[k], 4);
      }
      bound(k, shares[k], squares * squares, fourth);
    }
  }

 private:
  /// Bounds the degrees of freedom of an unknown from above.
  void bound(std::size_t k, double shares, double square_of_sum, double sum_of_squares) {
    double& nu = freedom_[k];
    if (std::isnan(nu)) return;
    if (shares > 0) nu = std::min(nu, 1 / shares);
    if (sum_of_squares > 0) nu = std::min(nu, 3 * square_of_sum / sum_of_squares);
    nu = std::max(nu, 1.0);
  }
  /// Unknowns that the rest of the bread still determines; marks the others.
  static std::vector<std::size_t> known_to(const ArrowMatrix& rest,
                                           const ArrowMatrix& all,
                                           std::vector<bool>& alone) {
    constexpr double little = 1e-9;  // of what all know
    std::vector<std::size_t> seen, known;
    for (std::size_t k = 0; k < all.size(); ++k)
      if (rest(k, k) > little * all(k, k))
        seen.push_back(k);
      else
        alone[k] = true;
    if (seen.empty()) return known;
    const auto part = std::make_shared<const ArrowLayout>(rest.layout().part(seen));
    const auto lost =
        in_singular_directions(ArrowRoot(rest.part(part, seen), singular), *part, singular);
    for (std::size_t k = 0; k < seen.size(); ++k)
      if (lost[k])
        alone[seen[k]] = true;
      else
        known.push_back(seen[k]);
    return known;
  }

  std::optional<ArrowInverse::Sandwich> sandwich_;
  std::vector<std::vector<double>> moves_;  ///< [cluster][unknown]
  std::vector<double> freedom_;
};

}  // namespace

Uncertainty::Uncertainty(std::size_t n) : verdicts(n) {
  constexpr std::size_t most = 128;
  correlated.resize(n <= most ? n : 0);
  std::iota(correlated.begin(), correlated.end(), std::size_t{0});
  correlations.assign(correlated.size(), std::vector<double>(correlated.size(), not_known));
}

std::vector<double> Uncertainty::std_errors() const {
  std::vector<double> all;
  for (const auto& v : verdicts) all.push_back(v.std_error);
  return all;
}

Determined find_determined(const ArrowMatrix& bread,
                           std::span<const double> x,
                           const Bounds& bounds,
                           double least) {
  const std::size_t n = x.size();
  Determined d;
  d.status.assign(n, ParameterStatus::free);
  const auto range = [&](std::size_t i) { return bounds.high[i] - bounds.low[i]; };
  const auto effect = [&](std::size_t i) { return bread(i, i) * range(i) * range(i); };
  double strongest = 0;
  const auto at_bound = [&](std::size_t i) { return bounds.at_end(i, x[i]); };
  for (std::size_t i = 0; i < n; ++i)
    if (!at_bound(i)) strongest = std::max(strongest, effect(i));
  std::vector<std::size_t> known;
  for (std::size_t i = 0; i < n; ++i) {
    if (at_bound(i))
      d.status[i] = ParameterStatus::at_bound;
    else if (!(effect(i) > 1e-18 * strongest))
      d.status[i] = ParameterStatus::not_identifiable;
    else
      known.push_back(i);
  }
  if (known.empty()) return d;

  // Directions in which nothing changes take their parameters out.
  const auto layout = std::make_shared<const ArrowLayout>(bread.layout().part(known));
  const ArrowRoot all(bread.part(layout, known), least);
  const auto [smallest, largest] = all.extremes();
  d.condition = largest / std::max(smallest, 1e-300);
  const auto lost = in_singular_directions(all, *layout, least);
  for (std::size_t k = 0; k < known.size(); ++k)
    if (lost[k])
      d.status[known[k]] = ParameterStatus::not_identifiable;
    else
      d.unknowns.push_back(known[k]);
  return d;
}

Uncertainty uncertainty(const Sandwich& s,
                        std::span<const double> x,
                        const Bounds& bounds,
                        double samples_used,
                        bool stated) {
  const std::size_t n = x.size();
  Determined found = find_determined(s.bread, x, bounds);
  const auto& determined = found.unknowns;
  Uncertainty u(n);
  u.condition = found.condition;
  for (std::size_t i = 0; i < n; ++i) {
    u[i].status = found.status[i];
    if (u[i].status == ParameterStatus::not_identifiable)
      u[i].reason = "other values of the rest make up for any change of it";
  }
  if (determined.empty()) return u;
  // What stands at a bound takes up nothing of the values.
  const auto unknowns = static_cast<double>(std::ranges::count_if(
      found.status, [](auto status) { return status != ParameterStatus::at_bound; }));

  const auto layout = std::make_shared<const ArrowLayout>(s.bread.layout().part(determined));
  const ArrowInverse bread(s.bread.part(layout, determined));
  const Covariance covariance = s.clusters.empty()
                                    ? Covariance(s, determined, layout, bread, samples_used)
                                    : Covariance(s, determined, layout, bread);
  std::vector<double> variance;
  const auto covariance_of = [&](std::size_t a, std::size_t b) {
    return stated ? bread(a, b) : covariance(a, b);
  };
  for (std::size_t a = 0; a < determined.size(); ++a) variance.push_back(covariance_of(a, a));

  for (std::size_t a = 0; a < determined.size(); ++a) {
    const std::size_t i = determined[a];
    if (!stated && (std::isnan(covariance.freedom(a)) || samples_used <= unknowns)) {
      u[i].reason = samples_used <= unknowns ? "no more values than unknowns"
                    : s.clusters.empty()
                        ? "only one value determines it: no interval holds"
                        : "only one incident angle determines it: no interval holds";
      continue;
    }
    constexpr double many = 1e9;
    u[i].freedom = stated ? many : covariance.freedom(a);
    u[i].variance = variance[a] / bread(a, a);
    const double error = std::sqrt(variance[a]), t = students_t_quantile(0.975, u[i].freedom);
    if (fills(t * error, bounds.high[i] - bounds.low[i])) {
      u[i].forget("its interval is as wide as its range");
      continue;
    }
    u[i].std_error = error;
    u[i].t = t;
  }
  const auto correlation = [&](std::size_t a, std::size_t b) {
    if (std::isnan(u[determined[a]].std_error)) return not_known;
    return covariance_of(a, b) / std::sqrt(variance[a] * variance[b]);
  };
  if (!u.correlated.empty()) {
    for (std::size_t a = 0; a < determined.size(); ++a)
      for (std::size_t b = 0; b < determined.size(); ++b)
        u.correlations[determined[a]][determined[b]] = correlation(a, b);
    return u;
  }
  double strongest = -1;
  for (std::size_t arm = 0; arm == 0 || arm < layout->arms().size(); ++arm) {
    auto block = layout->head();
    if (arm < layout->arms().size())
      block.insert(block.end(), layout->arms()[arm].begin(), layout->arms()[arm].end());
    std::vector<std::vector<double>> of_block;
    double largest = 0;
    for (const std::size_t a : block) {
      auto& row = of_block.emplace_back();
      for (const std::size_t b : block) {
        row.push_back(correlation(a, b));
        if (a != b && std::abs(row.back()) > largest) largest = std::abs(row.back());
      }
    }
    if (largest <= strongest) continue;
    strongest = largest;
    u.correlations = std::move(of_block);
    u.correlated.clear();
    for (const std::size_t a : block) u.correlated.push_back(determined[a]);
  }
  return u;
}

void ParameterVerdict::forget(std::string why) {
  keep_limit(ParameterStatus::not_identifiable, not_known, std::move(why));
}

void ParameterVerdict::keep_limit(ParameterStatus side, double bound, std::string why) {
  status = side;
  std_error = low = high = not_known;
  limit = bound;
  reason = std::move(why);
}

void ParameterVerdict::leave_unbounded(const char* best, bool at_end, const char* why) {
  status = ParameterStatus::unbounded;
  reason = fmt::format("best value {}{}; {}", best, at_end ? ", at the end of its range" : "", why);
}

Uncertainty wider(Uncertainty a, const Uncertainty& b) {
  for (std::size_t i = 0; i < a.verdicts.size(); ++i)
    // Larger, or NaN.
    if (!(b[i].std_error * b[i].t <= a[i].std_error * a[i].t) && !std::isnan(a[i].std_error))
      a[i] = b[i];
  return a;
}

}  // namespace gonio
