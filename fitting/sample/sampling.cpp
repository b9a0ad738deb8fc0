#include "fitting/sample/sampling.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <mutex>
#include <numeric>

#include "base/error.h"
#include "table/health/health.h"

#include <fmt/format.h>

namespace gonio {

// ---- groups -------------------------------------------------------------------------------------

Groups::Folding::Folding(const std::vector<std::vector<Part>>& parts) : size_(parts.size()) {
  for (const auto& p : parts) widest_ = std::max(widest_, p.size());
  for (const auto& p : parts) {
    count_.push_back(p.size());
    parts_.insert(parts_.end(), p.begin(), p.end());
    parts_.resize(parts_.size() + widest_ - p.size());
  }
  lines_.clear();
  for (std::size_t k = 0; k < widest_; ++k) {
    const auto place = [&](std::size_t group) {
      return static_cast<std::ptrdiff_t>(part(group, k).at);
    };
    Line line{size_ > 1 ? place(1) - place(0) : 1, part(0, k).swapped};
    for (std::size_t g = 0; g < size_; ++g) {
      const Part here = part(g, k);
      if (here.at == absent || here.swapped != line.swapped ||
          (g > 0 && place(g) - place(g - 1) != line.step))
        line.step = 0;
    }
    lines_.push_back(line);
  }
}

Groups::Groups(const Table& t, const SampleAngles& at, Bins bins, bool fold)
    : rows_(t.size() / at.row_size()), columns_(at.row_size()) {
  const Grid* g = t.grid();
  if (!fold || !g) return;
  std::vector<std::vector<Part>> groups;
  if (g->kind == Grid::Kind::in_out) {
    const Axis &in = g->axes[0], &out = g->axes[1];
    if (in.spacing != out.spacing || in.size != out.size || in.span != out.span) return;
    for (std::size_t a = 0; a < in.size; ++a)
      for (std::size_t b = a; b < in.size; ++b) {
        auto& parts = groups.emplace_back();
        parts.push_back({a * in.size + b, false});
        if (a != b) parts.push_back({b * in.size + a, true});
      }
    rows_ = Folding(groups);
    return;
  }
  // wi and wo change places with the sign of cos φ_d; nothing else depends on φ_d.
  std::vector<double> cosine;
  for (std::size_t k = 0; k < columns_.size(); ++k) {
    cosine.push_back(std::cos(g->axes[2].angle(static_cast<double>(k), bins)));
    const auto same = [&](const std::vector<Part>& parts) {
      return parts.size() < most &&
             std::abs(std::abs(cosine[parts[0].at]) - std::abs(cosine[k])) < 1e-12;
    };
    auto found = std::ranges::find_if(groups, same);
    if (found == groups.end()) found = groups.emplace(found);
    found->push_back({k, !found->empty() && cosine[(*found)[0].at] * cosine[k] < 0});
  }
  columns_ = Folding(groups);
}

// ---- sampling -----------------------------------------------------------------------------------

std::shared_ptr<const ApertureAngles> aperture_angles(const Table& t, Bins bins, bool frame) {
  if (!t.aperture) return nullptr;
  constexpr std::size_t most = std::size_t{1} << 16;
  if (t.size() > most)
    throw bad_input(t.path, "aperture", fmt::format("{} samples", t.size()),
                    fmt::format("at most {} of a table that is averaged over cones", most));
  const SampleAngles at(t, bins);
  struct Made {
    Aperture aperture;
    bool frame = false;
    std::vector<double> directions;
    std::shared_ptr<const ApertureAngles> angles;
  };
  Made asked{t.aperture, frame, {}, nullptr};
  for (std::size_t i = 0; i < t.size(); ++i) {
    const DirectionPair p = at.directions(i);
    asked.directions.insert(asked.directions.end(),
                            {p.wi.x, p.wi.y, p.wi.z, p.wo.x, p.wo.y, p.wo.z});
  }
  static std::mutex mutex;
  static std::array<Made, 2> kept;
  {
    const std::lock_guard lock(mutex);
    for (const Made& k : kept)
      if (k.angles && k.aperture == asked.aperture && k.frame == frame &&
          k.directions == asked.directions)
        return k.angles;
  }
  // Not under the lock: a thread that waits for its parts may take up another fit.
  asked.angles = std::make_shared<const ApertureAngles>(
      t.size(), [&](std::size_t i) { return at.directions(i); }, t.aperture, frame);
  const std::lock_guard lock(mutex);
  std::swap(kept[0], kept[1]);
  kept[0] = asked;
  return asked.angles;
}

// Light and viewer exchanged are other cones: under an aperture nothing is folded.
Sampling::Sampling(
    const Table& t, Bins bins, Metric metric, double offset, bool fold, bool copies, bool frame)
    : table_(t),
      way_{bins, metric, has_offset(metric) ? offset : 0, fold && !t.aperture, copies, frame},
      angles_(t, bins),
      groups_(t, angles_, bins, way_.fold),
      aperture_(aperture_angles(t, bins, frame)),
      copied_(copies ? std::vector<bool>{} : copied_pairs(t)) {
  assert(!(frame && t.grid()));
  if (t.weights.empty()) return;
  double sum = 0, samples = 0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    if (!(t.weights[i] > 0)) continue;
    const auto a = angles_(i);
    if (std::ranges::any_of(t.values,
                            [&](const auto& v) { return mask(a, v[i]) == Mask::valid; })) {
      sum += t.weights[i];
      ++samples;
    }
  }
  if (!std::isfinite(sum))
    throw bad_input(t.path, "weights", "a sum that is not finite", "weights of a usual size");
  constexpr double most = 1e9;
  is_counted_ = std::ranges::all_of(
      t.weights, [](double w) { return w >= 0 && w <= most && w == std::floor(w); });
  if (samples > 0 && !is_counted_) mean_weight_ = sum / samples;
}

Sampling Sampling::by(Metric metric, double offset) const {
  Sampling s = *this;
  s.bulk_.reset();
  s.way_.metric = metric;
  s.way_.offset = has_offset(metric) ? offset : 0;
  return s;
}

Sampling Sampling::without(std::vector<bool> which) const {
  assert(which.size() == table_.size() && !left_out_);
  Sampling s = *this;
  s.left_out_ = std::make_shared<const std::vector<bool>>(std::move(which));
  return s;
}

bool Sampling::reads_like(const Sampling& o) const {
  return &table_ == &o.table_ && way_ == o.way_ && bulk_ == o.bulk_ && left_out_ == o.left_out_;
}

double Sampling::root_weight(std::size_t i) const {
  if (left_out_ && (*left_out_)[i]) return 0;
  return table_.weights.empty() ? 1 : std::sqrt(table_.weights[i] / mean_weight_);
}

void SampleCounts::add(const SampleCounts& o) {
  used += o.used;
  samples += o.samples;
  zero += o.zero;
  zero_weight += o.zero_weight;
  copied += o.copied;
  for (std::size_t m = 0; m < masked.size(); ++m) masked[m] += o.masked[m];
}

std::map<std::string, std::size_t> SampleCounts::by_reason(const Sampling& s) const {
  std::map<std::string, std::size_t> reasons;
  for (std::size_t m = 1; m < names_of<Mask>.size(); ++m)
    reasons[std::string(names_of<Mask>[m])] = masked[m];
  if (!usable(s.metric(), 0, s.offset())) reasons["zero"] = zero;
  if (s.has_weights()) reasons["zero_weight"] = zero_weight;
  if (s.has_copies()) reasons["copied"] = copied;
  return reasons;
}

std::size_t Tasks::step_to(std::size_t all, std::size_t most) {
  std::size_t step = std::max<std::size_t>(all / std::max<std::size_t>(most, 1), 1);
  // Without a common divisor: else it would visit the same columns of every row of a grid.
  while (step > 1 && std::gcd(step, all) > 1) ++step;
  return step;
}

Tasks::Tasks(const Sampling& s, std::size_t most, std::size_t block)
    : step(step_to(s.groups().size(), most)), all_(s.groups().size()) {
  size_ = blocks * block * step;
  count = (all_ + size_ - 1) / size_;
}

// ---- blocks -------------------------------------------------------------------------------------

template <class F>
BlockReader<F>::BlockReader(const Sampling& s,
                            std::size_t first,
                            std::size_t last,
                            std::size_t step)
    : sampling_(s),
      row_(first / s.groups().columns().size()),
      column_(first % s.groups().columns().size()),
      left_(first < last ? (last - first + step - 1) / step : 0),
      step_(step),
      values_(s.groups().widest() * s.channels()),
      stored_(Column<F>::for_overwrite(block)),
      weight_(block, F(1)),
      ones_(block, F(1)) {
  for (std::size_t m = 0; m < s.groups().widest(); ++m)
    nol_.push_back(Column<F>::for_overwrite(block));
  for (std::size_t k = 0; k < s.angle_columns(); ++k)
    angles_.push_back(Column<F>::for_overwrite(block));
  if (const BoundModel* bulk = s.metric() == Metric::relative ? s.bulk() : nullptr) {
    nothing_free_.assign(bulk->model.value_count, false);
    bulk_ = std::make_unique<ModelDerivatives<F>>(bulk->model, nothing_free_, kernels<F>(), nullptr,
                                                  s.aperture() != nullptr);
    bulk_->set(std::vector<F>(bulk->values.begin(), bulk->values.end()));
  }
  for (auto& v : values_)
    v = {Column<F>::for_overwrite(block), Column<F>::for_overwrite(block),
         Column<F>::for_overwrite(block)};
}

template <class F>
SampleBlock<F> BlockReader<F>::angles() const {
  SampleBlock<F> b{{angles_[0].data(), angles_[1].data(), angles_[2].data(), angles_[3].data(),
                    angles_[4].data(), padded()},
                   means_ ? &means_->block() : nullptr};
  for (std::size_t k = 5; k < angles_.size(); ++k) b.frame[k - 5] = angles_[k].data();
  return b;
}

template <class F>
bool BlockReader<F>::next() {
  place();
  if (n_ == 0) return false;
  for (std::size_t i = n_; i < padded(); ++i) {
    for (auto& a : angles_) a[i] = F(0.5);
    for (auto& x : nol_) x[i] = F(0.5);
  }
  if (sampling_.aperture())
    means_ = std::make_shared<const MeanColumns<F>>(*sampling_.aperture(), there(), padded(),
                                                    sampling_.has_frame());
  for (std::size_t m = 0; m < sampling_.groups().widest(); ++m)
    for (std::size_t c = 0; c < sampling_.channels(); ++c) fill(m, c);
  if (bulk_) limit_weights();
  return true;
}

template <class F>
std::vector<std::size_t> BlockReader<F>::there() const {
  std::vector<std::size_t> all(sample_[0].begin(),
                               sample_[0].begin() + static_cast<std::ptrdiff_t>(n_));
  std::ranges::replace(all, absent, std::size_t{0});
  return all;
}

template <class F>
void BlockReader<F>::limit_weights() {
  const auto offset = static_cast<F>(sampling_.offset());
  bulk_->run(angles(), [&](std::size_t c) {
    const F* const bulk = bulk_->channel(c).value;
    for (std::size_t m = 0; m < sampling_.groups().widest(); ++m) {
      auto& v = values_[m * sampling_.channels() + c];
      for (std::size_t i = 0; i < n_; ++i) {
        const F part = 2 * (v.target[i] + offset) / (bulk[i] + offset);
        if (part < 1) v.weight[i] *= part;
      }
    }
  });
}

/// The angles and samples of the next groups.
template <class F>
void BlockReader<F>::place() {
  const auto &rows = sampling_.groups().rows(), &columns = sampling_.groups().columns();
  absent_.fill(0);
  for (auto& r : runs_) r.clear();
  n_ = 0;
  while (n_ < block && left_ > 0) {
    const std::size_t row = row_, from = n_;
    const auto at = sampling_.angles().row(rows.part(row, 0).at);
    if (at.is_level())
      place_level(at);
    else
      place_any(at);
    place_members(row, from);
    for (; column_ >= columns.size(); column_ -= columns.size()) ++row_;
  }
}

/// Samples left of a row, as many as go into the block.
template <class F>
void BlockReader<F>::place_any(const SampleAngles::Row& at) {
  const auto& columns = sampling_.groups().columns();
  for (; column_ < columns.size() && n_ < block && left_ > 0; column_ += step_, --left_) {
    const std::size_t column = columns.part(column_, 0).at;
    const FrameAngles<double> a = sampling_.has_frame()
                                      ? sampling_.angles().frame(at.first() + column)
                                      : FrameAngles<double>{at(column), 0, 0, 0, 0, 0, 0};
    if (!(a.nol > horizon_cosine && a.nov > horizon_cosine)) {
      mask_below_horizon(column_);
      continue;
    }
    const auto put = [&](std::size_t first, std::initializer_list<double> cosines) {
      for (const double c : cosines) angles_[first++][n_] = static_cast<F>(c);
    };
    put(0, {a.nol, a.nov, a.noh, a.voh, a.sin2_theta_h});
    if (sampling_.has_frame()) put(5, {a.xoh, a.yoh, a.xol, a.yol, a.xov, a.yov});
    group_column_[n_++] = column_;
  }
}

/// Samples of a row in which only nol and nov differ: several at once.
template <class F>
void BlockReader<F>::place_level(const SampleAngles::Row& at) {
  const auto& columns = sampling_.groups().columns();
  const double middle = at.middle(), swing = at.swing();
  const std::size_t from = n_, first = column_;
  const std::size_t count =
      std::min({block - n_, left_, (columns.size() - column_ + step_ - 1) / step_});
  if (cosine_.empty())
    for (std::size_t g = 0; g < columns.size(); ++g)
      cosine_.push_back(at.cos_phi_d(columns.part(g, 0).at));
  std::array<double, block> swings;
  for (std::size_t k = 0; k < count; ++k) swings[k] = swing * cosine_[first + k * step_];
  F *const nol = angles_[0].data(), *const nov = angles_[1].data();
  double lowest = 1;
  for (std::size_t k = 0; k < count; ++k) {
    const double a = middle - swings[k], b = middle + swings[k];
    nol[from + k] = static_cast<F>(a);
    nov[from + k] = static_cast<F>(b);
    const double lower = a < b ? a : b;
    lowest = lower < lowest ? lower : lowest;
  }
  const bool all = lowest > horizon_cosine;
  if (all) {
    for (std::size_t k = 0; k < count; ++k) group_column_[from + k] = first + k * step_;
    n_ += count;
  }
  for (std::size_t k = 0; !all && k < count; ++k) {
    if (!(middle - swings[k] > horizon_cosine && middle + swings[k] > horizon_cosine)) {
      mask_below_horizon(first + k * step_);
      continue;
    }
    nol[n_] = nol[from + k];
    nov[n_] = nov[from + k];
    group_column_[n_++] = first + k * step_;
  }
  column_ += count * step_;
  left_ -= count;
  const auto a = at(0);
  const std::array constant{a.noh, a.voh, a.sin2_theta_h};
  for (std::size_t k = 0; k < constant.size(); ++k)
    std::fill(angles_[2 + k].data() + from, angles_[2 + k].data() + n_,
              static_cast<F>(constant[k]));
}

/// Counts the members of the row's group in that column.
template <class F>
void BlockReader<F>::mask_below_horizon(std::size_t column) {
  const auto& g = sampling_.groups();
  counts_.masked[static_cast<std::size_t>(Mask::below_horizon)] +=
      g.rows().parts(row_) * g.columns().parts(column) * sampling_.channels();
}

/// The samples of the groups of one row, from number `from` on.
template <class F>
void BlockReader<F>::place_members(std::size_t row, std::size_t from) {
  if (n_ == from) return;
  const auto &rows = sampling_.groups().rows(), &columns = sampling_.groups().columns();
  const std::size_t width = sampling_.angles().row_size(), first = group_column_[from];
  const bool without_gap = group_column_[n_ - 1] - first == n_ - 1 - from;
  for (std::size_t m = 0; m < sampling_.groups().widest(); ++m) {
    const auto r = rows.part(row, m / columns.widest());
    const bool copy = r.at != absent && sampling_.is_copy(r.at);
    const bool row_there = r.at != absent && !copy;
    const std::size_t of_column = m % columns.widest();
    const auto& line = columns.line(of_column);
    const F *const as_is = angles_[r.swapped].data(), *const exchanged = angles_[!r.swapped].data();
    F* const nol = nol_[m].data();
    std::size_t* const sample = sample_[m].data();
    const std::ptrdiff_t step = without_gap && row_there ? line.step : 0;
    if (step != 0) {
      std::copy_n((line.swapped ? exchanged : as_is) + from, n_ - from, nol + from);
      const auto begin =
          static_cast<std::ptrdiff_t>(r.at * width + columns.part(first, of_column).at);
      for (std::size_t i = from; i < n_; ++i)
        sample[i] = static_cast<std::size_t>(begin + step * static_cast<std::ptrdiff_t>(i - from));
    } else {
      for (std::size_t i = from; i < n_; ++i) {
        const auto c = columns.part(group_column_[i], of_column);
        const bool there = row_there && c.at != absent;
        counts_.copied += copy && c.at != absent ? sampling_.channels() : 0;
        nol[i] = there ? (c.swapped ? exchanged : as_is)[i] : F(0.5);
        sample[i] = there ? r.at * width + c.at : absent;
        absent_[m] += !there;
      }
    }
    auto& runs = runs_[m];
    const bool goes_on =
        !runs.empty() && runs.back().step == step &&
        (step == 0 || sample[from] == sample[from - 1] + static_cast<std::size_t>(step));
    if (goes_on)
      runs.back().to = n_;
    else
      runs.push_back({from, n_, step});
  }
}

/// One member's values in one channel as they are stored; −1 where there is no such member.
template <class F>
void BlockReader<F>::gather(std::size_t member, const double* stored) {
  const std::size_t* const sample = sample_[member].data();
  F* const out = stored_.data();
  for (const auto& [from, to, step] : runs_[member]) {
    // Neighbours that a compiler can see as such: several at once.
    const std::size_t n = to - from;
    if (step == 1) {
      const double* const first = stored + sample[from];
      for (std::size_t i = 0; i < n; ++i) out[from + i] = static_cast<F>(first[i]);
    } else if (step == -1) {
      const double* const last = stored + sample[to - 1];
      for (std::size_t i = 0; i < n; ++i) out[from + i] = static_cast<F>(last[n - 1 - i]);
    } else {
      for (std::size_t i = from; i < to; ++i)
        out[i] = sample[i] == absent ? F(-1) : static_cast<F>(stored[sample[i]]);
    }
  }
}

/// One member's values in one channel.
template <class F>
void BlockReader<F>::fill(std::size_t member, std::size_t channel) {
  const Metric metric = sampling_.metric();
  const auto& sample = sample_[member];
  auto& v = values_[member * sampling_.channels() + channel];
  gather(member, sampling_.table().values[channel].data());
  if (sampling_.has_weights() && channel == 0)
    for (std::size_t i = 0; i < n_; ++i)
      weight_[i] = sample[i] == absent ? F(1) : static_cast<F>(sampling_.root_weight(sample[i]));
  for (std::size_t i = n_; i < padded(); ++i) stored_[i] = F(-1);

  TargetCounts c;
  const bool cosine = metric == Metric::l2_cosine;
  kernels<F>().target[static_cast<std::size_t>(link_of(metric))](
      padded(),
      {stored_.data(), weight_.data(), cosine ? nol_[member].data() : ones_.data(),
       static_cast<F>(sampling_.offset()), metric == Metric::relative, has_offset(metric),
       v.y.data(), v.target.data(), v.weight.data()},
      c);
  if (sampling_.in_uncertainties()) {
    const auto& u = sampling_.table().errors[channel];
    for (std::size_t i = 0; i < n_; ++i)
      if (v.weight[i] > 0) {
        const double scale =
            metric == Metric::log ? static_cast<double>(v.y[i]) + sampling_.offset() : 1;
        v.weight[i] = static_cast<F>(static_cast<double>(weight_[i]) * scale / u[sample[i]]);
      }
  }
  counts_.masked[static_cast<std::size_t>(Mask::not_finite)] += c.not_finite;
  counts_.masked[static_cast<std::size_t>(Mask::negative)] +=
      c.negative - absent_[member] - (padded() - n_);
  counts_.masked[static_cast<std::size_t>(Mask::valid)] += c.valid;
  counts_.zero += c.zero;
  counts_.zero_weight += c.zero_weight;
  const std::size_t used = c.valid - c.zero - c.zero_weight;
  counts_.used += used;
  if (!sampling_.is_counted()) {
    counts_.samples += static_cast<double>(used);
    return;
  }
  for (std::size_t i = 0; i < n_; ++i)
    if (v.weight[i] > 0) counts_.samples += sampling_.count_of(sample[i]);
}

template class BlockReader<float>;
template class BlockReader<double>;

}  // namespace gonio
