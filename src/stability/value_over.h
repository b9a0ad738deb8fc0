#pragma once
/// \file
/// A subject's value over a number of any kind: enclosures, scripts, graphs, numbers that round as they are told.

#include <optional>
#include <span>
#include <vector>

#include "brdf/catalogue/registry.h"
#include "brdf/function/any_function.h"
#include "brdf/term/product.h"
#include "stability/subject.h"

namespace gonio::stability {

/// One channel of a model by the product rule (brdf/term/product.h).
///
/// \param term  value of a term: TermUse → Quotient<T>, asked for each once, in the model's order
template <class T>
T value_of_terms(const Model& model, auto&& term) {
  std::optional<T> sum, under;
  const auto add = [](std::optional<T>& to, const T& x) { to = to ? T(*to + x) : x; };
  for (const auto& use : model.diffuse) {
    const T x = Quotient<T>(term(use)).value();
    add(sum, x);
    if (catalogue()[use.term].coupled) add(under, x);
  }
  for (const auto& lobe : model.lobes) {
    const Quotient<T> d = term(lobe.ndf), v = term(lobe.masking), dv = d * v;
    const Quotient<T> fresnel = term(lobe.fresnel);
    const bool coupled = under && &lobe == &model.lobes.front();
    if (coupled)
      sum = lobe_on(*sum, *under, One{}, dv.value(), fresnel.value());
    else
      add(sum, lobe_on(Zero{}, Zero{}, One{}, dv, fresnel).value());
  }
  return *sum;
}

/// Model of one channel.  \param parameters  in the order of its values
template <class T>
T value_over(const Model& model, std::span<const T> parameters, const FrameAngles<T>& angles) {
  return value_of_terms<T>(model, [&](const TermUse& use) {
    std::vector<T> own;
    for (const auto k : use.parameters) own.push_back(parameters[model.parameters[k].first]);
    return any_function<T>(use.term)(own, angles);
  });
}

/// Subject at inputs in its order.
template <class T>
T value_over(const Subject& s, std::span<const T> inputs) {
  const auto parameters = inputs.first(s.parameters);
  const auto angles = angles_of<T>(s.given, inputs.subspan(s.parameters));
  return s.term ? any_function<T>(*s.term)(parameters, angles).value()
                : value_over<T>(*s.model, parameters, angles);
}

}  // namespace gonio::stability
