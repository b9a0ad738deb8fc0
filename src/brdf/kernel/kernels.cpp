// Compiled once per instruction set (GONIO_ARCH): the loops over samples that are no single term's.
#include "brdf/kernel/kernels.h"

#include <limits>
#include <utility>

#include "brdf/kernel/lane.h"
#include "brdf/kernel/residual.h"

namespace gonio::inline GONIO_ARCH {
namespace {

// ---- columns with columns -----------------------------------------------------------------------

template <class F>
void product(std::size_t n, const F* a, const F* b, F* out) {
  using B = Lane<F>;
  for (std::size_t i = 0; i < n; i += lanes<B>) store<B>(out + i, load<B>(a + i) * load<B>(b + i));
}
template <class F>
void product_sum(std::size_t n, const F* a, const F* b, const F* c, const F* d, F* out) {
  using B = Lane<F>;
  for (std::size_t i = 0; i < n; i += lanes<B>)
    store<B>(out + i, load<B>(a + i) * load<B>(b + i) + load<B>(c + i) * load<B>(d + i));
}
template <class F>
void add_product(std::size_t n, const F* a, const F* b, const F* c, F* out) {
  using B = Lane<F>;
  for (std::size_t i = 0; i < n; i += lanes<B>)
    store<B>(out + i, load<B>(a + i) + load<B>(b + i) * load<B>(c + i));
}

// ---- residuals ----------------------------------------------------------------------------------

template <Link kind, class F>
void link(std::size_t n, const F* f, F offset, F* value, F* slope) {
  using B = Lane<F>;
  const B o(offset);
  for (std::size_t i = 0; i < n; i += lanes<B>) {
    const auto [v, s] = linked<kind, B>(load<B>(f + i), o);
    store<B>(value + i, v);
    store<B>(slope + i, s);
  }
}

/// True of what the log's link does not take for 0: less would only hide where a model crosses it, and its
/// relative error has squares past all bounds.
template <class B>
auto is_told_from_0(const B& x) {
  return constant<B>(faintest) < x;
}

template <Link kind, class F>
void targets(std::size_t n, const TargetArguments<F>& a, TargetCounts& counts) {
  using B = Lane<F>;
  constexpr F most = std::numeric_limits<F>::max();
  const B zero(0), one(1), offset(a.offset), link_offset(a.relative ? F(0) : a.offset);
  B not_finite(0), negative(0), valid(0), unused(0), weightless(0);
  for (std::size_t i = 0; i < n; i += lanes<B>) {
    const B value = load<B>(a.value + i), w = load<B>(a.weight + i);
    const auto finite = B(-most) <= value && value <= B(most), good = finite && zero <= value;
    const B sum = select<B>(good, value, zero) + offset;
    const auto use = a.positive ? good && is_told_from_0(sum) : good, on = zero < w;
    not_finite = not_finite + select<B>(finite, zero, one);
    negative = negative + select<B>(finite && value < zero, one, zero);
    valid = valid + select<B>(good, one, zero);
    unused = unused + select<B>(good, one, zero) - select<B>(use, one, zero);
    weightless = weightless + select<B>(use, one, zero) - select<B>(use && on, one, zero);
    const auto compared = use && on;
    const B y = select<B>(good && on, value, B(-1));
    const B weight = w * load<B>(a.cosine + i);
    store<B>(a.y + i, y);
    store<B>(a.out_weight + i,
             select<B>(compared, a.relative ? weight / select<B>(use, sum, one) : weight, zero));
    store<B>(a.target + i, select<B>(compared, linked<kind, B>(y, link_offset)[0], zero));
  }
  const auto count = [](const B& lanes_of) {
    alignas(64) std::array<F, lanes<B>> x;
    store<B>(x.data(), lanes_of);
    std::size_t sum = 0;
    for (const F v : x) sum += static_cast<std::size_t>(v);
    return sum;
  };
  counts.not_finite += count(not_finite);
  counts.negative += count(negative);
  counts.valid += count(valid);
  counts.zero += count(unused);
  counts.zero_weight += count(weightless);
}

template <class F>
void residual_sums(std::size_t n, const ResidualSums<F>& a) {
  using B = Lane<F>;
  const B zero(0), one(1);
  const auto add = [&](F* to, const auto& where, const B& x) {
    store<B>(to, load<B>(to) + select<B>(where, x, zero));
  };
  for (std::size_t i = 0; i < n; i += lanes<B>) {
    const B f = load<B>(a.f + i), y = load<B>(a.y + i), difference = f - y;
    const B ratio = load<B>(a.log_f + i) - load<B>(a.log_y + i);
    const auto valid = zero <= y, both = is_told_from_0(y) && zero < f;
    add(a.values + i, valid, one);
    add(a.squares + i, valid, difference * difference);
    add(a.positive + i, both, one);
    add(a.log_squares + i, both, ratio * ratio);
  }
}

/// Huber:  ρ(r²) = 2 m |r| − m²,  ρ' = m/|r|,  m = min(|r|, huber).
template <bool influence, class F>
void residual(std::size_t n, const ResidualArguments<F>& a) {
  using B = Lane<F>;
  const B zero(0), one(1), huber(a.huber);
  B cost = load<B>(a.cost);
  for (std::size_t i = 0; i < n; i += lanes<B>) {
    const auto [r, slope] = weighted<B>(load<B>(a.value + i), load<B>(a.slope + i),
                                        load<B>(a.target + i), load<B>(a.weight + i));
    const B size = max<B>(r, -r), m = min<B>(size, huber);
    const B rho1 = m / select<B>(zero < size, size, one) + select<B>(zero < size, zero, one);
    cost = cost + (2 * size - m) * m;
    if constexpr (influence) {
      store<B>(a.r + i, rho1 * r * slope);
      store<B>(a.weighted_slope + i, select<B>(huber < size, zero, slope));
    } else {
      const B root = sqrt(rho1);
      store<B>(a.r + i, root * r);
      store<B>(a.weighted_slope + i, root * slope);
    }
  }
  store<B>(a.cost, cost);
}

// ---- normal equations ---------------------------------------------------------------------------

template <class F, std::size_t K>
void gram(std::size_t n, const F* r, const F* slope, const F* const* j, F* sums) {
  using B = Lane<F>;
  Products<F, K> products(sums);
  for (std::size_t i = 0; i < n; i += lanes<B>) {
    std::array<B, K> c;
    c[0] = load<B>(r + i);
    const B w = load<B>(slope + i);
#pragma GCC unroll 12
    for (std::size_t k = 1; k < K; ++k) c[k] = unmasked<B>(w, load<B>(j[k - 1] + i));
    products.add(c);
  }
  products.store_to(sums);
}

/// The same of more columns than registers hold sums of, a sum at a time: blocks stay in the first cache.
template <class F>
void gram_of_many(
    std::size_t count, std::size_t n, const F* r, const F* slope, const F* const* j, F* sums) {
  using B = Lane<F>;
  std::size_t e = 0;
  for (std::size_t a = 0; a < count; ++a)
    for (std::size_t b = a; b < count; ++b, ++e) {
      B sum = load<B>(sums + e * padding);
      for (std::size_t i = 0; i < n; i += lanes<B>) {
        const B w = load<B>(slope + i);
        const B x = a == 0 ? load<B>(r + i) : unmasked<B>(w, load<B>(j[a - 1] + i));
        const B y = b == 0 ? load<B>(r + i) : unmasked<B>(w, load<B>(j[b - 1] + i));
        sum = sum + x * y;
      }
      store<B>(sums + e * padding, sum);
    }
}
template <class F, std::size_t K>
void gram_of(std::size_t n, const F* r, const F* slope, const F* const* j, F* sums) {
  if constexpr (K <= max_columns)
    gram<F, K>(n, r, slope, j, sums);
  else
    gram_of_many(K, n, r, slope, j, sums);
}

// ---- influences ---------------------------------------------------------------------------------

template <class F, std::size_t K>
void leverage(std::size_t n, const InfluenceArguments<F>& a) {
  using B = Lane<F>;
  const B zero(0);
  for (std::size_t i = 0; i < n; i += lanes<B>) {
    const B slope = load<B>(a.slope + i), score = load<B>(a.score + i);
    const auto on = slope < zero || zero < slope || score < zero || zero < score;
    std::array<B, K> j;
    for (std::size_t k = 0; k < K; ++k) {
      j[k] = select<B>(on, load<B>(a.j[k] + i), zero);
      store<B>(a.seen[k] + i, j[k]);
    }
    B sum(0);
    for (std::size_t k = 0; k < K; ++k) {
      B row(0);
      for (std::size_t l = 0; l < K; ++l) row = row + B(a.product[k * K + l]) * j[l];
      sum = sum + j[k] * row;
    }
    const B root = slope * load<B>(a.per_root + i);
    store<B>(a.h + i, root * root * sum);
  }
}

template <class F, std::size_t K>
void moves(std::size_t n, const InfluenceArguments<F>& a) {
  using B = Lane<F>;
  const B one(1);
  for (std::size_t i = 0; i < n; i += lanes<B>)
    store<B>(a.score + i,
             load<B>(a.score + i) * load<B>(a.per_root + i) / (one - load<B>(a.h + i)));
  if constexpr (K > 0) {
    for (std::size_t r = 0; r < a.beta.size() / K; ++r) {
      const F* const factor = a.beta.data() + r * K;
      B fourth = load<B>(a.fourth + r * padding), moves = load<B>(a.moves + r * padding);
      for (std::size_t i = 0; i < n; i += lanes<B>) {
        B beta(0);
        for (std::size_t k = 0; k < K; ++k) beta = beta + B(factor[k]) * load<B>(a.seen[k] + i);
        const B per_root = load<B>(a.per_root + i), by_slope = load<B>(a.slope + i) * beta,
                by_score = load<B>(a.score + i) * beta;
        const B share = by_slope * by_slope * per_root, move = by_score * by_score * per_root;
        fourth = fourth + share * share;
        moves = moves + move * move;
      }
      store<B>(a.fourth + r * padding, fourth);
      store<B>(a.moves + r * padding, moves);
    }
  }
}

// ---- the table ----------------------------------------------------------------------------------

#define GONIO_TEXT_(x) #x
#define GONIO_TEXT(x) GONIO_TEXT_(x)

template <class F, std::size_t... K>
constexpr Kernels<F> table(std::index_sequence<K...>) {
  return {GONIO_TEXT(GONIO_ARCH),
          {},  // the terms and what is fused of them are added by dispatch.cpp
          {},
          {},
          product<F>,
          product_sum<F>,
          add_product<F>,
          {link<Link::identity, F>, link<Link::log, F>},
          {targets<Link::identity, F>, targets<Link::log, F>},
          residual_sums<F>,
          residual<false, F>,
          residual<true, F>,
          {nullptr, gram_of<F, K + 1>...},
          {leverage<F, K>...},
          {moves<F, K>...}};
}

}  // namespace

extern const Kernels<float> table_float;
extern const Kernels<double> table_double;
constinit const Kernels<float> table_float = table<float>(std::make_index_sequence<most_columns>{});
constinit const Kernels<double> table_double =
    table<double>(std::make_index_sequence<most_columns>{});

}  // namespace gonio::inline GONIO_ARCH
