#pragma once
/// \file
/// A term: one factor of a model (D, V, F or diffuse), a struct template over its number.
///
///   about, parameters    what it is called, what it may be given
///   Term(span of T)      what depends on the parameters alone: computed once per block
///   operator()(angles)   the formula: computed once per sample; answers T or Quotient<T>
///   anisotropic          optional, true where it reads the tangent frame (FrameAngles)
///   as_shipped           optional, true where it is a shader's arithmetic operation by operation: in
///                        few bits it may divide by zero, cancel or overflow, and that is to be seen
///
/// The parameters are T (they may carry derivatives), the angles are plain_t<T> (they never do).
/// A term is added by writing its struct and naming it in its list (catalogue/distributions.h and its
/// neighbours); the registry, the command line, composition, the fit and the tests find it from there.

#include <array>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>

#include "geometry/angles.h"
#include "number/parameter.h"
#include "number/quotient.h"
#include "number/real.h"

namespace gonio {

/// A term's role in a model, told from its id.
enum class Role { ndf, masking, fresnel, diffuse };

constexpr Role role_of(std::string_view id) {
  if (id.starts_with("ndf.")) return Role::ndf;
  if (id.starts_with("masking.")) return Role::masking;
  if (id.starts_with("fresnel.")) return Role::fresnel;
  return Role::diffuse;
}

/// The id without the role's prefix, as a model spec writes it.
constexpr std::string_view short_id(std::string_view id) {
  return id.substr(id.find('.') + 1);
}

}  // namespace gonio

namespace gonio::inline GONIO_ARCH {

/// True of a term that reads the tangent frame, which an isotropic surface has not.
template <class Term>
inline constexpr bool is_anisotropic = requires {
  requires Term::anisotropic;
};

/// True of a term that is held to be finite in double only.
template <class Term>
inline constexpr bool is_as_shipped = requires {
  requires Term::as_shipped;
};

/// True of a term that is the same at all angles.
template <class Term>
inline constexpr bool is_uniform = requires {
  requires Term::uniform;
};

/// Angles of one sample, as a term is given them.
template <class Term, class B>
using angles_of = std::conditional_t<is_anisotropic<Term>, FrameAngles<B>, Angles<B>>;

/// True of a term that leaves its division to whoever multiplies it.
template <template <class> class Term, class F>
inline constexpr bool is_fraction =
    !std::same_as<decltype(std::declval<Term<F>>()(std::declval<angles_of<Term<F>, F>>())), F>;

template <class Term, class T>
concept TermOver = Real<T> && requires(const Term t,
                                       const angles_of<Term, plain_t<T>> a,
                                       std::span<const T, Term::parameters.size()> p) {
  { Term::about } -> std::same_as<const About&>;
  Term(p);
  { as_value(t(a)) } -> std::same_as<T>;
};

}  // namespace gonio::inline GONIO_ARCH
