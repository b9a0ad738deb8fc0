// Compiled once per instruction set (GONIO_ARCH): every loop of the program over samples.
#include "brdf/kernels.h"

#include <utility>

#include "brdf/catalogue.h"
#include "number/batch.h"
#include "number/dual.h"

namespace gonio::inline GONIO_ARCH {
namespace {

#ifdef GONIO_SCALAR
template <class F>
using Lane = F;
#else
template <class F>
using Lane = Batch<F>;
#endif

template <class F>
Angles<Lane<F>> angles(const Block<F>& x, std::size_t i) {
  using B = Lane<F>;
  return {load<B>(x.nol + i), load<B>(x.nov + i), load<B>(x.noh + i), load<B>(x.voh + i),
          load<B>(x.sin2_theta_h + i)};
}

// ---- a term over a column -----------------------------------------------------------------------

template <class Term, class T, class F>
Term bind(const F* p, auto lift) {
  std::array<T, Term::parameters.size()> a;
  for (std::size_t k = 0; k < a.size(); ++k) a[k] = lift(p[k], k);
  return Term(std::span<const T, Term::parameters.size()>(a));
}
template <template <class> class Term, class F>
auto bind_value(const F* p) {
  using B = Lane<F>;
  static_assert(TermOver<Term<B>, B>);
  return bind<Term<B>, B>(p, [](F x, std::size_t) { return B(x); });
}

template <template <class> class Term, class F>
void extend(const Block<F>& x, const F* p, const Join<F>& j) {
  using B = Lane<F>;
  const auto term = bind_value<Term, F>(p);
  for (std::size_t i = 0; i < x.n; i += lanes<B>) {
    const auto q = as_quotient<B>(term(angles(x, i)));
    store<B>(j.out + i, load<B>(j.num + i) * q.num);
    store<B>(j.out_den + i, load<B>(j.den + i) * q.den);
  }
}

template <template <class> class Term, class F>
void close(const Block<F>& x, const F* p, const Join<F>& j) {
  using B = Lane<F>;
  const auto term = bind_value<Term, F>(p);
  for (std::size_t i = 0; i < x.n; i += lanes<B>) {
    const auto q = as_quotient<B>(term(angles(x, i)));
    store<B>(j.out + i, load<B>(j.num + i) * q.num / (load<B>(j.den + i) * q.den));
  }
}

template <template <class> class Term, class F>
void add(const Block<F>& x, const F* p, const Join<F>& j) {
  using B = Lane<F>;
  const auto term = bind_value<Term, F>(p);
  for (std::size_t i = 0; i < x.n; i += lanes<B>)
    store<B>(j.out + i, load<B>(j.base + i) + load<B>(j.num + i) * as_value<B>(term(angles(x, i))));
}

template <template <class> class Term, class F>
void derivatives(const Block<F>& x, const F* p, F* value, F* const* d) {
  using B = Lane<F>;
  constexpr std::size_t N = Term<B>::parameters.size();
  using T = Dual<B, N>;
  const auto term = bind<Term<T>, T>(p, [](F v, std::size_t k) { return T::variable(B(v), k); });
  for (std::size_t i = 0; i < x.n; i += lanes<B>) {
    const T t = as_value<T>(term(angles(x, i)));
    store<B>(value + i, t.v);
    for (std::size_t k = 0; k < N; ++k) store<B>(d[k] + i, t.d[k]);
  }
}

template <template <class> class D,
          template <class>
          class V,
          template <class>
          class Fr,
          class F,
          std::size_t channels>
void fused(const Block<F>& x,
           const F* pd,
           const F* pv,
           const F* const* pf,
           const F* const* base,
           F* const* out) {
  using B = Lane<F>;
  const auto d = bind_value<D, F>(pd);
  const auto v = bind_value<V, F>(pv);
  const auto f = [&]<std::size_t... C>(std::index_sequence<C...>) {
    return std::array{bind_value<Fr, F>(pf[C])...};
  }
  (std::make_index_sequence<channels>{});
  for (std::size_t i = 0; i < x.n; i += lanes<B>) {
    const auto a = angles(x, i);
    const auto qd = as_quotient<B>(d(a)), qv = as_quotient<B>(v(a));
    const B num = qd.num * qv.num, den = qd.den * qv.den;
    for (std::size_t c = 0; c < channels; ++c) {
      const auto q = as_quotient<B>(f[c](a));
      store<B>(out[c] + i, load<B>(base[c] + i) + num * q.num / (den * q.den));
    }
  }
}

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

template <class F>
void link_identity(std::size_t n, const F* f, F offset, F* value, F* slope) {
  using B = Lane<F>;
  const B o(offset), one(1);
  for (std::size_t i = 0; i < n; i += lanes<B>) {
    store<B>(value + i, load<B>(f + i) + o);
    store<B>(slope + i, one);
  }
}

/// A model value of 0 (kd = 0 without a lobe) counts as tiny and has no slope: the log never sees it.
template <class F>
void link_log(std::size_t n, const F* f, F offset, F* value, F* slope) {
  using B = Lane<F>;
  const B o(offset), zero(0), tiny = constant<B>(1e-30L);
  for (std::size_t i = 0; i < n; i += lanes<B>) {
    const B x = load<B>(f + i) + o;
    const auto positive = tiny < x;
    const B y = select<B>(positive, x, tiny);
    store<B>(value + i, log(y));
    store<B>(slope + i, select<B>(positive, 1 / y, zero));
  }
}

/// Masked values must not reach a sum whatever they are (0·NaN is NaN), so they are chosen away.
/// Huber:  ρ(r²) = 2 m |r| − m²,  ρ' = m/|r|,  m = min(|r|, huber).
template <bool influence, class F>
void residual(std::size_t n, const ResidualArguments<F>& a) {
  using B = Lane<F>;
  const B zero(0), one(1), huber(a.huber);
  B cost = load<B>(a.cost);
  for (std::size_t i = 0; i < n; i += lanes<B>) {
    const B w = load<B>(a.weight + i);
    const auto on = zero < w;
    const B r = select<B>(on, w * (load<B>(a.value + i) - load<B>(a.target + i)), zero);
    const B slope = select<B>(on, w * load<B>(a.slope + i), zero);
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

/// K (K + 1)/2 sums in registers over one block.
template <class F, std::size_t K>
void gram(std::size_t n, const F* r, const F* slope, const F* const* j, F* sums) {
  using B = Lane<F>;
  constexpr std::size_t size = K * (K + 1) / 2;
  std::array<B, size> s;
  for (std::size_t e = 0; e < size; ++e) s[e] = load<B>(sums + e * padding);
  for (std::size_t i = 0; i < n; i += lanes<B>) {
    std::array<B, K> c;
    c[0] = load<B>(r + i);
    const B w = load<B>(slope + i), zero(0);
    const auto on = w < zero || zero < w;  // where masked, the derivatives may be NaN
#pragma GCC unroll 12
    for (std::size_t k = 1; k < K; ++k) c[k] = select<B>(on, w * load<B>(j[k - 1] + i), zero);
    std::size_t e = 0;
#pragma GCC unroll 12
    for (std::size_t a = 0; a < K; ++a)
#pragma GCC unroll 12
      for (std::size_t b = a; b < K; ++b, ++e) s[e] = s[e] + c[a] * c[b];
  }
  for (std::size_t e = 0; e < size; ++e) store<B>(sums + e * padding, s[e]);
}

// ---- tables -------------------------------------------------------------------------------------

template <template <class> class Term, class F>
constexpr TermKernels<F> term_entry() {
  bool coupled = false;
  if constexpr (role_of(Term<F>::about.id) == Role::diffuse) coupled = Term<F>::coupled;
  return {&Term<F>::about, Term<F>::parameters, coupled, extend<Term, F>, close<Term, F>,
          add<Term, F>,    derivatives<Term, F>};
}
template <class F, template <class> class... Terms>
constexpr auto term_table(TermList<Terms...>) {
  return std::array{term_entry<Terms, F>()...};
}
template <class F, template <class> class D, template <class> class V, template <class> class Fr>
constexpr FusedKernel<F> fused_entry(TermList<D, V, Fr>) {
  return {{D<F>::about.id, V<F>::about.id, Fr<F>::about.id},
          {nullptr, fused<D, V, Fr, F, 1>, nullptr, fused<D, V, Fr, F, 3>}};
}
template <class F, class... Lists>
constexpr auto fused_table(FusedList<Lists...>) {
  return std::array{fused_entry<F>(Lists{})...};
}

template <class F>
constexpr auto terms = term_table<F>(Catalogue{});
template <class F>
constexpr auto hot = fused_table<F>(Hot{});

#define GONIO_TEXT_(x) #x
#define GONIO_TEXT(x) GONIO_TEXT_(x)

template <class F, std::size_t... K>
constexpr Kernels<F> table(std::index_sequence<K...>) {
  return {GONIO_TEXT(GONIO_ARCH),
          terms<F>,
          hot<F>,
          product<F>,
          product_sum<F>,
          add_product<F>,
          {link_identity<F>, link_log<F>},
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
