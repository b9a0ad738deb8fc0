#include "table/rgl.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <memory>
#include <numbers>

#include "base/error.h"
#include "table/rgl_function.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gonio {
namespace {

using std::numbers::pi;
static_assert(std::endian::native == std::endian::little, "the files are little-endian");

constexpr std::string_view kMagic{"tensor_file\0", 12};

struct Tensor {
  std::string name;
  std::uint8_t type;
  std::uint64_t offset;
  std::vector<std::uint64_t> shape;
};
enum Type : std::uint8_t { kByte = 1, kFloat = 10 };

/// The fields of a file, read one by one when asked for.
class TensorFile {
 public:
  explicit TensorFile(InputFile& in) : in_(in) {
    std::array<char, kMagic.size()> magic{};
    in.read(magic.data(), magic.size());
    const auto major = next<std::uint8_t>(), minor = next<std::uint8_t>();
    if (major != 1)
      throw bad_input(in.path(), "byte 12", fmt::format("version {}.{}", major, minor), "1.0");
    const auto count = next<std::uint32_t>();
    if (count > 1024)
      throw bad_input(in.path(), "byte 14", fmt::format("{} fields", count), "at most 1024");
    for (std::uint32_t k = 0; k < count; ++k) {
      Tensor t;
      t.name.resize(next<std::uint16_t>());
      in.read(t.name.data(), t.name.size());
      const std::size_t dimensions = next<std::uint16_t>();
      t.type = next<std::uint8_t>();
      t.offset = next<std::uint64_t>();
      if (dimensions > 8) fail(t.name, fmt::format("{} dimensions", dimensions), "at most 8");
      for (std::size_t d = 0; d < dimensions; ++d) t.shape.push_back(next<std::uint64_t>());
      tensors_.push_back(std::move(t));
    }
  }

  bool has(std::string_view name) const {
    return std::ranges::find(tensors_, name, &Tensor::name) != tensors_.end();
  }
  /// The shape of a field, which must have so many dimensions, none of them empty, and lie in the file.
  const Tensor& tensor(std::string_view name, Type type, std::size_t dimensions) const {
    const auto t = std::ranges::find(tensors_, name, &Tensor::name);
    if (t == tensors_.end()) fail(name, "no such field", "one");
    if (t->type != type)
      fail(name, fmt::format("type {}", t->type),
           type == kByte ? "1 (bytes)" : "10 (32-bit floating point)");
    if (t->shape.size() != dimensions)
      fail(name, fmt::format("{} dimensions", t->shape.size()), fmt::format("{}", dimensions));
    // Divided, not multiplied: the product of 64-bit numbers may not fit.
    std::uint64_t left = t->offset > in_.size() ? 0 : in_.size() - t->offset;
    left /= type == kFloat ? sizeof(float) : 1;
    for (const auto n : t->shape) left = n == 0 ? 0 : left / n;
    if (left == 0)
      fail(name, fmt::format("shape {} at byte {}", fmt::join(t->shape, " × "), t->offset),
           "a field inside the file");
    return *t;
  }
  const Tensor& shaped(std::string_view name, const std::vector<std::uint64_t>& shape) const {
    const Tensor& t = tensor(name, kFloat, shape.size());
    if (t.shape != shape)
      fail(name, fmt::format("shape {}", fmt::join(t.shape, " × ")),
           fmt::format("{}", fmt::join(shape, " × ")));
    return t;
  }
  std::vector<float> floats(const Tensor& t) const {
    std::uint64_t count = 1;
    for (const auto n : t.shape) count *= n;  // at most the file's size: see tensor()
    const std::uint64_t most = t.name == "vndf" ? most_values / 4 : most_values;  // cumulated too
    if (count > most)
      fail(t.name, fmt::format("{} values", count), fmt::format("at most {}", most));
    std::vector<float> values(count);
    in_.read_at(t.offset, values.data(), count * sizeof(float));
    return values;
  }
  bool flag(std::string_view name) const {
    const Tensor& t = tensor(name, kByte, 1);
    char value = 0;
    in_.read_at(t.offset, &value, 1);
    return value != 0;
  }
  [[noreturn]] void fail(std::string_view field,
                         const std::string& found,
                         const std::string& expected) const {
    throw bad_input(in_.path(), fmt::format("field {}", field), found, expected);
  }

 private:
  template <class T>
  T next() {
    T value{};
    in_.read(&value, sizeof value);
    return value;
  }

  InputFile& in_;
  std::vector<Tensor> tensors_;
};

struct Point {
  double x, y;
};

/// A point of the unit square in a grid of width × height nodes.
struct Cell {
  std::size_t x, y;
  double part_x, part_y;

  Cell(const Point& p, std::size_t width, std::size_t height) {
    const auto place = [](double u, std::size_t n, std::size_t& i, double& part) {
      const double at = std::clamp(u, 0.0, 1.0) * static_cast<double>(n - 1);
      i = std::min(static_cast<std::size_t>(at), n - 2);
      part = at - static_cast<double>(i);
    };
    place(p.x, width, x, part_x);
    place(p.y, height, y, part_y);
  }

  struct Corner {
    std::size_t x, y;
    double weight;
  };
  std::array<Corner, 4> corners() const {
    return {{{x, y, (1 - part_x) * (1 - part_y)},
             {x + 1, y, part_x * (1 - part_y)},
             {x, y + 1, (1 - part_x) * part_y},
             {x + 1, y + 1, part_x * part_y}}};
  }
};

/// f over the nodes of a grid [slice][y][x]; bilinear between them.
struct Image {
  std::size_t width = 0, height = 0;
  std::vector<float> nodes;

  const float* slice(std::size_t k) const { return nodes.data() + k * width * height; }
  double operator()(const Point& p, std::size_t k = 0) const {
    const Cell c(p, width, height);
    const float* low = slice(k) + c.y * width + c.x;
    const auto along = [&](const float* v) {
      return std::lerp(static_cast<double>(v[0]), static_cast<double>(v[1]), c.part_x);
    };
    return std::lerp(along(low), along(low + width), c.part_y);
  }
};

/// Slices to be mixed, with their weights.
struct Mix {
  std::array<std::size_t, 4> slice{};
  std::array<double, 4> weight{};
};

/// ∫₀ˣ of a density that goes linearly from a to b over the unit interval, and its inverse.
double integral(double a, double b, double x) {
  return x * (a + x / 2 * (b - a));
}
double inverse_integral(double a, double b, double area) {
  const double root = std::sqrt(std::max(a * a + 2 * (b - a) * area, 0.0));
  return a + root > 0 ? std::min(2 * area / (a + root), 1.0) : 0;
}

/// The last i < n of an ascending sequence that is not above v; 0 if there is none.
template <class Sequence>
std::size_t last_not_above(std::size_t n, double v, Sequence at) {
  std::size_t i = 0;
  for (std::size_t step = std::bit_floor(n); step > 0; step /= 2)
    if (i + step < n && at(i + step) <= v) i += step;
  return i;
}

/// Densities over the unit square, bilinear between nodes, each of integral 1; and the mapping that
/// makes them uniform: y by the marginal distribution over rows, x by the conditional one in the row.
class Warp {
 public:
  Warp(Image density, std::size_t slices) : density_(std::move(density)) {
    const std::size_t w = density_.width, h = density_.height;
    rows_.resize(slices * h * w);
    marginal_.resize(slices * h);
    for (std::size_t k = 0; k < slices; ++k) {
      float* const d = density_.nodes.data() + k * w * h;
      double* const rows = rows_.data() + k * w * h;
      double* const marginal = marginal_.data() + k * h;
      sums(d, rows, marginal);
      const double total = marginal[h - 1];
      // A density of nothing is taken as even.
      if (!(total > 0)) std::fill_n(d, w * h, 1.0F);
      const double scale = total > 0 ? 1 / total : 1;
      for (std::size_t i = 0; i < w * h; ++i)
        d[i] = static_cast<float>(static_cast<double>(d[i]) * scale);
      sums(d, rows, marginal);
    }
  }

  Point sample(std::size_t slice, const Point& s) const {
    const std::size_t w = density_.width, h = density_.height;
    const double* const marginal = marginal_.data() + slice * h;
    const double* const rows = rows_.data() + slice * w * h;
    const double y_area = s.y * marginal[h - 1];
    const std::size_t y = last_not_above(h - 1, y_area, [&](std::size_t i) { return marginal[i]; });
    const double low = rows[y * w + w - 1], high = rows[(y + 1) * w + w - 1];
    const double part_y = inverse_integral(low, high, y_area - marginal[y]);
    const auto row_area = [&](std::size_t x) {
      return std::lerp(rows[y * w + x], rows[(y + 1) * w + x], part_y);
    };
    const double x_area = s.x * row_area(w - 1);
    const std::size_t x = last_not_above(w - 1, x_area, row_area);
    const float* const d = density_.slice(slice) + y * w + x;
    const auto at = [&](std::size_t dx) {
      return std::lerp(static_cast<double>(d[dx]), static_cast<double>(d[w + dx]), part_y);
    };
    const double part_x = inverse_integral(at(0), at(1), x_area - row_area(x));
    return {(static_cast<double>(x) + part_x) / static_cast<double>(w - 1),
            (static_cast<double>(y) + part_y) / static_cast<double>(h - 1)};
  }

  /// Of densities mixed.
  Point invert(const Mix& mix, const Point& u) const {
    const std::size_t w = density_.width, h = density_.height;
    const Cell c(u, w, h);
    double y_area = 0, x_area = 0, y_all = 0, x_all = 0;
    for (std::size_t k = 0; k < mix.slice.size(); ++k) {
      if (mix.weight[k] == 0) continue;
      const double* const marginal = marginal_.data() + mix.slice[k] * h;
      const double* const row = rows_.data() + (mix.slice[k] * h + c.y) * w;
      const float* const d = density_.slice(mix.slice[k]) + c.y * w + c.x;
      const auto at = [&](std::size_t dx) {
        return std::lerp(static_cast<double>(d[dx]), static_cast<double>(d[w + dx]), c.part_y);
      };
      y_area += mix.weight[k] * (marginal[c.y] + integral(row[w - 1], row[2 * w - 1], c.part_y));
      y_all += mix.weight[k] * marginal[h - 1];
      x_area += mix.weight[k] *
                (std::lerp(row[c.x], row[w + c.x], c.part_y) + integral(at(0), at(1), c.part_x));
      x_all += mix.weight[k] * std::lerp(row[w - 1], row[2 * w - 1], c.part_y);
    }
    // Where there is no density the mapping is not defined: any continuation will do.
    return {x_all > 0 ? x_area / x_all : u.x, y_all > 0 ? y_area / y_all : u.y};
  }

 private:
  void sums(const float* d, double* rows, double* marginal) const {
    const std::size_t w = density_.width, h = density_.height;
    for (std::size_t y = 0; y < h; ++y) {
      double sum = 0;
      for (std::size_t x = 0; x < w; ++x) {
        if (x > 0)
          sum += (static_cast<double>(d[y * w + x - 1]) + static_cast<double>(d[y * w + x])) / 2;
        rows[y * w + x] = sum;
      }
      marginal[y] = y == 0 ? 0 : marginal[y - 1] + (rows[y * w - 1] + rows[y * w + w - 1]) / 2;
    }
  }

  Image density_;
  std::vector<double> rows_, marginal_;  ///< cumulated: [slice][y][x], [slice][y]
};

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
    ndf_ = image(file, "ndf", file.tensor("ndf", kFloat, 2), 0);
    sigma_ = image(file, "sigma", file.tensor("sigma", kFloat, 2), 0);
    const Tensor& vndf = file.tensor("vndf", kFloat, 4);
    file.shaped("vndf", {n_phi, n_theta, vndf.shape[2], vndf.shape[3]});
    warp_ = std::make_unique<Warp>(image(file, "vndf", vndf, 0), n_phi * n_theta);

    const bool spectral = file.has("wavelengths");
    if (spectral) {
      for (const float nm : file.floats(file.tensor("wavelengths", kFloat, 1)))
        channels.push_back(fmt::format("{:.6g}", nm));
      auto sorted = channels;
      std::ranges::sort(sorted);
      if (std::ranges::adjacent_find(sorted) != sorted.end())
        file.fail("wavelengths", *std::ranges::adjacent_find(sorted) + " twice", "each once");
    } else {
      channels = {"r", "g", "b"};
    }
    const char* const name = spectral ? "spectra" : "rgb";
    const Tensor& data = file.tensor(name, kFloat, 5);
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

  /// f_r; \param guarded  see rgl_function(); else as the format interpolates it, above the horizon
  double at(DirectionPair p, std::size_t channel, bool guarded) const {
    if (!(p.wi.z > 0 && p.wo.z > 0)) return std::nan("");
    if (guarded && (p.wo.z < least_cosine || theta_of(p.wi) > theta_i.back() + 1e-6))
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
    return guarded ? within_span(f, mix, s, channel) : f;
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
    const auto stored = file.floats(file.tensor(name, kFloat, 1));
    std::vector<double> angles(stored.begin(), stored.end());
    for (std::size_t i = 0; i < angles.size(); ++i)
      if (!(angles[i] >= least - 1e-6 && angles[i] <= most + 1e-6) ||
          (i > 0 && !(angles[i] > angles[i - 1])))
        file.fail(name, fmt::format("{}", angles[i]),
                  fmt::format("ascending angles in [{:.4g}, {:.4g}]", least, most));
    return angles;
  }

  /// A field whose last two dimensions are a grid.  \param least  what its values may be at least
  static Image image(const TensorFile& file, const char* name, const Tensor& t, double least) {
    Image i{t.shape.back(), t.shape[t.shape.size() - 2], {}};
    if (i.width < 2 || i.height < 2)
      file.fail(name, fmt::format("{} × {} nodes", i.height, i.width), "2 × 2 or more");
    i.nodes = file.floats(t);
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
  double within_span(double f, const Mix& mix, const Point& s, std::size_t channel) const {
    const Cell cell(s, width(), height());
    double valid = 0, low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::size_t k = 0; k < mix.slice.size(); ++k)
      for (const auto& [x, y, part] : cell.corners()) {
        const std::size_t node = y * width() + x;
        const double scale = static_cast<double>(scale_.slice(mix.slice[k])[node]);
        const double weight = mix.weight[k] * part;
        if (weight == 0 || std::isnan(scale)) continue;
        const float* const nodes = data_.slice(mix.slice[k] * channels.size() + channel);
        low = std::min(low, static_cast<double>(nodes[node]) * scale);
        high = std::max(high, static_cast<double>(nodes[node]) * scale);
        valid += weight;
      }
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
  return head.starts_with(kMagic);
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
