// Compiled once per instruction set (GONIO_ARCH): whole models, each as one loop.
#include <tuple>
#include <utility>

#include "brdf/catalogue/catalogue.h"
#include "brdf/kernel/lane.h"

namespace gonio::inline GONIO_ARCH {
namespace {

/// A sum for each channel; 0 is not added to the first value (nor may a compiler leave that out: −0 + 0 is 0).
template <class F, std::size_t channels>
struct Sums {
  std::array<Lane<F>, channels> value;
  bool begun = false;  ///< known when compiled

  void add(const std::array<Lane<F>, channels>& x) {
    for (std::size_t c = 0; c < channels; ++c) value[c] = begun ? Lane<F>(value[c] + x[c]) : x[c];
    begun = true;
  }
};

template <template <class> class Term, class F, std::size_t channels>
class FusedDiffuse {
  using B = Lane<F>;

 public:
  static constexpr bool coupled = Term<F>::coupled, anisotropic = is_anisotropic<Term<F>>;
  explicit FusedDiffuse(const std::array<const F*, max_channels>* p)
      : term_(bind_channels<Term, channels>(p[0])) {}

  void add(const auto& x, Sums<F, channels>& sum, Sums<F, channels>& under) const {
    std::array<B, channels> value;
    for (std::size_t c = 0; c < channels; ++c) value[c] = as_value<B>(term_[c](x));
    sum.add(value);
    if constexpr (coupled) under.add(value);
  }

 private:
  std::array<Term<B>, channels> term_;
};

template <class List, class F, std::size_t channels>
class FusedLobe;
template <template <class> class D,
          template <class>
          class V,
          template <class>
          class Fr,
          class F,
          std::size_t channels>
class FusedLobe<TermList<D, V, Fr>, F, channels> {
  using B = Lane<F>;

 public:
  static constexpr bool anisotropic = is_anisotropic<D<F>> || is_anisotropic<V<F>>;
  explicit FusedLobe(const std::array<const F*, max_channels>* p)
      : d_(bind_value<D, F>(p[0][0])),
        v_(bind_value<V, F>(p[1][0])),
        f_(bind_channels<Fr, channels>(p[2])) {}

  /// \param less  what of the diffuse terms lies under the interface; where `coupled`
  template <bool coupled>
  void add(const auto& x, Sums<F, channels>& sum, const Sums<F, channels>& less) const {
    const auto d = as_quotient<B>(d_(x)), v = as_quotient<B>(v_(x));
    const B num = d.num * v.num, den = d.den * v.den;
    std::array<B, channels> value;
    if constexpr (is_fraction<Fr, F> && !coupled) {
      for (std::size_t c = 0; c < channels; ++c) {
        const auto f = as_quotient<B>(f_[c](x));
        value[c] = num * f.num / (den * f.den);
      }
    } else {
      const B dv = num / den;
      for (std::size_t c = 0; c < channels; ++c) {
        const B f = as_value<B>(f_[c](x));
        if constexpr (coupled)
          value[c] = (dv - less.value[c]) * f;
        else
          value[c] = dv * f;
      }
    }
    sum.add(value);
  }

 private:
  D<B> d_;
  V<B> v_;
  std::array<Fr<B>, channels> f_;
};

/// f_c = Σ diffuse_c + Σ D V F_c, the first lobe's F_c (D V − coupled_c)
template <class F, std::size_t channels, class... Diffuse, class First, class... Rest>
void run(const Block<F> columns,  // copied: stores cannot change them
         const std::array<F*, max_channels> out,
         const std::tuple<Diffuse...>& diffuse,
         const First& first,
         const Rest&... rest) {
  using B = Lane<F>;
  constexpr bool coupled = (false || ... || Diffuse::coupled);
  constexpr bool anisotropic =
      (First::anisotropic || ... || Rest::anisotropic) || (false || ... || Diffuse::anisotropic);
  for (std::size_t i = 0; i < columns.n; i += lanes<B>) {
    const auto x = angles_with<anisotropic>(columns, i);
    Sums<F, channels> sum, under;
    std::apply([&](const auto&... term) { (term.add(x, sum, under), ...); }, diffuse);
    first.template add<coupled>(x, sum, under);
    (rest.template add<false>(x, sum, under), ...);
    for (std::size_t c = 0; c < channels; ++c) store<B>(out[c] + i, sum.value[c]);
  }
}

template <class F, std::size_t channels, class Model>
struct Fused;
template <class F, std::size_t channels, template <class> class... Diffuse, class... Lobes>
struct Fused<F, channels, ModelTerms<TermList<Diffuse...>, Lobes...>> {
  static void value(const FusedArguments<F>& a) {
    const auto* const p = a.parameters.data();
    [&]<std::size_t... K, std::size_t... L>(std::index_sequence<K...>, std::index_sequence<L...>) {
      run<F, channels>(a.x, a.out, std::tuple{FusedDiffuse<Diffuse, F, channels>(p + K)...},
                       FusedLobe<Lobes, F, channels>(p + sizeof...(Diffuse) + 3 * L)...);
    }
    (std::index_sequence_for<TermList<Diffuse>...>{}, std::index_sequence_for<Lobes...>{});
  }
};

template <class F, template <class> class... Terms>
constexpr void put_ids(FusedKernel<F>& kernel, std::size_t& at, TermList<Terms...>) {
  ((kernel.ids[at++] = Terms<F>::about.id), ...);
}
template <class F, class Diffuse, class... Lobes>
constexpr FusedKernel<F> entry(ModelTerms<Diffuse, Lobes...>) {
  using M = ModelTerms<Diffuse, Lobes...>;
  FusedKernel<F> kernel{0, {}, {nullptr, Fused<F, 1, M>::value, nullptr, Fused<F, 3, M>::value}};
  std::size_t at = 0;
  put_ids(kernel, at, Diffuse{});
  kernel.diffuse = at;
  (put_ids(kernel, at, Lobes{}), ...);
  return kernel;
}
template <class F, class... Models>
constexpr auto table_of(FusedList<Models...>) {
  return std::array{entry<F>(Models{})...};
}
template <class F>
constexpr auto table = table_of<F>(Hot{});

}  // namespace

template <class F>
std::span<const FusedKernel<F>> fused_models();
template <>
std::span<const FusedKernel<float>> fused_models() {
  return table<float>;
}
template <>
std::span<const FusedKernel<double>> fused_models() {
  return table<double>;
}

}  // namespace gonio::inline GONIO_ARCH
