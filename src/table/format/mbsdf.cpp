#include "table/format/mbsdf.h"

#include <numbers>

#include "base/error.h"

#include <fmt/format.h>

namespace gonio {
namespace {

constexpr std::string_view kMagic = "NVIDIA ARC MBSDF", kVersion = "NVIDIA ARC MBSDF V1\n",
                           kReflection = "MBSDF_DATA_REFLECTION=\n";

void expect(InputFile& in, std::string_view line) {
  const auto place = fmt::format("byte {}", in.position());
  std::string found = in.peek(line.size());
  if (found != line)
    throw bad_input(in.path(), place, found.substr(0, found.find('\n')),
                    std::string(line.substr(0, line.size() - 1)));
  in.read(found.data(), found.size());
}

}  // namespace

Grid mbsdf_grid(std::size_t n_theta, std::size_t n_phi, Bins bins) {
  using enum Axis::Spacing;
  using std::numbers::pi;
  return {Grid::Kind::in_out,
          {{{"theta_i", uniform, n_theta, pi / 2},
            {"theta_o", uniform, n_theta, pi / 2},
            {"phi", inclusive, n_phi, pi}}},
          bins};
}

bool is_mbsdf(std::string_view head) {
  return head.starts_with(kMagic);
}

Table read_mbsdf(InputFile& in) {
  expect(in, kVersion);
  expect(in, kReflection);  // transmission has no place in a table of reflectance
  std::array<std::uint32_t, 3> header{};
  const auto place = fmt::format("byte {}", in.position());
  in.read(header.data(), sizeof header);
  const auto [type, n_theta, n_phi] = header;
  const std::size_t channels = type == 0 ? 1 : 3;
  const std::uint64_t floats = (in.size() - in.position()) / sizeof(float);
  const bool even = (in.size() - in.position()) % sizeof(float) == 0;
  if (type > 1)
    throw bad_input(in.path(), place, fmt::format("type {}", type), "0 (scalar) or 1 (RGB)");
  // Divided, not multiplied: the product of three 32-bit numbers may not fit.
  const std::uint64_t row = channels * std::uint64_t{n_phi};
  if (n_theta < 1 || n_phi < 2 || !even || floats % row != 0 || floats / row % n_theta != 0 ||
      floats / row / n_theta != n_theta)
    throw bad_input(in.path(), place,
                    fmt::format("{} × {} × {} × {} values in {} bytes", n_theta, n_theta, n_phi,
                                channels, in.size() - in.position()),
                    "4 bytes for each value, at least 1 × 1 × 2");
  if (floats > most_values)
    throw bad_input(in.path(), place, fmt::format("{} values", floats),
                    fmt::format("at most {}", most_values));
  Table t;
  t.format = "mbsdf";
  t.channels = type == 0 ? std::vector<std::string>{"f"} : std::vector<std::string>{"r", "g", "b"};
  const Grid grid = mbsdf_grid(n_theta, n_phi, Bins::centre);
  t.where = grid;
  for (std::size_t c = 0; c < channels; ++c) t.values.emplace_back(grid.size());
  std::vector<float> pixels(row);
  for (std::size_t i = 0; i < grid.size(); i += n_phi) {
    in.read(pixels.data(), pixels.size() * sizeof(float));
    for (std::size_t k = 0; k < pixels.size(); ++k)
      t.values[k % channels][i + k / channels] = static_cast<double>(pixels[k]);
  }
  return t;
}

void write_mbsdf(const Table& t, OutputFile& out, const std::string& path) {
  const Grid* g = t.grid();
  if (!g || *g != mbsdf_grid(g->axes[0].size, g->axes[2].size, g->bins) ||
      (t.values.size() != 1 && t.values.size() != 3))
    throw bad_input(path, "writing", "a table of another shape",
                    "one or three channels on MBSDF's theta_i × theta_o × phi");
  const std::size_t channels = t.values.size(), n_phi = g->axes[2].size;
  const std::array<std::uint32_t, 3> header{channels == 1 ? 0U : 1U,
                                            static_cast<std::uint32_t>(g->axes[0].size),
                                            static_cast<std::uint32_t>(n_phi)};
  out.write(kVersion);
  out.write(kReflection);
  out.write({reinterpret_cast<const char*>(header.data()), sizeof header});
  std::vector<float> pixels(channels * n_phi);
  for (std::size_t i = 0; i < g->size(); i += n_phi) {
    for (std::size_t k = 0; k < pixels.size(); ++k)
      pixels[k] = static_cast<float>(t.values[k % channels][i + k / channels]);
    out.write({reinterpret_cast<const char*>(pixels.data()), pixels.size() * sizeof(float)});
  }
}

}  // namespace gonio
