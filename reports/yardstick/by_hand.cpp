// Compiled once per instruction set (GONIO_ARCH), with contraction: products that are added to take
// one operation, as a hand that does not have to agree with anyone bit by bit would have it.
#include "reports/yardstick/by_hand.h"

#include <array>
#include <cmath>
#include <numbers>

#include "brdf/kernel/lane.h"

namespace gonio::inline GONIO_ARCH {
namespace {

template <class F>
inline constexpr F pi_of = std::numbers::pi_v<F>;

template <class F>
auto power_5(const F& x) {
  const F x2 = x * x;
  return F(x2 * x2 * x);
}

/// out(i, loads) for every lane.
template <class F>
void each(const Block<F>& x, auto&& body) {
  for (std::size_t i = 0; i < x.n; i += lanes<Lane<F>>) body(i);
}

/// r(c) = √(α² + (1 − α²) c²)
template <class F>
struct Root {
  Lane<F> a2, rest;
  explicit Root(F alpha) : a2(alpha * alpha), rest(1 - alpha * alpha) {}
  Lane<F> operator()(const Lane<F>& c) const { return sqrt(a2 + rest * c * c); }
};

/// Divisor of α²/π in D V: (NoH² (α² − 1) + 1)² · 2 (NoL r(NoV) + NoV r(NoL))
template <class F>
struct GgxCorrelated {
  using B = Lane<F>;
  Root<F> root;
  B less;
  explicit GgxCorrelated(F alpha) : root(alpha), less(alpha * alpha - 1) {}
  B den(const B& nol, const B& nov, const B& noh) const {
    const B q = noh * noh * less + B(1), sum = nol * root(nov) + nov * root(nol);
    return q * q * sum;
  }
  static F num(F alpha) { return alpha * alpha / (2 * pi_of<F>); }
};

template <class F>
void ggx_schlick(const Block<F>& x, const F* p, F* const* out) {
  using B = Lane<F>;
  const GgxCorrelated<F> g(p[0]);
  const B num(GgxCorrelated<F>::num(p[0])), f0(p[1]), rest(1 - p[1]);
  each(x, [&](std::size_t i) {
    const B den = g.den(load<B>(x.nol + i), load<B>(x.nov + i), load<B>(x.noh + i));
    store<B>(out[0] + i, num / den * (rest * power_5<B>(B(1) - load<B>(x.voh + i)) + f0));
  });
}

/// With |N² − s²| = m and a its root's real part:  F = R_s (c² m + s⁴)/(c² m + s⁴ + 2 a c s²)
template <class F>
void ggx_conductor(const Block<F>& x, const F* p, F* const* out) {
  using B = Lane<F>;
  const GgxCorrelated<F> g(p[0]);
  const F eta = p[1], k = p[2];
  const B num(GgxCorrelated<F>::num(p[0])), re(eta * eta - k * k), im2(4 * eta * eta * k * k);
  each(x, [&](std::size_t i) {
    const B den = g.den(load<B>(x.nol + i), load<B>(x.nov + i), load<B>(x.noh + i));
    const B c = load<B>(x.voh + i), c2 = c * c, s2 = B(1) - c2, t = re - s2;
    const B m = sqrt(t * t + im2), a = sqrt(B(F(0.5)) * (m + t));
    const B s_even = m + c2, odd = B(2) * a * c, p_even = c2 * m + s2 * s2;
    store<B>(out[0] + i,
             num * (s_even - odd) * p_even / (den * (s_even + odd) * (p_even + odd * s2)));
  });
}

/// e^(−tan²/α²)/(π α² NoH⁴)
template <class F>
Lane<F> beckmann(const Lane<F>& noh, F per_alpha2) {
  using B = Lane<F>;
  const B c2 = noh * noh, per_c2 = B(1) / c2;
  return exp((B(1) - per_c2) * B(per_alpha2)) * per_c2 * per_c2 * B(per_alpha2 / pi_of<F>);
}

/// G₁/c by Walter's fit.
template <class F>
std::array<Lane<F>, 2> beckmann_fit(const Lane<F>& c, const Lane<F>& alpha) {
  using B = Lane<F>;
  const B w = alpha * sqrt(B(1) - c * c);
  const auto masked = c < B(F(1.6)) * w;
  return {select<B>(masked, B(F(3.535)) * w + B(F(2.181)) * c, B(1)),
          select<B>(masked, w * w + B(F(2.276)) * w * c + B(F(2.577)) * c * c, c)};
}

template <class F>
void beckmann_schlick(const Block<F>& x, const F* p, F* const* out) {
  using B = Lane<F>;
  const F per_alpha2 = 1 / (p[0] * p[0]);
  const B alpha(p[0]), f0(p[1]), rest(1 - p[1]);
  each(x, [&](std::size_t i) {
    const auto [l, l_den] = beckmann_fit<F>(load<B>(x.nol + i), alpha);
    const auto [v, v_den] = beckmann_fit<F>(load<B>(x.nov + i), alpha);
    store<B>(out[0] + i, beckmann<F>(load<B>(x.noh + i), per_alpha2) * l * v *
                             (rest * power_5<B>(B(1) - load<B>(x.voh + i)) + f0) /
                             (B(4) * l_den * v_den));
  });
}

template <class F>
void gtr_schlick(const Block<F>& x, const F* p, F* const* out) {
  using B = Lane<F>;
  const F a2 = p[0] * p[0], gamma = p[1];
  const F norm = std::abs(gamma - 1) < F(1e-4)
                     ? (a2 - 1) / (pi_of<F> * std::log(a2))
                     : (gamma - 1) * (a2 - 1) / (pi_of<F> * (1 - std::pow(a2, 1 - gamma)));
  const Root<F> root(p[0]);
  const B less(a2 - 1), f0(p[2]), rest(1 - p[2]), num(norm / 2), power(-gamma);
  each(x, [&](std::size_t i) {
    const B nol = load<B>(x.nol + i), nov = load<B>(x.nov + i), noh = load<B>(x.noh + i);
    const B d = num * exp(power * log(noh * noh * less + B(1)));
    store<B>(out[0] + i, d / (nol * root(nov) + nov * root(nol)) *
                             (rest * power_5<B>(B(1) - load<B>(x.voh + i)) + f0));
  });
}

/// Colours of a metallic workflow: kd/π, F0.
template <class F>
struct Colours {
  std::array<Lane<F>, 3> diffuse, f0;
  Colours(const F* kd, const F* f0_of) {
    for (std::size_t c = 0; c < 3; ++c) {
      diffuse[c] = Lane<F>(kd[c] / pi_of<F>);
      f0[c] = Lane<F>(f0_of[c]);
    }
  }
};

template <class F>
void cook_torrance(const Block<F>& x, const F* p, F* const* out) {
  using B = Lane<F>;
  const GgxCorrelated<F> g(p[3]);
  const B num(GgxCorrelated<F>::num(p[3]));
  const Colours<F> colours(p, p + 4);
  each(x, [&](std::size_t i) {
    const B dv = num / g.den(load<B>(x.nol + i), load<B>(x.nov + i), load<B>(x.noh + i));
    const B m5 = power_5<B>(B(1) - load<B>(x.voh + i));
    for (std::size_t c = 0; c < 3; ++c) {
      const B f = colours.f0[c] + (B(1) - colours.f0[c]) * m5;
      store<B>(out[c] + i, colours.diffuse[c] + f * (dv - colours.diffuse[c]));
    }
  });
}

template <class F>
void gltf(const Block<F>& x, const F* p, F* const* out) {
  using B = Lane<F>;
  const Root<F> root(p[3]);
  const B less(p[3] * p[3] - 1), num(p[3] * p[3] / pi_of<F>);
  const Colours<F> colours(p, p + 4);
  each(x, [&](std::size_t i) {
    const B nol = load<B>(x.nol + i), nov = load<B>(x.nov + i), noh = load<B>(x.noh + i);
    const B q = noh * noh * less + B(1);
    const B dv = num / (q * q * (nol + root(nol)) * (nov + root(nov)));
    const B m5 = power_5<B>(B(1) - load<B>(x.voh + i));
    for (std::size_t c = 0; c < 3; ++c) {
      const B f = colours.f0[c] + (B(1) - colours.f0[c]) * m5;
      store<B>(out[c] + i, colours.diffuse[c] + f * (dv - colours.diffuse[c]));
    }
  });
}

template <class F>
void filament(const Block<F>& x, const F* p, F* const* out) {
  using B = Lane<F>;
  const GgxCorrelated<F> g(p[3]);
  const B num(GgxCorrelated<F>::num(p[3])), f90(p[7]);
  const Colours<F> colours(p, p + 4);
  each(x, [&](std::size_t i) {
    const B dv = num / g.den(load<B>(x.nol + i), load<B>(x.nov + i), load<B>(x.noh + i));
    const B m5 = power_5<B>(B(1) - load<B>(x.voh + i));
    for (std::size_t c = 0; c < 3; ++c)
      store<B>(out[c] + i, colours.diffuse[c] + dv * (colours.f0[c] + (f90 - colours.f0[c]) * m5));
  });
}

/// Values: kd, alpha, alpha_x, alpha_y, f0, alpha_2, f0_2, weight_2.
/// \param own_widths  masked by alpha_x and alpha_y, not by the remapped roughness
template <class F, bool own_widths>
void disney(const Block<F>& x, const F* p, F* const* out) {
  using B = Lane<F>;
  const Colours<F> colours(p, p + 6);
  const F r = std::sqrt(p[3]), g = (r + 1) * (r + 1) / 4, coat2 = p[9] * p[9];
  const Root<F> root(g), coat_root(F(0.25));
  const B two_r(2 * r), x2(1 / (p[4] * p[4])), y2(1 / (p[5] * p[5]));
  const B pi_xy(pi_of<F> * p[4] * p[5]), coat_less(coat2 - 1);
  const B ax2(p[4] * p[4]), ay2(p[5] * p[5]);
  const B coat_num(p[13] * (coat2 - 1) / (pi_of<F> * std::log(coat2))), coat_f0(p[10]);
  each(x, [&](std::size_t i) {
    const B nol = load<B>(x.nol + i), nov = load<B>(x.nov + i), noh = load<B>(x.noh + i);
    const B voh = load<B>(x.voh + i), m5 = power_5<B>(B(1) - voh);
    const B edge = two_r * voh * voh - B(F(0.5));
    const B spread =
        (B(1) + edge * power_5<B>(B(1) - nol)) * (B(1) + edge * power_5<B>(B(1) - nov));
    const B xoh = load<B>(x.frame[0] + i), yoh = load<B>(x.frame[1] + i);
    const B s = xoh * xoh * x2 + yoh * yoh * y2 + noh * noh;
    const auto masked = [&](const B& c, std::size_t along) {
      if constexpr (!own_widths) return c + root(c);
      const B t = load<B>(x.frame[along] + i), b = load<B>(x.frame[along + 1] + i);
      return c + sqrt(t * t * ax2 + b * b * ay2 + c * c);
    };
    const B base = B(1) / (pi_xy * s * s * masked(nol, 2) * masked(nov, 4));
    const B coat =
        coat_num * (coat_f0 + (B(1) - coat_f0) * m5) /
        ((noh * noh * coat_less + B(1)) * (nol + coat_root(nol)) * (nov + coat_root(nov)));
    for (std::size_t c = 0; c < 3; ++c) {
      const B f = colours.f0[c] + (B(1) - colours.f0[c]) * m5;
      store<B>(out[c] + i, colours.diffuse[c] * spread + base * f + coat);
    }
  });
}

template <class F>
void ue_mobile(const Block<F>& x, const F* p, F* const* out) {
  using B = Lane<F>;
  const F a2 = p[0] * p[0];
  const B alpha(p[0]), rest(1 - p[0]), b2(a2), edge(std::min(50 * p[4], F(1)));
  const std::array f0{B(p[1]), B(p[2]), B(p[3])};
  each(x, [&](std::size_t i) {
    const B nol = load<B>(x.nol + i), noh = load<B>(x.noh + i);
    const B nov = min(load<B>(x.nov + i) + B(F(1e-5)), B(1));
    const B d = (noh * b2 - noh) * noh + B(1), ndf = min(b2 / (d * d), B(2048));
    const B vis = nol * (nov * rest + alpha) + nov * (nol * rest + alpha);
    const B dv = ndf * (B(F(0.5)) / max(vis, B(F(0.001))));
    const B m5 = power_5<B>(B(1) - load<B>(x.voh + i));
    for (std::size_t c = 0; c < 3; ++c)
      store<B>(out[c] + i, dv * (edge * m5 + (B(1) - m5) * f0[c]));
  });
}

template <class F>
void ue_mobile_simple(const Block<F>& x, const F* p, F* const* out) {
  using B = Lane<F>;
  const B alpha(p[0]);
  std::array<B, 3> colour;
  for (std::size_t c = 0; c < 3; ++c) colour[c] = B(p[1 + c] * (std::sqrt(p[0]) + 1) / 4);
  each(x, [&](std::size_t i) {
    const B noh = load<B>(x.noh + i), n = noh * alpha, q = alpha / (B(1) - noh * noh + n * n);
    const B d = min(q * q, B(2048));
    for (std::size_t c = 0; c < 3; ++c) store<B>(out[c] + i, d * colour[c]);
  });
}

template <class F>
void unity_mobile(const Block<F>& x, const F* p, F* const* out) {
  using B = Lane<F>;
  const F a2 = p[0] * p[0];
  const B less(a2 - 1), num(a2 / (pi_of<F> * (4 * std::sqrt(p[0]) + 2)));
  const std::array f0{B(p[1]), B(p[2]), B(p[3])};
  each(x, [&](std::size_t i) {
    const B noh = load<B>(x.noh + i), loh = load<B>(x.voh + i), q = noh * noh * less + B(1);
    const B dv = num / (q * q * loh * loh);
    for (std::size_t c = 0; c < 3; ++c) store<B>(out[c] + i, dv * f0[c]);
  });
}

template <class F>
constexpr std::array table{
    HandWritten<F>{"ggx/smith_ggx.correlated/schlick", 1, ggx_schlick<F>},
    HandWritten<F>{"ggx/smith_ggx.correlated/conductor", 1, ggx_conductor<F>},
    HandWritten<F>{"beckmann/smith_beckmann.rational/schlick", 1, beckmann_schlick<F>},
    HandWritten<F>{"gtr/smith_ggx.correlated/schlick", 1, gtr_schlick<F>},
    HandWritten<F>{"lambert.coupled+ggx/smith_ggx.correlated/schlick", 3, cook_torrance<F>},
    HandWritten<F>{"lambert.coupled+ggx/smith_ggx.separable/schlick", 3, gltf<F>},
    HandWritten<F>{"lambert+ggx/smith_ggx.correlated/schlick.f90", 3, filament<F>},
    HandWritten<F>{
        "diffuse.disney+ggx_aniso/disney_remap/schlick+gtr1/disney_coat/schlick.weighted", 3,
        disney<F, false>},
    HandWritten<F>{"diffuse.disney+ggx_aniso/smith_ggx_aniso.separable/schlick+gtr1/disney_coat/"
                   "schlick.weighted",
                   3, disney<F, true>},
    HandWritten<F>{"ggx.ue_mobile/ue_joint.clamped/schlick.ue", 3, ue_mobile<F>},
    HandWritten<F>{"ggx.mobile/ue_mobile_simple/constant", 3, ue_mobile_simple<F>},
    HandWritten<F>{"ggx/unity_mobile/constant", 3, unity_mobile<F>}};

template <class F>
void bound(const Block<F>& x, F* out) {
  using B = Lane<F>;
  each(x, [&](std::size_t i) {
    store<B>(out + i, load<B>(x.noh + i) / (sqrt(load<B>(x.nol + i)) + sqrt(load<B>(x.nov + i))));
  });
}

}  // namespace

extern const ByHand<float> by_hand_float;
extern const ByHand<double> by_hand_double;
constinit const ByHand<float> by_hand_float{table<float>, {bound<float>}};
constinit const ByHand<double> by_hand_double{table<double>, {bound<double>}};

}  // namespace gonio::inline GONIO_ARCH
