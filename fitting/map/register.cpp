#include "fitting/map/register.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "base/quantile.h"
#include "geometry/vector.h"

namespace gonio {
namespace {

/// Puts a lane's frame, tangent, bitangent and normal.
void put_frame(Column<float>& to, std::size_t lane, const Direction& x, const Direction& z) {
  const Vector y = cross(vector_of(z), vector_of(x));
  std::size_t k = 0;
  for (const Vector& axis : {vector_of(x), y, vector_of(z)})
    for (const double part : {axis.x, axis.y, axis.z})
      to[k++ * padding + lane] = static_cast<float>(part);
}

}  // namespace

TexelRegister::TexelRegister(const TexelTask& task,
                             const TexelSamples& in,
                             const Kernels<float>& kernels,
                             const LaneKernels& lanes,
                             bool is_fused)
    : task_(task),
      in_(in),
      kernels_(kernels),
      lanes_(lanes),
      signal_(padding),
      same_angles_(in.shared && in.normal.empty() && !task.asked.refine_normals && !task.turns()),
      is_shared_(same_angles_ && is_fused && task.asked.metric == Metric::l2_cosine) {
  const std::size_t full = in.images * width_;
  // Kernels take whole multiples of `padding`, with what follows masked.
  const std::size_t room = (full + padding - 1) / padding * padding;
  for (auto& c : angles_) c = Column<float>(room, 0.5F);
  for (std::size_t c = 0; c < in.channels; ++c) {
    target_[c] = Column<float>(room);
    weight_[c] = Column<float>(room);
  }
  for (auto* c : {&light_, &view_}) *c = Column<float>(3 * room);
  for (auto* c : {&per_cosine_, &slope_}) *c = Column<float>(room, 1);
  frame_ = Column<float>(9 * padding);
  turn_ = Column<float>(4 * padding);
  usable_ = Column<float>(room);
  if (task.turns() || task.asked.refine_normals)
    for (auto& c : given_) c = Column<float>(room);
  read_shared();
}

/// Angles of directions that are the same for all texels, once.
void TexelRegister::read_shared() {
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
    if (usable_[i * width_] == 0) continue;
    for (std::size_t k = 0; k < shared_angles_.size(); ++k)
      shared_angles_[k][shared_image_.size()] = angles_[k][i * width_];
    shared_weight_[shared_image_.size()] = angles_[0][i * width_];
    shared_image_.push_back(i);
  }
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
void TexelRegister::put_frames(std::span<const std::size_t> texels) {
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
    put_frame(frame_, l, x, z);
  }
  for (std::size_t k = 0; k < 4; ++k)
    std::fill_n(turn_.data() + k * padding, padding, k == 0 || k == 3 ? 1.0F : 0.0F);
}

/// Angles of all samples; those below the surface get harmless ones.
void TexelRegister::make_angles() {
  TexelDirections d{in_.images,    in_.shared,   light_.data(),  view_.data(),
                    frame_.data(), turn_.data(), usable_.data(), {}};
  for (std::size_t k = 0; k < angles_.size(); ++k) d.angles[k] = angles_[k].data();
  lanes_.angles(d);
}

/// The same angles of all, and no value masked: false where one is.
bool TexelRegister::gather_shared(std::size_t first) {
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
  std::copy_n(signal, width_, signal_.data());
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

void TexelRegister::gather_lanes(std::span<const std::size_t> texels) {
  if (!in_.shared)
    for (std::size_t i = 0; i < in_.images; ++i)
      for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t l = 0; l < width_; ++l) {
          const std::size_t from = (i * 3 + k) * in_.texels + texels[l],
                            to = (k * in_.images + i) * width_ + l;
          light_[to] = in_.light[from];
          view_[to] = in_.view[from];
        }
  const std::size_t full = in_.images * width_, room = (full + padding - 1) / padding * padding;
  if (!same_angles_) {
    put_frames(texels);
    make_angles();
    constexpr std::array<std::size_t, 9> of{5, 6, 7, 8, 9, 10, 2, 0, 1};
    for (std::size_t k = 0; k < of.size() && given_[k].data(); ++k)
      std::copy_n(angles_[of[k]].data(), full, given_[k].data());
  }
  if (task_.asked.refine_normals)
    std::transform(angles_[0].data(), angles_[0].data() + room, per_cosine_.data(),
                   [](float c) { return 1 / c; });
  std::fill_n(signal_.data(), padding, 0.0F);
  count_.fill(0);
  const bool l2 = task_.asked.metric == Metric::l2_cosine, log = task_.asked.metric == Metric::log;
  const auto offset = static_cast<float>(task_.asked.offset);
  const float faintest_sum = l2 ? -1 : static_cast<float>(faintest);
  float* const signal = signal_.data();
  // A 0 may be light from below the surface, which says no more than that: where normals are
  // unknown it is left out.
  const float least = task_.asked.refine_normals ? std::numeric_limits<float>::min() : 0;
  for (std::size_t c = 0; c < in_.channels; ++c)
    for (std::size_t i = 0; i < in_.images; ++i) {
      const float* const from = in_.values.data() + (i * in_.channels + c) * in_.texels;
      float* const target = target_[c].data() + i * width_;
      float* const weight = weight_[c].data() + i * width_;
      const float* const usable = usable_.data() + i * width_;
      const float* const nol = angles_[0].data() + i * width_;
      for (std::size_t l = 0; l < width_; ++l) target[l] = from[texels[l]];
      for (std::size_t l = 0; l < width_; ++l) {
        const float y = target[l], sum = y + offset;
        const bool use = (usable[l] > 0) & (y >= least) & (y <= 1e18F) & (sum > faintest_sum);
        const float w = use ? (l2 ? nol[l] : 1 / sum) : 0, one = use ? 1.0F : 0.0F;
        target[l] = use ? y : 0;
        weight[l] = w;
        count_[l] += one;
        signal[l] += log ? one : w * target[l] * (w * target[l]);
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
  samples_.per_cosine = per_cosine_.data();
}

void TexelRegister::gather(std::span<const std::size_t> texels) {
  at_.clear();
  const bool in_a_row = texels.back() - texels.front() + 1 == width_ &&
                        std::ranges::is_sorted(texels, std::less_equal<>());
  if (is_shared_ && in_a_row && gather_shared(texels.front())) return;
  gather_lanes(texels);
}

void TexelRegister::in_logarithms() {
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

void TexelRegister::turn(const float* deg) {
  if (is_at(deg, 1)) return;
  for (std::size_t l = 0; l < width_; ++l) {
    const double t = double{deg[l]} * degree;
    const auto c = static_cast<float>(std::cos(t)), s = static_cast<float>(std::sin(t));
    turn_[0 * padding + l] = turn_[3 * padding + l] = c;
    turn_[1 * padding + l] = s;
    turn_[2 * padding + l] = -s;
  }
  TexelTurn about{in_.images, turn_.data(), {}, {}};
  for (std::size_t k = 0; k < about.from.size(); ++k)
    about.from[k] = given_[k].data(), about.to[k] = angles_[5 + k].data();
  lanes_.turn(about);
}

bool TexelRegister::is_at(const float* unknowns, std::size_t count) {
  const std::span now(unknowns, count * padding);
  if (std::ranges::equal(now, at_)) return true;
  at_.assign(now.begin(), now.end());
  return false;
}

void TexelRegister::tilt(const float* tilt) {
  if (is_at(tilt, 2)) return;
  constexpr float just_above = 1e-3F;  // stays what a refined normal puts below the surface
  TexelTilt about{in_.images, tilt, just_above, {}, {}};
  for (std::size_t k = 0; k < 3; ++k)
    about.from[3 * k] = given_[2 * k].data(), about.from[3 * k + 1] = given_[2 * k + 1].data(),
                   about.from[3 * k + 2] = given_[6 + k].data();
  constexpr std::array<std::size_t, 10> to{0, 1, 2, 4, 5, 6, 7, 8, 9, 10};
  for (std::size_t k = 0; k < to.size(); ++k) about.to[k] = angles_[to[k]].data();
  lanes_.tilt(about);
}

float TexelRegister::normal(std::size_t k, std::size_t lane) const {
  const auto tilt = [&](std::size_t axis) {
    return at_.empty() ? 0 : double{at_[axis * padding + lane]};
  };
  const auto part = [&](std::size_t axis) {
    return double{frame_[(3 * axis + k) * padding + lane]};
  };
  return static_cast<float>((tilt(0) * part(0) + tilt(1) * part(1) + part(2)) /
                            std::sqrt(1 + square(tilt(0)) + square(tilt(1))));
}

std::size_t TexelRegister::images_with_light(std::size_t lane) const {
  std::size_t lit = 0;
  for (std::size_t i = 0; i < in_.images; ++i)
    lit += std::ranges::any_of(std::span(weight_).first(in_.channels),
                               [&](const auto& w) { return w[i * width_ + lane] > 0; });
  return lit;
}

Direction TexelRegister::axis(std::size_t k, std::size_t lane) const {
  const auto of = [&](std::size_t j) { return double{frame_[(3 * k + j) * padding + lane]}; };
  return {of(0), of(1), of(2)};
}

Direction TexelRegister::of_image(const Column<float>& directions,
                                  std::size_t image,
                                  std::size_t lane) const {
  const auto of = [&](std::size_t k) {
    const std::size_t at = k * in_.images + image;
    return double{directions[in_.shared ? at : at * width_ + lane]};
  };
  return {of(0), of(1), of(2)};
}

std::vector<TexelRegister::Sent> TexelRegister::sent_by(std::size_t lane) const {
  std::vector<Sent> all;
  for (std::size_t i = 0; i < in_.images; ++i) {
    const std::size_t at = i * width_ + lane;
    double sum = 0, count = 0;
    for (std::size_t c = 0; c < in_.channels; ++c)
      if (weight_[c][at] > 0) ++count, sum += double{target_[c][at]};
    if (count == 0) continue;
    const Direction l = of_image(light_, i, lane), v = of_image(view_, i, lane);
    const Direction h{l.x + v.x, l.y + v.y, l.z + v.z};
    const double per = 1 / std::sqrt(dot(h, h));
    all.push_back({l, {per * h.x, per * h.y, per * h.z}, sum / count / double{per_cosine_[at]}});
  }
  return all;
}

/// Normal times albedo of a matt surface that sends what was measured, by least squares of ρ n·l, what is brighter counting less:
/// highlights are.  0 where the lights lie in a plane.
Direction TexelRegister::matt_normal(const std::vector<Sent>& sent) {
  constexpr int rounds = 4;
  Direction m{};
  for (int round = 0; round < rounds; ++round) {
    std::array<double, 6> h{};  // xx xy xz yy yz zz
    std::array<double, 3> g{};
    for (const auto& [l, half, y] : sent) {
      const double matt = dot(m, l);
      const double w = round > 0 && y > matt ? square(std::max(matt, 0.0) / y) : 1;
      const double x = w * l.x, u = w * l.y, z = w * l.z;
      h[0] += x * l.x, h[1] += x * l.y, h[2] += x * l.z;
      h[3] += u * l.y, h[4] += u * l.z, h[5] += z * l.z;
      g[0] += y * x, g[1] += y * u, g[2] += y * z;
    }
    const std::array c{h[3] * h[5] - h[4] * h[4], h[2] * h[4] - h[1] * h[5],
                       h[1] * h[4] - h[2] * h[3], h[0] * h[5] - h[2] * h[2],
                       h[1] * h[2] - h[0] * h[4], h[0] * h[3] - h[1] * h[1]};
    const double det = h[0] * c[0] + h[1] * c[1] + h[2] * c[2];
    constexpr double flat = 1e-6;
    if (!(det > flat * square(h[0] + h[3] + h[5]) * (h[0] + h[3] + h[5]))) return {};
    m = {(c[0] * g[0] + c[1] * g[1] + c[2] * g[2]) / det,
         (c[1] * g[0] + c[3] * g[1] + c[4] * g[2]) / det,
         (c[2] * g[0] + c[4] * g[1] + c[5] * g[2]) / det};
  }
  return m;
}

/// Sum of the half vectors of all images by the square of what is brighter than half of them: near the middle of a highlight.
Direction TexelRegister::highlight_normal(const std::vector<Sent>& sent) {
  if (sent.empty()) return {};
  std::vector<double> all;
  for (const auto& s : sent) all.push_back(s.y);
  const double middle = median(all);
  Direction m{};
  for (const auto& [l, h, y] : sent) {
    const double w = square(std::max(y - middle, 0.0));
    m = {m.x + w * h.x, m.y + w * h.y, m.z + w * h.z};
  }
  return m;
}

void TexelRegister::find_tilts(std::span<const float> low,
                               std::span<const float> high,
                               float* matt,
                               float* highlight) const {
  const auto put = [&](const Direction& m, std::size_t l, float* to) {
    const double along = dot(m, axis(2, l)), length = std::sqrt(dot(m, m));
    constexpr double steepest = 0.2;  // cosine
    for (std::size_t k = 0; k < 2; ++k)
      to[k * padding + l] =
          along > steepest * length
              ? std::clamp(static_cast<float>(dot(m, axis(k, l)) / along), low[k], high[k])
              : 0;
  };
  for (std::size_t l = 0; l < width_; ++l) {
    const auto sent = sent_by(l);
    put(matt_normal(sent), l, matt);
    put(highlight_normal(sent), l, highlight);
  }
}

}  // namespace gonio
