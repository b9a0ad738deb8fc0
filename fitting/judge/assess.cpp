#include "fitting/judge/assess.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

#include "brdf/model/derivatives.h"
#include "fitting/judge/arrow_inverse.h"
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
    constexpr std::size_t many = 360;
    if (count_ <= many) return;
    std::map<long, std::uint32_t> degrees;
    for (std::size_t i = 0; i < rank_.size(); ++i) {
      const long degree = std::lround(s.table().list()->theta_i_deg[i]);
      rank_[i] =
          degrees.try_emplace(degree, static_cast<std::uint32_t>(degrees.size())).first->second;
    }
    count_ = degrees.size();
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
       bool by_incident_angle,
       const IncidentKeys& keys,
       const Influences* influences)
      : sampling_(s),
        free_(free),
        huber_(static_cast<F>(std::min(huber, double{std::numeric_limits<F>::max()}))),
        by_angle_(by_incident_angle),
        keys_(keys),
        influences_(by_incident_angle ? nullptr : influences),
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
      for (const std::size_t i : x.free)
        for (const std::size_t j : x.free) x.entry.push_back(free.layout()->at(i, j));
      if (!influences_) continue;
      x.influence = influences_->channel(x.free);
      for (const std::size_t i : x.free)
        if (free.layout()->arm(i) != ArrowLayout::none) x.arm = free.layout()->arm(i);
      if (x.influence.unknown.size() > beta_.size()) beta_.resize(x.influence.unknown.size());
    }
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
    std::vector<std::size_t> entry;  ///< [derivative][derivative] of the matrices
    Influences::Channel influence;
    std::size_t arm = ArrowLayout::none;
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
        const std::size_t key = keys_(in.sample(m)[i], static_cast<double>(in.nol(m)[i]), last);
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

  /// Σ score j and Σ slope² j jᵀ over each run.
  /// \tparam K  how many columns j has
  template <std::size_t K>
  void add_scores(const std::vector<Run>& runs, const Channel& x) {
    for (const auto& run : runs) {
      std::array<double, K> sum{};
      std::array<std::array<double, K>, K> products{};
      // A few at a time in F, whose digits hold these.
      constexpr std::size_t few = 16;
      for (std::size_t from = run.begin; from < run.end; from += few) {
        std::array<F, K> sum_of_few{};
        std::array<std::array<F, K>, K> products_of_few{};
        for (std::size_t i = from; i < std::min(run.end, from + few); ++i) {
          if (score_[i] == 0 && slope_[i] == 0) continue;  // masked: its derivatives may be NaN
          for (std::size_t p = 0; p < K; ++p) {
            sum_of_few[p] += score_[i] * x.j[p][i];
            const F j = slope_[i] * slope_[i] * x.j[p][i];
            for (std::size_t q = p; q < K; ++q) products_of_few[p][q] += j * x.j[q][i];
          }
        }
        for (std::size_t p = 0; p < K; ++p) {
          sum[p] += static_cast<double>(sum_of_few[p]);
          for (std::size_t q = p; q < K; ++q)
            products[p][q] += static_cast<double>(products_of_few[p][q]);
        }
      }
      double* const score = part_.scores.data() + run.to * free_.size();
      double* const bread = part_.breads.data() + run.to * free_.layout()->entries();
      for (std::size_t p = 0; p < K; ++p) score[x.free[p]] += sum[p];
      for (std::size_t p = 0; p < K; ++p)
        for (std::size_t q = 0; q < K; ++q)
          bread[x.entry[p * K + q]] += products[std::min(p, q)][std::max(p, q)];
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
    if (influences_) divide_by_leverage(in.padded(), x);
    if (!by_angle_) {
      kernels_.gram[k + 1](in.padded(), score_, score_, x.j.data(), meat_[c].lanes());
      return;
    }
    static constexpr auto add = add_scores_of(std::make_index_sequence<max_columns + 1>());
    (this->*add[k])(runs_[m], x);
  }

  /// Sums of fourth powers, and each score over 1 − h.  A value that alone determines something has
  /// residual 0 whatever its error is: its score says nothing.
  /// \param n  with the padding, where scores are 0
  void divide_by_leverage(std::size_t n, const Channel& x) {
    const auto& at = x.influence;
    for (std::size_t k = 0; k < x.free.size(); ++k)
      for (std::size_t i = 0; i < n; ++i)  // derivatives of masked values may be NaN
        seen_[k][i] = score_[i] == 0 && slope_[i] == 0 ? F(0) : x.j[k][i];
    for (std::size_t r = 0; r < at.unknown.size(); ++r) {
      auto& beta = beta_[r];  // less the slope
      beta.fill(F(0));
      for (std::size_t k = 0; k < x.free.size(); ++k) {
        const auto factor = static_cast<F>(at.beta[r][k]);
        if (factor == 0) continue;
        for (std::size_t i = 0; i < n; ++i) beta[i] += factor * seen_[k][i];
      }
    }
    std::array<F, size> leverage{};
    for (std::size_t k = 0; k < x.free.size(); ++k) {
      if (at.row[k] == Influences::none) continue;
      const auto factor = static_cast<F>(at.leverage[k]);
      const auto& beta = beta_[at.row[k]];
      for (std::size_t i = 0; i < n; ++i)
        leverage[i] += factor * slope_[i] * slope_[i] * seen_[k][i] * beta[i];
    }
    constexpr F all = F(1) - F(1e-6);
    std::int32_t lone = 0;
    for (std::size_t i = 0; i < n; ++i) lone += leverage[i] < all ? 0 : 1;
    if (lone > 0) leave_out_lone(n, leverage, at);
    for (std::size_t i = 0; i < n; ++i) score_[i] /= F(1) - leverage[i];
    for (std::size_t r = 0; r < at.unknown.size(); ++r) {
      const std::size_t unknown = at.unknown[r], head = free_.layout()->within(unknown);
      const bool of_head =
          x.arm != ArrowLayout::none && free_.layout()->arm(unknown) == ArrowLayout::none;
      const auto add = [&](const F* factor, std::vector<double>& to,
                           std::vector<std::vector<double>>& by_arm) {
        const double sum = fourth_powers(n, factor, beta_[r].data());
        to[unknown] += sum;
        if (of_head) by_arm[x.arm][head] += sum;
      };
      add(slope_, part_.fourth, part_.fourth_by_arm);
      add(score_, part_.moves, part_.moves_by_arm);
    }
  }
  void leave_out_lone(std::size_t n, std::array<F, size>& leverage, const Influences::Channel& at) {
    constexpr F all = F(1) - F(1e-6);
    for (std::size_t i = 0; i < n; ++i) {
      if (leverage[i] < all) continue;
      score_[i] = leverage[i] = 0;
      for (std::size_t r = 0; r < at.unknown.size(); ++r) {
        const double beta = static_cast<double>(slope_[i]) * static_cast<double>(beta_[r][i]);
        part_.alone[at.unknown[r]] += beta * beta;
      }
    }
  }
  /// Σ (a b)⁴ in lanes, which vector instructions add up side by side.
  /// \param n  a multiple of the lanes
  static double fourth_powers(std::size_t n, const F* a, const F* b) {
    static_assert(size % padding == 0);
    double sum = 0;
    constexpr std::size_t few = 8 * padding;  // whose sum F holds
    for (std::size_t from = 0; from < n; from += few) {
      std::array<F, padding> lanes{};
      for (std::size_t i = from; i < std::min(n, from + few); i += padding)
        for (std::size_t l = 0; l < padding; ++l) {
          const F move = a[i + l] * b[i + l], square = move * move;
          lanes[l] += square * square;
        }
      for (const F lane : lanes) sum += static_cast<double>(lane);
    }
    return sum;
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
  const Influences* influences_;
  std::vector<std::array<F, size>> beta_;              ///< [row]
  std::array<std::array<F, size>, max_columns> seen_;  ///< derivatives, 0 where masked
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
  const IncidentKeys keys(s);
  const Tasks tasks(s, most, BlockReader<F>::block);
  std::vector<Part> parts(tasks.count);
  tbb::enumerable_thread_specific<Walk<F>> walks(
      [&] { return Walk<F>(s, b, free, huber, by_incident_angle, keys, influences); });
  tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t k) {
    BlockReader<F> in(s, tasks.first(k), tasks.last(k), tasks.step);
    parts[k] = walks.local().run(in);
  });
  Assessment a;
  const std::size_t entries = free.layout()->entries();
  a.sandwich.bread = a.sandwich.meat = ArrowMatrix(free.layout());
  std::vector<std::vector<double>> scores(keys.count()), breads(keys.count());
  std::vector<bool> seen(keys.count());
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

// ---- influences ---------------------------------------------------------------------------------

Influences::Influences(const ArrowMatrix& bread, const std::vector<std::size_t>& determined)
    : layout_(bread.shared_layout()), place_(bread.size(), none) {
  const auto layout = std::make_shared<const ArrowLayout>(layout_->part(determined));
  inverse_ = std::make_shared<const ArrowInverse>(bread.part(layout, determined));
  for (std::size_t k = 0; k < determined.size(); ++k) {
    place_[determined[k]] = k;
    error_.push_back(std::sqrt((*inverse_)(k, k)));
  }
}

Influences::Channel Influences::channel(const std::vector<std::size_t>& free) const {
  Channel c;
  std::vector<std::size_t> moved = layout_->head();
  for (const std::size_t i : free)
    if (layout_->arm(i) != ArrowLayout::none) moved.push_back(i);
  c.row.assign(free.size(), none);
  c.leverage.assign(free.size(), 0);
  for (const std::size_t i : moved) {
    const std::size_t a = place_[i];
    if (a == none) continue;
    auto& beta = c.beta.emplace_back();
    for (std::size_t k = 0; k < free.size(); ++k) {
      const std::size_t b = place_[free[k]];
      beta.push_back(b == none ? 0 : (*inverse_)(a, b) / error_[a]);
      if (free[k] != i) continue;
      c.row[k] = c.unknown.size();
      c.leverage[k] = error_[a];
    }
    c.unknown.push_back(i);
  }
  return c;
}

void Influences::add_others(const std::vector<std::vector<double>>& by_arm,
                            std::vector<double>& fourth) const {
  const auto& head = layout_->head();
  const auto all = fourth;
  for (std::size_t a = 0; a < by_arm.size(); ++a)
    for (const std::size_t i : layout_->arms()[a]) {
      if (place_[i] == none) continue;
      double root = 0;
      std::size_t column = 0;  // of the determined ones in the head
      for (std::size_t h = 0; h < head.size(); ++h) {
        const std::size_t place = place_[head[h]];
        if (place == none) continue;
        const double share =
            std::abs(inverse_->along(place_[i], column++)) * error_[place] / error_[place_[i]];
        root += share * std::pow(std::max(all[head[h]] - by_arm[a][h], 0.0), 0.25);
      }
      fourth[i] += std::pow(root, 4);
    }
}

// ---- assessment ---------------------------------------------------------------------------------

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
