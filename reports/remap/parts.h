#pragma once
/// \file
/// The parts of remap_report(), each filling its own.

#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "geometry/angles.h"
#include "reports/remap/remap.h"

namespace gonio {

namespace remapping {

using Row = FrameAngles<double>;

/// Pairs of directions by their cosines, each at as many azimuths between l and v, evenly in (0, π).
class Pairs {
 public:
  struct Cosines {
    double nol, nov;
  };
  Pairs(std::vector<Cosines>, std::size_t azimuths);
  std::span<const Cosines> cosines() const { return cosines_; }
  std::span<const Row> rows() const { return rows_; }
  std::size_t azimuths() const { return azimuths_; }

 private:
  std::vector<Cosines> cosines_;
  std::size_t azimuths_;
  std::vector<Row> rows_;
};

/// All pairs of the cosines, the first by the first.
std::vector<Pairs::Cosines> all_pairs(std::span<const double> cosines);

/// G2 of a masking term, a value for each row; a term without a width has none to be given.
std::vector<double> g2_at(std::size_t term, double roughness, std::span<const Row>);
/// The same, averaged over azimuths: a value for each pair.  What reads no half vector is looked at once.
std::vector<double> mean_g2(std::size_t term, double roughness, const Pairs&);
bool reads_half(std::size_t term);

/// Where f is least between the ends of `grid`: near the least of its values there, to 1e-5.
NearestRoughness nearest(const std::function<double(double)>& f, std::span<const double> grid);

/// "smith_ggx.separable" or "correlated", or Beckmann's, as ids.
std::array<std::string, 2> references_of(std::string_view ndf);

}  // namespace remapping

/// The forms, and each against its references.
void add_forms(RemapReport&, const RemapOptions&, const std::function<void(double)>& done);
/// After the forms: both k in both uses, G1, what stands for V F.
void add_claims(RemapReport&, const RemapOptions&);
/// From what the others have filled in.
void add_findings(RemapReport&);

}  // namespace gonio
