// How far from the truth each compensation ends with the tables that a shader reads.
#include <algorithm>
#include <cmath>
#include <limits>

#include "brdf/formula/scattering.h"
#include "integrate/albedo/ggx_albedo.h"
#include "integrate/light/split_sum_table.h"
#include "integrate/rule/quadrature.h"
#include "number/half.h"
#include "reports/energy/energy.h"
#include "reports/finding/names.h"

#include <fmt/format.h>

namespace gonio {
namespace {

constexpr std::size_t texels = 32;

/// Tables of a shader, by roughness and NoV: A and B, whose sum is E, and E_avg.
class Tables {
 public:
  Tables()
      : split_(stored(split_sum_table(form_id::smith, texels, texels, 0, {1e-6}), Storage::half)) {
    for (std::size_t i = 0; i < texels; ++i) {
      const double r = (static_cast<double>(i) + 0.5) / texels;
      average_[i] = static_cast<double>(
          Half(static_cast<float>(ggx_average_albedo(r * r, SmithGgx::correlated, 1e-6).value)));
    }
  }
  std::array<double, 2> split(double roughness, double nov) const { return split_(nov, roughness); }
  double e(double roughness, double nov) const {
    const auto [a, b] = split(roughness, nov);
    return a + b;
  }
  double average(double roughness) const {
    const double at = std::clamp(roughness * texels - 0.5, 0.0, texels - 1.0);
    const auto i = static_cast<std::size_t>(std::min(std::floor(at), texels - 2.0));
    return std::lerp(average_[i], average_[i + 1], at - static_cast<double>(i));
  }
  /// 2 ∫ (1 − E(μ)) μ dμ of E as it is looked up, which 1 − E_avg stands for.
  double lost(double roughness) const {
    double sum = 0;
    for (const auto& node : gauss_legendre(64))
      sum += node.weight * 2 * node.x * (1 - e(roughness, node.x));
    return sum;
  }

 private:
  SplitSumTable split_;
  std::array<double, texels> average_{};
};

/// Albedo of a material as a shader makes it.  \param single  without any compensation
double shaded(std::string_view id,
              const Tables& tables,
              const EnergyMaterial::At& at,
              double single,
              double f0) {
  const double e = tables.e(at.roughness, at.mu);
  if (id == "turquin") return Turquin<double>::apply(std::array{single, e, f0})[0];
  if (id == "fdez_aguera") {
    const auto [a, b] = tables.split(at.roughness, at.mu);
    return FdezAguera<double>::apply(std::array{a, b, f0})[0];
  }
  if (id == "kulla_conty") {
    const double average = tables.average(at.roughness), lost = 1 - average;
    const double back = multiple_bounces<double>(schlick_average(f0), average);
    return single + back * (1 - e) * (lost > 0 ? tables.lost(at.roughness) / lost : 0);
  }
  return single;
}

bool is_among(const std::vector<double>& all, double x) {
  return std::ranges::any_of(all, [&](double y) { return std::abs(x - y) < 1e-9; });
}

}  // namespace

std::vector<CompensationError> compensation_errors(const std::vector<EnergyMaterial>& materials) {
  static const Tables tables;
  const auto domain = compensation_domain();
  std::vector<CompensationError> out;
  for (const std::string_view id : {"single", "kulla_conty", "turquin", "fdez_aguera"}) {
    CompensationError c{id, 0, 0, "", 0};
    double squares = 0, gold_squares = 0;
    std::size_t n = 0, gold = 0;
    for (const auto& m : materials) {
      const bool is_gold = !m.f0;
      // A and B are of Schlick's Fresnel.
      if (is_gold && id == "fdez_aguera") continue;
      for (const auto& at : m.rows) {
        if (!is_among(domain.roughness, at.roughness) || !is_among(domain.mu, at.mu)) continue;
        const double off = shaded(id, tables, at, at.orders[0], m.normal) - at.truth;
        (is_gold ? gold_squares : squares) += off * off;
        ++(is_gold ? gold : n);
        if (is_gold || std::abs(off) <= std::abs(c.worst)) continue;
        c.worst = off;
        c.worst_at = fmt::format("{}, roughness {:g}, cosine {:g}", m.name, at.roughness, at.mu);
      }
    }
    c.rms = n ? std::sqrt(squares / static_cast<double>(n)) : no_value;
    c.gold_rms = gold ? std::sqrt(gold_squares / static_cast<double>(gold)) : no_value;
    out.push_back(std::move(c));
  }
  return out;
}

}  // namespace gonio
