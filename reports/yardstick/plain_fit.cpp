#include "reports/yardstick/plain_fit.h"

#include <algorithm>

#include "base/stopwatch.h"
#include "brdf/catalogue/catalogue.h"
#include "number/dual.h"

#include <ceres/ceres.h>

namespace gonio {
namespace {

constexpr int parameters = 7;

template <class T>
std::span<const T, 1> one(const T& x) {
  return std::span<const T, 1>(&x, 1);
}

class Bin : public ceres::SizedCostFunction<3, parameters> {
 public:
  Bin(const Angles<double>& a, const std::array<double, 3>& y) : a_(a), y_(y) {}

  bool Evaluate(double const* const* p, double* r, double** jacobians) const override {
    using T = Dual<double, parameters>;
    std::array<T, parameters> x;
    for (std::size_t i = 0; i < parameters; ++i) x[i] = T::variable(p[0][i], i);
    const T dv = Ggx<T>(one(x[0]))(a_).value() * SmithGgxCorrelated<T>(one(x[0]))(a_).value();
    for (std::size_t c = 0; c < 3; ++c) {
      const T f = dv * Schlick<T>(one(x[1 + c]))(a_) + Lambert<T>(one(x[4 + c]))(a_);
      const bool on = y_[c] > 0;
      const T residual = on ? log(f) - std::log(y_[c]) : T(0.0);
      r[c] = residual.v;
      if (jacobians && jacobians[0])
        std::copy(residual.d.begin(), residual.d.end(), jacobians[0] + c * parameters);
    }
    return true;
  }

 private:
  Angles<double> a_;
  std::array<double, 3> y_;
};

}  // namespace

PlainFit fit_plainly(const Table& t, std::vector<double> start, int threads) {
  PlainFit f{std::move(start), 0, 0, 0};
  Stopwatch begin;
  const SampleAngles at(t);
  ceres::Problem problem;
  for (std::size_t i = 0; i < t.size(); ++i) {
    const auto a = at(i);
    std::array<double, 3> y;
    for (std::size_t c = 0; c < 3; ++c)
      y[c] = mask(a, t.values[c][i]) == Mask::valid ? t.values[c][i] : -1;
    if (std::ranges::any_of(y, [](double v) { return v > 0; }))
      problem.AddResidualBlock(new Bin(a, y), nullptr, f.values.data());
  }
  for (int i = 0; i < parameters; ++i) {
    problem.SetParameterLowerBound(f.values.data(), i, i == 0 ? alpha_parameter.fit.low : 0);
    problem.SetParameterUpperBound(f.values.data(), i, 1);
  }
  f.build_ms = begin.ms();
  begin = {};
  ceres::Solver::Options o;
  o.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  o.num_threads = threads;
  o.function_tolerance = 1e-8;
  o.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(o, &problem, &summary);
  f.solve_ms = begin.ms();
  f.iterations = static_cast<int>(summary.iterations.size());
  return f;
}

}  // namespace gonio
