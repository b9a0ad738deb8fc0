#pragma once
/// \file
/// The product rule: how its terms make a model, whatever they are computed in.
///
///   f = Σ diffuse + Σ_l w_l F_l (D_l V_l − under_l)                                           [1/sr]
///
/// `under` is what of the diffuse terms lies below the lobe's interface and sees what F lets through: of
/// the first lobe the coupled terms, of the others nothing.  The model is built lobe by lobe, each `on`
/// what is there.  Numbers of a sample or of a register full make the fused loops and the kernels that
/// models are composed of; Partials (number/known.h) the columns of the fused normal equations; columns
/// that write down what is done to them the derivatives of a composed model.  What is absent, a weight
/// of 1 included, is a Known number and costs nothing.

#include "brdf/term/term.h"
#include "number/known.h"
#include "number/quotient.h"

namespace gonio::inline GONIO_ARCH {

/// Fractions in the rule: a product stays one, a sum divides.
template <Real T>
Quotient<T> operator*(const Quotient<T>& a, const Quotient<T>& b) {
  return {a.num * b.num, a.den * b.den, a.whole && b.whole};
}
template <Real T>
T operator+(const T& x, const Quotient<T>& q) {
  return x + q.value();
}

/// base with a lobe on it.
///
/// \param under  part of base
/// \param dv     D V; of several channels that share it, divided, else it may be a Quotient as F may
template <class Base, class Under, class Weight, class Shape, class Fresnel>
auto lobe_on(const Base& base,
             const Under& under,
             const Weight& weight,
             const Shape& dv,
             const Fresnel& fresnel) {
  return base + weight * (dv - under) * fresnel;
}

/// D V of one lobe, as one fraction.
template <template <class> class D, template <class> class V, class T>
struct LobeShape {
  static constexpr bool anisotropic = is_anisotropic<D<T>> || is_anisotropic<V<T>>;
  D<T> d;
  V<T> v;

  Quotient<T> operator()(const auto& angles) const {
    return as_quotient<T>(d(angles)) * as_quotient<T>(v(angles));
  }
};

}  // namespace gonio::inline GONIO_ARCH
