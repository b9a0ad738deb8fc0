#pragma once
/// \file
/// Which form of the catalogue a function of a person's file is, and by which slip it differs.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "brdf/catalogue/foreign_terms.h"
#include "number/parameter.h"

namespace gonio {

/// A way from a file's parameter to the catalogue's alpha.
struct WidthMap {
  std::string_view text;  ///< "alpha = roughness²", of the name put in for w
  double power;           ///< alpha = w^power
};

struct NearestForm {
  std::size_t term = 0;  ///< of the catalogue
  std::string width;     ///< the file's parameter that stands for alpha; empty: none
  double power = 1;      ///< alpha = width^power
  double factor = 1;     ///< the file's value over the form's
  double difference =
      0;  ///< largest, of a distribution over its peak; where it is capped, elsewhere
  std::optional<double> cap;  ///< the file's largest value, where it is less than the form's
  /// Least and largest of the factors by width, where one for all is not enough: the form is right, its norm is not.
  std::optional<Range> norms;
};

/// Whether a parameter's name says roughness, whose square alpha is.
bool is_rough(std::string_view name);

/// Model of the catalogue whose highlight a whole function has.
struct NearestModel {
  std::string spec;
  std::string width;
  double power = 1;          ///< of D: alpha = width^power
  double masking_power = 1;  ///< of V
  double factor = 1;         ///< the function's highlight over the model's
  std::size_t operations = 0;
  bool lacks_diffuse =
      false;  ///< the function has a diffuse part that is not Lambert's, which the model has not
};
/// The model whose D V F is the function's, with its other colours dark, but for a factor; none where none is, or where widths and f0 have no usual names.
std::optional<NearestModel> nearest_model(std::size_t foreign_term);
/// The likely mistakes in its factor and its width, a sentence each.
std::vector<std::string> likely_slips(const NearestModel&);

/// The nearest form of the same role; none where nothing has a value that can be compared.
std::optional<NearestForm> nearest_form(std::size_t foreign_term);
/// The likely mistakes, a sentence each; empty where the function is what its names promise, or resembles no form.
std::vector<std::string> likely_slips(std::size_t foreign_term, const NearestForm&);
/// What is right where the caller passes alpha and wrong where it passes a roughness, a sentence.
std::vector<std::string> to_check(const std::string& width, double power);
/// True where the file's function is that form, by these maps.
bool is_same(const NearestForm&);

/// Values at which a function is looked at: within the parameter's bounds, or within [0.05, 1] where it has none.
std::vector<double> values_between(const Parameter&, std::size_t count);
/// The parameter whose name says that it is a width: alpha, roughness, m …
std::optional<std::size_t> width_of(std::span<const Parameter>);

}  // namespace gonio
