// Compiled once per instruction set (GONIO_ARCH): the loops over samples that are no single term's.
#include "brdf/kernel/kernels.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "brdf/catalogue/catalogue.h"
#include "brdf/kernel/lane.h"
#include "number/dual.h"

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

/// link(f + offset) and its derivative.  A model value of 0 (kd = 0 without a lobe) counts as tiny and
/// has no slope: the log never sees it.
template <Link kind, class B>
std::array<B, 2> linked(const B& f, const B& offset) {
  const B x = f + offset, one(1), tiny = constant<B>(1e-30L);
  if constexpr (kind == Link::identity) return {x, one};
  const auto positive = tiny < x;
  const B y = select<B>(positive, x, tiny);
  return {log(y), select<B>(positive, one / y, B(0))};
}

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
    const auto use = a.positive ? good && zero < sum : good, on = zero < w;
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
void left(std::size_t n, const LeftArguments<F>& a) {
  using B = Lane<F>;
  const B zero(0), one(1);
  const auto add = [&](F* to, const auto& where, const B& x) {
    store<B>(to, load<B>(to) + select<B>(where, x, zero));
  };
  for (std::size_t i = 0; i < n; i += lanes<B>) {
    const B f = load<B>(a.f + i), y = load<B>(a.y + i), difference = f - y;
    const B ratio = load<B>(a.log_f + i) - load<B>(a.log_y + i);
    const auto valid = zero <= y, both = zero < y && zero < f;
    add(a.values + i, valid, one);
    add(a.squares + i, valid, difference * difference);
    add(a.positive + i, both, one);
    add(a.log_squares + i, both, ratio * ratio);
  }
}

/// r = w (value − target) and ∂r/∂f.  Masked values must not reach a sum whatever they are (0·NaN is
/// NaN), so they are chosen away.
template <class B>
std::array<B, 2> weighted(const B& value, const B& slope, const B& target, const B& w) {
  const B zero(0);
  const auto on = zero < w;
  return {select<B>(on, w * (value - target), zero), select<B>(on, w * slope, zero)};
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

/// K (K + 1)/2 sums of products of K columns in registers, upper triangle row by row.
template <class F, std::size_t K>
class Products {
  using B = Lane<F>;

 public:
  explicit Products(const F* sums) {
    for (std::size_t e = 0; e < s_.size(); ++e) s_[e] = load<B>(sums + e * padding);
  }
  void add(const std::array<B, K>& c) {
    std::size_t e = 0;
#pragma GCC unroll 12
    for (std::size_t a = 0; a < K; ++a)
#pragma GCC unroll 12
      for (std::size_t b = a; b < K; ++b, ++e) s_[e] = s_[e] + c[a] * c[b];
  }
  void store_to(F* sums) const {
    for (std::size_t e = 0; e < s_.size(); ++e) store<B>(sums + e * padding, s_[e]);
  }

 private:
  std::array<B, K*(K + 1) / 2> s_;
};

/// w j, or 0 where w is 0: there j may be NaN.
template <class B>
B unmasked(const B& w, const B& j) {
  const B zero(0);
  return select<B>(w < zero || zero < w, w * j, zero);
}

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

// ---- the normal equations of a whole model, fused -----------------------------------------------

/// No diffuse term.
template <class T>
struct Black {
  static constexpr std::array<Parameter, 0> parameters{};
  static constexpr bool coupled = false;
};

/// Where the parameters of V stand among those of D and the rest of V.
template <class D, class V>
constexpr auto places_of_v() {
  std::array<std::size_t, V::parameters.size()> at{};
  std::size_t next = D::parameters.size();
  for (std::size_t k = 0; k < at.size(); ++k) {
    at[k] = next;
    for (std::size_t i = 0; i < D::parameters.size(); ++i)
      if (D::parameters[i].name == V::parameters[k].name) at[k] = i;
    if (at[k] == next) ++next;
  }
  return at;
}

template <class Term, class T, std::size_t N, class F>
Term variables(const F* p, const std::array<std::size_t, N>& at) {
  std::array<T, N> a;
  for (std::size_t k = 0; k < N; ++k)
    a[k] = T::variable(typename RealTraits<T>::Plain(p[k]), at[k]);
  return Term(std::span<const T, N>(a));
}
template <std::size_t N>
constexpr std::array<std::size_t, N> in_order() {
  std::array<std::size_t, N> at{};
  for (std::size_t k = 0; k < N; ++k) at[k] = k;
  return at;
}

/// f = D V F + diffuse, or F (D V − diffuse) + diffuse under the interface, channel by channel.
template <template <class> class Diffuse,
          template <class>
          class D,
          template <class>
          class V,
          template <class>
          class Fr,
          Link kind,
          class F>
void fused_normal(const NormalArguments<F>& a) {
  using B = Lane<F>;
  constexpr std::size_t nd = D<B>::parameters.size(), nf = Fr<B>::parameters.size(),
                        nk = Diffuse<B>::parameters.size();
  constexpr auto of_v = places_of_v<D<B>, V<B>>();
  constexpr std::size_t ns = std::max(nd, std::ranges::max(of_v) + 1), K = 1 + ns + nf + nk;
  constexpr std::size_t block = 256;
  alignas(64) std::array<std::array<F, block>, 1 + ns> dv;  // D V and its derivatives
  using S = Dual<B, ns>;
  using T = Dual<B, nf>;
  const auto d = variables<D<S>, S>(a.d, in_order<nd>());
  const auto v = variables<V<S>, S>(a.v, of_v);
  for (std::size_t at = 0; at < a.x.n; at += block) {
    const auto x = a.x.part(at, std::min(block, a.x.n - at));
    for (std::size_t i = 0; i < x.n; i += lanes<B>) {
      const auto angle = angles(x, i);
      const auto qd = as_quotient<S>(d(angle)), qv = as_quotient<S>(v(angle));
      const S product = Quotient<S>{qd.num * qv.num, qd.den * qv.den}.value();
      store<B>(dv[0].data() + i, product.v);
      for (std::size_t k = 0; k < ns; ++k) store<B>(dv[1 + k].data() + i, product.d[k]);
    }
    for (std::size_t c = 0; c < a.channels; ++c) {
      const auto fresnel = variables<Fr<T>, T>(a.f[c], in_order<nf>());
      const auto& target = a.target[c];
      const B offset(a.offset);
      Products<F, K> products(a.sums[c]);
      B cost = load<B>(a.cost);
      for (std::size_t i = 0; i < x.n; i += lanes<B>) {
        const auto angle = angles(x, i);
        const T fr = as_value<T>(fresnel(angle));
        B lobe = load<B>(dv[0].data() + i), under(0);
        std::array<B, nk> j_diffuse;
        if constexpr (nk > 0) {
          using U = Dual<B, nk>;
          const U u = as_value<U>(variables<Diffuse<U>, U>(a.diffuse[c], in_order<nk>())(angle));
          under = u.v;
          for (std::size_t k = 0; k < nk; ++k)
            j_diffuse[k] = Diffuse<B>::coupled ? B((1 - fr.v) * u.d[k]) : u.d[k];
          if constexpr (Diffuse<B>::coupled) lobe = lobe - under;
        }
        const auto [value, slope] = linked<kind, B>(lobe * fr.v + under, offset);
        const auto [r, w] =
            weighted<B>(value, slope, load<B>(target + at + i), load<B>(a.weight[c] + at + i));
        std::array<B, K> column;
        column[0] = r;
        for (std::size_t k = 0; k < ns; ++k)
          column[1 + k] = unmasked<B>(w, load<B>(dv[1 + k].data() + i) * fr.v);
        for (std::size_t k = 0; k < nf; ++k) column[1 + ns + k] = unmasked<B>(w, lobe * fr.d[k]);
        for (std::size_t k = 0; k < nk; ++k) column[1 + ns + nf + k] = unmasked<B>(w, j_diffuse[k]);
        products.add(column);
        cost = cost + r * r;
      }
      store<B>(a.cost, cost);
      products.store_to(a.sums[c]);
    }
  }
}

// ---- tables -------------------------------------------------------------------------------------

template <class F,
          template <class>
          class Diffuse,
          template <class>
          class D,
          template <class>
          class V,
          template <class>
          class Fr>
constexpr NormalKernel<F> normal_entry(std::string_view diffuse) {
  return {diffuse,
          {D<F>::about.id, V<F>::about.id, Fr<F>::about.id},
          {fused_normal<Diffuse, D, V, Fr, Link::identity, F>,
           fused_normal<Diffuse, D, V, Fr, Link::log, F>}};
}
template <class F, template <class> class D, template <class> class V, template <class> class Fr>
constexpr NormalKernel<F> normal_entry(TermList<D, V, Fr>) {
  return normal_entry<F, Black, D, V, Fr>("");
}
template <class F,
          template <class>
          class Diffuse,
          template <class>
          class D,
          template <class>
          class V,
          template <class>
          class Fr>
constexpr NormalKernel<F> normal_entry(TermList<Diffuse, D, V, Fr>) {
  return normal_entry<F, Diffuse, D, V, Fr>(Diffuse<F>::about.id);
}
template <class F, class... Lists>
constexpr auto normal_table(FusedList<Lists...>) {
  return std::array{normal_entry<F>(Lists{})...};
}

template <class F>
constexpr auto hot_fits = normal_table<F>(HotFits{});

#define GONIO_TEXT_(x) #x
#define GONIO_TEXT(x) GONIO_TEXT_(x)

template <class F, std::size_t... K>
constexpr Kernels<F> table(std::index_sequence<K...>) {
  return {GONIO_TEXT(GONIO_ARCH),
          {},  // the terms and what is fused of them are added by dispatch.cpp
          {},
          hot_fits<F>,
          product<F>,
          product_sum<F>,
          add_product<F>,
          {link<Link::identity, F>, link<Link::log, F>},
          {targets<Link::identity, F>, targets<Link::log, F>},
          left<F>,
          residual<false, F>,
          residual<true, F>,
          {nullptr, gram<F, K + 1>...}};
}

}  // namespace

extern const Kernels<float> table_float;
extern const Kernels<double> table_double;
constinit const Kernels<float> table_float = table<float>(std::make_index_sequence<max_columns>{});
constinit const Kernels<double> table_double =
    table<double>(std::make_index_sequence<max_columns>{});

}  // namespace gonio::inline GONIO_ARCH
