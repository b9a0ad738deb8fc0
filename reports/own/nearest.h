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
#include "reports/own/guards.h"

namespace gonio {

/// Values that differ by less are the same.
inline constexpr double same_within = 1e-3;

struct NearestForm {
  std::size_t term = 0;            ///< of the catalogue
  std::optional<Parameter> width;  ///< the file's parameter that stands for alpha
  double power = 1;                ///< alpha = width^power
  double factor = 1;               ///< the file's value over the form's
  double difference =
      0;  ///< largest, of a distribution over its peak; where it is capped, elsewhere
  std::optional<double> cap;  ///< the file's largest value, where it is less than the form's
  /// Least and largest of the factors by width, where one for all is not enough: the form is right, its norm is not.
  std::optional<Range> norms;
  std::optional<Bite> bite;
  std::optional<Drop> drop;               ///< of masking
  bool of_one = false;                    ///< masking by one direction
  bool is_swapped = false;                ///< its two widths, by their names
  std::vector<std::string> as_shipped{};  ///< what it lacks beside the form that it stands for
};

/// The nearest form of the same role; none where nothing has a value that can be compared.
std::optional<NearestForm> nearest_form(std::size_t foreign_term);
/// The likely mistakes, a sentence each; empty where the function is what its names promise, or resembles no form.
std::vector<std::string> likely_slips(std::size_t foreign_term, const NearestForm&);
/// What is right for some callers and wrong for others, a sentence each.
std::vector<std::string> to_check(const Parameter& width, double power);
std::vector<std::string> to_check(const NearestForm&);
/// What its k is right for; "" of a form without one.  \param form  its id
std::string k_of(std::string_view form);
/// "4 times too large: a 4 is missing below"
std::string factor_text(double factor);
/// True where the file's function is that form, by these maps.
bool is_same(const NearestForm&);

}  // namespace gonio
