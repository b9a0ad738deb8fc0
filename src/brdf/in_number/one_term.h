#pragma once
/// \file
/// One term, or one map, evaluated on its own, by the names of its parameters and angles.

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "brdf/in_number/number.h"

namespace gonio {

/// One term at the given angles.  D and F: their value.  A masking term gives G2 = 4 NoL NoV V; with
/// NoL left at 1, where Λ is 0, that is G1(NoV).  A diffuse term: its value in 1/sr, uncoupled.
///
/// Each name of `at` (noh, nol, nov, voh or cos, sin2_theta_h; of the frame xoh, yoh, xol, yol, xov,
/// yov) is a column; columns of one value serve all rows.  Of h, what is given decides: sin2_theta_h
/// is xoh² + yoh² or else (1 − noh)(1 + noh), noh is √(1 − sin²θ_h).  A direction of whose frame
/// nothing is given lies above the tangent.
///
/// One of noh and voh gives the other by 2 VoH NoH = NoL + NoV; of one direction only, the other stands along the normal.
/// A term of two directions that reads what does not follow so is wrong usage.
struct TermValues {
  std::vector<std::pair<std::string, double>> parameters;  ///< all of them, defaults included
  std::vector<double> values;
};
/// True where a term's value depends on an angle: by values on both sides of it, at angles like no others; at several, for a
/// minimum or a clamp may hide one.
bool reads_angle(std::size_t term, double FrameAngles<double>::*angle);
TermValues evaluate_term(std::size_t term,
                         Number number,
                         const std::map<std::string, double>& parameters,
                         const std::map<std::string, std::vector<double>>& at);

/// A map row by row: each name of `at` is a parameter with a value per row, columns of one value serve
/// all rows; the others are as `parameters` or their defaults say.  values: [row][output]
struct MapValues {
  std::vector<std::pair<std::string, double>> parameters;
  std::vector<std::vector<double>> values;
};
MapValues evaluate_map(std::size_t map,
                       Number number,
                       const std::map<std::string, double>& parameters,
                       const std::map<std::string, std::vector<double>>& at);

}  // namespace gonio
