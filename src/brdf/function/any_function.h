#pragma once
/// \file
/// A term as a function over a number, of the catalogue or of a person's file.

#include "brdf/catalogue/foreign_terms.h"
#include "brdf/function/functions.h"

namespace gonio {

/// Rows of a foreign term: its program, run in T.
template <class T>
void foreign_rows(const ForeignTerm&,
                  std::span<const T> parameters,
                  std::span<const FrameAngles<T>> rows,
                  Quotient<T>* out);

template <class T>
struct AnyFunction {
  TermFunction<T> own;
  const ForeignTerm* foreign;

  void rows(std::span<const T> parameters,
            std::span<const FrameAngles<T>> at,
            Quotient<T>* out) const {
    foreign ? foreign_rows<T>(*foreign, parameters, at, out) : own.rows(parameters, at, out);
  }
  Quotient<T> operator()(std::span<const T> parameters, const FrameAngles<T>& angles) const {
    Quotient<T> q;
    rows(parameters, {&angles, 1}, &q);
    return q;
  }
};

template <class T>
AnyFunction<T> any_function(std::size_t term) {
  const auto* foreign = foreign_term(term);
  return {foreign ? TermFunction<T>{} : term_function<T>(term), foreign};
}

}  // namespace gonio
