// What every term's scan shares, for one instruction set: angles from what is given, and the
// comparison with double.
#include "stability/kernel/half_columns.h"

#include <limits>

#include "brdf/kernel/lane.h"
#include "number/half_lanes.h"

namespace gonio::stability {
inline namespace GONIO_ARCH {
namespace {

template <class B>
std::array<B, 11> in_order(const FrameAngles<B>& a) {
  return {a.nol, a.nov, a.noh, a.voh, a.sin2_theta_h, a.xoh, a.yoh, a.xol, a.yol, a.xov, a.yov};
}

/// \param into, out_of  a register from what is loaded, and what is stored of it
template <class B, class F>
void angles_in(Given given,
               std::size_t n,
               std::span<const F* const> in,
               const AngleColumns<F>& out,
               auto&& out_of) {
  using R = Lane<F>;
  std::array<B, 4> given_values{B(0), B(0), B(0), B(0)};
  for (std::size_t i = 0; i < n; i += lanes<R>) {
    for (std::size_t k = 0; k < in.size(); ++k) given_values[k] = B(load<R>(in[k] + i));
    const auto all =
        in_order(angles_of<B>(given, std::span<const B>(given_values).first(in.size())));
    for (std::size_t k = 0; k < all.size(); ++k) store<R>(out[k] + i, out_of(all[k]));
  }
}
template <HalfRules rules>
void half_angles(Given given,
                 std::size_t n,
                 std::span<const float* const> in,
                 const AngleColumns<float>& out) {
  using B = HalfOver<Lane<float>, rules>;
  angles_in<B, float>(given, n, in, out, [](const B& x) { return x.as_floats(); });
}
void double_angles(Given given,
                   std::size_t n,
                   std::span<const double* const> in,
                   const AngleColumns<double>& out) {
  using B = Lane<double>;
  angles_in<B, double>(given, n, in, out, [](const B& x) { return x; });
}

/// Unit of the last digit of a half next to |f|: by the exponent of f, at least that of 2⁻¹⁴.
template <class B>
B half_ulp(const B& size) {
  if constexpr (std::same_as<B, double>) {
    const auto bits = std::bit_cast<std::uint64_t>(std::max(size, 0x1p-14));
    return std::bit_cast<double>(bits & 0x7ff0'0000'0000'0000) * 0x1p-10;
  } else {
    using Integer = xsimd::batch<std::uint64_t, typename B::arch_type>;
    const auto bits = xsimd::bitwise_cast<Integer>(xsimd::max(size, B(0x1p-14)));
    return xsimd::bitwise_cast<B>(bits & Integer(std::uint64_t{0x7ff0'0000'0000'0000})) *
           B(0x1p-10);
  }
}

/// Lanes of a register, one of a scalar.
template <class B>
std::array<double, lanes<B>> lanes_of(const B& x) {
  alignas(64) std::array<double, lanes<B>> lane;
  store<B>(lane.data(), x);
  return lane;
}
template <class B>
std::uint64_t total(const B& counts) {
  double sum = 0;
  for (const double c : lanes_of<B>(counts)) sum += c;
  return static_cast<std::uint64_t>(sum);
}

void compare(
    std::size_t n, const float* x, const double* f, const Tolerance& tolerance, Compared& found) {
  using B = Lane<double>;
  constexpr std::size_t width = lanes<B>;
  const B zero(0.0), most(65504.0), infinite(65520.0), normal(0x1p-14), keeps(tolerance.relative),
      allowed(tolerance.absolute);
  const B one(1.0);
  B relative(0.0), ulp(0.0);
  B nothing(0.0), over(0.0), undefined(0.0), negative(0.0), negative_too(0.0), vanished(0.0),
      lost(0.0);
  alignas(64) std::array<double, width> as_double;
  for (std::size_t i = 0; i < n; i += width) {
    for (std::size_t k = 0; k < width; ++k) as_double[k] = static_cast<double>(x[i + k]);
    const B got = load<B>(as_double.data()), want = load<B>(f + i);
    const B size_got = select<B>(got < zero, -got, got), size = select<B>(want < zero, -want, want);
    const B error = select<B>(got < want, want - got, got - want);
    const auto a_value = size_got <= most, in_range = size < infinite;
    const auto too_large = infinite <= size;  // neither: f is no number
    const auto no_value = in_range && !a_value, is_normal = normal <= size;
    const auto compared = in_range && a_value;
    const auto both_normal = compared && is_normal && normal <= size_got;
    relative = max<B>(relative, select<B>(both_normal, error / size, zero));
    ulp = max<B>(ulp, select<B>(compared, error / half_ulp<B>(size), zero));
    const auto add = [&](B& counts, const auto& where) {
      counts = counts + select<B>(where, one, zero);
    };
    add(nothing, no_value);
    add(over, too_large && !a_value);
    add(undefined, !in_range && !too_large && !a_value);
    add(negative, compared && got < zero && zero <= want);
    add(negative_too, compared && got < zero && want < zero);
    add(vanished, compared && is_normal && size_got <= zero);
    add(lost, no_value || too_large ||
                  (compared && max<B>(keeps * max<B>(size, normal), allowed) < error));
  }
  found.no_value += total(nothing);
  found.overflow += total(over);
  found.undefined += total(undefined);
  found.negative += total(negative);
  found.negative_too += total(negative_too);
  found.vanished += total(vanished);
  found.beyond_tolerance += total(lost);
  for (const double r : lanes_of<B>(relative)) found.relative = std::max(found.relative, r);
  for (const double u : lanes_of<B>(ulp)) found.ulp = std::max(found.ulp, u);
}

#define GONIO_TEXT_(x) #x
#define GONIO_TEXT(x) GONIO_TEXT_(x)

}  // namespace

extern const HalfKernels half_columns;
constinit const HalfKernels half_columns = {GONIO_TEXT(GONIO_ARCH),
                                            {half_angles<all_rules[0]>, half_angles<all_rules[1]>,
                                             half_angles<all_rules[2]>, half_angles<all_rules[3]>},
                                            double_angles,
                                            compare,
                                            {}};

}  // namespace GONIO_ARCH
}  // namespace gonio::stability
