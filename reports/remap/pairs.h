#pragma once
/// \file
/// Pairs of directions at which masking forms are compared, and the roughness by which they are told; and what is
/// measured there.

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
/// G2 averaged over azimuths: a value for each pair.  What reads no half vector is looked at once.
std::vector<double> mean_g2(std::size_t term, double roughness, const Pairs&);
bool reads_half(std::size_t term);

/// Place where f is least between the ends of `grid`: near the least of its values there, to 1e-5.
NearestRoughness nearest(const std::function<double(double)>& f, std::span<const double> grid);

/// Every form against its references: `forms` and `rows` of what is returned.
struct MeasuredForms {
  std::vector<RemapForm> forms;
  std::vector<RemapRow> rows;
};
MeasuredForms measured_forms(const RemapOptions&,
                             std::span<const double> mu,
                             std::span<const double> cosines,
                             const std::function<void(double)>& done);
/// Both k in both uses.
std::vector<RemapUse> uses_of_k(const std::vector<RemapForm>&, std::span<const double> mu);
/// G1 of both k where the seeds say what it is.
std::vector<RemapG1> claimed_g1();
/// Forms that stand for V F, of those measured.
std::vector<RemapVf> in_place_of_vf(const std::vector<RemapForm>&,
                                    const RemapOptions&,
                                    std::span<const double> cosines);

}  // namespace remapping

}  // namespace gonio
