#pragma once
/// \file
/// Files in formats that gonio reads and does not write, made from functions of directions.

#include <array>
#include <cstdint>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "geometry/direction.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gonio::test {

using Brdf = std::function<double(const DirectionPair&, std::size_t channel)>;

template <class T>
std::string bytes_of(const T& value) {
  return {reinterpret_cast<const char*>(&value), sizeof value};
}

struct TensorField {
  std::string name;
  std::uint8_t type;  ///< 1 bytes, 10 floats
  std::vector<std::uint64_t> shape;
  std::string data;
};

inline TensorField floats_field(std::string name,
                                std::vector<std::uint64_t> shape,
                                const std::vector<float>& v) {
  return {std::move(name),
          10,
          std::move(shape),
          {reinterpret_cast<const char*>(v.data()), v.size() * sizeof(float)}};
}

inline std::string tensor_file(const std::vector<TensorField>& fields) {
  std::uint64_t offset = 18;
  for (const auto& f : fields) offset += 13 + f.name.size() + 8 * f.shape.size();
  std::string head =
      std::string("tensor_file\0\1\0", 14) + bytes_of(static_cast<std::uint32_t>(fields.size()));
  std::string data;
  for (const auto& f : fields) {
    head += bytes_of(static_cast<std::uint16_t>(f.name.size())) + f.name +
            bytes_of(static_cast<std::uint16_t>(f.shape.size())) + bytes_of(f.type) +
            bytes_of(offset + data.size());
    for (const auto n : f.shape) head += bytes_of(n);
    data += f.data;
  }
  return head + data;
}

struct Square {
  double x, y;
};

/// An RGL file.  The facets' density over the unit square is x (1 + 2 y) up to scale unless `even`, so
/// that s = (x², (y + y²)/2) in closed form.
struct RglFile {
  std::vector<float> phi_i{0}, theta_i{0, 0.4F, 0.8F, 1.2F};
  std::size_t size = 8;              ///< of the grid of values
  std::vector<float> wavelengths{};  ///< empty: r, g, b
  bool jacobian = true, even = false;
  bool grooved = false;  ///< the facets' projected area depends on the azimuth
  Brdf f{};

  std::size_t channels() const { return wavelengths.empty() ? 3 : wavelengths.size(); }
  static double ndf(double u) { return 1 - 0.5 * u; }
  double sigma(double theta, double phi) const {
    using std::numbers::pi;
    const double along = grooved ? std::abs(phi) / pi : 0;
    return 1 - (0.25 + 0.5 * along) * std::sqrt(2 / pi * theta);
  }

  Square facet(std::size_t x, std::size_t y) const {
    const auto n = static_cast<double>(size - 1);
    const Square s{static_cast<double>(x) / n, static_cast<double>(y) / n};
    return even ? s : Square{std::sqrt(s.x), (std::sqrt(1 + 8 * s.y) - 1) / 2};
  }
  DirectionPair pair(double theta, double phi, const Square& u) const {
    using std::numbers::pi;
    const Direction wi = direction(theta, phi),
                    m = direction(u.x * u.x * pi / 2,
                                  (2 * u.y - 1) * pi + (phi_i.size() > 2 ? 0 : phi));
    const double twice = 2 * dot(wi, m);
    return {wi, {twice * m.x - wi.x, twice * m.y - wi.y, twice * m.z - wi.z}};
  }
  std::vector<TensorField> fields() const {
    std::vector<float> density, values;
    for (const float phi : phi_i)
      for (const float theta : theta_i) {
        density.insert(density.end(), {0, 1, 0, 3});
        for (std::size_t c = 0; c < channels(); ++c)
          for (std::size_t y = 0; y < size; ++y)
            for (std::size_t x = 0; x < size; ++x) {
              const Square u = facet(x, y);
              const auto p = pair(static_cast<double>(theta), static_cast<double>(phi), u);
              const double factor =
                  jacobian
                      ? ndf(u.x) / (4 * sigma(static_cast<double>(theta), static_cast<double>(phi)))
                      : 1;
              values.push_back(static_cast<float>(f(p, c) * p.wo.z / factor));
            }
      }
    const float side = grooved ? 0.25F : 0.75F;
    if (even) density.assign(density.size(), 5);
    const auto n_phi = phi_i.size(), n_theta = theta_i.size();
    std::vector<TensorField> all{{"description", 1, {4}, "test"},
                                 floats_field("phi_i", {n_phi}, phi_i),
                                 floats_field("theta_i", {n_theta}, theta_i),
                                 floats_field("ndf", {2, 2}, {1, 0.5F, 1, 0.5F}),
                                 floats_field("sigma", {3, 2}, {1, side, 1, 0.75F, 1, side}),
                                 floats_field("vndf", {n_phi, n_theta, 2, 2}, density),
                                 floats_field(wavelengths.empty() ? "rgb" : "spectra",
                                              {n_phi, n_theta, channels(), size, size}, values),
                                 {"jacobian", 1, {1}, std::string(1, jacobian ? '\1' : '\0')}};
    if (!wavelengths.empty())
      all.push_back(floats_field("wavelengths", {wavelengths.size()}, wavelengths));
    return all;
  }
  std::string bytes() const { return tensor_file(fields()); }
};

/// A BSDF in LBNL's XML.
struct KlemsFile {
  struct Ring {
    double low, high;
    int patches;
  };
  /// The half basis.
  std::vector<Ring> rings{{0, 6.5, 1},      {6.5, 19.5, 8},   {19.5, 32.5, 12}, {32.5, 46.5, 16},
                          {46.5, 61.5, 20}, {61.5, 76.5, 12}, {76.5, 90, 4}};
  bool columns = true;
  std::vector<std::string> bands{"Visible"}, directions{"Reflection Front"};
  /// \param block  counts them
  std::function<double(const DirectionPair&, std::size_t block)> f{};

  /// As an outgoing direction has it.
  std::vector<Direction> centres() const {
    std::vector<Direction> all;
    for (const auto& r : rings)
      for (int k = 0; k < r.patches; ++k)
        all.push_back(direction((r.low == 0 ? 0 : (r.low + r.high) / 2) * degree,
                                2 * std::numbers::pi * k / r.patches));
    return all;
  }
  std::string matrix(std::size_t block) const {
    std::string text;
    for (const Direction& row : centres()) {
      for (const Direction& column : centres()) {
        const Direction& in = columns ? column : row;
        text += fmt::format("{:.9g}, ", f({{-in.x, -in.y, in.z}, columns ? row : column}, block));
      }
      text += "\n";
    }
    return text;
  }
  std::string bytes() const {
    std::string text = fmt::format(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<WindowElement><Optical><Layer>\n"
        "<DataDefinition><IncidentDataStructure>{}</IncidentDataStructure>\n<AngleBasis>"
        "<AngleBasisName>LBNL/Klems Half</AngleBasisName>\n",
        columns ? "Columns" : "Rows");
    for (const auto& r : rings)
      text += fmt::format(
          "<AngleBasisBlock><Theta>{}</Theta><ThetaBounds><LowerTheta>{}</LowerTheta>"
          "<UpperTheta>{}</UpperTheta></ThetaBounds><nPhis>{}</nPhis></AngleBasisBlock>\n",
          (r.low + r.high) / 2, r.low, r.high, r.patches);
    text += "</AngleBasis></DataDefinition>\n";
    std::size_t block = 0;
    for (const auto& band : bands)
      for (const auto& direction : directions)
        text += fmt::format(
            "<WavelengthData><Wavelength unit=\"Integral\"> {} </Wavelength>"
            "<WavelengthDataBlock><WavelengthDataDirection>{}</WavelengthDataDirection>"
            "<ColumnAngleBasis>LBNL/Klems Half</ColumnAngleBasis>"
            "<RowAngleBasis>LBNL/Klems Half</RowAngleBasis>\n<ScatteringData>\n{}</ScatteringData>"
            "</WavelengthDataBlock></WavelengthData>\n",
            band, direction, matrix(block++));
    return text + "</Layer></Optical></WindowElement>\n";
  }
};

/// An SSDD file of two samples.  \param type  PARAM_TYPE less its ending
inline std::string ssdd_file(const std::string& type,
                             const std::string& mode,
                             const std::string& numbers) {
  return "VERSION 0.3\nDATA_TYPE brdf\nCOLOR_MODEL monochrome\nPARAM_TYPE " + type +
         "_coordinate_system\nPARAM0_LIST 10 20\nPARAM2_LIST 30\nPARAM3_LIST 0\nDATA " + mode +
         "\n" + numbers;
}

/// A file of MIT CSAIL's anisotropic measurements.  \param value  of a bin, by its number; without it there are none
template <class Value = std::nullptr_t>
std::string ngan_file(const std::array<std::int32_t, 4>& bins, bool half, Value value) {
  std::array<std::int32_t, 16> header{bins[0], bins[1], bins[2], bins[3]};
  header[6] = 1;
  header[9] = half;
  header[10] = 3;
  std::string bytes = bytes_of(header);
  if constexpr (!std::is_same_v<Value, std::nullptr_t>)
    for (std::size_t k = 0; k < 3 * std::size_t(bins[0] * bins[1] * bins[2] * bins[3]); ++k)
      bytes += bytes_of(static_cast<float>(value(k)));
  return bytes;
}

/// A tabulated BSDF of Zemax, its directions computed by rotating the mirror direction and not as the reader does.
struct ZemaxFile {
  std::string symmetry = "PlaneSymmetrical";
  std::vector<double> rotation{0}, incident{0, 30, 75}, azimuth{0, 60, 120, 180},
      radius{0, 10, 40, 80};
  bool xyz = false;
  Brdf f{};

  /// Radius towards the normal within the plane of incidence, then a turn about the mirror direction (Rodrigues).
  static Direction outgoing(double incident, double azimuth, double radius) {
    const Direction k = direction(incident * degree, std::numbers::pi);
    const double zenith = (incident - radius) * degree;
    const Direction v{-std::sin(zenith), 0, std::cos(zenith)};
    const double c = std::cos(azimuth * degree), s = std::sin(azimuth * degree),
                 along = dot(k, v) * (1 - c);
    return {v.x * c + (k.y * v.z - k.z * v.y) * s + k.x * along,
            v.y * c + (k.z * v.x - k.x * v.z) * s + k.y * along,
            v.z * c + (k.x * v.y - k.y * v.x) * s + k.z * along};
  }
  std::string bytes() const {
    std::string text = fmt::format(
        "# made by a test\r\nSource\tMeasured\nsymmetry {}\nSpectralContent {}\nScatterType BRDF\n"
        "SampleRotation {}\n{}\nAngleOfIncidence {}\n{}\nScatterAzimuth {}\n{}\nScatterRadial "
        "{}\n{}\n",
        symmetry, xyz ? "XYZ" : "Monochrome", rotation.size(), fmt::join(rotation, " "),
        incident.size(), fmt::join(incident, " "), azimuth.size(), fmt::join(azimuth, "\t"),
        radius.size(), fmt::join(radius, " "));
    for (std::size_t c = 0; c < (xyz ? 3 : 1); ++c) {
      text += fmt::format("\n{}\nDataBegin\n",
                          xyz ? fmt::format("Tristimulus{}", "XYZ"[c]) : "Monochrome");
      for (const double turn : rotation)
        for (const double theta : incident) {
          text += "TIS 0.5\n";
          for (const double a : azimuth) {
            for (const double r : radius) {
              const auto wo = outgoing(theta, a, r);
              const auto turned = [&](const Direction& d) {
                return direction(theta_of(d), phi_of(d) - turn * degree);
              };
              text += fmt::format(
                  "{:.9g} ",
                  wo.z > 0 ? f({turned(direction(theta * degree, 0)), turned(wo)}, c) : 0);
            }
            text += "\n";
          }
        }
      text += "DataEnd\n";
    }
    return text;
  }
};

/// A tensor tree in LBNL's XML.
inline std::string tensor_tree_file(std::size_t axes,
                                    const std::string& braces,
                                    const std::string& side = "Reflection Front") {
  return fmt::format(
      "<?xml version=\"1.0\"?>\n<WindowElement><Optical><Layer><DataDefinition>"
      "<IncidentDataStructure>TensorTree{}</IncidentDataStructure></DataDefinition><WavelengthData>"
      "<Wavelength>Visible</Wavelength><WavelengthDataBlock><WavelengthDataDirection>{}"
      "</WavelengthDataDirection><AngleBasis>LBNL/Shirley-Chiu</AngleBasis><ScatteringData>\n{}\n"
      "</ScatteringData></WavelengthDataBlock></WavelengthData></Layer></Optical></"
      "WindowElement>\n",
      axes, side, braces);
}

/// \param rows  the numbers of each sample
inline std::string alta_file(const std::string& in,
                             const std::string& out,
                             std::size_t n_in,
                             std::size_t n_out,
                             const std::vector<std::vector<double>>& rows) {
  std::string text = fmt::format(
      "#ALTA_BEGIN_HEADER\n#DIM {} {}\n#VS 0\n#PARAM_IN {}\n#PARAM_OUT {}\n"
      "#ALTA_END_HEADER\n",
      n_in, n_out, in, out);
  for (const auto& row : rows) {
    for (const double v : row) text += fmt::format("{:.17g} ", v);
    text += "\n";
  }
  return text;
}

}  // namespace gonio::test
