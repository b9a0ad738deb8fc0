#pragma once
/// \file
/// Values of a list around one incident direction, and between its samples.

#include <span>
#include <vector>

#include "table/table.h"

namespace gonio {

/// True of a value that counts in an integral.  Noise goes both ways: without its negative half the rest would be too bright.
bool counts_in_integral(Mask, bool noisy);

/// Samples of one incident direction, which is turned to φ = 0, and f between them.
class AroundOneLight {
 public:
  static constexpr double reach_deg =
      12;  ///< from a direction to the nearest sample that speaks for it

  /// \param samples  numbers in the table, all of one incident direction
  /// \param half     azimuths lie on one side: the other is its mirror image
  /// \param noisy    negative values are noise, and no mark
  AroundOneLight(const Table&, const std::vector<std::size_t>& samples, bool half, bool noisy);

  bool reaches(const Direction& wo) const { return near(wo, 0).first != nullptr; }
  /// Half the angle between the mirror direction and the sample nearest to it.
  double from_mirror() const { return innermost_->theta_h; }

  /// f of one channel at a direction [1/sr].
  struct Between {
    double line, middle, doubt;
  };
  /// f interpolated over θ_h from the nearest sample to the nearest one on the other side of the direction: by a line, and midway
  /// between that and a line of logarithms, since a highlight lies along circles of θ_h, and its flank between the two.
  /// Nearer to the mirror direction than any sample it rises by nobody knows how much, at most about as steeply as farther
  /// out.
  void operator()(const DirectionPair&, std::span<Between> channels) const;

 private:
  struct Sample {
    Direction wo;
    double theta_h;
    std::size_t number;  ///< in the table
  };
  /// The nearest sample, the next, and the nearest on the other side in θ_h; all null where the first is out of reach.
  struct Near {
    const Sample *first = nullptr, *second = nullptr, *across = nullptr;
  };
  static double height(const Sample& s) { return s.wo.z; }
  Near near(const Direction& wo, double theta_h) const;
  double value(const Sample*, std::size_t channel) const;

  const Table& table_;
  SampleAngles at_;
  bool noisy_;
  std::vector<Sample> all_;
  const Sample *innermost_ = nullptr, *next_ = nullptr;  ///< of the least θ_h, and farther out
};

}  // namespace gonio
