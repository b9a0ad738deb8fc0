#include "fitting/map/texels.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "base/error.h"
#include "fitting/judge/uncertainty.h"
#include "fitting/map/passes.h"
#include "fitting/solve/order.h"
#include "geometry/vector.h"
#include "number/distributions.h"

#include <fmt/format.h>

namespace gonio {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
/// Steps of the first round, after which texels that are not there yet wait for a register full of their kind; and of all.
constexpr int first_steps = 8, most_steps = 150;

/// Puts a lane's frame, tangent, bitangent and normal.
/// \return  the bitangent
Direction put_frame(Column<float>& to, std::size_t lane, const Direction& x, const Direction& z) {
  const Vector y = cross(vector_of(z), vector_of(x));
  std::size_t k = 0;
  for (const Vector& axis : {vector_of(x), y, vector_of(z)})
    for (const double part : {axis.x, axis.y, axis.z})
      to[k++ * padding + lane] = static_cast<float>(part);
  return {y.x, y.y, y.z};
}

/// Texel on its way, between two rounds.
struct Waiting {
  std::size_t texel;
  std::vector<float> x;
  float damping;
};

/// Fits texels, a register full at a time.
class LaneFit {
 public:
  LaneFit(const TexelTask&, const TexelSamples&, std::string_view instruction_set, TexelFit& out);

  void fit_all();

 private:
  void read_shared();
  void gather(std::span<const std::size_t> texels);
  bool gather_shared(std::size_t first);
  void gather_lanes(std::span<const std::size_t> texels);
  void put_frames(std::span<const std::size_t> texels);
  void make_angles();
  void find_tilt();
  void find_start(std::span<const TexelTask::Start> starts);
  void in_logarithms();
  bool descend(int steps);
  void fit(std::span<const std::size_t> texels, std::span<const Waiting> waiting, int steps);
  void take_lowest(std::vector<float>& lowest);
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

  // Samples of the register.
  std::array<Column<float>, 11> angles_;
  std::array<Column<float>, max_channels> target_, weight_;
  Column<float> light_, view_, cosine_, slope_, frame_, base_, turn_, tilt_;
  std::vector<bool> is_middle_;  ///< [slot]: a diffuse term's own, one for all channels
  bool has_middles_ = false;
  std::vector<std::uint8_t> usable_;  ///< [sample][lane]: above the surface
  LaneSamples samples_;
  std::array<float, padding> count_{};  ///< of values

  // Samples whose angles are the same for all texels.
  bool same_angles_ = false, is_shared_ = false;
  std::array<Column<float>, 5> shared_angles_;
  Column<float> shared_weight_;
  std::vector<std::size_t> shared_image_;  ///< [sample]: above the surface
  std::vector<std::size_t> rows_;          ///< of the values that are read, channel by channel
  std::vector<float> row_weight_;
  Column<float> read_, read_signal_;                  ///< of the registers that are read at once
  std::size_t chunk_ = static_cast<std::size_t>(-1);  ///< the first texel of those

  // The register on its way.
  Column<float> values_, memory_, inverse_, own_inverse_, left_out_, variance_;
  TexelState state_{};
  std::vector<Waiting> waiting_;
  std::vector<double> t_;  ///< 97.5 % quantile of Student's t by degrees of freedom
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
      passes_(task, kernels_, lanes_) {
  const std::size_t unknowns = std::max<std::size_t>(n(), 1), full = in.images * width_;
  // Kernels take whole multiples of `padding`, with what follows masked.
  const std::size_t room = (full + padding - 1) / padding * padding;
  for (auto& c : angles_) c = Column<float>(room, 0.5F);
  for (std::size_t c = 0; c < in.channels; ++c) {
    target_[c] = Column<float>(room);
    weight_[c] = Column<float>(room);
  }
  for (auto* c : {&light_, &view_}) *c = Column<float>(3 * room);
  for (auto* c : {&cosine_, &slope_}) *c = Column<float>(room, 1);
  frame_ = Column<float>(9 * padding);
  base_ = Column<float>(9 * padding);
  turn_ = Column<float>(4 * padding);
  tilt_ = Column<float>(2 * padding);
  is_middle_.resize(task.model().value_count);
  for (const auto& d : task.model().diffuse)
    for (const std::size_t k : d.parameters) {
      const auto& q = task.model().parameters[k];
      const bool scalar = q.count == 1 && !task.is_shape[q.first];
      is_middle_[q.first] = scalar && task.problem.free.mask()[q.first];
      has_middles_ = has_middles_ || is_middle_[q.first];
    }
  usable_.resize(room);

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
  state_ = {take(unknowns), take(unknowns), take(matrix), take(unknowns), take(1),
            take(1),        take(1),        take(1),      take(1),        nullptr};
  state_.scratch = next;
  inverse_ = Column<float>(unknowns * unknowns * padding);
  own_inverse_ = Column<float>(max_channels * max_columns * (max_columns + 1) / 2 * padding);
  left_out_ = Column<float>(unknowns * padding);
  variance_ = Column<float>(unknowns * padding);

  t_.push_back(std::numeric_limits<double>::infinity());
  for (std::size_t nu = 1; nu <= in.images * in.channels; ++nu)
    t_.push_back(nu < 400 ? students_t_quantile(0.975, static_cast<double>(nu)) : t_.back());
  same_angles_ = in.shared && in.normal.empty() && !task.asked.refine_normals && !task.turns();
  read_shared();
}

/// Angles of directions that are the same for all texels, once.
void LaneFit::read_shared() {
  if (!in_.shared) return;
  for (std::size_t i = 0; i < in_.images; ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      light_[k * in_.images + i] = in_.light[i * 3 + k];
      view_[k * in_.images + i] = in_.view[i * 3 + k];
    }
  if (!same_angles_) return;
  const std::vector<std::size_t> any(width_, 0);
  put_frames(any);
  make_angles();
  for (auto& c : shared_angles_) c = Column<float>(in_.images + padding, 0.5F);
  shared_weight_ = Column<float>(in_.images + padding);
  for (std::size_t i = 0; i < in_.images; ++i) {
    if (!usable_[i * width_]) continue;
    for (std::size_t k = 0; k < shared_angles_.size(); ++k)
      shared_angles_[k][shared_image_.size()] = angles_[k][i * width_];
    shared_weight_[shared_image_.size()] = angles_[0][i * width_];
    shared_image_.push_back(i);
  }
  is_shared_ = passes_.is_fused() && task_.asked.metric == Metric::l2_cosine;
  if (!is_shared_) return;
  for (std::size_t c = 0; c < in_.channels; ++c)
    for (std::size_t i = 0; i < shared_image_.size(); ++i) {
      rows_.push_back(shared_image_[i] * in_.channels + c);
      row_weight_.push_back(shared_weight_[i]);
    }
  read_ = Column<float>(TexelRows::registers * (rows_.size() * width_ + padding));
  read_signal_ = Column<float>(TexelRows::registers * padding);
}

/// Tangents, bitangents and normals.
void LaneFit::put_frames(std::span<const std::size_t> texels) {
  for (std::size_t l = 0; l < width_; ++l) {
    Direction z;
    if (!in_.normal.empty()) {
      const auto of = [&](std::size_t k) { return double{in_.normal[k * in_.texels + texels[l]]}; };
      const double length = std::hypot(of(0), of(1), of(2));
      z = {of(0) / length, of(1) / length, of(2) / length};  // no number: nothing is above it
    }
    // The map's x less its part along the normal; of a normal along x: −z, or z.
    const double across = std::hypot(z.y, z.z);
    const Direction x = across > 1e-6 ? Direction{across, -z.x * z.y / across, -z.x * z.z / across}
                                      : Direction{0, 0, z.x > 0 ? -1.0 : 1.0};
    put_frame(base_, l, x, z);
  }
  std::copy_n(base_.data(), 9 * padding, frame_.data());
  for (std::size_t k = 0; k < 4; ++k)
    std::fill_n(row(turn_, k), padding, k == 0 || k == 3 ? 1.0F : 0.0F);
}

/// Angles of all samples; those below the surface get harmless ones.
void LaneFit::make_angles() {
  TexelDirections d{in_.images,   in_.shared, light_.data(), view_.data(), frame_.data(),
                    turn_.data(), {}};
  for (std::size_t k = 0; k < angles_.size(); ++k) d.angles[k] = angles_[k].data();
  lanes_.angles(d);
  const std::size_t full = in_.images * width_;
  for (std::size_t i = 0; i < full; ++i) {
    usable_[i] = angles_[0][i] > 0 && angles_[1][i] > 0 && std::isfinite(angles_[2][i]);
    if (!usable_[i])
      for (auto& c : angles_) c[i] = 0.5F;
  }
}

/// The same angles of all, and no value masked: false where one is.
bool LaneFit::gather_shared(std::size_t first) {
  const std::size_t samples = shared_image_.size(), rows = rows_.size(),
                    at_once = TexelRows::registers * width_;
  const std::size_t chunk = first / at_once * at_once, part = (first - chunk) / width_;
  if (chunk + at_once > in_.texels || first % width_ != 0) return false;
  if (chunk != chunk_) {
    lanes_.read({in_.values.data(), in_.texels, chunk, rows_, row_weight_, read_.data(),
                 read_signal_.data()});
    chunk_ = chunk;
  }
  const float* const signal = read_signal_.data() + part * padding;
  for (std::size_t l = 0; l < width_; ++l)
    if (std::isnan(signal[l])) return false;
  std::copy_n(signal, width_, state_.signal);
  std::fill_n(count_.begin(), width_, static_cast<float>(samples * in_.channels));
  samples_ = {};
  samples_.shared = true;
  samples_.x = {shared_angles_[0].data(), shared_angles_[1].data(), shared_angles_[2].data(),
                shared_angles_[3].data(), shared_angles_[4].data(), samples * width_};
  for (std::size_t c = 0; c < in_.channels; ++c) {
    samples_.target[c] = read_.data() + (part * rows + c * samples) * width_;
    samples_.weight[c] = shared_weight_.data();
  }
  return true;
}

void LaneFit::gather_lanes(std::span<const std::size_t> texels) {
  if (!in_.shared)
    for (std::size_t i = 0; i < in_.images; ++i)
      for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t l = 0; l < width_; ++l) {
          const std::size_t from = (i * 3 + k) * in_.texels + texels[l],
                            to = (k * in_.images + i) * width_ + l;
          light_[to] = in_.light[from];
          view_[to] = in_.view[from];
        }
  if (!same_angles_) {
    put_frames(texels);
    make_angles();
  }
  const std::size_t full = in_.images * width_, room = (full + padding - 1) / padding * padding;
  if (task_.asked.refine_normals) std::copy_n(angles_[0].data(), room, cosine_.data());
  std::fill_n(state_.signal, padding, 0.0F);
  count_.fill(0);
  const bool l2 = task_.asked.metric == Metric::l2_cosine, log = task_.asked.metric == Metric::log;
  const auto offset = static_cast<float>(task_.asked.offset);
  // A 0 may be light from below the surface, which says no more than that: where normals are
  // unknown it is left out.
  const float least = task_.asked.refine_normals ? std::numeric_limits<float>::min() : 0;
  for (std::size_t c = 0; c < in_.channels; ++c)
    for (std::size_t i = 0; i < in_.images; ++i) {
      const float* const from = in_.values.data() + (i * in_.channels + c) * in_.texels;
      for (std::size_t l = 0; l < width_; ++l) {
        const float y = from[texels[l]], sum = y + offset;
        const std::size_t at = i * width_ + l;
        const bool use =
            usable_[at] && y >= least && y <= 1e18F && (l2 || sum > static_cast<float>(faintest));
        const float w = use ? (l2 ? angles_[0][at] : 1 / sum) : 0;
        target_[c][at] = use ? y : 0;
        weight_[c][at] = w;
        count_[l] += use ? 1.0F : 0.0F;
        state_.signal[l] += log ? (use ? 1.0F : 0.0F) : w * target_[c][at] * (w * target_[c][at]);
      }
    }
  samples_ = {};
  samples_.x = {angles_[0].data(), angles_[1].data(), angles_[2].data(),
                angles_[3].data(), angles_[4].data(), room};
  for (std::size_t k = 0; k < 6; ++k) samples_.x.frame[k] = angles_[5 + k].data();
  for (std::size_t c = 0; c < in_.channels; ++c) {
    samples_.target[c] = target_[c].data();
    samples_.weight[c] = weight_[c].data();
  }
  samples_.cosine = cosine_.data();
}

void LaneFit::gather(std::span<const std::size_t> texels) {
  const bool in_a_row = texels.back() - texels.front() + 1 == width_ &&
                        std::ranges::is_sorted(texels, std::less_equal<>());
  if (is_shared_ && in_a_row && gather_shared(texels.front())) return;
  gather_lanes(texels);
}

/// Targets of the log metric, in place of those of relative differences that the start was found by.
void LaneFit::in_logarithms() {
  if (task_.asked.metric != Metric::log) return;
  for (std::size_t c = 0; c < in_.channels; ++c) {
    kernels_.link[static_cast<std::size_t>(Link::log)](samples_.x.n, target_[c].data(),
                                                       static_cast<float>(task_.asked.offset),
                                                       target_[c].data(), slope_.data());
    for (std::size_t i = 0; i < samples_.x.n; ++i) {
      const bool use = weight_[c][i] > 0;
      weight_[c][i] = use ? 1.0F : 0.0F;
      target_[c][i] = use ? target_[c][i] : 0;
    }
  }
}

/// Values of the model's parameters, and angles where the unknowns move them.
void LaneFit::put_values(const float* unknowns) {
  const std::size_t slots = task_.model().value_count;
  for (std::size_t i = 0; i < n(); ++i)
    if (task_.unknowns.slot[i] < slots)
      std::copy_n(unknowns + i * padding, padding, row(values_, task_.unknowns.slot[i]));
  if (task_.turns()) {
    const float* const tangent = row(values_, task_.model().tangent()->first);
    for (std::size_t l = 0; l < width_; ++l) {
      const double t = double{tangent[l]} * degree;
      const auto c = static_cast<float>(std::cos(t)), s = static_cast<float>(std::sin(t));
      turn_[0 * padding + l] = turn_[3 * padding + l] = c;
      turn_[1 * padding + l] = s;
      turn_[2 * padding + l] = -s;
    }
    return make_angles();
  }
  if (!task_.asked.refine_normals) return;
  // n = m/|m|, m = n₀ + t x₀ + u y₀; what t and u do to n, a = (x₀ − n (n·x₀))/|m|, in the frame of
  // n.
  const float* const tilt = unknowns + task_.unknown_of[slots] * padding;
  std::vector<std::size_t> none(width_, 0);
  for (std::size_t l = 0; l < width_; ++l) {
    const auto axis = [&](const Column<float>& f, std::size_t k) {
      return Direction{double{f[3 * k * padding + l]}, double{f[(3 * k + 1) * padding + l]},
                       double{f[(3 * k + 2) * padding + l]}};
    };
    const Direction x0 = axis(base_, 0), y0 = axis(base_, 1), z0 = axis(base_, 2);
    const double t = double{tilt[l]}, u = double{tilt[padding + l]},
                 length = std::sqrt(1 + t * t + u * u);
    const Direction z{(z0.x + t * x0.x + u * y0.x) / length, (z0.y + t * x0.y + u * y0.y) / length,
                      (z0.z + t * x0.z + u * y0.z) / length};
    // x of the new frame: x₀ less its part along z.
    const double along = dot(x0, z), across = std::sqrt(1 - along * along);
    const Direction x{(x0.x - along * z.x) / across, (x0.y - along * z.y) / across,
                      (x0.z - along * z.z) / across};
    const Direction y = put_frame(frame_, l, x, z);
    std::size_t k = 0;
    for (const auto& by : {x0, y0})  // x and y are across z: its part drops out
      for (const auto& a : {x, y})
        turn_[k++ * padding + l] = static_cast<float>(dot(by, a) / length);
  }
  const auto above = usable_;
  make_angles();
  usable_ = above;  // as the given normals have it
  // What a refined normal puts below the surface stays just above it.
  constexpr float least = 1e-3F;
  for (std::size_t i = 0; i < in_.images * width_; ++i)
    for (std::size_t k = 0; k < 2; ++k) angles_[k][i] = std::max(angles_[k][i], least);
}

/// The tilt at which matt surfaces would send the light that was measured, by least squares of ρ n·l, what is brighter counting
/// less: highlights are.  0 where the lights or the answer say nothing.
void LaneFit::find_tilt() {
  constexpr int rounds = 4;
  const std::size_t slots = task_.model().value_count, first = task_.unknown_of[slots];
  for (std::size_t l = 0; l < width_; ++l) {
    const auto axis = [&](std::size_t k) {
      return Direction{double{base_[3 * k * padding + l]}, double{base_[(3 * k + 1) * padding + l]},
                       double{base_[(3 * k + 2) * padding + l]}};
    };
    Direction m{};
    for (int round = 0; round < rounds; ++round) {
      std::array<double, 6> h{};  // xx xy xz yy yz zz
      std::array<double, 3> g{};
      for (std::size_t i = 0; i < in_.images; ++i) {
        const std::size_t at = i * width_ + l;
        const auto of = [&](std::size_t k) {
          return double{in_.shared ? light_[k * in_.images + i]
                                   : light_[(k * in_.images + i) * width_ + l]};
        };
        const Direction light{of(0), of(1), of(2)};
        for (std::size_t c = 0; c < in_.channels; ++c) {
          if (!(weight_[c][at] > 0)) continue;
          const double y = double{target_[c][at]} * double{cosine_[at]}, matt = dot(m, light);
          const double w = round > 0 && y > matt ? square(std::max(matt, 0.0) / y) : 1;
          h[0] += w * light.x * light.x, h[1] += w * light.x * light.y;
          h[2] += w * light.x * light.z, h[3] += w * light.y * light.y;
          h[4] += w * light.y * light.z, h[5] += w * light.z * light.z;
          g[0] += w * y * light.x, g[1] += w * y * light.y, g[2] += w * y * light.z;
        }
      }
      const std::array c{h[3] * h[5] - h[4] * h[4], h[2] * h[4] - h[1] * h[5],
                         h[1] * h[4] - h[2] * h[3], h[0] * h[5] - h[2] * h[2],
                         h[1] * h[2] - h[0] * h[4], h[0] * h[3] - h[1] * h[1]};
      const double det = h[0] * c[0] + h[1] * c[1] + h[2] * c[2];
      constexpr double flat = 1e-6;
      if (!(det > flat * square(h[0] + h[3] + h[5]) * (h[0] + h[3] + h[5]))) {
        m = {};
        break;
      }
      m = {(c[0] * g[0] + c[1] * g[1] + c[2] * g[2]) / det,
           (c[1] * g[0] + c[3] * g[1] + c[4] * g[2]) / det,
           (c[2] * g[0] + c[4] * g[1] + c[5] * g[2]) / det};
    }
    const double along = dot(m, axis(2)), length = std::sqrt(dot(m, m));
    constexpr double steepest = 0.2;  // cosine
    for (std::size_t k = 0; k < 2; ++k)
      tilt_[k * padding + l] =
          along > steepest * length
              ? std::clamp(static_cast<float>(dot(m, axis(k)) / along),
                           task_.unknowns.low[first + k], task_.unknowns.high[first + k])
              : 0;
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
      passes_.linear(samples_, values_.data());
      lanes_.compare(u, passes_.linear_unknowns(), passes_.sums(), state_);
      if (round < 2) put_values(state_.tried);
    }
  }
}

bool LaneFit::descend(int steps) {
  for (int k = 0; k < steps; ++k) {
    put_values(state_.tried);
    passes_.normal(samples_, values_.data());
    if (!lanes_.descend(task_.unknowns, passes_.unknowns(), passes_.sums(), state_)) return true;
  }
  return false;
}

void LaneFit::fit(std::span<const std::size_t> texels,
                  std::span<const Waiting> waiting,
                  int steps) {
  gather(texels);
  std::vector<std::vector<float>> begins;
  const auto find_starts = [&] {
    for (const auto& group : task_.starts) {
      find_start(group);
      begins.emplace_back(state_.x, state_.x + n() * padding);
    }
  };
  if (waiting.empty()) {
    std::fill_n(tilt_.data(), 2 * padding, 0.0F);
    find_starts();
    // From a normal far off other parameters are led astray before it is found.
    if (task_.asked.refine_normals && in_.normal.empty()) {
      find_tilt();
      find_starts();
      // A diffuse roughness of 0 does not move.
      const auto& u = task_.unknowns;
      const auto tilted = begins;
      for (const float part : {0.1F, 0.2F, 0.4F})
        for (std::size_t g = tilted.size() / 2; has_middles_ && g < tilted.size(); ++g) {
          auto& x = begins.emplace_back(tilted[g]);
          for (std::size_t i = 0; i < n(); ++i)
            if (u.slot[i] < is_middle_.size() && is_middle_[u.slot[i]])
              std::fill_n(x.data() + i * padding, padding, std::lerp(u.low[i], u.high[i], part));
        }
    }
  }
  in_logarithms();
  std::fill_n(state_.damping, padding, 0.0F);
  if (!waiting.empty()) {
    auto& x = begins.emplace_back(n() * padding);
    for (std::size_t l = 0; l < width_; ++l) {
      const Waiting& w = waiting[l < waiting.size() ? l : 0];
      for (std::size_t i = 0; i < n(); ++i) x[i * padding + l] = w.x[i];
      state_.damping[l] = w.damping;
    }
  }
  std::vector<float> lowest;
  for (const auto& x : begins) {
    std::ranges::copy(x, state_.x);
    std::ranges::copy(x, state_.tried);
    std::fill_n(state_.cost, padding, std::numeric_limits<float>::infinity());
    for (float* const row : {state_.promise, state_.done}) std::fill_n(row, padding, 0.0F);
    if (begins.size() > 1) std::fill_n(state_.damping, padding, 0.0F);
    descend(begins.size() > 1 ? most_steps : steps);
    if (begins.size() == 1) return;
    for (std::size_t l = 0; l < width_; ++l)
      if (state_.done[l] == 0) state_.done[l] = 2;
    take_lowest(lowest);
  }
}

/// Keeps of each texel the lower of two ends: that of the state and of an earlier one, empty the first time.
void LaneFit::take_lowest(std::vector<float>& lowest) {
  float* const now = memory_.data();
  const auto size = static_cast<std::size_t>(state_.scratch - now),
             cost = static_cast<std::size_t>(state_.cost - now);
  if (lowest.empty()) lowest.assign(now, now + size);
  for (std::size_t l = 0; l < padding; ++l) {
    const bool lower = now[cost + l] < lowest[cost + l];
    for (std::size_t at = l; at < size; at += padding)
      (lower ? lowest[at] : now[at]) = lower ? now[at] : lowest[at];
  }
}

/// True of a lane whose normal is sought in fewer than three images with light: whatever fits, others fit as well.
bool LaneFit::leaves_tilt_open(std::size_t lane) const {
  if (!task_.asked.refine_normals) return false;
  std::size_t lit = 0;
  for (std::size_t i = 0; i < in_.images; ++i)
    lit += std::ranges::any_of(std::span(weight_).first(in_.channels),
                               [&](const auto& w) { return w[i * width_ + lane] > 0; });
  return lit < 3;
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
  passes_.worth(samples_, values_.data(), own);
  lanes_.variances(u, passes_.unknowns(), passes_.sums(), inverse_.data(), variance_.data());

  for (std::size_t l = 0; l < texels.size(); ++l) {
    if (state_.done[l] == 0) continue;  // waits
    const std::size_t t = texels[l];
    const bool none = count_[l] == 0, few = none || leaves_tilt_open(l);
    float squares = 0;
    for (std::size_t c = 0; c < in_.channels; ++c) squares += passes_.sums()[c][l];
    out_.rms[t] = none ? nan : std::sqrt(squares / count_[l]);
    const auto outcome = none ? TexelOutcome::no_data
                         : state_.done[l] == 1 && !std::isnan(out_.rms[t])
                             ? TexelOutcome::converged
                             : TexelOutcome::not_converged;
    out_.outcome[t] = static_cast<std::uint8_t>(outcome);
    std::size_t taken = 0;
    for (std::size_t i = 0; i < n(); ++i) taken += left_out_[i * padding + l] != 1;
    const auto values = static_cast<std::size_t>(count_[l]);
    out_.signal[t] = none ? nan : std::sqrt(state_.signal[l] / count_[l]);
    out_.count[t] = count_[l];
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
            const double half = t_[values - taken] * double{error};
            // A tangent is the same half a turn further.
            const double range = double{u.high[i]} - double{u.low[i]},
                         most = s == tangent ? std::min(range, 180.0) : range;
            if (2 * half >= most)
              status = ParameterStatus::not_identifiable;
            else
              to.std_error[t] = error;
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
      out_.normal[k * in_.texels + t] = open ? nan : frame_[(6 + k) * padding + l];
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
  const auto continue_waiting = [&](std::size_t count) {
    for (std::size_t l = 0; l < count; ++l) texels[l] = waiting_[l].texel;
    fill_up(count);
    fit(texels, {waiting_.data(), count}, most_steps);
    for (std::size_t l = 0; l < count; ++l)
      if (state_.done[l] == 0) state_.done[l] = 2;
    finish({texels.data(), count});
    waiting_.erase(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(count));
  };
  for (std::size_t first = 0; first < in_.texels; first += width_) {
    const std::size_t count = std::min(width_, in_.texels - first);
    for (std::size_t l = 0; l < count; ++l) texels[l] = first + l;
    fill_up(count);
    fit(texels, {}, first_steps);
    for (std::size_t l = 0; l < count; ++l) {
      if (state_.done[l] != 0) continue;
      auto& w = waiting_.emplace_back(Waiting{first + l, {}, state_.damping[l]});
      for (std::size_t i = 0; i < n(); ++i) w.x.push_back(state_.x[i * padding + l]);
    }
    finish({texels.data(), count});
    while (waiting_.size() >= width_) continue_waiting(width_);
  }
  if (!waiting_.empty()) continue_waiting(waiting_.size());
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
                             std::vector<std::uint8_t>(s.texels)});
  for (auto* column : {&fit.rms, &fit.signal, &fit.misfit}) column->assign(s.texels, nan);
  for (auto* column : {&fit.count, &fit.freedom}) column->assign(s.texels, 0);
  fit.outcome.assign(s.texels, static_cast<std::uint8_t>(TexelOutcome::no_data));
  if (o.refine_normals) fit.normal.assign(3 * s.texels, nan);
  if (s.texels > 0) LaneFit(task, s, instruction_set, fit).fit_all();
  return fit;
}

}  // namespace gonio
