#include "fitting/sample/data.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <numeric>

#include <tbb/parallel_for.h>

namespace gonio {
namespace {

/// The group's target and weight in one channel; returns its rest.
template <class F>
double fold(const BlockReader<F>& in,
            std::size_t channel,
            std::size_t members,
            const FitBlock<F>& out) {
  F* const __restrict target = out.target(channel), * const __restrict weight = out.weight(channel);
  const auto& first = in.values(0, channel);
  if (members == 1) {
    std::copy_n(first.target.data(), out.n, target);
    std::copy_n(first.weight.data(), out.n, weight);
    return 0;
  }
  // One member after the other: running sums of weights, means and squares about the mean.
  std::array<F, padding> rest{};  // lane by lane
  for (std::size_t i = 0; i < out.n; ++i) {
    target[i] = first.target[i];
    weight[i] = first.weight[i] * first.weight[i];
  }
  for (std::size_t m = 1; m < members; ++m) {
    const F *const t = in.values(m, channel).target.data(), *const w =
                                                                in.values(m, channel).weight.data();
    for (std::size_t i = 0; i < out.n; i += padding)
      for (std::size_t l = 0; l < padding; ++l) {
        const std::size_t k = i + l;
        const F w2 = w[k] * w[k], sum = weight[k] + w2;
        const F off = t[k] - target[k], part = w2 / (sum > 0 ? sum : F(1));
        rest[l] += weight[k] * part * off * off;
        target[k] += part * off;
        weight[k] = sum;
      }
  }
  for (std::size_t i = 0; i < out.n; ++i) weight[i] = std::sqrt(weight[i]);
  return std::accumulate(rest.begin(), rest.end(), 0.0);
}

/// Angles over which the block's samples are means, by their numbers in its last column.
template <class F>
void find_means(const FitData<F>& d, std::size_t samples, FitBlock<F>& b) {
  if (!d.aperture) return;
  std::vector<std::size_t> number(samples);
  for (std::size_t i = 0; i < samples; ++i)
    number[i] = static_cast<std::size_t>(b.columns[(b.columns_count - 1) * b.n + i]);
  b.means = std::make_shared<const MeanColumns<F>>(*d.aperture, number, b.n, d.angle_columns > 5);
}

/// Blocks that so many groups fill.
template <class F>
constexpr std::size_t blocks_of(std::size_t groups) {
  return (groups + BlockReader<F>::block - 1) / BlockReader<F>::block;
}

/// Picks every `step`-th group that has a value.
template <class F>
class Picker {
 public:
  /// \param since  how many have passed since the last one picked
  /// \param groups  that will be looked at, at most
  Picker(std::size_t step, std::size_t since, std::size_t groups, std::size_t columns)
      : step_(step), left_(step - since - 1) {
    rows_.reserve((groups / step + 1) * columns);
  }
  /// \param with_value  those groups of the block, in order
  void look_at(const FitBlock<F>& b, std::span<const std::uint32_t> with_value) {
    for (; left_ < with_value.size(); left_ += step_)
      for (std::size_t k = 0; k < b.columns_count; ++k)
        rows_.push_back(b.columns[k * b.n + with_value[left_]]);
    left_ -= with_value.size();
  }
  /// [group picked][column]
  const std::vector<F>& rows() const { return rows_; }

 private:
  std::size_t step_;
  std::size_t left_;  ///< groups before the next one picked
  std::vector<F> rows_;
};

/// One pass over the table's groups; every `steps[l]`-th with a value goes into level l too.
template <class F>
FitLevels<F> read(const Sampling& s, const Tasks& tasks, const std::vector<std::size_t>& steps) {
  struct Part {
    double rest = 0;
    std::size_t groups = 0;
    SampleCounts counts;
    std::vector<Picker<F>> levels;
  };
  FitLevels<F> levels;
  FitData<F>& all = levels.all;
  all.link = link_of(s.metric());
  all.offset = static_cast<F>(s.link_offset());
  all.angle_columns = s.angle_columns();
  all.aperture = s.aperture();
  std::size_t blocks = 0;
  for (std::size_t k = 0; k < tasks.count; ++k) blocks += blocks_of<F>(tasks.groups(k));
  all.reserve(tasks.count, blocks, s.channels());
  std::vector<Part> parts(tasks.count);
  tbb::parallel_for(std::size_t{0}, tasks.count, [&](std::size_t k) {
    BlockReader<F> in(s, tasks.first(k), tasks.last(k), tasks.step);
    Part& part = parts[k];
    // tasks begin at different places
    for (const std::size_t step : steps)
      part.levels.emplace_back(step, (7 * k + step - 1) % step, tasks.groups(k),
                               all.columns(s.channels()));
    std::array<std::uint32_t, BlockReader<F>::block> with_value;
    std::array<F, BlockReader<F>::block> largest;  // weight of each group over the channels
    while (in.next()) {
      FitBlock<F>& b = all.add_block(k, in.size());
      const auto x = in.angles();
      std::size_t at = 0;
      const auto copy = [&](const F* angle) {
        if (angle) std::copy_n(angle, b.n, b.columns + b.n * at++);
      };
      for (const F* angle : {x.nol, x.nov, x.noh, x.voh, x.sin2_theta_h}) copy(angle);
      std::ranges::for_each(x.frame, copy);
      if (all.aperture) {
        F* const number = b.columns + (b.columns_count - 1) * b.n;
        std::fill_n(number, b.n, F(0));
        const auto samples = in.there();
        for (std::size_t i = 0; i < in.size(); ++i) number[i] = static_cast<F>(samples[i]);
        b.means = in.means();
      }
      for (std::size_t c = 0; c < s.channels(); ++c)
        part.rest += fold(in, c, s.groups().widest(), b);
      largest.fill(0);
      for (std::size_t c = 0; c < s.channels(); ++c) {
        const F* const weight = b.weight(c);
        for (std::size_t i = 0; i < b.n; ++i)
          largest[i] = weight[i] > largest[i] ? weight[i] : largest[i];
      }
      std::size_t count = 0;
      for (std::size_t i = 0; i < in.size(); ++i) {
        with_value[count] = static_cast<std::uint32_t>(i);
        count += largest[i] > 0;
      }
      for (auto& level : part.levels) level.look_at(b, {with_value.data(), count});
      part.groups += count;
    }
    part.counts = in.counts();
  });
  for (const auto& p : parts) {
    all.rest += p.rest;
    all.groups += p.groups;
    all.counts.add(p.counts);
  }
  for (std::size_t l = 0; l < steps.size(); ++l) {
    std::vector<F> rows;
    for (const auto& p : parts)
      rows.insert(rows.end(), p.levels[l].rows().begin(), p.levels[l].rows().end());
    levels.thinned.push_back(picked_from(all, s.channels(), rows));
  }
  return levels;
}

}  // namespace

template <class F>
FitData<F> picked_from(const FitData<F>& all, std::size_t channels, const std::vector<F>& rows) {
  constexpr std::size_t block = BlockReader<F>::block, task = Tasks::blocks * block;
  const std::size_t columns = all.columns(channels);
  FitData<F> d;
  d.angle_columns = all.angle_columns;
  d.aperture = all.aperture;
  d.link = all.link;
  d.offset = all.offset;
  d.groups = rows.size() / columns;
  d.reserve((d.groups + task - 1) / task, blocks_of<F>(d.groups), channels);
  for (std::size_t at = 0; at < d.groups; at += block) {
    const std::size_t n = std::min(block, d.groups - at);
    auto& b = d.add_block(at / task, n);
    for (std::size_t k = 0; k < columns; ++k) {
      F* const to = b.columns + k * b.n;
      for (std::size_t i = 0; i < n; ++i) to[i] = rows[(at + i) * columns + k];
      std::fill(to + n, to + b.n, k < all.angle_columns ? F(0.5) : F(0));
    }
    find_means(d, n, b);
    for (std::size_t c = 0; c < channels; ++c)
      d.counts.used += static_cast<std::size_t>(
          std::count_if(b.weight(c), b.weight(c) + b.n, [](F w) { return w > 0; }));
  }
  return d;
}

template <class F>
SampleBlock<F> FitBlock<F>::angles() const {
  const F* const x = columns;
  SampleBlock<F> b{{x, x + n, x + 2 * n, x + 3 * n, x + 4 * n, n},
                   means ? &means->block() : nullptr};
  for (std::size_t k = 5; k < angle_columns; ++k) b.frame[k - 5] = x + k * n;
  return b;
}

template <class F>
void FitData<F>::reserve(std::size_t count, std::size_t blocks, std::size_t channels) {
  columns_count_ = columns(channels);
  used_ = 0;
  tasks.resize(count);
  for (auto& t : tasks) t.reserve(Tasks::blocks);
  memory = Column<F>::for_overwrite(blocks * BlockReader<F>::block * columns_count_);
}

template <class F>
FitBlock<F>& FitData<F>::add_block(std::size_t task, std::size_t n) {
  const std::size_t full = BlockReader<F>::block * columns_count_;
  // Side by side as they come, whatever their task: those below the horizon take no memory.
  const std::size_t at = std::atomic_ref(used_).fetch_add(1, std::memory_order_relaxed);
  return tasks[task].emplace_back(FitBlock<F>{(n + padding - 1) / padding * padding, angle_columns,
                                              columns_count_, memory.data() + at * full, nullptr});
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
  to.angle_columns = from.angle_columns;
  to.aperture = from.aperture;
  std::size_t blocks = 0;
  for (const auto& t : from.tasks) blocks += t.size();
  to.reserve(from.tasks.size(), blocks,
             from.tasks.empty() || from.tasks[0].empty()
                 ? 0
                 : (from.tasks[0][0].columns_count - from.angle_columns) / 2);
  for (std::size_t k = 0; k < from.tasks.size(); ++k)
    for (const auto& b : from.tasks[k]) {
      auto& own = to.add_block(k, b.n);
      std::copy_n(b.columns, b.columns_count * b.n, own.columns);
      find_means(to, b.n, own);
    }
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
template FitData<float> picked_from(const FitData<float>&, std::size_t, const std::vector<float>&);
template FitData<double> picked_from(const FitData<double>&,
                                     std::size_t,
                                     const std::vector<double>&);
template FitData<double> in_double(const FitData<float>&);
template FitData<double> in_double(const FitData<double>&);

}  // namespace gonio
