#pragma once
/// \file
/// Samples left out by an expression, as people write it: "theta_o > 80", "retro < 8 or f > 100".

#include <string>
#include <string_view>

#include "table/table.h"

namespace gonio {

/// Leaves out the samples for which an expression holds: a list loses them, a grid has no value there.
/// Comparisons of sums and products, joined by and, or, not; names, in degrees:
///
///   theta_i, phi_i, theta_o, phi_o   as the table has them    phi   phi_o − phi_i, 0 to 180
///   theta_h, theta_d                 of the half vector       retro, mirror   wo from wi, and from its mirror image
///   f, f_CHANNEL                     the channels' mean, or one of them [1/sr]
///
/// Throws wrong usage, with the place, for what is no such expression; bad_input for a division by 0, and where no sample
/// is left.
void leave_out(Table&, std::string_view expression);

/// Number of values that were left out: those that a fit would have used otherwise, or that another reason keeps from it, too.
std::size_t values_left_out(const Table&, Mask otherwise = Mask::valid);

/// What options that take such an expression say of it.
inline constexpr const char* mask_in_words =
    "samples to leave out, as 'theta_o > 80' or 'retro < 8 or f > 100': names are theta_i, phi_i, "
    "theta_o, phi_o, phi, "
    "theta_h, theta_d, retro and mirror (angles between the two directions, and from the mirror's) "
    "in degrees, f and "
    "f_CHANNEL";

}  // namespace gonio
