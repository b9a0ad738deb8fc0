#pragma once
/// \file
/// A role's terms in fifty digits.  Included by the files that pay for Boost.Multiprecision; each term is
/// compiled once.

#include <vector>

#include "brdf/in_number/terms_in.h"
#include "number/wide.h"

namespace gonio {

using WideTerm = void (*)(const std::vector<Wide>& parameters,
                          std::span<const FrameAngles<Wide>> rows,
                          Wide* out);

/// A term as formula and as entry of the catalogue in fifty digits.
struct WideEntry {
  WideTerm f;
  bool anisotropic;
};
template <Role role>
std::span<const WideEntry> wide_terms();

/// A term's values at rows, rounded to double.
void wide_values(WideTerm term,
                 bool g2,
                 std::span<const double> parameters,
                 std::span<const FrameAngles<double>> rows,
                 double* out);

inline namespace GONIO_ARCH {

template <template <class> class Term>
void wide(const std::vector<Wide>& p, std::span<const FrameAngles<Wide>> rows, Wide* out) {
  static_assert(TermOver<Term<Wide>, Wide>);
  const Term<Wide> term{std::span<const Wide, Term<Wide>::parameters.size()>(p)};
  for (const auto& row : rows) *out++ = as_value<Wide>(term(row));
}

template <template <class> class Term, bool g2>
void values(std::span<const double> parameters,
            std::span<const FrameAngles<double>> rows,
            double* out) {
  wide_values(wide<Term>, g2, parameters, rows, out);
}
template <template <class> class... Terms>
constexpr auto values_of(TermList<Terms...>) {
  return std::array{
      TermIn{values<Terms, false>, is_masking<Terms<Wide>> ? &values<Terms, true> : nullptr}...};
}
template <template <class> class... Terms>
constexpr auto entries(TermList<Terms...>) {
  return std::array{WideEntry{wide<Terms>, is_anisotropic<Terms<Wide>>}...};
}

}  // namespace GONIO_ARCH

#define GONIO_TERMS_IN_WIDE(role, list)            \
  template <>                                      \
  std::span<const TermIn> terms_in_wide<role>() {  \
    static constexpr auto all = values_of(list{}); \
    return all;                                    \
  }                                                \
  template <>                                      \
  std::span<const WideEntry> wide_terms<role>() {  \
    static constexpr auto all = entries(list{});   \
    return all;                                    \
  }

}  // namespace gonio
