#include "fitting/solve/accumulate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/whole_loop.h"
#include "brdf/model/derivatives.h"

#include <tbb/enumerable_thread_specific.h>

namespace gonio {
namespace {

/// A model's derivatives and what comes after them: link, residual, sums.
template <class F>
class Pass {
 public:
  Pass(const Model& m, const FreeSlots& free, bool means)
      : kernels_(kernels<F>()),
        derivatives_(m, free.mask(), kernels_, nullptr, means),
        link_(derivatives_.fresh()),
        link_slope_(derivatives_.fresh()),
        r_(derivatives_.fresh()),
        slope_(derivatives_.fresh()),
        free_(m.channels),
        j_(m.channels) {
    for (std::size_t c = 0; c < m.channels; ++c)
      for (const auto& [slot, column] : derivatives_.channel(c).d) {
        j_[c][free_[c].size()] = column;
        free_[c].push_back(free.index(slot));
      }
  }

  void set(std::span<const double> values) {
    values_.assign(values.begin(), values.end());
    derivatives_.set(values_);
  }

  /// visit(c) with r of that channel made
  template <class Visit>
  void run(const FitBlock<F>& b, const FitData<F>& d, F huber, F* cost, Visit&& visit) {
    derivatives_.run(b.angles(), [&](std::size_t c) {
      kernels_.link[static_cast<std::size_t>(d.link)](b.n, derivatives_.channel(c).value, d.offset,
                                                      link_, link_slope_);
      kernels_.residual(b.n,
                        {link_, link_slope_, b.target(c), b.weight(c), huber, r_, slope_, cost});
      visit(c);
    });
  }
  void add(std::size_t n, std::size_t c, GramSums<F>& sums) const {
    kernels_.gram[free_[c].size() + 1](n, r_, slope_, j_[c].data(), sums.lanes());
  }
  const std::vector<std::size_t>& free(std::size_t c) const { return free_[c]; }
  const F* r() const { return r_; }

 private:
  const Kernels<F>& kernels_;
  ModelDerivatives<F> derivatives_;
  std::vector<F> values_;
  F *link_, *link_slope_, *r_, *slope_;
  std::vector<std::vector<std::size_t>> free_;         ///< [channel][derivative]
  std::vector<std::array<const F*, most_columns>> j_;  ///< ∂f/∂slot
};

/// The fused pass of a model, where there is one.
template <class F>
class FusedPass {
 public:
  FusedPass(const Model& m, const FreeSlots& free)
      : model_(m), terms_(terms_of(m)), at_(m.channels) {
    const auto ids = fused_ids(m);
    if (!ids || m.channels > max_channels) return;
    for (const auto& normal : kernels<F>().normal)
      if (normal.ids == *ids) kernel_ = &normal;
    if (!kernel_) return;
    for (std::size_t c = 0; c < m.channels; ++c)
      for (std::size_t k = 0; k < kernel_->count; ++k) {
        const auto& column = kernel_->columns[k];
        const std::size_t slot = slot_of(*terms_[column.term], column.parameter, c);
        at_[c].push_back(free.mask()[slot] ? free.index(slot) : free.size());
      }
  }
  explicit operator bool() const { return kernel_ != nullptr; }
  /// The unknown that each column belongs to.
  const std::vector<std::size_t>& at(std::size_t c) const { return at_[c]; }

  void run(std::span<const double> values,
           const FitData<F>& d,
           const std::vector<FitBlock<F>>& blocks,
           std::vector<GramSums<F>>& sums,
           F* cost) const {
    std::array<std::array<std::array<F, max_parameters>, max_channels>, max_fused_terms> p{};
    NormalArguments<F> a{{}, model_.channels, {}, {}, {}, d.offset, {}, cost};
    for (std::size_t t = 0; t < terms_.size(); ++t)
      for (std::size_t c = 0; c < model_.channels; ++c) {
        for (std::size_t k = 0; k < terms_[t]->parameters.size(); ++k)
          p[t][c][k] = static_cast<F>(values[slot_of(*terms_[t], k, c)]);
        a.parameters[t][c] = p[t][c].data();
      }
    for (std::size_t c = 0; c < model_.channels; ++c) a.sums[c] = sums[c].lanes();
    TurnedFrame<F> turned(model_, kernels<F>());
    const std::vector<F> in_number(values.begin(), values.end());
    turned.set(in_number);
    for (const auto& b : blocks) {
      a.x = turned(b.angles());
      for (std::size_t c = 0; c < model_.channels; ++c) {
        a.target[c] = b.target(c);
        a.weight[c] = b.weight(c);
      }
      kernel_->pass[static_cast<std::size_t>(d.link)](a);
    }
  }

 private:
  std::size_t slot_of(const TermUse& t, std::size_t parameter, std::size_t channel) const {
    if (parameter == t.parameters.size()) return model_.tangent()->first;
    return model_.parameters[t.parameters[parameter]].slot(channel);
  }

  const Model& model_;
  std::vector<const TermUse*> terms_;
  const NormalKernel<F>* kernel_ = nullptr;
  std::vector<std::vector<std::size_t>> at_;  ///< [channel][column]
};

void add(std::vector<double>& to, const std::vector<double>& from) {
  for (std::size_t i = 0; i < to.size(); ++i) to[i] += from[i];
}

}  // namespace

bool is_finite(const NormalEquations& e, double scale) {
  const auto finite = [&](double x) { return std::isfinite(scale * x); };
  return finite(e.cost) && std::ranges::all_of(e.h.entries(), finite) &&
         std::ranges::all_of(e.g, finite);
}

FreeSlots::FreeSlots(std::vector<bool> free) : mask_(std::move(free)), index_(mask_.size()) {
  for (std::size_t i = 0; i < mask_.size(); ++i)
    if (mask_[i]) {
      index_[i] = slots_.size();
      slots_.push_back(i);
    }
  layout_ = std::make_shared<const ArrowLayout>(size());
}

FreeSlots::FreeSlots(const Model& m, std::vector<bool> free) : FreeSlots(std::move(free)) {
  constexpr std::size_t few = 32;  // whose dense matrices cost nothing
  if (size() <= few) return;
  std::vector<std::size_t> shared;
  std::vector<std::vector<std::size_t>> own(m.channels);
  for (const auto& p : m.parameters)
    for (std::size_t c = 0; c < p.count; ++c)
      if (mask_[p.first + c]) (p.count > 1 ? own[c] : shared).push_back(index_[p.first + c]);
  layout_ = std::make_shared<const ArrowLayout>(std::move(shared), std::move(own));
}

std::vector<double> FreeSlots::of(std::span<const double> values) const {
  std::vector<double> free;
  for (const std::size_t s : slots_) free.push_back(values[s]);
  return free;
}

void FreeSlots::put(std::span<const double> free, std::span<double> values) const {
  for (std::size_t i = 0; i < slots_.size(); ++i) values[slots_[i]] = free[i];
}

template <class F>
void GramSums<F>::scatter(const std::vector<std::size_t>& free,
                          std::size_t n,
                          ArrowMatrix& h,
                          std::vector<double>* g) const {
  const std::size_t k = free.size();
  if (g)
    for (std::size_t a = 0; a < k; ++a)
      if (free[a] < n) (*g)[free[a]] += entry(1 + a);
  std::size_t e = k + 1;
  for (std::size_t a = 0; a < k; ++a)
    for (std::size_t b = a; b < k; ++b, ++e) {
      if (free[a] == n || free[b] == n) continue;
      h.add(free[a], free[b], entry(e));
    }
}

template <class F>
struct Accumulator<F>::Passes {
  tbb::enumerable_thread_specific<Pass<F>> pass;
  FusedPass<F> fused;
};

template <class F>
Accumulator<F>::Accumulator(const Model& m,
                            const FitData<F>& d,
                            const FreeSlots& free,
                            double huber)
    : model_(m),
      data_(d),
      free_(free),
      huber_(static_cast<F>(std::min(huber, double{std::numeric_limits<F>::max()}))),
      passes_(new Passes{
          tbb::enumerable_thread_specific<Pass<F>>(
              [&m, &free, means = d.aperture != nullptr] { return Pass<F>(m, free, means); }),
          FusedPass<F>(m, free)}) {}
template <class F>
Accumulator<F>::~Accumulator() = default;

template <class F>
NormalEquations Accumulator<F>::normal_equations(std::span<const double> values) const {
  const std::size_t n = free_.size();
  std::vector<NormalEquations> parts(data_.tasks.size());
  for_each_whole(parts.size(), [&](std::size_t task) {
    std::vector<GramSums<F>> sums;
    alignas(64) std::array<F, padding> cost{};
    auto& e = parts[task];
    e = {ArrowMatrix(free_.layout()), std::vector<double>(n), 0};
    const auto begin = [&](const auto& columns) {
      for (std::size_t c = 0; c < model_.channels; ++c) sums.emplace_back(columns(c).size() + 1);
    };
    const auto collect = [&](const auto& columns) {
      for (const F lane : cost) e.cost += static_cast<double>(lane) / 2;
      for (std::size_t c = 0; c < model_.channels; ++c) sums[c].scatter(columns(c), n, e.h, &e.g);
    };
    if (const auto& fused = passes_->fused;
        fused && !data_.aperture && huber_ == std::numeric_limits<F>::max()) {
      begin([&](std::size_t c) { return std::span(fused.at(c)); });
      fused.run(values, data_, data_.tasks[task], sums, cost.data());
      return collect([&](std::size_t c) { return fused.at(c); });
    }
    Pass<F>& pass = passes_->pass.local();
    pass.set(values);
    begin([&](std::size_t c) { return std::span(pass.free(c)); });
    for (const auto& b : data_.tasks[task])
      pass.run(b, data_, huber_, cost.data(), [&](std::size_t c) { pass.add(b.n, c, sums[c]); });
    collect([&](std::size_t c) { return pass.free(c); });
  });
  NormalEquations total{ArrowMatrix(free_.layout()), std::vector<double>(n), data_.rest / 2};
  for (const auto& e : parts) {  // in the order of the samples
    total.h += e.h;
    add(total.g, e.g);
    total.cost += e.cost;
  }
  return total;
}

template <class F>
std::vector<double> Accumulator<F>::channel_costs(std::span<const double> values) const {
  std::vector<std::vector<double>> parts(data_.tasks.size());
  for_each_whole(parts.size(), [&](std::size_t task) {
    auto& costs = parts[task];
    costs.resize(model_.channels);
    Pass<F>& pass = passes_->pass.local();
    pass.set(values);
    alignas(64) std::array<F, padding> cost{};
    for (const auto& b : data_.tasks[task])
      pass.run(b, data_, huber_, cost.data(), [&](std::size_t c) {
        for (F& lane : cost) costs[c] += static_cast<double>(std::exchange(lane, F(0))) / 2;
      });
  });
  std::vector<double> total(model_.channels);
  for (const auto& costs : parts) add(total, costs);
  return total;
}

template <class F>
std::vector<double> Accumulator<F>::residuals(std::span<const double> values) const {
  std::vector<double> all;
  Pass<F> pass(model_, free_, data_.aperture != nullptr);
  pass.set(values);
  alignas(64) std::array<F, padding> cost{};
  for (const auto& task : data_.tasks)
    for (const auto& b : task)
      pass.run(b, data_, std::numeric_limits<F>::max(), cost.data(), [&](std::size_t c) {
        for (std::size_t i = 0; i < b.n; ++i)
          if (b.weight(c)[i] > 0) all.push_back(static_cast<double>(pass.r()[i]));
      });
  return all;
}

template class GramSums<float>;
template class GramSums<double>;
template class Accumulator<float>;
template class Accumulator<double>;

}  // namespace gonio
