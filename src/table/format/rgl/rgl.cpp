#include "table/format/rgl/rgl.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <numbers>

#include "base/error.h"
#include "table/format/rgl/function.h"
#include "table/format/rgl/material.h"
#include "table/format/rgl/tensor_file.h"

#include <fmt/format.h>

namespace gonio {
namespace {

using std::numbers::pi;
using namespace rgl;

/// The field in which gonio marks grid points whose value it made up; renderers pass over it.
constexpr const char* invented = "gonio_invented";

std::vector<double> axis(const TensorFile& file, const char* name, double least, double most) {
  const auto stored = file.floats(file.tensor(name, Tensor::floats, 1));
  std::vector<double> angles(stored.begin(), stored.end());
  for (std::size_t i = 0; i < angles.size(); ++i)
    if (!(angles[i] >= least - 1e-6 && angles[i] <= most + 1e-6) ||
        (i > 0 && !(angles[i] > angles[i - 1])))
      file.fail(name, fmt::format("{}", angles[i]),
                fmt::format("ascending angles in [{:.4g}, {:.4g}]", least, most));
  return angles;
}

/// Parts of a turn that are alike, of an anisotropic file.
int symmetry_of(const TensorFile& file, const std::vector<double>& phi_i) {
  if (phi_i.size() <= 2) return 1;
  const double span = phi_i.back() - phi_i.front();
  const auto symmetry = static_cast<int>(std::lround(2 * pi / span));
  if ((symmetry != 1 && symmetry != 2 && symmetry != 4) ||
      !(std::abs(span * symmetry - 2 * pi) < 1e-3))
    file.fail("phi_i", fmt::format("{:.4g} of a turn", span / (2 * pi)),
              "a whole, a half or a quarter");
  return symmetry;
}

/// A field whose last two dimensions are a grid.  \param least  what its values may be at least
Image image(const TensorFile& file,
            const char* name,
            const Tensor& t,
            double least,
            std::uint64_t most = most_values) {
  Image i{static_cast<std::size_t>(t.shape.back()),
          static_cast<std::size_t>(t.shape[t.shape.size() - 2]),
          {}};
  if (i.width < 2 || i.height < 2)
    file.fail(name, fmt::format("{} × {} nodes", i.height, i.width), "2 × 2 or more");
  i.nodes = file.floats(t, most);
  for (const float v : i.nodes)
    if (least > -1 && !(static_cast<double>(v) >= least && std::isfinite(v)))
      file.fail(name, fmt::format("{}", v), fmt::format("finite numbers from {} on", least));
  return i;
}

std::vector<std::string> wavelengths_of(const TensorFile& file) {
  const auto& wavelengths = file.tensor("wavelengths", Tensor::floats, 1);
  if (wavelengths.shape[0] > most_channels)
    file.fail("wavelengths", fmt::format("{} channels", wavelengths.shape[0]),
              fmt::format("at most {}", most_channels));
  std::vector<std::string> names;
  for (const float nm : file.floats(wavelengths)) names.push_back(fmt::format("{:.6g}", nm));
  auto sorted = names;
  std::ranges::sort(sorted);
  if (std::ranges::adjacent_find(sorted) != sorted.end())
    file.fail("wavelengths", *std::ranges::adjacent_find(sorted) + " twice", "each once");
  return names;
}

Material read_material(InputFile& in) {
  const TensorFile file(in);
  Fields f;
  f.theta_i = axis(file, "theta_i", 0, pi / 2);
  f.phi_i = axis(file, "phi_i", -2 * pi, 2 * pi);
  const int symmetry = symmetry_of(file, f.phi_i);
  const std::uint64_t n_phi = f.phi_i.size(), n_theta = f.theta_i.size();
  f.jacobian = file.flag("jacobian");
  f.ndf = image(file, "ndf", file.tensor("ndf", Tensor::floats, 2), 0);
  f.sigma = image(file, "sigma", file.tensor("sigma", Tensor::floats, 2), 0);
  const Tensor& vndf = file.tensor("vndf", Tensor::floats, 4);
  file.shaped("vndf", {n_phi, n_theta, vndf.shape[2], vndf.shape[3]});
  f.vndf = image(file, "vndf", vndf, 0, most_values / 4);  // cumulated too
  f.spectral = file.has("wavelengths");
  f.channels = f.spectral ? wavelengths_of(file) : std::vector<std::string>{"r", "g", "b"};
  const char* const name = f.spectral ? "spectra" : "rgb";
  const Tensor& data = file.tensor(name, Tensor::floats, 5);
  file.shaped(name, {n_phi, n_theta, f.channels.size(), data.shape[3], data.shape[4]});
  f.data = image(file, name, data, -std::numeric_limits<double>::infinity());
  // The list has four angles for each sample beside the values.
  const std::uint64_t samples = n_phi * n_theta * f.data.width * f.data.height;
  if (samples * (f.channels.size() + 4) > most_values)
    file.fail(name, fmt::format("{} samples × {} channels", samples, f.channels.size()),
              fmt::format("at most {} numbers", most_values));
  if (file.has(invented))
    f.invented = file.bytes(invented, {n_phi, n_theta, data.shape[3], data.shape[4]});
  return Material(std::move(f), symmetry);
}

/// Density over the unit square of an incident direction by which f cos θ_o is drawn: that of f cos θ_o in wo, times dω_o over the
/// square's area, 4 (wi·m) 2π² u sin θ_m over the density of m.  Up to scale.
Image luminance_of(const Material& m) {
  const std::size_t n = m.channels.size(), nodes = m.width() * m.height();
  std::vector<double> share(n, 1 / static_cast<double>(n));
  if (!m.spectral) share = {0.2126, 0.7152, 0.0722};
  const double first = 1 / static_cast<double>(m.vndf().width - 1);
  Image luminance{m.width(), m.height(), {}};
  for (std::size_t slice = 0; slice < m.phi_i.size() * m.theta_i.size(); ++slice) {
    double sum = 0;
    for (std::size_t i = 0; i < nodes; ++i) {
      auto [pair, u] = m.sample(slice / m.theta_i.size(), slice % m.theta_i.size(), i % m.width(),
                                i / m.width());
      u.x = std::max(u.x, first);  // at the pole the quotient is one of zeros
      const Direction facet = direction_at(u);
      const double density = m.vndf()(u, slice);
      double v = 0;
      for (std::size_t c = 0; c < n; ++c)
        v += share[c] * std::max(static_cast<double>(m.data.slice(slice * n + c)[i]), 0.0);
      if (m.has_jacobian) v *= m.ndf(u);
      v *= std::max(dot(pair.wi, facet), 0.0) * u.x * std::hypot(facet.x, facet.y);
      luminance.nodes.push_back(density > 0 ? static_cast<float>(v / density) : 0.0F);
      sum += static_cast<double>(luminance.nodes.back());
    }
    // A renderer divides by the sum: of what reflects nothing all is drawn alike.
    if (!(sum > 0))
      std::fill_n(luminance.nodes.end() - static_cast<std::ptrdiff_t>(nodes), nodes, 1.0F);
  }
  return luminance;
}

}  // namespace

bool is_rgl(std::string_view head) {
  return head.starts_with(tensor_magic);
}

Table read_rgl(InputFile& in) {
  return table_of(std::make_shared<const Material>(read_material(in)));
}

void write_rgl(const Table& t, OutputFile& out, const std::string& path) {
  const auto material = material_of(t);
  if (!material)
    throw bad_input(path, "writing", "a table that was not resampled",
                    "one that gonio convert or synth made for this format");
  const Material& m = *material;
  const std::uint64_t n_phi = m.phi_i.size(), n_theta = m.theta_i.size(), n = m.channels.size();
  const std::vector<float> phi_i(m.phi_i.begin(), m.phi_i.end()),
      theta_i(m.theta_i.begin(), m.theta_i.end());
  std::vector<float> wavelengths;
  if (m.spectral)
    for (const auto& name : m.channels) wavelengths.push_back(std::stof(name));
  const Image luminance = luminance_of(m);
  TensorWriter file;
  file.bytes("description", "resampled by gonio");
  file.floats("phi_i", {n_phi}, phi_i);
  file.floats("theta_i", {n_theta}, theta_i);
  file.floats("ndf", {m.ndf.height, m.ndf.width}, m.ndf.nodes);
  file.floats("sigma", {m.sigma.height, m.sigma.width}, m.sigma.nodes);
  file.floats("vndf", {n_phi, n_theta, m.vndf().height, m.vndf().width}, m.vndf().nodes);
  file.floats("luminance", {n_phi, n_theta, m.height(), m.width()}, luminance.nodes);
  file.floats(m.spectral ? "spectra" : "rgb", {n_phi, n_theta, n, m.height(), m.width()},
              m.data.nodes);
  if (m.spectral) file.floats("wavelengths", {n}, wavelengths);
  if (!m.invented.empty())
    file.bytes(invented, {n_phi, n_theta, m.height(), m.width()}, m.invented);
  file.bytes("jacobian", m.has_jacobian ? std::string_view("\1", 1) : std::string_view("\0", 1));
  file.write(out);
}

RglFunction rgl_function(const Table& t) {
  auto material = material_of(t);
  if (!material) return {};
  return [material = std::move(material)](const DirectionPair& p, std::size_t channel) {
    return material->at(p, channel, false);
  };
}

}  // namespace gonio
