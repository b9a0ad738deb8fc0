// One E(mu, alpha) by several ways: how exact each is, and how long that takes.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/random.h"
#include "brdf/formula/masking.h"
#include "integrate/albedo/directional_albedo.h"
#include "integrate/albedo/ggx_albedo.h"
#include "integrate/rule/slopes.h"
#include "integrate/scattering/visible_facets.h"
#include "reports/energy/energy.h"
#include "timing/timing.h"

namespace gonio {
namespace {

using std::numbers::pi;

struct Case {
  double roughness, mu;
};
constexpr Case cases[] = {{0.2, 0.9}, {0.5, 0.5}, {1, 0.1}};

BoundModel ggx(double roughness) {
  return bind_model("ggx/smith_ggx.correlated/constant",
                    {{"alpha", {roughness * roughness}}, {"f0", {1}}}, 1);
}

/// Drawing of an estimator: the light's direction, or the half vector between it and v.
enum class Drawn { light, normals, visible_normals };

/// E from n samples: the mean of f NoL over the density of what is drawn.
class Sampler {
 public:
  Sampler(const Case& c, Drawn drawn)
      : drawn_(drawn),
        mu_(c.mu),
        sine_(std::sqrt((1 - c.mu) * (1 + c.mu))),
        alpha_(c.roughness * c.roughness),
        model_(ggx(c.roughness)),
        facets_(alpha_, alpha_),
        block_(false) {}

  double operator()(std::size_t n, std::uint64_t seed) {
    Draws draw(seed, n);
    const auto& lobe = model_.model.lobes.front();
    const auto parameters = term_parameters(model_, lobe.ndf, 0);
    double sum = 0;
    for (std::size_t first = 0; first < n; first += at_once) {
      const std::size_t count = std::min(at_once, n - first);
      const auto x = block_.resize(count);
      weight_.resize(count);
      for (std::size_t k = 0; k < count; ++k) put(x, k, draw);
      double* const v = block_.extra(0);
      term_values(lobe.masking.term, parameters, block_.block(), v);
      if (drawn_ == Drawn::light) {
        double* const d = block_.extra(1);
        term_values(lobe.ndf.term, parameters, block_.block(), d);
        for (std::size_t k = 0; k < count; ++k) weight_[k] *= d[k];
      }
      for (std::size_t k = 0; k < count; ++k) sum += weight_[k] * v[k];
    }
    return sum / static_cast<double>(n);
  }

 private:
  static constexpr std::size_t at_once = 4096;

  /// Weight that multiplies V, or D V: 0 below the horizon.
  void put(std::span<double* const> x, std::size_t k, Draws& draw) {
    const Facet m = facet(draw);
    const double length2 = m.x * m.x + m.y * m.y + m.z * m.z, scale = 1 / std::sqrt(length2);
    const double noh = m.z * scale, voh = (sine_ * m.x + mu_ * m.z) * scale;
    const double nol = put_half_vector(x, k, mu_, noh, voh, (m.x * m.x + m.y * m.y) / length2);
    // f NoL / density: of l 1/2π; of h, D NoH or D VoH/σ(v), times 1/(4 VoH)
    weight_[k] = nol == 0                   ? 0
                 : drawn_ == Drawn::light   ? 2 * pi * nol
                 : drawn_ == Drawn::normals ? 4 * nol * voh / noh
                                            : 4 * nol * area();
  }

  /// σ(v) = NoV (1 + Λ(v))
  double area() const { return (mu_ + SmithRoot<double>(alpha_)(mu_) / smith_scale) / 2; }

  Facet facet(Draws& draw) {
    if (drawn_ == Drawn::visible_normals) return facets_({-sine_, 0, -mu_}, area(), draw);
    const double u = draw.uniform(), phi = 2 * pi * draw.uniform();
    if (drawn_ == Drawn::normals) {
      const double tangent = alpha_ * std::sqrt((1 - u) / u);
      return {tangent * std::cos(phi), tangent * std::sin(phi), 1};
    }
    const double s = std::sqrt((1 - u) * (1 + u));
    return {s * std::cos(phi) + sine_, s * std::sin(phi), u + mu_};
  }

  Drawn drawn_;
  double mu_, sine_, alpha_;
  BoundModel model_;
  GgxFacets facets_;
  AngleBlock block_;
  std::vector<double> weight_;
};

}  // namespace

std::vector<EstimatorPoint> estimator_points(const EnergyOptions& o,
                                             const std::function<void(double)>& done) {
  std::vector<EstimatorPoint> out;
  struct Chance {
    std::string_view name;
    Drawn drawn;
  };
  static constexpr Chance by_chance[] = {{"random lights", Drawn::light},
                                         {"random normals", Drawn::normals},
                                         {"random visible normals", Drawn::visible_normals}};
  constexpr std::size_t repeats = 32;
  std::size_t finished = 0;
  for (const Case& c : cases) {
    const double alpha = c.roughness * c.roughness;
    const double truth = ggx_albedo(alpha, c.mu, SmithGgx::correlated, 1e-13).value;
    const auto add = [&](std::string_view name, double goal, double error, double bound,
                         double evaluations, const Timing& t) {
      out.push_back({name, c.roughness, c.mu, goal, error, bound, evaluations, t.ns, t.spread_ns});
    };
    const auto model = ggx(c.roughness);
    for (int digits = 1; digits <= 11; ++digits) {
      const double goal = std::pow(10.0, -digits);
      const auto one = ggx_albedo(alpha, c.mu, SmithGgx::correlated, goal);
      add("one integral", goal, std::abs(one.value - truth), one.error,
          std::numeric_limits<double>::quiet_NaN(),
          time_of([&] { ggx_albedo(alpha, c.mu, SmithGgx::correlated, goal); }));
      if (digits == 11) break;
      const auto two = directional_albedo(model, {&c.mu, 1}, 0, {goal, Goal{}.evaluations})[0];
      add("two integrals", goal, std::abs(two.value[0] - truth), two.error,
          static_cast<double>(two.evaluations), time_of([&] {
            directional_albedo(model, {&c.mu, 1}, 0, {goal, Goal{}.evaluations});
          }));
    }
    for (const auto& way : by_chance) {
      Sampler sample(c, way.drawn);
      for (std::size_t n = 16; n <= o.samples; n *= 4) {
        double squares = 0;
        for (std::size_t seed = 1; seed <= repeats; ++seed) {
          const double off = sample(n, seed) - truth;
          squares += off * off / static_cast<double>(repeats);
        }
        add(way.name, static_cast<double>(n), std::sqrt(squares), 0, static_cast<double>(n),
            time_of([&] { sample(n, 1); }));
      }
      done(static_cast<double>(++finished) /
           static_cast<double>(std::size(cases) * std::size(by_chance)));
    }
  }
  return out;
}

}  // namespace gonio
