#pragma once
/// \file
/// Whole models, each as one loop: f of all channels, and the normal equations of a fit.  Included by the
/// files that name the models, compiled per instruction set.

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

#include "brdf/kernel/lane.h"
#include "brdf/kernel/residual.h"
#include "brdf/kernel/tilt.h"
#include "brdf/term/product.h"
#include "brdf/term/term_list.h"
#include "number/dual.h"

namespace gonio::inline GONIO_ARCH {

/// A whole model: its diffuse terms, and D, V, F of each lobe.
template <class Diffuse, class... Lobes>
struct ModelTerms {};

/// A list of models whose terms are inlined into one loop: the same formulas, worth it where a profile
/// says so.
template <class... Models>
struct FusedList {};

/// body<0>(), body<1>() …
template <std::size_t n>
void each(auto&& body) {
  [&]<std::size_t... I>(std::index_sequence<I...>) {
    (body.template operator()<I>(), ...);
  }
  (std::make_index_sequence<n>{});
}

// ---- the value ----------------------------------------------------------------------------------

template <class List, class F, std::size_t channels>
struct BoundLobe;
template <template <class> class D,
          template <class>
          class V,
          template <class>
          class Fr,
          class F,
          std::size_t channels>
struct BoundLobe<TermList<D, V, Fr>, F, channels> {
  using B = Lane<F>;
  static constexpr bool anisotropic = LobeShape<D, V, B>::anisotropic;
  LobeShape<D, V, B> shape;
  std::array<Fr<B>, channels> fresnel;

  explicit BoundLobe(const std::array<const F*, max_channels>* p)
      : shape{bind_value<D, F>(p[0][0]), bind_value<V, F>(p[1][0])},
        fresnel(bind_channels<Fr, channels>(p[2])) {}

  /// D V as the rule takes it: divided once for all channels, unless F is a fraction that shares its
  /// division.
  template <bool coupled>
  auto shape_at(const auto& x) const {
    if constexpr (is_fraction<Fr, F> && !coupled)
      return shape(x);
    else
      return shape(x).value();
  }
  template <bool coupled>
  auto fresnel_at(std::size_t channel, const auto& x) const {
    if constexpr (is_fraction<Fr, F> && !coupled)
      return as_quotient<B>(fresnel[channel](x));
    else
      return as_value<B>(fresnel[channel](x));
  }
};

template <class F, class Model>
struct Fused;
template <class F, template <class> class... Diffuse, class... Lobes>
struct Fused<F, ModelTerms<TermList<Diffuse...>, Lobes...>> {
  using B = Lane<F>;
  static constexpr bool coupled = (false || ... || Diffuse<F>::coupled);
  static constexpr bool anisotropic =
      (BoundLobe<Lobes, F, 1>::anisotropic || ...) || (false || ... || is_anisotropic<Diffuse<F>>);

  template <std::size_t channels>
  static void value(const FusedArguments<F>& a) {
    const Block<F> columns = a.x;  // copied: stores cannot change them
    const auto out = a.out;
    const auto* const p = a.parameters.data();
    [&]<std::size_t... K, std::size_t... L>(std::index_sequence<K...>, std::index_sequence<L...>) {
      const std::tuple diffuse{bind_channels<Diffuse, channels>(p[K])...};
      const std::tuple lobes{BoundLobe<Lobes, F, channels>(p + sizeof...(Diffuse) + 3 * L)...};
      for (std::size_t i = 0; i < columns.n; i += lanes<B>) {
        const auto x = angles_with<anisotropic>(columns, i);
        const std::tuple shapes{std::get<L>(lobes).template shape_at < L == 0 && coupled > (x)...};
        std::array<B, channels> f;
        for (std::size_t c = 0; c < channels; ++c) {
          const std::tuple terms{as_value<B>(std::get<K>(diffuse)[c](x))...};
          const auto add = [&]<std::size_t l>(const auto& base, const auto& under) {
            const auto& lobe = std::get<l>(lobes);
            return as_value<B>(lobe_on(base, under, One{}, std::get<l>(shapes),
                                       lobe.template fresnel_at < l == 0 && coupled > (c, x)));
          };
          f[c] = add.template operator()<0>(
              (Zero{} + ... + std::get<K>(terms)),
              (Zero{} + ... + only_if<Diffuse<F>::coupled>(std::get<K>(terms))));
          ((f[c] =
                [&] {
                  if constexpr (L == 0)
                    return f[c];
                  else
                    return add.template operator()<L>(f[c], Zero{});
                }()),
           ...);
        }
        for (std::size_t c = 0; c < channels; ++c) store<B>(out[c] + i, f[c]);
      }
    }
    (std::index_sequence_for<TermList<Diffuse>...>{}, std::index_sequence_for<Lobes...>{});
  }
};

// ---- the normal equations -----------------------------------------------------------------------

/// Where the parameters of V stand among those of D and the rest of V: they share those of one name.
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
template <std::size_t N>
constexpr std::array<std::size_t, N> in_order() {
  std::array<std::size_t, N> at{};
  for (std::size_t k = 0; k < N; ++k) at[k] = k;
  return at;
}

template <class Term, class T, class Way, std::size_t N, class F>
Term variables(const F* p, const std::array<std::size_t, N>& at) {
  return bind<Term, T, Way>(p, [&](const Lane<F>& x, std::size_t k) {
    if constexpr (T::count == 0)
      return T(x);
    else
      return T::variable(x, at[k]);
  });
}

/// A term in a number that carries its derivatives by all its parameters.
template <template <class> class Term, class F, class Way>
struct TermSlopes {
  static constexpr std::size_t count = Term<Lane<F>>::parameters.size();
  using T = Dual<Lane<F>, count>;
  Term<T> term;

  explicit TermSlopes(const F* p) : term(variables<Term<T>, T, Way>(p, in_order<count>())) {}
  T operator()(const auto& angles) const { return as_value<T>(term(angles)); }
};

/// A lobe's D V and F with their derivatives.
/// \tparam moves  whether D V has any
template <class List, class F, class Way, bool moves>
struct LobeSlopes;
template <template <class> class D,
          template <class>
          class V,
          template <class>
          class Fr,
          class F,
          class Way,
          bool moves>
struct LobeSlopes<TermList<D, V, Fr>, F, Way, moves> {
  using B = Lane<F>;
  static constexpr auto of_v = places_of_v<D<B>, V<B>>();
  static constexpr bool turns = LobeShape<D, V, B>::anisotropic;
  static constexpr std::size_t of_d = D<B>::parameters.size(),
                               of_frame = moves ? (tilts<Way> ? 2 : turns) : 0,
                               of_shape =
                                   moves ? std::max(of_d, std::ranges::max(of_v) + 1) + of_frame
                                         : 0;
  using S = Dual<B, of_shape, moves && tilts<Way>>;
  using Fresnel = TermSlopes<Fr, F, Way>;

  static auto shape(const F* d, const F* v) {
    return LobeShape<D, V, S>{variables<D<S>, S, Way>(d, in_order<of_d>()),
                              variables<V<S>, S, Way>(v, of_v)};
  }
  static constexpr void put_columns(auto& columns, std::size_t& at, std::size_t term) {
    for (std::size_t k = 0; moves && k < of_d; ++k) columns[at++] = {term, k};
    for (std::size_t k = 0; moves && k < of_v.size(); ++k)
      if (of_v[k] >= of_d) columns[at++] = {term + 1, k};
    for (std::size_t k = 0; k < of_frame; ++k) columns[at++] = {term, of_d + k};
    for (std::size_t k = 0; k < Fresnel::count; ++k) columns[at++] = {term + 2, k};
  }
};

/// Sums of a channel's normal equations, of r and its derivatives.
template <class F, std::size_t K>
class NormalSums {
 public:
  NormalSums(const NormalArguments<F>& a, std::size_t channel) : products_(a.sums[channel]) {}
  void add(const std::array<Lane<F>, K>& column) { products_.add(column); }
  void store(const NormalArguments<F>& a, std::size_t channel) const {
    products_.store_to(a.sums[channel]);
  }

 private:
  Products<F, K> products_;
};

/// \tparam Way    what the lanes of a register are
/// \tparam moves  whether there are derivatives by the parameters of D and V
template <class F, class Model, class Way = SamplesAsLanes, bool moves = true>
struct FusedNormal;
template <class F, template <class> class... Diffuse, class... Lobes, class Way, bool moves>
struct FusedNormal<F, ModelTerms<TermList<Diffuse...>, Lobes...>, Way, moves> {
  using B = Lane<F>;
  using Value = Fused<F, ModelTerms<TermList<Diffuse...>, Lobes...>>;
  template <std::size_t l>
  using LobeAt = LobeSlopes<std::tuple_element_t<l, std::tuple<Lobes...>>, F, Way, moves>;
  static constexpr std::size_t n_diffuse = sizeof...(Diffuse), n_lobes = sizeof...(Lobes);
  static constexpr std::size_t block = Way::block;

  /// Rows that D V and its derivatives take of the lobes before l.
  static constexpr std::size_t rows_before(std::size_t l) {
    std::size_t n = 0, k = 0;
    ((n += k++ < l ? 1 + LobeSlopes<Lobes, F, Way, moves>::of_shape : 0), ...);
    return n;
  }
  /// Columns: the residual's and one for each parameter.
  static constexpr std::size_t K = 1 +
                                   (0 + ... +
                                    (LobeSlopes<Lobes, F, Way, moves>::of_shape +
                                     LobeSlopes<Lobes, F, Way, moves>::Fresnel::count)) +
                                   (0 + ... + TermSlopes<Diffuse, F, Way>::count);
  static_assert(K <= max_columns);
  static_assert((0 + ... + (LobeSlopes<Lobes, F, Way, moves>::of_frame > 0)) <= 1,
                "one column by the turn of the frame, two by its tilt");
  static_assert(!tilts<Way> || (is_uniform<Diffuse<F>> && ...), "tilts move D V only");

  /// Parameters by which the columns after the residual's are derivatives: of each lobe those of D, those of
  /// V that D has not, the turn or tilt of its frame, and of F; then those of the diffuse terms.
  static constexpr auto columns() {
    std::array<FusedColumn, max_columns - 1> all{};
    std::size_t at = 0, term = n_diffuse;
    ((LobeSlopes<Lobes, F, Way, moves>::put_columns(all, at, term), term += 3), ...);
    term = 0;
    [[maybe_unused]] const auto put = [&](std::size_t count) {
      for (std::size_t k = 0; k < count; ++k) all[at++] = {term, k};
      ++term;
    };
    (put(TermSlopes<Diffuse, F, Way>::count), ...);
    return all;
  }

  /// Those, and where normals tilt the cosine over that of the normal given and its derivatives.
  static constexpr std::size_t of_ratio = tilts<Way> ? 1 + 2 * moves : 0;
  using Rows = std::array<std::array<F, block>, rows_before(n_lobes) + of_ratio>;

  /// D V of each lobe and its derivatives, which the channels share, times that ratio.  Flat: left to itself, GCC calls
  /// a function for each sample.
  template <class Arguments>
  [[gnu::flatten]] static void fill(const Block<F>& x,
                                    std::size_t at,
                                    const Arguments& a,
                                    Rows& rows) {
    each<n_lobes>([&]<std::size_t l>() {
      const auto* const p = a.parameters.data() + n_diffuse + 3 * l;
      const auto shape = LobeAt<l>::shape(p[0][0], p[1][0]);
      auto* const row = rows.data() + rows_before(l);
      for (std::size_t i = 0; i < x.n; i += lanes<B>) {
        const auto angles = angles_with < LobeAt<l>::turns || tilts<Way>, Way > (x, i);
        typename LobeAt<l>::S dv;
        if constexpr (tilts<Way>) {
          const B per_given = load<B>(a.per_cosine + at + i);
          auto* const ratio_row = rows.data() + rows_before(n_lobes);
          typename LobeAt<l>::S ratio;
          if constexpr (moves) {
            const auto tilted = tilting<LobeAt<l>::of_shape>(angles);
            ratio = tilted.nol * per_given;
            dv = shape(tilted).value() * ratio;
            for (std::size_t k = 0; k < 2; ++k)
              store<B>(ratio_row[1 + k].data() + i, ratio.d[LobeAt<l>::of_shape - 2 + k]);
          } else {
            ratio = angles.nol * per_given;
            dv = shape(angles).value() * ratio;
          }
          store<B>(ratio_row[0].data() + i, ratio.v);
        } else if constexpr (moves && LobeAt<l>::turns)
          dv = shape(turning<LobeAt<l>::of_shape>(angles)).value();
        else
          dv = shape(angles).value();
        store<B>(row[0].data() + i, dv.v);
        for (std::size_t k = 0; k < LobeAt<l>::of_shape; ++k)
          store<B>(row[1 + k].data() + i, dv.d[k]);
      }
    });
  }

  /// Row k of the ratio, where there is any.
  template <std::size_t k>
  static auto ratio_at(const Rows& rows, std::size_t i) {
    if constexpr (tilts<Way>)
      return load<B>(rows[rows_before(n_lobes) + k].data() + i);
    else
      return One{};
  }

  /// Diffuse light as an input of the rule, where there is any.
  static auto beneath(const B& sum) { return input<2, 3>(sum); }
  static Zero beneath(Zero) { return {}; }

  /// Derivative of f by diffuse term u, given what the first lobe made of its sum.
  template <std::size_t u>
  static auto by_diffuse(const auto& first) {
    if constexpr (std::array{Diffuse<F>::coupled...}[u])
      return std::get<2>(first.d);
    else
      return One{};
  }

  /// Derivative of f by a factor of all diffuse terms.
  static auto by_ratio(const auto& first, const auto&... values) {
    return [&]<std::size_t... U>(std::index_sequence<U...>) {
      return (Zero{} + ... + (by_diffuse<U>(first) * values));
    }
    (std::make_index_sequence<n_diffuse>{});
  }

  /// \tparam Sums  what becomes of a sample's residual and its derivatives
  template <Link kind, template <class, std::size_t> class Sums = NormalSums, class Arguments>
  static void pass(const Arguments& a) {
    [&]<std::size_t... U, std::size_t... L>(std::index_sequence<U...>, std::index_sequence<L...>) {
      alignas(64) Rows rows;
      for (std::size_t at = 0; at < a.x.n; at += block) {
        const auto x = Way::part(a.x, at, std::min(block, a.x.n - at));
        fill(x, at, a, rows);
        for (std::size_t c = 0; c < a.channels; ++c) {
          const std::tuple terms{TermSlopes<Diffuse, F, Way>(a.parameters[U][c])...};
          const std::tuple fresnels{
              typename LobeAt<L>::Fresnel(a.parameters[n_diffuse + 3 * L + 2][c])...};
          const F *const target = a.target[c] + at, *const weight =
                                                        a.weight[c] + Way::template place<F>(at);
          const B offset(a.offset);
          Sums<F, K> sums(a, c);
          B cost = load<B>(a.cost);
          for (std::size_t i = 0; i < x.n; i += lanes<B>) {
            const auto angles = angles_with<Value::anisotropic, Way>(x, i);
            [[maybe_unused]] const auto ratio = ratio_at<0>(rows, i);
            const std::tuple diffuse{std::get<U>(terms)(angles) * ratio...};
            const std::tuple fresnel{std::get<L>(fresnels)(angles)...};
            std::array<B, n_lobes> by_shape, by_fresnel;
            const auto add = [&]<std::size_t l>(const auto& base, const auto& under) {
              const B dv = load<B>(rows[rows_before(l)].data() + i);
              const auto sum =
                  lobe_on(base, under, One{}, input<0, 3>(dv), input<1, 3>(std::get<l>(fresnel).v));
              by_shape[l] = std::get<0>(sum.d);
              by_fresnel[l] = std::get<1>(sum.d);
              return sum;
            };
            const auto first = add.template operator()<0>(
                beneath((Zero{} + ... + std::get<U>(diffuse).v)),
                beneath((Zero{} + ... + only_if<Diffuse<F>::coupled>(std::get<U>(diffuse).v))));
            B f = first.v;
            each<n_lobes - 1>([&]<std::size_t before>() {
              f = add.template operator()<before + 1>(input<2, 3>(f), Zero{}).v;
            });

            const auto [value, slope] = linked<kind, B>(f, offset);
            const auto compared =
                weighted<B>(value, slope, load<B>(target + i), Way::of_sample(weight, i));
            const B &r = compared[0], &w = compared[1];  // names that lambdas may capture
            [[maybe_unused]] const auto matt = by_ratio(first, std::get<U>(terms)(angles).v...);
            std::array<B, K>
                column;  // made after the link: what lives across a logarithm is spilled
            column[0] = r;
            std::size_t k = 1;
            each<n_lobes>([&]<std::size_t l>() {
              each<LobeAt<l>::of_shape>([&]<std::size_t s>() {
                const B by = load<B>(rows[rows_before(l) + 1 + s].data() + i) * by_shape[l];
                constexpr std::size_t fixed = LobeAt<l>::of_shape - LobeAt<l>::of_frame;
                if constexpr (tilts<Way> && s >= fixed)
                  column[k++] = unmasked<B>(w, by + matt * ratio_at<1 + s - fixed>(rows, i));
                else
                  column[k++] = unmasked<B>(w, by);
              });
              for (const B& slope_of_f : std::get<l>(fresnel).d)
                column[k++] = unmasked<B>(w, by_fresnel[l] * slope_of_f);
            });
            each<n_diffuse>([&]<std::size_t u>() {
              for (const B& d : std::get<u>(diffuse).d)
                column[k++] = unmasked<B>(w, B(by_diffuse<u>(first) * d));
            });
            sums.add(column);
            cost = cost + r * r;
          }
          store<B>(a.cost, cost);
          sums.store(a, c);
        }
      }
    }
    (std::make_index_sequence<n_diffuse>{}, std::make_index_sequence<n_lobes>{});
  }
};

// ---- tables -------------------------------------------------------------------------------------

template <class F, template <class> class... Terms>
constexpr void put_ids(FusedIds& ids, std::size_t& at, TermList<Terms...>) {
  ((ids.id[at++] = Terms<F>::about.id), ...);
}
template <class F, class Diffuse, class... Lobes>
constexpr FusedIds ids_of(ModelTerms<Diffuse, Lobes...>) {
  FusedIds ids;
  put_ids<F>(ids, ids.diffuse, Diffuse{});
  std::size_t at = ids.diffuse;
  (put_ids<F>(ids, at, Lobes{}), ...);
  return ids;
}

template <class F, class... Models>
constexpr auto value_table(FusedList<Models...>) {
  return std::array<FusedKernel<F>, sizeof...(Models)>{
      FusedKernel<F>{ids_of<F>(Models{}),
                     {nullptr, Fused<F, Models>::template value<1>, nullptr,
                      Fused<F, Models>::template value<3>}}...};
}
template <class F, class... Models>
constexpr auto normal_table(FusedList<Models...>) {
  return std::array<NormalKernel<F>, sizeof...(Models)>{NormalKernel<F>{
      ids_of<F>(Models{}),
      FusedNormal<F, Models>::columns(),
      FusedNormal<F, Models>::K - 1,
      {FusedNormal<F, Models>::template pass<Link::identity, NormalSums, NormalArguments<F>>,
       FusedNormal<F, Models>::template pass<Link::log, NormalSums, NormalArguments<F>>}}...};
}

/// Defined in the file of each group of models.
template <FusedGroup group, class F>
FusedModels<F> fused_models();

#define GONIO_FUSED(group, Hot, HotFits)                          \
  template <>                                                     \
  FusedModels<float> fused_models<group, float>() {               \
    static constexpr auto values = value_table<float>(Hot{});     \
    static constexpr auto fits = normal_table<float>(HotFits{});  \
    return {values, fits};                                        \
  }                                                               \
  template <>                                                     \
  FusedModels<double> fused_models<group, double>() {             \
    static constexpr auto values = value_table<double>(Hot{});    \
    static constexpr auto fits = normal_table<double>(HotFits{}); \
    return {values, fits};                                        \
  }

}  // namespace gonio::inline GONIO_ARCH
