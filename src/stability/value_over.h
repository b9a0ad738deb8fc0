#pragma once
/// \file
/// A subject's value over a number of any kind: enclosures, scripts, numbers that round as they are told.

#include <optional>
#include <span>
#include <vector>

#include "brdf/catalogue/registry.h"
#include "brdf/function/functions.h"
#include "brdf/term/product.h"
#include "stability/subject.h"

namespace gonio::stability {

/// Term of a model, its parameters among the model's.
template <class T>
Quotient<T> value_over(const TermUse& use,
                       const Model& model,
                       std::span<const T> parameters,
                       const FrameAngles<T>& angles) {
  std::vector<T> own;
  for (const auto k : use.parameters) own.push_back(parameters[model.parameters[k].first]);
  return term_function<T>(use.term)(own, angles);
}

/// Model of one channel, by the product rule (brdf/term/product.h).
template <class T>
T value_over(const Model& model, std::span<const T> parameters, const FrameAngles<T>& angles) {
  std::optional<T> sum, under;
  const auto add = [](std::optional<T>& to, const T& x) { to = to ? T(*to + x) : x; };
  for (const auto& use : model.diffuse) {
    const T x = value_over(use, model, parameters, angles).value();
    add(sum, x);
    if (catalogue()[use.term].coupled) add(under, x);
  }
  for (const auto& lobe : model.lobes) {
    const auto dv = value_over(lobe.ndf, model, parameters, angles) *
                    value_over(lobe.masking, model, parameters, angles);
    const auto fresnel = value_over(lobe.fresnel, model, parameters, angles);
    const bool coupled = under && &lobe == &model.lobes.front();
    if (coupled)
      sum = lobe_on(*sum, *under, One{}, dv.value(), fresnel.value());
    else
      add(sum, lobe_on(Zero{}, Zero{}, One{}, dv, fresnel).value());
  }
  return *sum;
}

/// Subject at inputs in its order.
template <class T>
T value_over(const Subject& s, std::span<const T> inputs) {
  const auto parameters = inputs.first(s.parameters);
  const auto angles = angles_of<T>(s.given, inputs.subspan(s.parameters));
  return s.term ? term_function<T>(*s.term)(parameters, angles).value()
                : value_over<T>(*s.model, parameters, angles);
}

}  // namespace gonio::stability
