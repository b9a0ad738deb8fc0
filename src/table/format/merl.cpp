#include "table/format/merl.h"

#include <bit>
#include <cstring>
#include <numbers>
#include <span>

#include "base/error.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

namespace gonio {
namespace {

static_assert(std::endian::native == std::endian::little, "the files are little-endian");

using Dims = std::array<std::int32_t, 3>;
constexpr Dims kReciprocal{90, 90, 180}, kNonReciprocal{90, 90, 360};
constexpr std::array<double, 3> kScale{1.0 / 1500, 1.15 / 1500, 1.66 / 1500};

bool known(const Dims& d) {
  return d == kReciprocal || d == kNonReciprocal;
}

/// Size of a file with these dimensions [bytes]; 0 where no file can have it.
std::uint64_t file_size(const Dims& d) {
  std::uint64_t n = 1;
  for (const auto size : d) {
    if (size <= 0 || size > 1 << 16) return 0;
    n *= static_cast<std::uint64_t>(size);
  }
  return sizeof d + 3 * n * sizeof(double);
}

}  // namespace

Grid merl_grid(Bins bins, bool reciprocal) {
  using enum Axis::Spacing;
  using std::numbers::pi;
  return {Grid::Kind::half_difference,
          {{{"theta_h", quadratic, 90, pi / 2},
            {"theta_d", uniform, 90, pi / 2},
            {"phi_d", uniform, reciprocal ? 180U : 360U, reciprocal ? pi : 2 * pi}}},
          bins};
}

bool is_merl(std::string_view head, std::uint64_t size) {
  Dims dims{};
  if (head.size() < sizeof dims) return false;
  std::memcpy(dims.data(), head.data(), sizeof dims);
  return known(dims) || file_size(dims) == size;
}

Table read_merl(InputFile& in) {
  Dims dims{};
  in.read(dims.data(), sizeof dims);
  if (!known(dims))
    throw bad_input(in.path(), "byte 0",
                    fmt::format("dimensions ({}, {}, {})", dims[0], dims[1], dims[2]),
                    "(90, 90, 180) or (90, 90, 360)");
  if (in.size() != file_size(dims))
    throw bad_input(in.path(), "size", fmt::format("{} bytes", in.size()),
                    fmt::format("{} bytes", file_size(dims)));
  Table t;
  t.format = "merl";
  t.channels = {"r", "g", "b"};
  t.negative_is_noise = false;
  const Grid grid = merl_grid(Bins::centre, dims == kReciprocal);
  t.where = grid;
  for (std::size_t c = 0; c < kScale.size(); ++c) t.values.emplace_back(grid.size());
  constexpr std::size_t part = 1 << 14;  // stays in the cache between reading and scaling
  const std::size_t parts = (grid.size() + part - 1) / part;
  tbb::parallel_for(std::size_t{0}, kScale.size() * parts, [&](std::size_t k) {
    const std::size_t c = k / parts, first = k % parts * part;
    const std::span v(t.values[c].data() + first, std::min(part, grid.size() - first));
    in.read_at(sizeof dims + (c * grid.size() + first) * sizeof(double), v.data(), v.size_bytes());
    for (double& x : v) x *= kScale[c];
  });
  return t;
}

void write_merl(const Table& t, OutputFile& out, const std::string& path) {
  const Grid* g = t.grid();
  const bool reciprocal = g && *g == merl_grid(g->bins, true);
  if (!g || !(reciprocal || *g == merl_grid(g->bins, false)) ||
      (t.values.size() != 1 && t.values.size() != 3))
    throw bad_input(path, "writing", "a table of another shape",
                    "one or three channels on MERL's 90 × 90 × 180 or 360");
  const Dims dims = reciprocal ? kReciprocal : kNonReciprocal;
  out.write({reinterpret_cast<const char*>(dims.data()), sizeof dims});
  const SampleAngles at(t);
  std::vector<double> row(g->axes[2].size);
  for (std::size_t c = 0; c < 3; ++c) {
    const auto& plane = t.values[t.values.size() == 1 ? 0 : c];
    for (std::size_t start = 0; start < plane.size(); start += row.size()) {
      for (std::size_t k = 0; k < row.size(); ++k) {
        const double v = plane[start + k];
        row[k] = mask(at(start + k), v) == Mask::below_horizon ? -1 : v / kScale[c];
      }
      out.write({reinterpret_cast<const char*>(row.data()), row.size() * sizeof(double)});
    }
  }
}

}  // namespace gonio
