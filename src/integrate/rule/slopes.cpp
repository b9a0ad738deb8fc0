#include "integrate/rule/slopes.h"

#include <algorithm>
#include <cmath>

#include "brdf/catalogue/registry.h"

namespace gonio {

std::span<double* const> AngleBlock::resize(std::size_t n) {
  const std::size_t padded = (n + padding - 1) / padding * padding;
  if (padded > capacity_) {
    capacity_ = padded;
    columns_.clear();
    pointers_.clear();
    for (int i = 0; i < (frame_ ? 11 : 5); ++i) {
      columns_.push_back(Column<double>::for_overwrite(capacity_));
      pointers_.push_back(columns_.back().data());
    }
    for (auto& c : extra_) c = Column<double>::for_overwrite(capacity_);
  }
  padded_ = padded;
  for (auto* c : pointers_) std::fill(c + n, c + padded, 0.5);
  return pointers_;
}

Block<double> AngleBlock::block() const {
  const auto& c = pointers_;
  Block<double> b{c[0], c[1], c[2], c[3], c[4], padded_};
  for (std::size_t k = 5; k < c.size(); ++k) b.frame[k - 5] = c[k];
  return b;
}

double* AngleBlock::extra(std::size_t i) {
  while (extra_.size() <= i) extra_.push_back(Column<double>::for_overwrite(capacity_));
  return extra_[i].data();
}

double put_half_vector(
    std::span<double* const> x, std::size_t k, double nov, double noh, double voh, double sin2) {
  const double nol = 2 * voh * noh - nov;
  const bool above = nol > 0 && voh > 0;
  x[0][k] = above ? std::min(nol, 1.0) : 0.5;
  x[1][k] = nov;
  x[2][k] = noh;
  x[3][k] = above ? std::min(voh, 1.0) : 0.5;
  x[4][k] = sin2;
  return above ? nol : 0;
}

std::vector<double> term_parameters(const BoundModel& b, const TermUse& t, std::size_t channel) {
  std::vector<double> p;
  for (const auto i : t.parameters) p.push_back(b.values[b.model.parameters[i].slot(channel)]);
  return p;
}

void term_values(std::size_t term,
                 std::span<const double> parameters,
                 const Block<double>& x,
                 double* out) {
  Scratch<double> scratch;
  std::array<double, most_parameters> p{};
  std::ranges::copy(parameters, p.begin());
  const auto& t = kernels<double>(instruction_sets().front()).terms[term];
  for (std::size_t at = 0; at < x.n; at += scratch.block)
    t.add_product(x.part(at, std::min(scratch.block, x.n - at)), p.data(),
                  {scratch.ones(), nullptr, scratch.zeros(), out + at, nullptr});
}

std::array<double, 2> slope_widths(std::size_t ndf, std::span<const double> parameters) {
  constexpr std::size_t steps = 72;  // 8 a decade, from 1e-7
  const auto tangent = [](std::size_t k) { return std::pow(10, static_cast<double>(k) / 8 - 7); };
  std::array<double, 2> widths{1, 1};
  AngleBlock x(true);
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const auto c = x.resize(steps);
    for (std::size_t k = 0; k < steps; ++k) {
      const double t = tangent(k), noh = 1 / std::sqrt(1 + t * t);
      c[2][k] = noh;
      c[4][k] = t * t * noh * noh;
      c[5][k] = axis == 0 ? t * noh : 0;
      c[6][k] = axis == 1 ? t * noh : 0;
      for (const std::size_t unread : {0, 1, 3, 7, 8, 9, 10}) c[unread][k] = 0.5;
    }
    double* const d = x.extra(0);
    term_values(ndf, parameters, x.block(), d);
    const auto density = [&](std::size_t k) {
      return d[k] * c[2][k] * c[2][k] * c[2][k] * c[2][k];
    };
    for (std::size_t k = 0; k + 1 < steps; ++k)
      // a fall by t^-1/2 over an eighth of a decade
      if (density(k + 1) < density(k) * std::pow(10, -1 / 16.0)) {
        widths[axis] = std::clamp(2.6 * tangent(k), 1e-6, 1.0);
        break;
      }
  }
  return widths;
}

}  // namespace gonio
