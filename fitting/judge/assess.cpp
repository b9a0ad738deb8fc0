#include "fitting/judge/assess.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "brdf/model/derivatives.h"
#include "table/health/health.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

namespace gonio {
namespace {

constexpr std::size_t none = static_cast<std::size_t>(-1);

/// Which interval between given angles a cosine lies in.
class AngleBands {
 public:
  explicit AngleBands(std::vector<double> edges_deg) : edges_deg_(std::move(edges_deg)) {
    for (const double e : edges_deg_) cosine_.push_back(std::cos(e * degree));
    for (std::size_t k = 0; k < near_.size(); ++k)
      near_[k] = onwards(0, std::min(static_cast<double>(k + 1) / cells, 1.0));
  }
  std::size_t size() const { return edges_deg_.size() - 1; }
  double from_deg(std::size_t band) const { return edges_deg_[band]; }
  double to_deg(std::size_t band) const { return edges_deg_[band + 1]; }
  std::size_t operator()(double cosine) const {
    return onwards(near_[static_cast<std::size_t>(std::clamp(cosine, 0.0, 1.0) * cells)], cosine);
  }
  /// True where operator() would give that band.
  bool holds(std::size_t band, double cosine) const {
    return (band == 0 || cosine < cosine_[band]) &&
           (band + 1 == size() || cosine >= cosine_[band + 1]);
  }
  /// Adds `step` times the band of each cosine.
  template <class F>
  void add_to(std::size_t n, const F* cosine, std::int32_t step, std::int32_t* sum) const {
    for (std::size_t band = 1; band < size(); ++band) {
      auto edge = static_cast<F>(cosine_[band]);  // of all F below it, and of no other
      if (static_cast<double>(edge) < cosine_[band]) edge = std::nextafter(edge, F(2));
      for (std::size_t i = 0; i < n; ++i) sum[i] += cosine[i] < edge ? step : 0;
    }
  }

 private:
  static constexpr double cells = 1024;
  std::size_t onwards(std::size_t band, double cosine) const {
    while (band + 1 < size() && cosine < cosine_[band + 1]) ++band;
    return band;
  }
  std::vector<double> edges_deg_, cosine_;
  /// The band of the largest cosine of each cell: none of the cell lies in a band before it.
  std::array<std::size_t, static_cast<std::size_t>(cells) + 1> near_{};
};

/// Small numbers that tell incident angles apart.
class IncidentKeys {
 public:
  explicit IncidentKeys(const Sampling& s)
      : grid_(s.table().grid()), first_(first_of_copies(s.table())) {
    if (grid_) {
      count_ = first_.empty() ? degrees_.size() : first_.size();
      if (!first_.empty()) samples_per_angle_ = grid_->axes[1].size * grid_->axes[2].size;
      return;
    }
    auto angles = incident_angles(*s.table().list());
    count_ = angles.count;
    rank_ = std::move(angles.number);
  }
  std::size_t count() const { return count_; }
  /// \param last  that of a neighbour, where the answer is looked for first; or `none`
  std::size_t operator()(std::size_t sample, double nol, std::size_t last) const {
    if (grid_ && first_.empty() && last != none && degrees_.holds(last, nol)) return last;
    if (!grid_) return rank_[sample];
    return first_.empty() ? degrees_(nol) : first_[sample / samples_per_angle_];
  }

 private:
  /// Cut at three quarters: grids tend to have their angles at whole and half degrees.
  static std::vector<double> whole_degrees() {
    std::vector<double> edges{0};
    for (double e = 0.75; e < 90; ++e) edges.push_back(e);
    edges.push_back(90);
    return edges;
  }
  const Grid* grid_;
  std::vector<std::size_t> first_;
  std::size_t samples_per_angle_ = 1, count_ = 0;
  std::vector<std::uint32_t> rank_;
  AngleBands degrees_{whole_degrees()};
};

struct Sums {
  double values = 0, positive = 0, squares = 0, log_squares = 0;

  void add(const Sums& s) {
    values += s.values;
    positive += s.positive;
    squares += s.squares;
    log_squares += s.log_squares;
  }
  double rms() const { return values > 0 ? std::sqrt(squares / values) : 0; }
  double log_rms() const { return positive > 0 ? std::sqrt(log_squares / positive) : 0; }
};

struct Bands {
  const char* angle;
  AngleBands by;
};
const std::array<Bands, 3>& bands() {
  static const std::array<Bands, 3> all{Bands{"theta_i", AngleBands({0, 20, 40, 60, 75, 90})},
                                        Bands{"theta_h", AngleBands({0, 1, 3, 8, 20, 45, 90})},
                                        Bands{"theta_d", AngleBands({0, 20, 40, 60, 75, 90})}};
  return all;
}
using BandSums = std::array<std::vector<Sums>, 3>;
BandSums no_sums() {
  BandSums s;
  for (std::size_t k = 0; k < s.size(); ++k) s[k].resize(bands()[k].by.size());
  return s;
}

/// Findings of one task.
struct Part {
  ArrowMatrix bread, meat;
  std::vector<std::size_t> keys;  ///< of the incident angles seen
  std::vector<double> scores;     ///< [of those][free slot]
  BandSums sums = no_sums();
  SampleCounts counts;
};

/// A task's walk over its blocks.
template <class F>
class Walk {
 public:
  Walk(const Sampling& s,
       const BoundModel& b,
       const FreeSlots& free,
       double huber,
       bool by_incident_angle,
       const IncidentKeys& keys)
      : sampling_(s),
        free_(free),
        huber_(static_cast<F>(std::min(huber, double{std::numeric_limits<F>::max()}))),
        by_angle_(by_incident_angle),
        keys_(keys),
        kernels_(kernels<F>()),
        values_(b.values.begin(), b.values.end()),
        derivatives_(b.model, free.mask(), kernels_) {
    derivatives_.set(values_);
    for (auto* x : {&link_, &link_slope_, &log_f_, &log_y_, &unused_, &score_, &slope_})
      *x = derivatives_.fresh();
    for (std::size_t m = 0; m < s.groups().widest(); ++m)
      for (auto* sums : {&values_seen_[m], &positive_[m], &squares_[m], &log_squares_[m]})
        *sums = Column<F>::for_overwrite(size);
    for (std::size_t c = 0; c < s.channels(); ++c) {
      auto& x = channel_.emplace_back();
      for (const auto& [slot, column] : derivatives_.channel(c).d) {
        x.j[x.free.size()] = column;
        x.free.push_back(free.index(slot));
      }
    }
  }

  Part run(BlockReader<F>& in) {
    const std::size_t n = free_.size();
    part_ = {ArrowMatrix(free_.layout()), ArrowMatrix(free_.layout()), {}, {}, no_sums(), {}};
    place_.assign(keys_.count(), none);
    bread_.assign(sampling_.channels(), {});
    meat_.assign(sampling_.channels(), {});
    while (in.next()) block(in);
    for (std::size_t c = 0; c < sampling_.channels(); ++c) {
      bread_[c].scatter(channel_[c].free, n, part_.bread, nullptr);
      if (!by_angle_) meat_[c].scatter(channel_[c].free, n, part_.meat, nullptr);
    }
    part_.counts = in.counts();
    return std::move(part_);
  }

 private:
  static constexpr std::size_t size = BlockReader<F>::block;
  struct Channel {
    std::vector<std::size_t> free;
    std::array<const F*, max_columns> j{};
  };

  void block(const BlockReader<F>& in) {
    const std::size_t members = sampling_.groups().widest();
    const auto x = in.angles();
    if (by_angle_) find_incident_angles(in, members);
    for (std::size_t m = 0; m < members; ++m)
      for (auto* sums : {&values_seen_[m], &positive_[m], &squares_[m], &log_squares_[m]})
        std::fill_n(sums->data(), x.n, F(0));
    // With ln f − ln y for the metric there is no need to compute the logarithms twice.
    const auto offset = static_cast<F>(sampling_.link_offset());
    const bool logs = link_of(sampling_.metric()) == Link::log && offset == 0;
    const auto& log = kernels_.link[static_cast<std::size_t>(Link::log)];
    derivatives_.run(x, [&](std::size_t c) {
      const F* const f = derivatives_.channel(c).value;
      kernels_.link[static_cast<std::size_t>(link_of(sampling_.metric()))](x.n, f, offset, link_,
                                                                           link_slope_);
      if (!logs) log(x.n, f, F(0), log_f_, unused_);
      const F* const log_f = logs ? link_ : log_f_;
      for (std::size_t m = 0; m < members; ++m) {
        const auto& v = in.values(m, c);
        kernels_.influence(x.n, {link_, link_slope_, v.target.data(), v.weight.data(), huber_,
                                 score_, slope_, cost_.data()});
        sandwich(in, c, m);
        if (!logs) log(x.n, v.y.data(), F(0), log_y_, unused_);
        kernels_.residual_sums(
            x.n, {f, v.y.data(), log_f, logs ? v.target.data() : log_y_, values_seen_[m].data(),
                  squares_[m].data(), positive_[m].data(), log_squares_[m].data()});
      }
    });
    bands_of(in, x, members);
  }

  /// Neighbours of one incident angle, and where its scores stand in the part.
  struct Run {
    std::size_t begin, end, to;
  };

  void find_incident_angles(const BlockReader<F>& in, std::size_t members) {
    for (std::size_t m = 0; m < members; ++m) {
      std::array<F, size> weight{};
      for (std::size_t c = 0; c < sampling_.channels(); ++c) {
        const F* const w = in.values(m, c).weight.data();
        for (std::size_t i = 0; i < in.size(); ++i) weight[i] = w[i] > weight[i] ? w[i] : weight[i];
      }
      auto& runs = runs_[m];
      runs.clear();
      std::size_t last = none;
      for (std::size_t i = 0; i < in.size(); ++i) {
        if (!(weight[i] > 0)) continue;  // adds nothing to any
        const std::size_t key = keys_(in.sample(m)[i], static_cast<double>(in.nol(m)[i]), last);
        if (key == last) continue;
        last = key;
        if (place_[key] == none) {
          place_[key] = part_.keys.size() * free_.size();
          part_.keys.push_back(key);
          part_.scores.resize(part_.keys.size() * free_.size());
        }
        if (!runs.empty()) runs.back().end = i;
        runs.push_back({i, in.size(), place_[key]});
      }
    }
  }

  /// Σ score j over each run.
  /// \tparam K  how many columns j has
  template <std::size_t K>
  void add_scores(const std::vector<Run>& runs, const Channel& x) {
    for (const auto& run : runs) {
      std::array<double, K> sum{};
      for (std::size_t i = run.begin; i < run.end; ++i) {
        if (score_[i] == 0) continue;  // masked values, whose derivatives may be NaN
        for (std::size_t p = 0; p < K; ++p)
          sum[p] += static_cast<double>(score_[i]) * static_cast<double>(x.j[p][i]);
      }
      for (std::size_t p = 0; p < K; ++p) part_.scores[run.to + x.free[p]] += sum[p];
    }
  }
  using AddScores = void (Walk::*)(const std::vector<Run>&, const Channel&);
  template <std::size_t... K>
  static constexpr std::array<AddScores, sizeof...(K)> add_scores_of(std::index_sequence<K...>) {
    return {&Walk::add_scores<K>...};
  }

  void sandwich(const BlockReader<F>& in, std::size_t c, std::size_t m) {
    const Channel& x = channel_[c];
    const std::size_t k = x.free.size();
    if (k == 0) return;
    kernels_.gram[k + 1](in.padded(), score_, slope_, x.j.data(), bread_[c].lanes());
    if (!by_angle_) {
      kernels_.gram[k + 1](in.padded(), score_, score_, x.j.data(), meat_[c].lanes());
      return;
    }
    static constexpr auto add = add_scores_of(std::make_index_sequence<max_columns + 1>());
    (this->*add[k])(runs_[m], x);
  }

  void bands_of(const BlockReader<F>& in, const Block<F>& x, std::size_t members) {
    const auto& [theta_i, theta_h, theta_d] = bands();
    constexpr std::int32_t most = 8;  // bands of one angle
    std::array<std::int32_t, size> of_group{}, band;
    theta_h.by.add_to(in.size(), x.noh, most, of_group.data());
    theta_d.by.add_to(in.size(), x.voh, most * most, of_group.data());
    for (std::size_t m = 0; m < members; ++m) {
      band = of_group;
      theta_i.by.add_to(in.size(), in.nol(m), 1, band.data());
      // Neighbours mostly lie in the same three bands.
      for (std::size_t i = 0; i < in.size();) {
        const auto here = static_cast<std::size_t>(band[i]);
        Sums s;
        for (; i < in.size() && static_cast<std::size_t>(band[i]) == here; ++i)
          s.add({static_cast<double>(values_seen_[m][i]), static_cast<double>(positive_[m][i]),
                 static_cast<double>(squares_[m][i]), static_cast<double>(log_squares_[m][i])});
        part_.sums[0][here % most].add(s);
        part_.sums[1][here / most % most].add(s);
        part_.sums[2][here / (most * most)].add(s);
      }
    }
  }

  const Sampling& sampling_;
  const FreeSlots& free_;
  F huber_;
  bool by_angle_;
  const IncidentKeys& keys_;
  const Kernels<F>& kernels_;
  std::vector<F> values_;
  ModelDerivatives<F> derivatives_;
  F *link_, *link_slope_, *log_f_, *log_y_, *unused_, *score_, *slope_;
  std::vector<Channel> channel_;
  std::vector<GramSums<F>> bread_, meat_;
  alignas(64) std::array<F, padding> cost_{};
  std::vector<std::size_t> place_;
  std::array<std::vector<Run>, Groups::most> runs_;
  using PerMember = std::array<Column<F>, Groups::most>;
  PerMember values_seen_, positive_, squares_, log_squares_;
  Part part_;
};

FitResiduals statistics(const BandSums& sums) {
  Sums all;
  for (const auto& s : sums[0]) all.add(s);
  FitResiduals r{all.rms(), all.log_rms(), {}};
  for (std::size_t k = 0; k < sums.size(); ++k)
    for (std::size_t i = 0; i < sums[k].size(); ++i) {
      const auto& [angle, by] = bands()[k];
      const auto& s = sums[k][i];
      r.bands.push_back({angle, by.from_deg(i), by.to_deg(i), static_cast<std::size_t>(s.values),
                         s.rms(), s.log_rms()});
    }
  return r;
}

template <class F>
Assessment assess_in(const Sampling& s,
                     const BoundModel& b,
                     const FreeSlots& free,
                     double huber,
                     bool by_incident_angle,
                     std::size_t most) {
  const std::size_t n = free.size();
  const IncidentKeys keys(s);
  const Tasks tasks(s, most, BlockReader<F>::block);
  std::vector<Part> parts(tasks.count);
  tbb::enumerable_thread_specific<Walk<F>> walks(
      [&] { return Walk<F>(s, b, free, huber, by_incident_angle, keys); });
  tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t k) {
    BlockReader<F> in(s, tasks.first(k), tasks.last(k), tasks.step);
    parts[k] = walks.local().run(in);
  });
  Assessment a;
  a.sandwich = {ArrowMatrix(free.layout()), ArrowMatrix(free.layout()), {}};
  std::vector<std::vector<double>> scores(keys.count());
  std::vector<bool> seen(keys.count());
  BandSums sums = no_sums();
  for (const auto& p : parts) {  // in the order of the samples
    a.sandwich.bread += p.bread;
    a.sandwich.meat += p.meat;
    for (std::size_t k = 0; k < p.keys.size(); ++k) {
      auto& sum = scores[p.keys[k]];
      sum.resize(n);
      for (std::size_t i = 0; i < n; ++i) sum[i] += p.scores[k * n + i];
      seen[p.keys[k]] = true;
    }
    for (std::size_t k = 0; k < sums.size(); ++k)
      for (std::size_t i = 0; i < sums[k].size(); ++i) sums[k][i].add(p.sums[k][i]);
    a.counts.add(p.counts);
  }
  a.incident_angles = static_cast<std::size_t>(std::ranges::count(seen, true));
  for (std::size_t k = 0; k < scores.size(); ++k)
    if (seen[k]) a.sandwich.scores.push_back(std::move(scores[k]));
  a.residuals = statistics(sums);
  return a;
}

}  // namespace

Assessment assess(const Sampling& s,
                  const BoundModel& b,
                  const FreeSlots& free,
                  double huber,
                  bool by_incident_angle,
                  bool in_float,
                  std::size_t most) {
  return in_float ? assess_in<float>(s, b, free, huber, by_incident_angle, most)
                  : assess_in<double>(s, b, free, huber, by_incident_angle, most);
}

FitResiduals residual_statistics(const BoundModel& b, const Sampling& s, std::size_t most) {
  const FreeSlots nothing(std::vector<bool>(b.model.value_count, false));
  return assess(s, b, nothing, no_huber, false, false, most).residuals;
}

}  // namespace gonio
