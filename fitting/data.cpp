#include "fitting/data.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <tbb/parallel_for.h>

namespace gonio {
namespace {

/// The group's target and weight in one channel; returns its rest.
template <class F>
double fold(const BlockReader<F>& in, std::size_t channel, std::size_t members, FitBlock<F>& out) {
  F* const target = out.columns.data() + (5 + 2 * channel) * out.n;
  F* const weight = target + out.n;
  const auto& first = in.values(0, channel);
  if (members == 1) {
    std::copy_n(first.target.data(), out.n, target);
    std::copy_n(first.weight.data(), out.n, weight);
    return 0;
  }
  // One member after the other: running sums of weights, means and squares about the mean.
  double rest = 0;
  for (std::size_t i = 0; i < out.n; ++i) {
    target[i] = first.target[i];
    weight[i] = first.weight[i] * first.weight[i];
  }
  for (std::size_t m = 1; m < members; ++m) {
    const auto& v = in.values(m, channel);
    F squares = 0;
    for (std::size_t i = 0; i < out.n; ++i) {
      const F w2 = v.weight[i] * v.weight[i], sum = weight[i] + w2, off = v.target[i] - target[i];
      const F part = w2 / (sum > 0 ? sum : F(1));
      squares += weight[i] * part * off * off;
      target[i] += part * off;
      weight[i] = sum;
    }
    rest += static_cast<double>(squares);
  }
  for (std::size_t i = 0; i < out.n; ++i) weight[i] = std::sqrt(weight[i]);
  return rest;
}

}  // namespace

template <class F>
Block<F> FitBlock<F>::angles() const {
  const F* const x = columns.data();
  return {x, x + n, x + 2 * n, x + 3 * n, x + 4 * n, n};
}

template <class F>
FitData<F> fit_data(const Sampling& s, std::size_t most) {
  const Tasks tasks(s, most, BlockReader<F>::block);
  FitData<F> d;
  d.link = link_of(s.metric());
  d.offset = static_cast<F>(s.link_offset());
  d.tasks.resize(tasks.count);
  struct Sums {
    double rest = 0;
    std::size_t groups = 0;
    SampleCounts counts;
  };
  std::vector<Sums> sums(d.tasks.size());
  tbb::parallel_for(std::size_t{0}, d.tasks.size(), [&](std::size_t k) {
    BlockReader<F> in(s, tasks.first(k), tasks.last(k), tasks.step);
    while (in.next()) {
      FitBlock<F> b{in.padded(), Column<F>::for_overwrite((5 + 2 * s.channels()) * in.padded())};
      const auto x = in.angles();
      std::size_t at = 0;
      for (const F* angle : {x.nol, x.nov, x.noh, x.voh, x.sin2_theta_h})
        std::copy_n(angle, b.n, b.columns.data() + b.n * at++);
      for (std::size_t c = 0; c < s.channels(); ++c)
        sums[k].rest += fold(in, c, s.groups().widest(), b);
      sums[k].groups += in.size();
      d.tasks[k].push_back(std::move(b));
    }
    sums[k].counts = in.counts();
  });
  for (const auto& x : sums) {
    d.rest += x.rest;
    d.groups += x.groups;
    d.counts.add(x.counts);
  }
  return d;
}

template struct FitBlock<float>;
template struct FitBlock<double>;
template FitData<float> fit_data(const Sampling&, std::size_t);
template FitData<double> fit_data(const Sampling&, std::size_t);

}  // namespace gonio
