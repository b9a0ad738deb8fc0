#include "table/format/rgl.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <numbers>

#include "table/format/rgl_function.h"
#include "table/format/rgl_warp.h"
#include "table/format/tensor_file.h"

#include <fmt/format.h>

namespace gonio {
namespace {

using std::numbers::pi;
using namespace rgl;

/// Cosine of θ_o = 70°, under which values between samples are held within the samples' span.
constexpr double guarded_cosine = 0.3420201433256687;

/// The contents of a file, and f_r by them.
class Material {
 public:
  explicit Material(InputFile& in) {
    const TensorFile file(in);
    theta_i = axis(file, "theta_i", 0, pi / 2);
    phi_i = axis(file, "phi_i", -2 * pi, 2 * pi);
    isotropic = phi_i.size() <= 2;
    const std::uint64_t n_phi = phi_i.size(), n_theta = theta_i.size();
    if (!isotropic) {
      const double span = phi_i.back() - phi_i.front();
      symmetry = static_cast<int>(std::lround(2 * pi / span));
      if ((symmetry != 1 && symmetry != 2 && symmetry != 4) ||
          !(std::abs(span * symmetry - 2 * pi) < 1e-3))
        file.fail("phi_i", fmt::format("{:.4g} of a turn", span / (2 * pi)),
                  "a whole, a half or a quarter");
    }
    jacobian_ = file.flag("jacobian");
    ndf_ = image(file, "ndf", file.tensor("ndf", Tensor::floats, 2), 0);
    sigma_ = image(file, "sigma", file.tensor("sigma", Tensor::floats, 2), 0);
    const Tensor& vndf = file.tensor("vndf", Tensor::floats, 4);
    file.shaped("vndf", {n_phi, n_theta, vndf.shape[2], vndf.shape[3]});
    warp_ = std::make_unique<Warp>(image(file, "vndf", vndf, 0, most_values / 4),  // cumulated too
                                   n_phi * n_theta);

    const bool spectral = file.has("wavelengths");
    if (spectral) {
      const auto& wavelengths = file.tensor("wavelengths", Tensor::floats, 1);
      if (wavelengths.shape[0] > most_channels)
        file.fail("wavelengths", fmt::format("{} channels", wavelengths.shape[0]),
                  fmt::format("at most {}", most_channels));
      for (const float nm : file.floats(wavelengths)) channels.push_back(fmt::format("{:.6g}", nm));
      auto sorted = channels;
      std::ranges::sort(sorted);
      if (std::ranges::adjacent_find(sorted) != sorted.end())
        file.fail("wavelengths", *std::ranges::adjacent_find(sorted) + " twice", "each once");
    } else {
      channels = {"r", "g", "b"};
    }
    const char* const name = spectral ? "spectra" : "rgb";
    const Tensor& data = file.tensor(name, Tensor::floats, 5);
    file.shaped(name, {n_phi, n_theta, channels.size(), data.shape[3], data.shape[4]});
    data_ = image(file, name, data, -std::numeric_limits<double>::infinity());
    // The list has four angles for each sample beside the values.
    const std::uint64_t samples = n_phi * n_theta * data_.width * data_.height;
    if (samples * (channels.size() + 4) > most_values)
      file.fail(name, fmt::format("{} samples × {} channels", samples, channels.size()),
                fmt::format("at most {} numbers", most_values));
    set_scale();
  }

  std::size_t width() const { return data_.width; }
  std::size_t height() const { return data_.height; }

  struct Sample {
    DirectionPair pair;
    Point u;  ///< of the facet normal, their half vector
  };
  /// The grid point (x, y) of an incident direction.
  Sample sample(std::size_t p, std::size_t t, std::size_t x, std::size_t y) const {
    const Point s{static_cast<double>(x) / static_cast<double>(width() - 1),
                  static_cast<double>(y) / static_cast<double>(height() - 1)};
    const Point u = warp_->sample(p * theta_i.size() + t, s);
    const Direction wi = direction(theta_i[t], isotropic ? 0 : phi_i[p]),
                    m = direction(u.x * u.x * pi / 2, (2 * u.y - 1) * pi);
    const double twice = 2 * dot(wi, m);
    return {{wi, {twice * m.x - wi.x, twice * m.y - wi.y, twice * m.z - wi.z}}, u};
  }
  /// f_r of all channels there, appended to them.
  void values(std::size_t p,
              std::size_t t,
              std::size_t x,
              std::size_t y,
              const Sample& s,
              std::vector<Values>& to) const {
    const double scale = scale_at(s, theta_i[t]);
    // The pole of the facets is a grid point in every row: the sample is their mean.
    const std::size_t rows = x == 0 ? height() - 1 : 1;
    for (std::size_t c = 0; c < to.size(); ++c) {
      const float* const nodes = data_.slice((p * theta_i.size() + t) * to.size() + c);
      double sum = 0;
      for (std::size_t k = y; k < y + rows; ++k) sum += static_cast<double>(nodes[k * width() + x]);
      to[c].push_back(sum / static_cast<double>(rows) * scale);
    }
  }

  /// f_r above the horizon as the format interpolates it; \param guard  see rgl_function()
  double at(DirectionPair p, std::size_t channel, bool guard) const {
    if (!(p.wi.z > 0 && p.wo.z > 0)) return std::nan("");
    if (guard && (p.wo.z < least_cosine || theta_of(p.wi) > theta_i.back() + 1e-6))
      return std::nan("");
    fold(p);
    const double azimuth = isotropic ? phi_i[0] : phi_of(p.wi);
    const Direction h{p.wi.x + p.wo.x, p.wi.y + p.wo.y, p.wi.z + p.wo.z};
    const double turns = (phi_of(h) - (isotropic ? phi_of(p.wi) : 0)) / (2 * pi) + 0.5;
    const Point u{std::sqrt(2 / pi * theta_of(h)), turns - std::floor(turns)};
    const Mix mix = mixed(azimuth, theta_of(p.wi));
    const Point s = warp_->invert(mix, u);
    double value = 0;
    for (std::size_t k = 0; k < mix.slice.size(); ++k)
      if (mix.weight[k] != 0)
        value += mix.weight[k] * data_(s, mix.slice[k] * channels.size() + channel);
    const double f = value * jacobian(u, theta_of(p.wi), phi_of(p.wi)) / p.wo.z;
    return guard ? guarded(f, mix, s, p.wo.z, channel) : f;
  }

  std::vector<double> theta_i, phi_i;  ///< [rad]
  bool isotropic = true;
  int symmetry = 1;
  std::vector<std::string> channels;

 private:
  static std::vector<double> axis(const TensorFile& file,
                                  const char* name,
                                  double least,
                                  double most) {
    const auto stored = file.floats(file.tensor(name, Tensor::floats, 1));
    std::vector<double> angles(stored.begin(), stored.end());
    for (std::size_t i = 0; i < angles.size(); ++i)
      if (!(angles[i] >= least - 1e-6 && angles[i] <= most + 1e-6) ||
          (i > 0 && !(angles[i] > angles[i - 1])))
        file.fail(name, fmt::format("{}", angles[i]),
                  fmt::format("ascending angles in [{:.4g}, {:.4g}]", least, most));
    return angles;
  }

  /// A field whose last two dimensions are a grid.  \param least  what its values may be at least
  static Image image(const TensorFile& file,
                     const char* name,
                     const Tensor& t,
                     double least,
                     std::uint64_t most = most_values) {
    Image i{t.shape.back(), t.shape[t.shape.size() - 2], {}};
    if (i.width < 2 || i.height < 2)
      file.fail(name, fmt::format("{} × {} nodes", i.height, i.width), "2 × 2 or more");
    i.nodes = file.floats(t, most);
    for (const float v : i.nodes)
      if (least > -1 && !(static_cast<double>(v) >= least && std::isfinite(v)))
        file.fail(name, fmt::format("{}", v), fmt::format("finite numbers from {} on", least));
    return i;
  }

  double jacobian(const Point& u, double theta, double phi) const {
    if (!jacobian_) return 1;
    return ndf_(u) / (4 * sigma_({std::sqrt(2 / pi * theta), phi / (2 * pi) + 0.5}));
  }

  /// f_r over the value stored, at a grid point; NaN where that says nothing.
  double scale_at(const Sample& s, double theta) const {
    return s.pair.wi.z > horizon_cosine && s.pair.wo.z >= least_cosine
               ? jacobian(s.u, theta, phi_of(s.pair.wi)) / s.pair.wo.z
               : std::nan("");
  }
  /// The value f at s, held within the span of the valid grid points around: near the horizon the
  /// cosine divided out is not that of what is interpolated.  Away from it f stays as it is, unless a
  /// grid point has none.
  double guarded(
      double f, const Mix& mix, const Point& s, double cos_o, std::size_t channel) const {
    const Cell cell(s, width(), height());
    double valid = 0, low = std::numeric_limits<double>::infinity(), high = -low;
    bool near_horizon = cos_o < guarded_cosine;
    for (std::size_t k = 0; k < mix.slice.size(); ++k)
      for (const auto& [x, y, part] : cell.corners()) {
        const std::size_t node = y * width() + x;
        const double scale = static_cast<double>(scale_.slice(mix.slice[k])[node]);
        const double weight = mix.weight[k] * part;
        if (weight == 0) continue;
        if (std::isnan(scale)) {
          near_horizon = true;
          continue;
        }
        const float* const nodes = data_.slice(mix.slice[k] * channels.size() + channel);
        low = std::min(low, static_cast<double>(nodes[node]) * scale);
        high = std::max(high, static_cast<double>(nodes[node]) * scale);
        valid += weight;
      }
    if (!near_horizon) return f;
    return valid > 0.5 ? std::clamp(f, low, high) : std::nan("");
  }
  void set_scale() {
    scale_ = {width(), height(), {}};
    scale_.nodes.reserve(phi_i.size() * theta_i.size() * width() * height());
    for (std::size_t p = 0; p < phi_i.size(); ++p)
      for (std::size_t t = 0; t < theta_i.size(); ++t)
        for (std::size_t y = 0; y < height(); ++y)
          for (std::size_t x = 0; x < width(); ++x)
            scale_.nodes.push_back(static_cast<float>(scale_at(sample(p, t, x, y), theta_i[t])));
  }

  /// Into the part of the turn that the file holds.
  void fold(DirectionPair& p) const {
    if (symmetry == 1) return;
    const auto outside = [&](const Direction& d) {
      const double phi = phi_of(d);
      double distance = 2 * pi;
      for (const double turned : {phi - 2 * pi, phi, phi + 2 * pi})
        distance =
            std::min(distance, std::max({phi_i.front() - turned, turned - phi_i.back(), 0.0}));
      return distance;
    };
    const auto mirrored = [](const Direction& d, double x, double y) {
      return Direction{x * d.x, y * d.y, d.z};
    };
    std::array<double, 2> best{1, 1};
    for (const auto& [x, y] :
         {std::array{-1.0, -1.0}, std::array{-1.0, 1.0}, std::array{1.0, -1.0}})
      if ((symmetry == 4 || x == y) &&
          outside(mirrored(p.wi, x, y)) < outside(mirrored(p.wi, best[0], best[1])))
        best = {x, y};
    p = {mirrored(p.wi, best[0], best[1]), mirrored(p.wo, best[0], best[1])};
  }

  Mix mixed(double phi, double theta) const {
    const auto place = [](const std::vector<double>& axis, double at) {
      if (axis.size() < 2) return std::pair{std::size_t{0}, 0.0};
      const auto above = std::ranges::upper_bound(axis, at) - axis.begin();
      const std::size_t i =
          std::clamp<std::size_t>(static_cast<std::size_t>(above), 1, axis.size() - 1) - 1;
      return std::pair{i, std::clamp((at - axis[i]) / (axis[i + 1] - axis[i]), 0.0, 1.0)};
    };
    while (phi < phi_i.front() - 1e-9) phi += 2 * pi;
    while (phi > phi_i.back() + 1e-9 && phi - 2 * pi >= phi_i.front()) phi -= 2 * pi;
    const auto [p, part_p] = isotropic ? std::pair{std::size_t{0}, 0.0} : place(phi_i, phi);
    const auto [t, part_t] = place(theta_i, theta);
    const std::size_t p1 = part_p > 0 ? p + 1 : p, t1 = part_t > 0 ? t + 1 : t, n = theta_i.size();
    return {{p * n + t, p * n + t1, p1 * n + t, p1 * n + t1},
            {(1 - part_p) * (1 - part_t), (1 - part_p) * part_t, part_p * (1 - part_t),
             part_p * part_t}};
  }

  bool jacobian_ = true;
  Image ndf_, sigma_, data_;
  Image scale_;  ///< [φ_i, θ_i][y][x]: see scale_at()
  std::unique_ptr<Warp> warp_;
};

struct Between {
  std::shared_ptr<const Material> material;
  double operator()(const DirectionPair& p, std::size_t channel) const {
    return material->at(p, channel, true);
  }
};

}  // namespace

bool is_rgl(std::string_view head) {
  return head.starts_with(tensor_magic);
}

Table read_rgl(InputFile& in) {
  const auto material = std::make_shared<const Material>(in);
  const Material& m = *material;
  Table t;
  t.format = "rgl";
  t.channels = m.channels;
  t.values.resize(m.channels.size());
  const std::size_t phis = m.isotropic ? 1 : m.phi_i.size();
  const bool closed = !m.isotropic && m.symmetry == 1;
  DirectionList l;
  for (std::size_t p = 0; p < phis; ++p)
    for (std::size_t k = 0; k < m.theta_i.size(); ++k) {
      // One direction under several names: the pole under every φ_i, and the two ends of a full
      // turn.
      if (p > 0 && (m.theta_i[k] == 0 || (closed && p + 1 == phis))) continue;
      for (std::size_t y = 0; y + 1 < m.height(); ++y)
        for (std::size_t x = y == 0 ? 0 : 1; x < m.width(); ++x) {
          const Material::Sample s = m.sample(p, k, x, y);
          const auto& [wi, wo] = s.pair;
          l.theta_i_deg.push_back(theta_of(wi) / degree);
          l.phi_i_deg.push_back(phi_of(wi) / degree);
          l.theta_o_deg.push_back(theta_of(wo) / degree);
          l.phi_o_deg.push_back(phi_of(wo) / degree);
          m.values(p, k, x, y, s, t.values);
        }
    }
  t.where = std::move(l);
  t.between = Between{material};
  return t;
}

RglFunction rgl_function(const Table& t) {
  const auto* const between = t.between.target<Between>();
  if (!between) return {};
  return [material = between->material](const DirectionPair& p, std::size_t channel) {
    return material->at(p, channel, false);
  };
}

}  // namespace gonio
