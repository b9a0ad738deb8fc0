#include "fitting/judge/assess.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "fitting/sample/incident_angles.h"
#include "fitting/sample/model_blocks.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

namespace gonio {
namespace {

constexpr std::size_t none = static_cast<std::size_t>(-1);

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
  std::vector<std::size_t> keys;                                 ///< of the incident angles seen
  std::vector<double> scores, breads;                            ///< [of those][free slot], [entry]
  std::vector<double> fourth, alone, moves;                      ///< [free slot]
  std::vector<std::vector<double>> fourth_by_arm, moves_by_arm;  ///< [arm][of the head]
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
       const IncidentKeys* keys,
       const Influences* influences)
      : sampling_(s),
        free_(free),
        huber_(static_cast<F>(std::min(huber, double{std::numeric_limits<F>::max()}))),
        keys_(keys),
        influences_(keys ? nullptr : influences),
        kernels_(kernels<F>()),
        model_(s, b, free.mask()) {
    for (auto* x : {&log_f_, &log_y_, &unused_, &score_, &slope_}) *x = model_.fresh();
    for (std::size_t m = 0; m < s.groups().widest(); ++m)
      for (auto* sums : {&values_seen_[m], &positive_[m], &squares_[m], &log_squares_[m]})
        *sums = Column<F>::for_overwrite(size);
    std::size_t most_rows = 0;
    for (std::size_t c = 0; c < s.channels(); ++c) {
      auto& x = channel_.emplace_back();
      for (const auto& [slot, column] : model_.channel(c).d) {
        x.j[x.free.size()] = column;
        x.free.push_back(free.index(slot));
      }
      for (std::size_t p = 0; p < x.free.size(); ++p)
        for (std::size_t q = p; q < x.free.size(); ++q) {
          const auto [i, j] = std::minmax(x.free[p], x.free[q]);
          x.upper.push_back(free.layout()->at(i, j));
          if (free.layout()->at(j, i) != x.upper.back())
            mirrored_.emplace_back(x.upper.back(), free.layout()->at(j, i));
        }
      if (!influences_) continue;
      x.influence = influences_->channel(x.free);
      for (const std::size_t i : x.free)
        if (free.layout()->arm(i) != ArrowLayout::none) x.arm = free.layout()->arm(i);
      const auto& at = x.influence;
      const std::size_t k = x.free.size(), rows = at.unknown.size();
      for (const auto& row : at.beta)
        for (const double beta : row) x.beta.push_back(static_cast<F>(beta));
      x.product.resize(k * k);
      for (std::size_t p = 0; p < k; ++p)
        for (std::size_t q = 0; q < k && at.row[p] != Influences::none; ++q)
          x.product[p * k + q] = static_cast<F>(at.leverage[p] * at.beta[at.row[p]][q]);
      most_rows = std::max(most_rows, rows);
    }
    if (!influences_) return;
    for (auto* sums : {&fourth_, &moves_}) *sums = Column<F>(most_rows * padding);
    for (std::size_t m = 0; m < s.groups().widest(); ++m) per_root_[m] = Column<F>(size, F(1));
    columns_.resize(most_columns);
    for (auto& column : columns_) column = Column<F>(size);
    for (std::size_t k = 0; k + 1 < most_columns; ++k) seen_[k] = columns_[k].data();
    leverage_ = columns_.back().data();
  }

  Part run(BlockReader<F>& in) {
    const std::size_t n = free_.size();
    part_ = {};
    part_.bread = part_.meat = ArrowMatrix(free_.layout());
    if (influences_) {
      part_.fourth.resize(n);
      part_.alone.resize(n);
      part_.moves.resize(n);
      part_.fourth_by_arm.assign(free_.layout()->arms().size(),
                                 std::vector<double>(free_.layout()->head().size()));
      part_.moves_by_arm = part_.fourth_by_arm;
    }
    place_.assign(keys_ ? keys_->count() : 0, none);
    for (auto* sums : {&bread_, &meat_}) {
      sums->clear();
      for (const auto& x : channel_) sums->emplace_back(x.free.size() + 1);
    }
    while (in.next()) block(in);
    for (std::size_t c = 0; c < sampling_.channels(); ++c) {
      bread_[c].scatter(channel_[c].free, n, part_.bread, nullptr);
      if (!keys_) meat_[c].scatter(channel_[c].free, n, part_.meat, nullptr);
    }
    for (std::size_t k = 0; k < part_.keys.size(); ++k) {
      double* const bread = part_.breads.data() + k * free_.layout()->entries();
      for (const auto& [upper, lower] : mirrored_) bread[lower] = bread[upper];
    }
    part_.counts = in.counts();
    return std::move(part_);
  }

 private:
  static constexpr std::size_t size = BlockReader<F>::block;
  struct Channel {
    std::vector<std::size_t> free;
    std::array<const F*, most_columns> j{};
    std::vector<std::size_t> upper;  ///< entries of the matrices, row by row from the diagonal on
    Influences::Channel influence;
    std::vector<F> product, beta;  ///< its influence, as kernels read it
    std::size_t arm = ArrowLayout::none;
  };

  void block(const BlockReader<F>& in) {
    const std::size_t members = sampling_.groups().widest();
    const auto x = in.angles();
    if (keys_) find_incident_angles(in, members);
    if (influences_ && sampling_.is_counted()) find_counts(in, members);
    for (std::size_t m = 0; m < members; ++m)
      for (auto* sums : {&values_seen_[m], &positive_[m], &squares_[m], &log_squares_[m]})
        std::fill_n(sums->data(), x.n, F(0));
    // With ln f − ln y for the metric there is no need to compute the logarithms twice.
    const bool logs = link_of(sampling_.metric()) == Link::log && sampling_.link_offset() == 0;
    const auto& log = kernels_.link[static_cast<std::size_t>(Link::log)];
    model_.run(in, [&](std::size_t c) {
      const F *const f = model_.channel(c).value, *const link = model_.link();
      if (!logs) log(x.n, f, F(0), log_f_, unused_);
      const F* const log_f = logs ? link : log_f_;
      for (std::size_t m = 0; m < members; ++m) {
        const auto& v = in.values(m, c);
        kernels_.influence(x.n, {link, model_.slope(), v.target.data(), v.weight.data(), huber_,
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
    std::size_t begin, end, to;  ///< `to`: number among the part's keys
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
        const std::size_t key = (*keys_)(in.sample(m)[i], static_cast<double>(in.nol(m)[i]), last);
        if (key == last) continue;
        last = key;
        if (place_[key] == none) {
          place_[key] = part_.keys.size();
          part_.keys.push_back(key);
          part_.scores.resize(part_.keys.size() * free_.size());
          part_.breads.resize(part_.keys.size() * free_.layout()->entries());
        }
        if (!runs.empty()) runs.back().end = i;
        runs.push_back({i, in.size(), place_[key]});
      }
    }
  }

  /// Σ score j and Σ slope² j jᵀ over each run, the upper half of it.
  /// \tparam K  how many columns j has
  template <std::size_t K>
  void add_scores(const std::vector<Run>& runs, const Channel& x) {
    for (const auto& run : runs) {
      double* const score = part_.scores.data() + run.to * free_.size();
      double* const bread = part_.breads.data() + run.to * free_.layout()->entries();
      // A few at a time in F, whose digits hold these.
      constexpr std::size_t few = 16;
      for (std::size_t from = run.begin; from < run.end; from += few) {
        std::array<F, K> sum{};
        std::array<F, K*(K + 1) / 2> products{};
        for (std::size_t i = from; i < std::min(run.end, from + few); ++i) {
          if (score_[i] == 0 && slope_[i] == 0) continue;  // masked: its derivatives may be NaN
          for (std::size_t p = 0, e = 0; p < K; ++p) {
            sum[p] += score_[i] * x.j[p][i];
            const F j = slope_[i] * slope_[i] * x.j[p][i];
            for (std::size_t q = p; q < K; ++q) products[e++] += j * x.j[q][i];
          }
        }
        for (std::size_t p = 0; p < K; ++p) score[x.free[p]] += static_cast<double>(sum[p]);
        for (std::size_t e = 0; e < products.size(); ++e)
          bread[x.upper[e]] += static_cast<double>(products[e]);
      }
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
    if (influences_) divide_by_leverage(in.padded(), x, per_root_[m].data());
    if (!keys_) {
      kernels_.gram[k + 1](in.padded(), score_, score_, x.j.data(), meat_[c].lanes());
      return;
    }
    static constexpr auto add = add_scores_of(std::make_index_sequence<most_columns>());
    (this->*add[k])(runs_[m], x);
  }

  /// 1/√count of each value.
  void find_counts(const BlockReader<F>& in, std::size_t members) {
    for (std::size_t m = 0; m < members; ++m)
      for (std::size_t i = 0; i < in.size(); ++i) {
        const std::size_t sample = in.sample(m)[i];
        const double count = sample == none ? 0 : sampling_.count_of(sample);
        per_root_[m][i] = count > 0 ? static_cast<F>(1 / std::sqrt(count)) : F(1);
      }
  }

  /// Sums of fourth powers, and each score over 1 − h.  A value that alone determines something has
  /// residual 0 whatever its error is: its score says nothing.
  /// \param n  with the padding, where scores are 0
  void divide_by_leverage(std::size_t n, const Channel& x, const F* per_root) {
    const auto& at = x.influence;
    const std::size_t k = x.free.size(), rows = at.unknown.size();
    for (auto* sums : {&fourth_, &moves_}) std::fill_n(sums->data(), rows * padding, F(0));
    const InfluenceArguments<F> a{slope_, per_root, x.j.data(), seen_.data(),   x.product,
                                  x.beta, score_,   leverage_,  fourth_.data(), moves_.data()};
    kernels_.leverage[k](n, a);
    std::int32_t lone = 0;
    for (std::size_t i = 0; i < n; ++i) lone += leverage_[i] < all ? 0 : 1;
    if (lone > 0) leave_out_lone(n, x);
    kernels_.moves[k](n, a);
    for (std::size_t r = 0; r < rows; ++r) {
      const std::size_t unknown = at.unknown[r], head = free_.layout()->within(unknown);
      const bool of_head =
          x.arm != ArrowLayout::none && free_.layout()->arm(unknown) == ArrowLayout::none;
      const auto add = [&](const Column<F>& lanes, std::vector<double>& to,
                           std::vector<std::vector<double>>& by_arm) {
        double sum = 0;
        for (std::size_t l = 0; l < padding; ++l)
          sum += static_cast<double>(lanes.data()[r * padding + l]);
        to[unknown] += sum;
        if (of_head) by_arm[x.arm][head] += sum;
      };
      add(fourth_, part_.fourth, part_.fourth_by_arm);
      add(moves_, part_.moves, part_.moves_by_arm);
    }
  }
  void leave_out_lone(std::size_t n, const Channel& x) {
    const std::size_t k = x.free.size();
    for (std::size_t i = 0; i < n; ++i) {
      if (leverage_[i] < all) continue;
      score_[i] = leverage_[i] = 0;
      for (std::size_t r = 0; r < x.influence.unknown.size(); ++r) {
        double beta = 0;
        for (std::size_t p = 0; p < k; ++p)
          beta += static_cast<double>(x.beta[r * k + p]) * static_cast<double>(seen_[p][i]);
        beta *= static_cast<double>(slope_[i]);
        part_.alone[x.influence.unknown[r]] += beta * beta;
      }
    }
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
  const IncidentKeys* keys_;  ///< where values of one incident angle make a cluster; else nullptr
  const Influences* influences_;
  static constexpr F all = F(1) - F(1e-6);  ///< leverage from which on a value is alone
  std::vector<Column<F>> columns_;
  std::array<F*, most_columns - 1> seen_{};  ///< derivatives, 0 where masked
  F* leverage_ = nullptr;
  Column<F> fourth_, moves_;  ///< lane sums of each row
  std::array<Column<F>, Groups::most> per_root_;
  const Kernels<F>& kernels_;
  ModelBlocks<F> model_;
  F *log_f_, *log_y_, *unused_, *score_, *slope_;
  std::vector<Channel> channel_;
  std::vector<std::pair<std::size_t, std::size_t>>
      mirrored_;  ///< entries, and those across the diagonal
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

void add(std::span<const double> from, std::vector<double>& to) {
  to.resize(from.size());
  for (std::size_t i = 0; i < from.size(); ++i) to[i] += from[i];
}

template <class F>
Assessment assess_in(const Sampling& s,
                     const BoundModel& b,
                     const FreeSlots& free,
                     double huber,
                     bool by_incident_angle,
                     const Influences* influences,
                     std::size_t most) {
  const std::size_t n = free.size();
  std::optional<IncidentKeys> keys;
  if (by_incident_angle) keys.emplace(s);
  const Tasks tasks(s, most, BlockReader<F>::block);
  std::vector<Part> parts(tasks.count);
  tbb::enumerable_thread_specific<Walk<F>> walks(
      [&] { return Walk<F>(s, b, free, huber, keys ? &*keys : nullptr, influences); });
  tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t k) {
    BlockReader<F> in(s, tasks.first(k), tasks.last(k), tasks.step);
    parts[k] = walks.local().run(in);
  });
  Assessment a;
  const std::size_t entries = free.layout()->entries();
  a.sandwich.bread = a.sandwich.meat = ArrowMatrix(free.layout());
  const std::size_t angles = keys ? keys->count() : 0;
  std::vector<std::vector<double>> scores(angles), breads(angles);
  std::vector<bool> seen(angles);
  std::vector<std::vector<double>> fourth_by_arm, moves_by_arm;
  BandSums sums = no_sums();
  for (const auto& p : parts) {  // in the order of the samples
    a.sandwich.bread += p.bread;
    a.sandwich.meat += p.meat;
    for (std::size_t k = 0; k < p.keys.size(); ++k) {
      add(std::span(p.scores).subspan(k * n, n), scores[p.keys[k]]);
      add(std::span(p.breads).subspan(k * entries, entries), breads[p.keys[k]]);
      seen[p.keys[k]] = true;
    }
    add(p.fourth, a.sandwich.fourth);
    add(p.alone, a.sandwich.alone);
    add(p.moves, a.sandwich.moves);
    fourth_by_arm.resize(p.fourth_by_arm.size());
    moves_by_arm.resize(p.moves_by_arm.size());
    for (std::size_t k = 0; k < fourth_by_arm.size(); ++k) {
      add(p.fourth_by_arm[k], fourth_by_arm[k]);
      add(p.moves_by_arm[k], moves_by_arm[k]);
    }
    for (std::size_t k = 0; k < sums.size(); ++k)
      for (std::size_t i = 0; i < sums[k].size(); ++i) sums[k][i].add(p.sums[k][i]);
    a.counts.add(p.counts);
  }
  a.incident_angles = static_cast<std::size_t>(std::ranges::count(seen, true));
  for (std::size_t k = 0; k < scores.size(); ++k)
    if (seen[k])
      a.sandwich.clusters.push_back(
          {ArrowMatrix(free.layout(), std::move(breads[k])), std::move(scores[k])});
  if (influences && !by_incident_angle) {
    influences->add_others(fourth_by_arm, a.sandwich.fourth);
    influences->add_others(moves_by_arm, a.sandwich.moves);
  }
  a.residuals = statistics(sums);
  return a;
}

}  // namespace

Assessment assess(const Sampling& s,
                  const BoundModel& b,
                  const FreeSlots& free,
                  double huber,
                  bool by_incident_angle,
                  const Influences* influences,
                  bool in_float,
                  std::size_t most) {
  return in_float ? assess_in<float>(s, b, free, huber, by_incident_angle, influences, most)
                  : assess_in<double>(s, b, free, huber, by_incident_angle, influences, most);
}

FitResiduals residual_statistics(const BoundModel& b, const Sampling& s, std::size_t most) {
  const FreeSlots nothing(std::vector<bool>(b.model.value_count, false));
  return assess(s, b, nothing, no_huber, false, nullptr, false, most).residuals;
}

}  // namespace gonio
