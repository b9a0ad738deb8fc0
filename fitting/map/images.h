#pragma once
/// \file
/// Images of a stack that do not agree with the others: some were exposed otherwise, or two stand for each other.

#include <cstddef>
#include <optional>
#include <vector>

#include "fitting/map/sample.h"

namespace gonio {

/// Images that are all off by one factor.
struct OtherExposure {
  std::vector<std::size_t> images;  ///< in order, no more than half of all
  double brightness = 1;            ///< how bright they are beside what the others say
  double ratio =
      1;  ///< median over texels of the rms that is left with that put right, over that as given
};
/// Looks for two exposures: brightness is fitted by image, and images whose brightness forms two groups are put right and fitted again.  None where that
/// leaves more than half of the rms.
/// \param given  fit of the sample as it is
std::optional<OtherExposure> other_exposure(const TexelSample&,
                                            const TexelOptions&,
                                            const TexelFit& given);

/// Two images that stand for each other.
struct Exchanged {
  std::size_t first = 0, second = 0;
  double ratio = 1;  ///< as above
};
/// Exchanges each two of the images that differ most from what a fit says.  None where that leaves more than half of the rms.
std::optional<Exchanged> exchanged_images(const TexelSample&,
                                          const TexelOptions&,
                                          const TexelFit& given);

/// The images whose logarithms differ most from what a fit says, 16 at most.
std::vector<std::size_t> loudest(const TexelSample&,
                                 std::vector<std::size_t> images,
                                 const std::vector<double>& f_r);

}  // namespace gonio
