#include "fitting/map/texels.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include "base/error.h"
#include "fitting/judge/uncertainty.h"
#include "fitting/map/register.h"
#include "fitting/solve/order.h"
#include "number/distributions.h"

#include <fmt/format.h>

namespace gonio {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
/// Steps from each of several starts, after which the lowest goes on; and of all.
constexpr int steps_of_each = 8, most_steps = 150;
/// Starts from which a texel descends: the lowest of those that may lie in valleys of their own.
constexpr std::size_t starts_kept = 2;

constexpr double normal_quantile = 1.959963984540054;  // of 0.975

/// Texel on its way, waiting for a register full of its kind.
struct Waiting {
  std::size_t texel;
  std::vector<float> state;  ///< its lane of the register's
  int steps;
};

/// The starts at which each lane's cost is lowest, best first.
class LowestStarts {
 public:
  explicit LowestStarts(std::size_t most) : most_(most) {}
  /// \param x  [unknown][padding]   \param cost  [padding]
  void add(const std::vector<float>& x, const float* cost) {
    if (x_.size() < most_) {
      x_.push_back(x);
      cost_.emplace_back().fill(std::numeric_limits<float>::infinity());
    }
    for (std::size_t l = 0; l < padding; ++l) {
      std::size_t at = 0;
      while (at < cost_.size() && !(cost[l] < cost_[at][l])) ++at;
      if (at == cost_.size()) continue;
      for (std::size_t k = cost_.size() - 1; k > at; --k) put(k, l, x_[k - 1], cost_[k - 1][l]);
      put(at, l, x, cost[l]);
    }
  }
  std::vector<std::vector<float>>& starts() { return x_; }
  /// False of lanes whose second start is so far above where the first led to that its valley cannot be deeper: where that
  /// led into the wrong one of a dull lobe's two, without noise, the other's start was at most 1.8 times as far off, by its RMS.
  std::array<bool, padding> second_may_be_deeper(const float* cost) const {
    constexpr float far = 8;
    std::array<bool, padding> may{};
    for (std::size_t l = 0; l < padding; ++l) may[l] = cost_[1][l] < far * cost[l];
    return may;
  }

 private:
  void put(std::size_t k, std::size_t lane, const std::vector<float>& x, float cost) {
    for (std::size_t i = lane; i < x.size(); i += padding) x_[k][i] = x[i];
    cost_[k][lane] = cost;
  }
  std::size_t most_;
  std::vector<std::vector<float>> x_;
  std::vector<std::array<float, padding>> cost_;
};

/// True where the camera stays where it is, as far as the first texel sees.
bool has_one_view(const TexelSamples& in) {
  const float least = std::cos(10 * std::numbers::pi_v<float> / 180);
  const std::size_t stride = in.shared ? 1 : in.texels;
  const auto view = [&](std::size_t image, std::size_t axis) {
    return in.view[(3 * image + axis) * stride];
  };
  for (std::size_t i = 1; i < in.images; ++i)
    if (!(view(i, 0) * view(0, 0) + view(i, 1) * view(0, 1) + view(i, 2) * view(0, 2) > least))
      return false;
  return in.images > 0;
}

/// Fits texels, a register full at a time.
class LaneFit {
 public:
  LaneFit(const TexelTask&, const TexelSamples&, std::string_view instruction_set, TexelFit& out);

  void fit_all();

 private:
  void find_start(std::span<const TexelTask::Start> starts);
  std::vector<float> start_of(std::span<const TexelTask::Start> starts);
  void add_middles(std::vector<std::vector<float>>& begins) const;
  void begin_tilted(std::span<const TexelTask::Start>, LowestStarts& begins);
  void step(int most);
  void descend(std::size_t count, bool to_the_end);
  void fit(std::span<const std::size_t> texels);
  void take_lowest(std::vector<float>& lowest, const std::array<bool, padding>& tries);
  void finish(std::span<const std::size_t> texels);
  void judge_singular(std::size_t lane);
  bool leaves_tilt_open(std::size_t lane) const;
  void put_values(const float* unknowns);
  float* row(Column<float>& c, std::size_t r) const { return c.data() + r * padding; }
  std::size_t n() const { return task_.unknowns.count; }

  const TexelTask& task_;
  const TexelSamples& in_;
  TexelFit& out_;
  const Kernels<float>& kernels_;
  const LaneKernels& lanes_;
  const std::size_t width_ = lanes_.lanes;
  TexelPasses passes_;

  TexelRegister register_;
  Column<float> tilt_;
  std::vector<bool> is_middle_;  ///< [slot]: a diffuse term's own, one for all channels
  bool has_middles_ = false;
  bool seeks_dull_;  ///< a dull lobe's valley is one of its own

  // The register on its way.
  Column<float> values_, memory_, inverse_, own_inverse_, left_out_, variance_, freedom_;
  TexelState state_{};
  std::array<int, padding> steps_{};  ///< of each lane
  std::vector<Waiting> waiting_;
};

LaneFit::LaneFit(const TexelTask& task,
                 const TexelSamples& in,
                 std::string_view instruction_set,
                 TexelFit& out)
    : task_(task),
      in_(in),
      out_(out),
      kernels_(kernels<float>(instruction_set)),
      lanes_(lane_kernels(instruction_set)),
      passes_(task, kernels_, lanes_),
      register_(task, in, kernels_, lanes_, passes_.is_fused()),
      seeks_dull_(task.has_dull_group && has_one_view(in)) {
  const std::size_t unknowns = std::max<std::size_t>(n(), 1);
  tilt_ = Column<float>(2 * padding);
  is_middle_.resize(task.model().value_count);
  for (const auto& d : task.model().diffuse)
    for (const std::size_t k : d.parameters) {
      const auto& q = task.model().parameters[k];
      const bool scalar = q.count == 1 && !task.is_shape[q.first];
      is_middle_[q.first] = scalar && !task.is_linear && task.problem.free.mask()[q.first];
      has_middles_ = has_middles_ || is_middle_[q.first];
    }

  values_ = Column<float>(task.model().value_count * padding);
  for (std::size_t s = 0; s < task.model().value_count; ++s)
    std::fill_n(row(values_, s), padding, static_cast<float>(task.problem.start.values[s]));
  const std::size_t matrix = unknowns * (unknowns + 1) / 2;
  memory_ = Column<float>((4 * matrix + 16 * unknowns + 8) * padding);
  float* next = memory_.data();
  const auto take = [&](std::size_t rows) {
    float* const at = next;
    next += rows * padding;
    return at;
  };
  state_ = {take(unknowns), take(unknowns), take(matrix),       take(unknowns), take(1), take(1),
            take(1),        take(1),        register_.signal(), take(1),        nullptr};
  state_.scratch = next;
  inverse_ = Column<float>(unknowns * unknowns * padding);
  own_inverse_ = Column<float>(max_channels * max_columns * (max_columns + 1) / 2 * padding);
  left_out_ = Column<float>(unknowns * padding);
  variance_ = Column<float>(unknowns * padding);
  freedom_ = Column<float>(unknowns * padding);
}

/// Values of the model's parameters, and angles where the unknowns move them.
void LaneFit::put_values(const float* unknowns) {
  const std::size_t slots = task_.model().value_count;
  for (std::size_t i = 0; i < n(); ++i)
    if (task_.unknowns.slot[i] < slots)
      std::copy_n(unknowns + i * padding, padding, row(values_, task_.unknowns.slot[i]));
  if (task_.turns())
    register_.turn(row(values_, task_.model().tangent()->first));
  else if (task_.asked.refine_normals)
    register_.tilt(unknowns + task_.unknown_of[slots] * padding);
}

/// The best of the shapes that are tried, all else solved for; its cost is the state's.
std::vector<float> LaneFit::start_of(std::span<const TexelTask::Start> starts) {
  find_start(starts);
  return {state_.x, state_.x + n() * padding};
}

/// Looks at starts whose normals are spread over a cone, the lane's own among them: from one far off other parameters are led astray
/// before it is found.
void LaneFit::begin_tilted(std::span<const TexelTask::Start> group, LowestStarts& begins) {
  const auto& u = task_.unknowns;
  const std::size_t first = task_.unknown_of[task_.model().value_count];
  std::vector<TexelTask::Start> some;  // of the cone: the descent finds the rest
  for (std::size_t k = 1; k < group.size(); k += 3) some.push_back(group[k]);
  if (some.empty()) some.assign(group.begin(), group.end());
  const auto look = [&](std::span<const TexelTask::Start> shapes) {
    begins.add(start_of(shapes), state_.cost);
  };
  look(group);
  Column<float> highlight(2 * padding);
  register_.find_tilts(std::span(u.low).subspan(first), std::span(u.high).subspan(first),
                       tilt_.data(), highlight.data());
  look(group);
  std::copy_n(highlight.data(), 2 * padding, tilt_.data());
  look(group);
  for (const double steep : {0.2, 0.45})
    for (int k = 0; k < 6; ++k) {
      const double turn = (k + (steep > 0.3 ? 0.5 : 0)) * std::numbers::pi / 3;
      std::fill_n(tilt_.data(), padding, static_cast<float>(steep * std::cos(turn)));
      std::fill_n(tilt_.data() + padding, padding, static_cast<float>(steep * std::sin(turn)));
      look(some);
    }
}

/// Adds the first of these starts with diffuse roughnesses that move: one of 0 does not.
void LaneFit::add_middles(std::vector<std::vector<float>>& begins) const {
  const auto& u = task_.unknowns;
  for (const float part : {0.1F, 0.2F, 0.4F}) {
    auto x = begins.front();
    for (std::size_t i = 0; i < n(); ++i)
      if (u.slot[i] < is_middle_.size() && is_middle_[u.slot[i]])
        std::fill_n(x.data() + i * padding, padding, std::lerp(u.low[i], u.high[i], part));
    begins.push_back(std::move(x));
  }
}

/// The best of the shapes that are tried, all else solved for.
void LaneFit::find_start(std::span<const TexelTask::Start> starts) {
  const auto& u = task_.unknowns;
  const float far = std::numeric_limits<float>::max();
  std::fill_n(state_.cost, padding, far);
  const auto begin = [&] {
    for (std::size_t i = 0; i < n(); ++i) {
      const std::size_t s = u.slot[i], slots = task_.problem.start.values.size();
      if (s >= slots) {
        std::copy_n(row(tilt_, s - slots), padding, state_.tried + i * padding);
        continue;
      }
      const auto x = static_cast<float>(task_.problem.start.values[s]);
      std::fill_n(state_.tried + i * padding, padding, std::clamp(x, u.low[i], u.high[i]));
    }
  };
  begin();
  std::copy_n(state_.tried, n() * padding, state_.x);
  for (const auto& start : starts) {
    begin();
    for (const auto& [slot, value] : start)
      std::fill_n(state_.tried + task_.unknown_of[slot] * padding, padding, value);
    put_values(state_.tried);
    // What is not linear is led near its best before it counts.
    std::array<float, padding> best{};
    std::copy_n(state_.cost, padding, best.begin());
    for (int round = task_.is_linear ? 2 : 0; round < 3; ++round) {
      if (round < 2)
        std::fill_n(state_.cost, padding, -far);
      else
        std::copy_n(best.begin(), padding, state_.cost);
      passes_.linear(register_.samples(), values_.data());
      lanes_.compare(u, passes_.linear_unknowns(), passes_.sums(), state_);
      if (round < 2) put_values(state_.tried);
    }
  }
}

/// Takes that many steps, or fewer where all lanes are there.
void LaneFit::step(int most) {
  for (int k = 0; k < most; ++k) {
    put_values(state_.tried);
    passes_.normal(register_.samples(), values_.data());
    for (std::size_t l = 0; l < width_; ++l) steps_[l] += state_.done[l] == 0;
    if (!lanes_.descend(task_.unknowns, passes_.unknowns(), passes_.sums(), state_)) return;
  }
}

/// Steps until each of the first `count` lanes is there or has taken all steps it may, or until most are: the others wait for more of
/// their kind.
void LaneFit::descend(std::size_t count, bool to_the_end) {
  for (;;) {
    std::size_t moving = 0;
    for (std::size_t l = 0; l < count; ++l) {
      if (state_.done[l] == 0 && steps_[l] >= most_steps) state_.done[l] = 2;
      moving += state_.done[l] == 0;
    }
    if (moving == 0 || (!to_the_end && 2 * moving < width_)) return;
    step(1);
  }
}

/// Begins the fit of a register full, up to where one start is left.
void LaneFit::fit(std::span<const std::size_t> texels) {
  register_.gather(texels);
  LowestStarts lowest_starts(task_.has_dull_group && !seeks_dull_ ? 1 : starts_kept);
  auto& begins = lowest_starts.starts();
  std::fill_n(tilt_.data(), 2 * padding, 0.0F);
  for (const auto& group : task_.starts)
    if (task_.asked.refine_normals && in_.normal.empty())
      begin_tilted(group, lowest_starts);
    else
      lowest_starts.add(start_of(group), state_.cost);
  if (has_middles_) add_middles(begins);
  register_.in_logarithms();
  std::vector<float> lowest;
  for (const auto& x : begins) {
    std::array<bool, padding> tries;
    tries.fill(true);
    if (seeks_dull_ && &x == &begins.front() + 1)
      tries = lowest_starts.second_may_be_deeper(state_.cost);
    if (std::ranges::count(tries, true) == 0) continue;
    std::ranges::copy(x, state_.x);
    std::ranges::copy(x, state_.tried);
    std::fill_n(state_.cost, padding, std::numeric_limits<float>::infinity());
    for (float* const row : {state_.gain, state_.damping, state_.promise, state_.done})
      std::fill_n(row, padding, 0.0F);
    steps_.fill(0);
    if (begins.size() == 1) return;
    step(steps_of_each);
    take_lowest(lowest, tries);
  }
}

/// Keeps of each texel the one of two ends whose next step leads lower: that of the state and an earlier one, empty the first time.
void LaneFit::take_lowest(std::vector<float>& lowest, const std::array<bool, padding>& tries) {
  float* const now = memory_.data();
  const auto size = static_cast<std::size_t>(state_.scratch - now),
             cost = static_cast<std::size_t>(state_.cost - now),
             promise = static_cast<std::size_t>(state_.promise - now);
  const auto expected = [&](const float* at, std::size_t l) {
    return at[cost + l] - at[promise + l];
  };
  if (lowest.empty()) lowest.assign(now, now + size);
  for (std::size_t l = 0; l < padding; ++l) {
    const bool lower = tries[l] && expected(now, l) < expected(lowest.data(), l);
    for (std::size_t at = l; at < size; at += padding)
      (lower ? lowest[at] : now[at]) = lower ? now[at] : lowest[at];
  }
}

/// True of a lane whose normal is sought in fewer than three images with light: whatever fits, others fit as well.
bool LaneFit::leaves_tilt_open(std::size_t lane) const {
  return task_.asked.refine_normals && register_.images_with_light(lane) < 3;
}

void LaneFit::finish(std::span<const std::size_t> texels) {
  const auto& u = task_.unknowns;
  const std::size_t slots = task_.model().value_count;
  const auto* const turned = task_.model().tangent();
  const std::size_t tangent = turned ? turned->first : slots;
  put_values(state_.tried);
  lanes_.invert(u, state_, false, left_out_.data(), inverse_.data());
  bool again = false;
  for (std::size_t l = 0; l < width_; ++l) {
    bool singular = false;
    for (std::size_t i = 0; i < n(); ++i) singular = singular || left_out_[i * padding + l] == 3;
    if (singular) judge_singular(l);
    again = again || singular;
  }
  if (again) lanes_.invert(u, state_, true, left_out_.data(), inverse_.data());

  std::array<const float*, max_channels> own{};
  for (std::size_t c = 0; c < in_.channels; ++c) {
    float* to = own_inverse_.data() + c * max_columns * (max_columns + 1) / 2 * padding;
    own[c] = to;
    const auto& of = passes_.unknowns()[c];
    for (std::size_t a = 0; a < of.size(); ++a)
      for (std::size_t b = 0; b <= a; ++b, to += padding)
        if (of[a] < n() && of[b] < n())
          std::copy_n(inverse_.data() + (of[a] * n() + of[b]) * padding, padding, to);
        else
          std::fill_n(to, padding, 0.0F);
  }
  passes_.worth(register_.samples(), values_.data(), own);
  lanes_.variances(u, passes_.unknowns(), passes_.sums(), inverse_.data(), variance_.data(),
                   freedom_.data());

  for (std::size_t l = 0; l < texels.size(); ++l) {
    if (state_.done[l] == 0) continue;  // waits
    const std::size_t t = texels[l];
    const bool none = register_.count(l) == 0, few = none || leaves_tilt_open(l);
    float squares = 0;
    for (std::size_t c = 0; c < in_.channels; ++c) squares += passes_.sums()[c][l];
    out_.rms[t] = none ? nan : std::sqrt(squares / register_.count(l));
    const auto outcome = none ? TexelOutcome::no_data
                         : state_.done[l] == 1 && !std::isnan(out_.rms[t])
                             ? TexelOutcome::converged
                             : TexelOutcome::not_converged;
    out_.outcome[t] = static_cast<std::uint8_t>(outcome);
    std::size_t taken = 0;
    for (std::size_t i = 0; i < n(); ++i) taken += left_out_[i * padding + l] != 1;
    const auto values = static_cast<std::size_t>(register_.count(l));
    out_.signal[t] = none ? nan : std::sqrt(state_.signal[l] / register_.count(l));
    out_.count[t] = register_.count(l);
    out_.freedom[t] = static_cast<float>(values > taken ? values - taken : 0);
    // Lobes of like terms, and widths along and across the tangent, stand in the order of a fit of
    // a table.
    std::vector<std::size_t> from;
    std::vector<double> value;
    if (task_.turns() || task_.model().lobes.size() > 1) {
      for (std::size_t s = 0; s < slots; ++s) value.push_back(double{values_[s * padding + l]});
      from = put_in_order(task_.problem, value);
    }
    std::size_t column = 0;
    for (const auto& q : task_.model().parameters)
      for (std::size_t c = 0; c < q.count; ++c, ++column) {
        auto& to = out_.columns[column];
        const std::size_t s = q.first + c, i = task_.unknown_of[from.empty() ? s : from[s]];
        auto status = ParameterStatus::fixed;
        to.value[t] = value.empty() ? values_[s * padding + l] : static_cast<float>(value[s]);
        if (i < n()) {
          const float left = left_out_[i * padding + l],
                      error = std::sqrt(variance_[i * padding + l]);
          status = few || left >= 2 || std::isnan(to.value[t]) ? ParameterStatus::not_identifiable
                   : left == 1                                 ? ParameterStatus::at_bound
                                                               : ParameterStatus::free;
          if (status == ParameterStatus::free && values > taken) {
            // Of no noise at all there are no parts: fmin.
            const auto most_freedom = static_cast<float>(values - taken);
            const float freedom =
                std::fmax(std::fmin(freedom_[i * padding + l], most_freedom), 1.0F);
            const double spread = double{error} * spread_of(double{freedom});
            // A tangent is the same half a turn further.
            const double range = double{u.high[i]} - double{u.low[i]},
                         most = s == tangent ? std::min(range, 180.0) : range;
            if (fills(normal_quantile * spread, most)) {
              status = ParameterStatus::not_identifiable;
            } else {
              to.std_error[t] = static_cast<float>(spread);
              to.freedom[t] = freedom;
            }
          }
          if (status == ParameterStatus::not_identifiable) to.value[t] = nan;
        }
        to.status[t] = static_cast<std::uint8_t>(status);
      }
    if (!task_.asked.refine_normals) continue;
    const std::size_t tilt = task_.unknown_of[slots];
    const bool open =
        few || left_out_[tilt * padding + l] >= 2 || left_out_[(tilt + 1) * padding + l] >= 2;
    for (std::size_t k = 0; k < 3; ++k)
      out_.normal[k * in_.texels + t] = open ? nan : register_.normal(k, l);
  }
}

/// Says which unknowns of a lane make up for each other, in double as a fit of a table does.
void LaneFit::judge_singular(std::size_t lane) {
  constexpr double rounding = 5e-6;  // of a float's sums, with room
  const auto& u = task_.unknowns;
  ArrowMatrix bread(std::make_shared<const ArrowLayout>(n()));
  std::vector<double> x;
  Bounds bounds;
  for (std::size_t i = 0; i < n(); ++i) {
    const auto unit = [&](std::size_t k) {
      return u.by_ratio[k] ? double{state_.x[k * padding + lane]} : 1.0;
    };
    for (std::size_t j = u.first[i]; j <= i; ++j)
      bread.add(i, j, double{state_.h[(i * (i + 1) / 2 + j) * padding + lane]} / unit(i) / unit(j));
    x.push_back(double{state_.tried[i * padding + lane]});
    bounds.low.push_back(double{u.low[i]});
    bounds.high.push_back(double{u.high[i]});
  }
  const auto found = find_determined(bread, x, bounds, rounding);
  for (std::size_t i = 0; i < n(); ++i)
    left_out_[i * padding + lane] = found.status[i] == ParameterStatus::at_bound           ? 1.0F
                                    : found.status[i] == ParameterStatus::not_identifiable ? 2.0F
                                                                                           : 0.0F;
}

void LaneFit::fit_all() {
  std::vector<std::size_t> texels(width_);
  const auto fill_up = [&](std::size_t from) {  // with what is looked at and forgotten
    for (std::size_t l = from; l < width_; ++l) texels[l] = texels[0];
  };
  const auto size = static_cast<std::size_t>(state_.scratch - memory_.data());
  const auto go_on = [&](std::size_t count, bool to_the_end) {
    descend(count, to_the_end);
    const std::size_t waited = waiting_.size();
    for (std::size_t l = 0; l < count; ++l) {
      if (state_.done[l] != 0) continue;
      auto& w = waiting_.emplace_back(Waiting{texels[l], {}, steps_[l]});
      for (std::size_t at = l; at < size; at += padding) w.state.push_back(memory_[at]);
    }
    if (waiting_.size() < waited + count) finish({texels.data(), count});
  };
  const auto continue_waiting = [&](std::size_t count, bool to_the_end) {
    const auto end = waiting_.begin() + static_cast<std::ptrdiff_t>(count);
    std::vector<Waiting> now(std::make_move_iterator(waiting_.begin()),
                             std::make_move_iterator(end));
    waiting_.erase(waiting_.begin(), end);
    for (std::size_t l = 0; l < count; ++l) texels[l] = now[l].texel;
    fill_up(count);
    register_.gather(texels);
    register_.in_logarithms();
    for (std::size_t l = 0; l < width_; ++l) {
      const Waiting& w = now[l < count ? l : 0];
      for (std::size_t at = 0; at < w.state.size(); ++at) memory_[at * padding + l] = w.state[at];
      steps_[l] = w.steps;
    }
    go_on(count, to_the_end);
  };
  for (std::size_t first = 0; first < in_.texels; first += width_) {
    const std::size_t count = std::min(width_, in_.texels - first);
    for (std::size_t l = 0; l < count; ++l) texels[l] = first + l;
    fill_up(count);
    fit(texels);
    go_on(count, false);
    while (waiting_.size() >= width_) continue_waiting(width_, false);
  }
  if (!waiting_.empty()) continue_waiting(waiting_.size(), true);
}

void check_sizes(const TexelSamples& s) {
  const auto expect = [](const char* what, std::size_t found, std::size_t expected) {
    if (found != expected)
      throw wrong_usage(fmt::format("{}: {} numbers, expected {}", what, found, expected));
  };
  const std::size_t directions = 3 * s.images * (s.shared ? 1 : s.texels);
  expect("values", s.values.size(), s.images * s.channels * s.texels);
  expect("light", s.light.size(), directions);
  expect("view", s.view.size(), directions);
  if (!s.normal.empty()) expect("normal", s.normal.size(), 3 * s.texels);
}

}  // namespace

double spread_of(double freedom) {
  constexpr std::size_t steps = 256;  // of 1/freedom, between which it is a line
  static const auto table = [] {
    std::array<float, steps + 1> all{1};  // floats, which no library's last digits change
    for (std::size_t k = 1; k <= steps; ++k)
      all[k] = static_cast<float>(
          students_t_quantile(0.975, static_cast<double>(steps) / static_cast<double>(k)) /
          normal_quantile);
    return all;
  }();
  const double at = static_cast<double>(steps) / freedom;
  const auto below = std::min(static_cast<std::size_t>(at), steps - 1);
  const double low = double{table[below]}, high = double{table[below + 1]};
  return low + (at - static_cast<double>(below)) * (high - low);
}

void check(const TexelOptions& o, std::size_t channels) {
  const TexelTask task(o, channels);
}

TexelFit fit_texels(const TexelSamples& s,
                    const TexelOptions& o,
                    std::string_view instruction_set) {
  check_sizes(s);
  const TexelTask task(o, s.channels);
  TexelFit fit;
  for (const auto& q : task.model().parameters)
    for (std::size_t c = 0; c < q.count; ++c)
      fit.columns.push_back({q.name, q.count > 1 ? static_cast<int>(c) : -1,
                             std::vector<float>(s.texels, nan), std::vector<float>(s.texels, nan),
                             std::vector<float>(s.texels, nan),
                             std::vector<std::uint8_t>(s.texels)});
  for (auto* column : {&fit.rms, &fit.signal, &fit.misfit}) column->assign(s.texels, nan);
  for (auto* column : {&fit.count, &fit.freedom}) column->assign(s.texels, 0);
  fit.outcome.assign(s.texels, static_cast<std::uint8_t>(TexelOutcome::no_data));
  if (o.refine_normals) fit.normal.assign(3 * s.texels, nan);
  if (s.texels > 0) LaneFit(task, s, instruction_set, fit).fit_all();
  return fit;
}

}  // namespace gonio
