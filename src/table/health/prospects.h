#pragma once
/// \file
/// Prospects of a fit: what it can hope to determine, told before any is made.

#include <string>
#include <vector>

#include "table/health/facts.h"

namespace gonio {

/// \param health  all of it but the prospects
///
/// alpha: yes where a highlight around the half vector is resolved; weakly where it is narrower than
///   samples or bins can tell (an upper bound), or where there is none but the values are not flat; no
///   where they are, without samples there, for a retro-reflector, or where each incident angle holds
///   one constant; weakly where a retro-reflector has a second highlight there.  Flat: 98 % of the values lie
///   within a factor of 1.25 beside what the noise makes.
/// f0: as alpha, but not for a retro-reflector, and weakly where the highlight is first seen beyond θ_d = 45°.
/// fresnel, the rise towards grazing: yes where a highlight is sampled beyond θ_d = 75°, weakly
///   beyond 60°.
/// kd: yes where the values are flat, or where at most a fifth of the base would be the tail of a GGX
///   lobe as wide and as high as the highlight; no where two thirds of it would be, or where it is not
///   positive; weakly between, and below the noise floor.
/// precision: yes to 5 % relative noise, weakly to 30 %; weakly where more than half of the valid
///   values are below three times the noise floor.
/// intervals, by incident angle: yes from 8 incident angles on, weakly from 2.
std::vector<Prospect> prospects(TableFacts&, const Health&);

}  // namespace gonio
