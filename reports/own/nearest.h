#pragma once
/// \file
/// Which form of the catalogue a function of a person's file is, and by which slip it differs.

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "brdf/catalogue/foreign_terms.h"
#include "number/parameter.h"

namespace gonio {

/// Values that differ by less are the same.
inline constexpr double same_within = 1e-3;

/// A guard or a clamp that holds a narrow peak down.
struct Bite {
  double from = 0;                 ///< the width where a tenth of the peak is lost
  double narrowest = 0, left = 0;  ///< the narrowest, and what is left of the peak there
  bool is_little = false;          ///< only where lobes are narrower than materials are
};
/// \param left  part of the peak by width
std::optional<Bite> bite_of(const Parameter& width,
                            double power,
                            const std::function<double(double)>& left);
std::string text_of(const Bite&, const Parameter& width, double power);

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
};

/// The nearest form of the same role; none where nothing has a value that can be compared.
std::optional<NearestForm> nearest_form(std::size_t foreign_term);
/// The likely mistakes, a sentence each; empty where the function is what its names promise, or resembles no form.
std::vector<std::string> likely_slips(std::size_t foreign_term, const NearestForm&);
/// What is right for some callers and wrong for others, a sentence each.
std::vector<std::string> to_check(const Parameter& width, double power);
std::vector<std::string> to_check(const NearestForm&);
inline constexpr const char* k_of_direct_light =
    "its k is that of direct light, (roughness + 1)²/8: right for lamps; under an environment k = "
    "alpha/2";
/// "4 times too large: a 4 is missing below"
std::string factor_text(double factor);
/// True where the file's function is that form, by these maps.
bool is_same(const NearestForm&);

}  // namespace gonio
