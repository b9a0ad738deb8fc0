#pragma once
/// \file
/// Forms that shaders have by a slip: those that no factor and no map of a width turn into one of the catalogue.

#include <array>
#include <cstddef>
#include <span>
#include <string>

#include "reports/measure/samples.h"

namespace gonio {

struct SlipForm {
  double (*value)(double alpha, const auditing::Row&);  ///< D, or V
  const char *slip, *like;  ///< like: the right form of the catalogue, without its role
};
/// Those of a distribution or of a masking term.
std::span<const SlipForm> slip_forms(Role);

/// The slip by which values over rows are F at that F0, a sentence; empty where they are that of none.
/// \param of_model  of a whole model, which has other cosines, too
std::string fresnel_slip(double f0,
                         std::span<const auditing::Row>,
                         std::span<const double> values,
                         bool of_model);
/// Said of a highlight that is F0 times a Fresnel term of its own: a weight, or a slip.
inline constexpr const char* f0_after =
    "its F0 multiplies a Fresnel term of 0.04: right of a weight; an F0 belongs inside, as in F0 + "
    "(1 − F0) (1 − VoH)⁵";
/// A dielectric's or a conductor's exact F with a slip.
struct ExactSlip {
  double (*value)(double cosine, double eta, double k);
  const char* slip;
};
std::span<const ExactSlip> exact_slips();
/// A cosine that shaders take by slip where VoH belongs.
struct OtherCosine {
  double (*of)(const auditing::Row&);
  const char* slip;
};
std::span<const OtherCosine> other_cosines();
/// Reflectance of light polarised across the plane of incidence, and along it.
std::array<double, 2> polarised(double cosine, double eta, double k = 0);

/// The slip by which a distribution, a masking or a Fresnel function of a file is none of ours, a sentence; empty where none is known.
std::string slip_form(std::size_t foreign_term);

}  // namespace gonio
