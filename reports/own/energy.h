#pragma once
/// \file
/// Energy of a whole function of a person's file: the most and the least light that it returns, and where.

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "integrate/rule/cubature.h"
#include "number/parameter.h"

namespace gonio {

/// A largest or smallest value and where it is.
struct FoundAt {
  double value = 0;
  std::string at;
  std::string repeat{};  ///< a command that prints it
};
void take_largest(std::optional<FoundAt>&, double value, const std::string& at);
void take_smallest(std::optional<FoundAt>&, double value, const std::string& at);

/// Directional albedos of a function of a file over values of its parameters.
class OwnAlbedo {
 public:
  /// \param token  the function as it is named in a spec
  OwnAlbedo(std::string token, std::span<const Parameter>, std::size_t channels, bool anisotropic);

  struct Place {
    std::vector<double> values;
    double mu = 1, phi_deg = 0;
  };
  /// By cosine of the view: the largest of its channels, or the smallest; NaN where one has no value.
  std::vector<double> at(const std::vector<double>& values,
                         std::span<const double> mu,
                         double phi_deg,
                         const Goal&,
                         bool smallest = false) const;
  double along_normal(const std::vector<double>& values) const;
  FoundAt found(const Place&, bool smallest) const;
  /// The albedo at a place with all colours dark but for F0.
  double without_diffuse(const Place&) const;

  std::span<const Parameter> parameters() const { return parameters_; }
  bool is_anisotropic() const { return anisotropic_; }

 private:
  std::string token_;
  std::span<const Parameter> parameters_;
  std::size_t channels_;
  bool anisotropic_;
};

/// Largest and smallest albedos within all bounds, for views up to 88°.  They are sought: from corners, defaults and places
/// between, and then uphill from the best.
struct Energy {
  FoundAt albedo;  ///< the largest
  std::optional<FoundAt>
      part;  ///< the largest that one colour adds at its upper bound; none of one colour
  /// Where the largest exceeds 1: what is left of it there with all colours dark that are not F0: the highlight's.
  std::optional<double> without_diffuse;
  FoundAt darkest;               ///< the smallest, colours at their upper bounds
  std::optional<FoundAt> usual;  ///< with defaults, at NoV 0.5
};
Energy energy_of(const OwnAlbedo&);

}  // namespace gonio
