#pragma once
/// \file
/// Arrangements of a stack's directions and images that explain it better than the one that it has.

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "base/names.h"
#include "fitting/map/sample.h"

namespace gonio {

/// What is known of the azimuths of lights.
enum class AzimuthCheck {
  open,            ///< others explain the images as well
  half_turn_open,  ///< none of the others but that by half a turn
  checked,
};
template <>
inline constexpr std::array<std::string_view, 3> names_of<AzimuthCheck>{"open", "half_turn_open",
                                                                        "checked"};
/// The same for people, with what to do.
std::string words_of(AzimuthCheck);

/// Arrangement of a stack's directions, or of its images, under which the texels' fits leave less.
struct OtherArrangement {
  std::string what;  ///< as "the light's azimuth is negated"; empty: none leaves less
  /// What to change in the stack; of two that only the photographs tell apart, what to look at and then one for each answer.
  std::vector<std::string> cure;
  std::string measure = "rms";  ///< of what less is left
  /// Median over texels of the rms that is left under it, over the rms that is left as given.
  double ratio = 1;
  /// Half as much or less is left, in nearly every texel or in nearly every one that tells: the stack is not as it says.
  bool sure = false;
  AzimuthCheck azimuth = AzimuthCheck::open;
};

/// The arrangement that leaves least light unexplained, if less than the given one: by the better of two fits each, that of the model asked for and that of
/// `better`, so that directions are not blamed for a model that does not fit.
/// \param better  the model that fits the given arrangement best
OtherArrangement other_arrangement(const TexelSample&, TexelOptions asked, TexelOptions better);

/// Names of the images whose lamps the stack has farthest to the right, and farthest on top.
struct LampsOfList {
  std::string right, top;
};
/// The azimuths under which refined normals belong to a surface, if they do not as given.  Of half a turn nothing is known: it makes hollows of bumps.  Nor does
/// the curl of a dome, or of what is the same along x and along y, decide between mirror images and quarter turns: photographs do.
/// \param sample  pieces of a map (turns_of_normals)
OtherArrangement arrangement_of_normals(const TexelSample& sample,
                                        const TexelFit& refined,
                                        const LampsOfList&);

/// Why a stack is refused, in lines: what its directions are, and what to do.
std::string refusal_of(const OtherArrangement&);

}  // namespace gonio
