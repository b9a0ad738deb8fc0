#include "fitting/data.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

namespace gonio {
namespace {

/// The group's target and weight in one channel; returns its rest.
template <class F>
double fold(const BlockReader<F>& in,
            std::size_t channel,
            std::size_t members,
            const FitBlock<F>& out) {
  F *const target = out.target(channel), *const weight = out.weight(channel);
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

/// Columns of groups picked out of blocks.
template <class F>
class Picked {
 public:
  explicit Picked(std::size_t columns) : columns_(columns) {}
  std::size_t size() const { return columns_[0].size(); }
  void pick(const FitBlock<F>& b, std::size_t i) {
    for (std::size_t k = 0; k < columns_.size(); ++k) columns_[k].push_back(b.columns[k * b.n + i]);
  }
  void append(const Picked& p) {
    for (std::size_t k = 0; k < columns_.size(); ++k)
      columns_[k].insert(columns_[k].end(), p.columns_[k].begin(), p.columns_[k].end());
  }
  /// Cut into blocks and tasks; what is used is counted.
  void cut_into(FitData<F>& d) const {
    constexpr std::size_t block = BlockReader<F>::block;
    d.groups = size();
    d.reserve((size() + Tasks::blocks * block - 1) / (Tasks::blocks * block),
              (columns_.size() - 5) / 2);
    for (std::size_t at = 0; at < size(); at += block) {
      const std::size_t n = std::min(block, size() - at);
      const auto& b = d.add_block(at / (Tasks::blocks * block), n);
      for (std::size_t k = 0; k < columns_.size(); ++k) {
        F* const to = b.columns + k * b.n;
        std::copy_n(columns_[k].data() + at, n, to);
        std::fill(to + n, to + b.n, k < 5 ? F(0.5) : F(0));
      }
      for (std::size_t c = 0; 5 + 2 * c < columns_.size(); ++c)
        d.counts.used += static_cast<std::size_t>(
            std::count_if(b.weight(c), b.weight(c) + b.n, [](F w) { return w > 0; }));
    }
  }

 private:
  std::vector<std::vector<F>> columns_;
};

/// One pass over the table's groups; every `steps[l]`-th with a value goes into level l too.
template <class F>
FitLevels<F> read(const Sampling& s, const Tasks& tasks, const std::vector<std::size_t>& steps) {
  struct Part {
    double rest = 0;
    std::size_t groups = 0;
    SampleCounts counts;
    std::vector<Picked<F>> picked;
    std::vector<std::size_t> since;  ///< groups passed since the last one picked
  };
  const auto like = [&](FitData<F>& d) {
    d.link = link_of(s.metric());
    d.offset = static_cast<F>(s.link_offset());
  };
  FitLevels<F> levels;
  FitData<F>& all = levels.all;
  like(all);
  all.reserve(tasks.count, s.channels());
  std::vector<Part> parts(tasks.count);
  const Picked<F> none(5 + 2 * s.channels());
  tbb::parallel_for(std::size_t{0}, tasks.count, [&](std::size_t k) {
    BlockReader<F> in(s, tasks.first(k), tasks.last(k), tasks.step);
    Part& part = parts[k];
    part.picked.assign(steps.size(), none);
    for (const std::size_t step : steps) part.since.push_back((7 * k + step - 1) % step);
    while (in.next()) {
      const FitBlock<F>& b = all.add_block(k, in.size());
      const auto x = in.angles();
      std::size_t at = 0;
      for (const F* angle : {x.nol, x.nov, x.noh, x.voh, x.sin2_theta_h})
        std::copy_n(angle, b.n, b.columns + b.n * at++);
      for (std::size_t c = 0; c < s.channels(); ++c)
        part.rest += fold(in, c, s.groups().widest(), b);
      for (std::size_t i = 0; i < in.size(); ++i) {
        bool compared = false;
        for (std::size_t c = 0; c < s.channels(); ++c) compared = compared || b.weight(c)[i] > 0;
        if (!compared) continue;
        for (std::size_t l = 0; l < steps.size(); ++l)  // tasks begin at different places
          if (++part.since[l] >= steps[l]) {
            part.since[l] = 0;
            part.picked[l].pick(b, i);
          }
      }
      part.groups += in.size();
    }
    part.counts = in.counts();
  });
  std::vector<Picked<F>> picked(steps.size(), none);
  for (const auto& p : parts) {
    all.rest += p.rest;
    all.groups += p.groups;
    all.counts.add(p.counts);
    for (std::size_t l = 0; l < steps.size(); ++l) picked[l].append(p.picked[l]);
  }
  for (const auto& p : picked) {
    like(levels.thinned.emplace_back());
    p.cut_into(levels.thinned.back());
  }
  return levels;
}

}  // namespace

template <class F>
Block<F> FitBlock<F>::angles() const {
  const F* const x = columns;
  return {x, x + n, x + 2 * n, x + 3 * n, x + 4 * n, n};
}

template <class F>
void FitData<F>::reserve(std::size_t count, std::size_t channels) {
  columns_count_ = 5 + 2 * channels;
  tasks.resize(count);
  for (auto& t : tasks) t.reserve(Tasks::blocks);
  memory = Column<F>::for_overwrite(count * Tasks::blocks * BlockReader<F>::block * columns_count_);
}

template <class F>
FitBlock<F>& FitData<F>::add_block(std::size_t task, std::size_t n) {
  const std::size_t full = BlockReader<F>::block * columns_count_;
  const std::size_t at = task * Tasks::blocks + tasks[task].size();
  return tasks[task].emplace_back(FitBlock<F>{(n + padding - 1) / padding * padding, columns_count_,
                                              memory.data() + at * full});
}

template <class F>
FitData<F> fit_data(const Sampling& s, std::size_t most) {
  return read<F>(s, Tasks(s, most, BlockReader<F>::block), {}).all;
}

template <class F>
FitLevels<F> fit_levels(const Sampling& s, std::span<const std::size_t> levels) {
  constexpr auto all = static_cast<std::size_t>(-1);
  std::vector<std::size_t> steps;
  for (const std::size_t most : levels) steps.push_back(Tasks::step_to(s.groups().size(), most));
  return read<F>(s, Tasks(s, all, BlockReader<F>::block), steps);
}

template <class F>
FitData<double> in_double(const FitData<F>& from) {
  FitData<double> to;
  to.link = from.link;
  to.offset = static_cast<double>(from.offset);
  to.rest = from.rest;
  to.groups = from.groups;
  to.counts = from.counts;
  to.reserve(from.tasks.size(), from.tasks.empty() || from.tasks[0].empty()
                                    ? 0
                                    : (from.tasks[0][0].columns_count - 5) / 2);
  for (std::size_t k = 0; k < from.tasks.size(); ++k)
    for (const auto& b : from.tasks[k])
      std::copy_n(b.columns, b.columns_count * b.n, to.add_block(k, b.n).columns);
  return to;
}

template struct FitBlock<float>;
template struct FitBlock<double>;
template struct FitData<float>;
template struct FitData<double>;
template FitData<float> fit_data(const Sampling&, std::size_t);
template FitData<double> fit_data(const Sampling&, std::size_t);
template FitLevels<float> fit_levels(const Sampling&, std::span<const std::size_t>);
template FitLevels<double> fit_levels(const Sampling&, std::span<const std::size_t>);
template FitData<double> in_double(const FitData<float>&);
template FitData<double> in_double(const FitData<double>&);

}  // namespace gonio
