#pragma once
/// \file
/// The samples of a table as a fit looks at them: which belong together, what is left out and why,
/// and with what weight a model is compared with each.

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/names.h"
#include "brdf/kernel/kernels.h"
#include "brdf/model/derivatives.h"
#include "brdf/model/evaluate.h"
#include "brdf/model/mean_block.h"
#include "fitting/sample/mean_columns.h"
#include "table/table.h"

namespace gonio {

/// Residual of model f against datum y:
///   log        ln(f + offset) − ln(y + offset)
///   l2_cosine  (f − y) NoL
///   relative   (f − y)/(y + offset)
///   uncertainty  (f − y)/u, of a table that states the standard uncertainty u of each value
/// each of them w (link(f + offset) − t) with a target t and a weight w that depend on the datum.  Of a table with
/// uncertainties log and relative count standard uncertainties, too: they are times (y + offset)/u.
enum class Metric { log, l2_cosine, relative, uncertainty };
template <>
inline constexpr std::array<std::string_view, 4> names_of<Metric>{"log", "l2_cosine", "relative",
                                                                  "uncertainty"};
constexpr bool has_offset(Metric m) {
  return m == Metric::log || m == Metric::relative;
}

constexpr Link link_of(Metric m) {
  return m == Metric::log ? Link::log : Link::identity;
}
/// True where a datum that is valid (≥ 0) can be used: log and relative need y + offset above `faintest`.
constexpr bool usable(Metric m, double y, double offset) {
  return y >= 0 && (!has_offset(m) || y + offset > static_cast<double>(faintest));
}

/// Samples at which every isotropic reciprocal model has one value: those that change places with
/// light and viewer exchanged, or mirrored at the plane of incidence, where the layout has them.  A
/// grid has; of lists, which alone say where the tangent of an anisotropic surface is, none are folded.
/// The members of a group are those of its row times those of its column.
class Groups {
 public:
  static constexpr std::size_t most = 4;  ///< members
  static constexpr std::size_t absent = static_cast<std::size_t>(-1);
  struct Part {
    std::size_t at = absent;  ///< row or column of the table; absent: there is no such member
    bool swapped = false;     ///< NoL and NoV are those of the first member exchanged
  };
  /// Groups of rows, or of columns: each alone, or several in one.
  class Folding {
   public:
    explicit Folding(std::size_t size) : size_(size) {}
    /// Parts under one number, of all groups in order.
    struct Line {
      std::ptrdiff_t step = 0;  ///< from each to the next; 0 where that differs or one is absent
      bool swapped = false;     ///< all of them, where there is a step
    };
    const Line& line(std::size_t k) const { return lines_[k]; }
    /// \param parts  of each group, the first one not swapped
    explicit Folding(const std::vector<std::vector<Part>>& parts);
    std::size_t size() const { return size_; }
    /// The most parts that a group has here.
    std::size_t widest() const { return widest_; }
    Part part(std::size_t group, std::size_t k) const {
      return parts_.empty() ? Part{group, false} : parts_[group * widest_ + k];
    }
    std::size_t parts(std::size_t group) const { return count_.empty() ? 1 : count_[group]; }

   private:
    std::size_t size_, widest_ = 1;
    std::vector<Part> parts_;  ///< [group][widest]; empty: each alone
    std::vector<std::size_t> count_;
    std::vector<Line> lines_{{1, false}};
  };

  /// \param fold  false: each sample is alone
  Groups(const Table&, const SampleAngles&, Bins, bool fold);
  const Folding& rows() const { return rows_; }
  const Folding& columns() const { return columns_; }
  std::size_t size() const { return rows_.size() * columns_.size(); }
  /// The most members that a group has here: part r of its row with part c of its column is number
  /// r · columns().widest() + c.
  std::size_t widest() const { return rows_.widest() * columns_.widest(); }

 private:
  Folding rows_, columns_;
};

/// A table, and how a model is compared with it.
class Sampling {
 public:
  /// \param copies  whether angles that only repeat another are looked at, too
  /// \param frame   whether samples have the angles of the frame, which anisotropic models read: of a list alone
  Sampling(const Table&,
           Bins,
           Metric,
           double offset,
           bool fold,
           bool copies = false,
           bool frame = false);
  const Table& table() const { return table_; }
  const SampleAngles& angles() const { return angles_; }
  const Groups& groups() const { return groups_; }
  bool has_frame() const { return way_.frame; }
  const std::shared_ptr<const ApertureAngles>& aperture() const { return aperture_; }
  /// Columns that the angles of a sample take.
  std::size_t angle_columns() const { return way_.frame ? 11 : 5; }
  Metric metric() const { return way_.metric; }
  /// True where residuals are in standard uncertainties that the table states.
  bool in_uncertainties() const {
    return !table_.errors.empty() && way_.metric != Metric::l2_cosine;
  }
  /// Samples of this one, compared in another way.
  Sampling by(Metric, double offset) const;
  /// This one, in which some samples weigh nothing.
  /// \param which  [sample]
  Sampling without(std::vector<bool> which) const;
  /// True where another one reads the same columns from the same table.
  bool reads_like(const Sampling&) const;
  /// Model of the data's bulk, for a robust fit; or null.  Under the relative metric a value below half of
  /// what it says weighs no more than that half would: else the smallest outliers outweigh all others.
  const BoundModel* bulk() const { return bulk_.get(); }
  void set_bulk(std::shared_ptr<const BoundModel> bulk) { bulk_ = std::move(bulk); }
  double offset() const { return way_.offset; }  ///< of the log and relative metrics [1/sr]
  /// Offset that the link adds to f: a difference needs none.
  double link_offset() const { return way_.metric == Metric::log ? way_.offset : 0; }
  std::size_t channels() const { return table_.values.size(); }
  /// √weight, of weights that are all whole numbers; of others √(weight over the mean weight).
  double root_weight(std::size_t sample) const;
  bool has_weights() const { return !table_.weights.empty() || left_out_; }
  /// Samples that one of the table counts as: its weight where all are whole numbers, else 1.
  double count_of(std::size_t sample) const { return is_counted_ ? table_.weights[sample] : 1; }
  bool is_counted() const { return is_counted_; }
  /// True for rows of the table that are left out: their values only repeat those of others.
  bool is_copy(std::size_t row) const { return !copied_.empty() && copied_[row]; }
  bool has_copies() const { return !copied_.empty(); }

 private:
  /// Way to look at a table: all but its samples.
  struct Way {
    Bins bins;
    Metric metric;
    double offset;
    bool fold, copies, frame;
    bool operator==(const Way&) const = default;
  };
  const Table& table_;
  Way way_;
  SampleAngles angles_;
  Groups groups_;
  double mean_weight_ = 1;
  bool is_counted_ = false;
  std::shared_ptr<const std::vector<bool>> left_out_;  ///< [sample]; null: none is
  std::shared_ptr<const BoundModel> bulk_;
  std::shared_ptr<const ApertureAngles> aperture_;
  std::vector<bool> copied_;  ///< [row]; empty: none is
};

/// Angles over which the samples of a table with an aperture are means; null where it has none.  Those of the last two tables are kept:
/// they take a millisecond a sample.  Throws bad_input where samples are more than 2¹⁶.
std::shared_ptr<const ApertureAngles> aperture_angles(const Table&, Bins, bool frame);

struct SampleCounts {
  std::size_t used = 0, zero = 0, zero_weight = 0, copied = 0;
  double samples = 0;  ///< that those used count as, see Sampling::count_of()
  std::array<std::size_t, names_of<Mask>.size()> masked{};  ///< by Mask

  void add(const SampleCounts&);
  /// Values left out, by reason.
  std::map<std::string, std::size_t> by_reason(const Sampling&) const;
};

/// All groups or about `most` of them, evenly spread, cut into tasks of a fixed size, so that sums do
/// not depend on the number of threads.
struct Tasks {
  static constexpr std::size_t blocks = 64;  ///< of one
  std::size_t count, step;
  /// A step that leaves about `most` of `all`.
  static std::size_t step_to(std::size_t all, std::size_t most);
  Tasks(const Sampling&, std::size_t most, std::size_t block);
  std::size_t first(std::size_t task) const { return task * size_; }
  std::size_t last(std::size_t task) const { return std::min(all_, (task + 1) * size_); }
  /// Groups of a task, at most.
  std::size_t groups(std::size_t task) const {
    return (last(task) - first(task) + step - 1) / step;
  }

 private:
  std::size_t all_, size_;
};

/// Reads the groups first, first + step … below last, block by block, leaving out those below the
/// horizon.  One per thread.
template <class F>
class BlockReader {
 public:
  static constexpr std::size_t block = Scratch<F>::block;
  static constexpr std::size_t absent = Groups::absent;
  /// One member of each group: its values in one channel.
  struct Values {
    Column<F> y;               ///< [1/sr]; −1 where masked
    Column<F> target, weight;  ///< 0 where there is nothing to compare
  };

  BlockReader(const Sampling&, std::size_t first, std::size_t last, std::size_t step = 1);

  /// The next block; false after the last.
  bool next();
  std::size_t size() const { return n_; }  ///< groups; what follows up to padded() is masked
  std::size_t padded() const { return (n_ + padding - 1) / padding * padding; }
  SampleBlock<F> angles() const;
  /// Angles over which the block's samples are means; null where they are none.
  const std::shared_ptr<const MeanColumns<F>>& means() const { return means_; }
  const Values& values(std::size_t member, std::size_t channel) const {
    return values_[member * sampling_.channels() + channel];
  }
  /// Numbers of the first member's samples; of one that is absent, which weighs nothing, the first of all.
  std::vector<std::size_t> there() const;
  /// Indices in the table, `absent` where a group has no such member.
  const std::size_t* sample(std::size_t member) const { return sample_[member].data(); }
  /// NoL of those samples.
  const F* nol(std::size_t member) const { return nol_[member].data(); }
  const SampleCounts& counts() const { return counts_; }

 private:
  void place();
  void place_any(const SampleAngles::Row&);
  void place_level(const SampleAngles::Row&);
  void mask_below_horizon(std::size_t column);
  void place_members(std::size_t row, std::size_t from);
  void gather(std::size_t member, const double* stored);
  void fill(std::size_t member, std::size_t channel);
  void limit_weights();

  /// Groups of a block whose samples lie `step` apart; 0: anywhere, or absent.
  struct Run {
    std::size_t from, to;
    std::ptrdiff_t step;
  };

  const Sampling& sampling_;
  std::size_t row_, column_, left_, step_, n_ = 0;
  std::vector<Column<F>> angles_;  ///< five, and six of a frame
  std::array<std::array<std::size_t, block>, Groups::most> sample_;
  std::array<std::vector<Run>, Groups::most> runs_;
  std::array<std::size_t, Groups::most> absent_{};  ///< how many are, of each member
  std::array<std::size_t, block> group_column_;
  std::vector<double> cosine_;  ///< of φ_d, of the first column of each group
  std::vector<Column<F>> nol_;
  std::vector<Values> values_;
  Column<F> stored_, weight_, ones_;
  std::unique_ptr<ModelDerivatives<F>> bulk_;  ///< where it limits the weights
  std::vector<bool> nothing_free_;
  std::shared_ptr<const MeanColumns<F>> means_;
  SampleCounts counts_;
};

}  // namespace gonio
