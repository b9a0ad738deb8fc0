#pragma once
/// \file
/// f_r of a model over columns of angles.

#include <array>
#include <initializer_list>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/memory.h"
#include "brdf/catalogue/registry.h"
#include "brdf/kernel/kernels.h"
#include "brdf/model/model.h"
#include "geometry/angles.h"

namespace gonio {

/// The most parameters of a term, people's own functions included.
inline constexpr std::size_t most_parameters = 16;

/// A 64-byte aligned array.
template <class F>
class Column {
 public:
  Column() = default;
  explicit Column(std::size_t n, F fill = F(0));
  /// Not filled: its pages are first touched by whoever writes them, on all threads.
  static Column for_overwrite(std::size_t n);
  F* data() { return data_.get(); }
  const F* data() const { return data_.get(); }
  F& operator[](std::size_t i) { return data_[i]; }
  F operator[](std::size_t i) const { return data_[i]; }

 private:
  struct Free {
    void operator()(F* p) const { free_array(p); }
  };
  std::unique_ptr<F[], Free> data_;
};

/// Angles as columns, padded with harmless ones; every sample is to be set.
template <class F>
class AngleColumns {
 public:
  /// \param frame  with the tangent frame, which anisotropic terms read
  explicit AngleColumns(std::size_t n, bool frame = false);
  std::size_t size() const { return size_; }
  std::size_t padded() const { return padded_; }
  void set(std::size_t i, const Angles<double>& a) {
    put(i, 0, {a.nol, a.nov, a.noh, a.voh, a.sin2_theta_h});
  }
  /// The frame is left out where there are no columns for it.
  void set(std::size_t i, const FrameAngles<double>& a) {
    set(i, static_cast<const Angles<double>&>(a));
    if (column_.size() > 5) put(i, 5, {a.xoh, a.yoh, a.xol, a.yol, a.xov, a.yov});
  }
  Block<F> block() const {
    Block<F> b{column_[0].data(), column_[1].data(), column_[2].data(),
               column_[3].data(), column_[4].data(), padded_};
    for (std::size_t k = 5; k < column_.size(); ++k) b.frame[k - 5] = column_[k].data();
    return b;
  }

 private:
  void put(std::size_t i, std::size_t first, std::initializer_list<double> values) {
    for (const double v : values) column_[first++][i] = static_cast<F>(v);
  }

  std::size_t size_, padded_;
  std::vector<Column<F>> column_;
};

/// Scratch columns of one block, made on demand; one per thread.
/// \tparam samples  of a block: with those of a fit, which are the same in float and double, the
///                  columns of a pass stay in the L2 cache
template <class F, std::size_t samples = 256>
class Scratch {
 public:
  static constexpr std::size_t block = samples;
  Scratch();
  F* operator[](std::size_t i);
  const F* ones() { return (*this)[0]; }
  const F* zeros() { return (*this)[1]; }
  const F* minus_ones() { return (*this)[2]; }
  static constexpr std::size_t first_free = 3;

 private:
  std::vector<Column<F>> columns_;
};

/// Blocks of angles whose frame is turned to a model's tangent, at the azimuth t:
///
///   x' = x cos t + y sin t,   y' = y cos t − x sin t
///
/// One per thread.
template <class F>
class TurnedFrame {
 public:
  static constexpr std::size_t block = 512;  ///< samples at once, at most
  TurnedFrame(const Model&, const Kernels<F>&);
  /// For the blocks that follow, model.value_count of them.
  void set(std::span<const F> values);
  /// True where there is something to turn: not of an isotropic model, nor where t is 0.
  explicit operator bool() const { return turns_; }
  /// x with the turned frame, until the next; x as it is where there is nothing to turn.
  Block<F> operator()(const Block<F>& x);

 private:
  const Kernels<F>& kernels_;
  bool has_tangent_ = false, turns_ = false;
  std::size_t slot_ = 0;              ///< of the tangent's value
  std::array<Column<F>, 3> factors_;  ///< cos t, sin t, −sin t, at all samples
  std::array<Column<F>, 6> turned_;
};

/// Terms of a model in the order of fused kernels: diffuse terms, then D, V, F of each lobe.
std::vector<const TermUse*> terms_of(const Model&);
/// The ids by which fused kernels know a model; no value where it has more terms than they take.
std::optional<FusedIds> fused_ids(const Model&);

/// f_r of one model over columns, prepared once: a fused loop where there is one, else the kernels of its
/// terms block by block.  Not shared by threads.
template <class F>
class Evaluator {
 public:
  explicit Evaluator(const Model&, const Kernels<F>& = kernels<F>());
  /// For the runs that follow, model.value_count of them.
  void set(std::span<const F> values);
  /// f_c of every sample.  out: one column per channel, as long as x.  Below the horizon the terms are not
  /// defined: the caller leaves such samples out.
  void operator()(const Block<F>& x, std::span<F* const> out);
  bool is_fused() const { return fused_ != nullptr; }
  /// Between the terms of a model that is not fused: with the angles and what is written, 2 KB each,
  /// they stay in the L1 cache.
  using Between = Scratch<F, 2048 / sizeof(F)>;

 private:
  /// A term, and per channel its parameters and which values they are.
  struct Term {
    const TermEntry* entry;
    const TermKernels<F>* kernels;
    std::vector<std::array<std::size_t, most_parameters>> slots;
    std::vector<std::array<F, most_parameters>> parameters;
    std::size_t count = 0;
    bool is_ggx = false;
  };
  void fused(const Block<F>& x, std::size_t at, std::span<F* const> out);
  void compose(const Block<F>& x, std::size_t at, std::span<F* const> out);
  /// A model has one diffuse term at most.
  bool has_uniform_diffuse() const {
    return diffuse_ == 1 && terms_[0].kernels->uniform && terms_.size() > 1;
  }

  std::size_t channels_, diffuse_ = 0;
  bool coupled_ = false;     ///< a diffuse term lies under the first lobe
  std::vector<Term> terms_;  ///< diffuse terms, then D, V, F of each lobe
  std::vector<F>
      uniform_;  ///< of each channel: the diffuse term where it is the same at all angles
  typename FusedKernel<F>::Value fused_ = nullptr;
  FusedArguments<F> arguments_{};  ///< its parameters are those of terms_
  TurnedFrame<F> turned_;
  std::vector<F*> dv_;
  Between scratch_;
};

/// f_c for every sample of x.  values: model.value_count of them; out: one column per channel, as
/// long as x.  Evaluator's one run.
template <class F>
void evaluate(const Model& model,
              std::span<const F> values,
              const Block<F>& x,
              std::span<F* const> out,
              const Kernels<F>& k = kernels<F>());

/// f_c for a list of angles, in double: [channel][sample].  0 below the horizon.  An anisotropic
/// model needs the frame: without it that is wrong usage.
std::vector<std::vector<double>> evaluate(const BoundModel& model,
                                          std::span<const Angles<double>> angles);
std::vector<std::vector<double>> evaluate(const BoundModel& model,
                                          std::span<const FrameAngles<double>> angles);

}  // namespace gonio
