#include "table/format/ngan.h"

#include <cstring>

#include "base/error.h"

#include <fmt/format.h>

namespace gonio {
namespace {

using NganHeader = std::array<std::int32_t, 16>;
constexpr std::size_t kNganChannels = 3,
                      kPerSample = 4 + kNganChannels;  ///< numbers, directions included
constexpr std::int32_t kMostBins = 1 << 16;

bool known(const NganHeader& h) {
  for (std::size_t k = 0; k < 4; ++k)
    if (h[k] < 1 || h[k] > kMostBins) return false;
  return h[6] == 1 && h[7] == 0 && (h[9] == 0 || h[9] == 1) && h[10] == kNganChannels;
}

/// Most φ_i of `all`, evenly spaced, of which a table can hold `rows` each; 0 where it cannot hold one.
std::size_t azimuths(std::size_t all, std::size_t rows) {
  for (std::size_t kept = all; kept > 0; --kept)
    if (all % kept == 0 && rows <= most_values / kPerSample / kept) return kept;
  return 0;
}

}  // namespace

bool is_ngan(std::string_view head) {
  NganHeader h{};
  if (head.size() < sizeof h) return false;
  std::memcpy(h.data(), head.data(), sizeof h);
  return known(h);
}

Table read_ngan(InputFile& in) {
  NganHeader h{};
  in.read(h.data(), sizeof h);
  if (!known(h))
    throw bad_input(in.path(), "byte 0", "another header",
                    "four numbers of bins, and 1, 0, 0 or 1, and 3 as numbers 6, 7, 9 and 10");
  std::array<std::uint64_t, 4> bins{};
  // Divided, not multiplied: the product of four may not fit.
  std::uint64_t left = in.size() - sizeof h;
  bool fits = left % (kNganChannels * sizeof(float)) == 0;
  left /= kNganChannels * sizeof(float);
  for (std::size_t k = 0; k < bins.size(); ++k) {
    bins[k] = static_cast<std::uint64_t>(h[k]);
    fits = fits && left % bins[k] == 0;
    left /= bins[k];
  }
  const auto [n_in, n_out, n_diff, n_phi] = bins;
  if (!fits || left != 1)
    throw bad_input(
        in.path(), "byte 0",
        fmt::format("{} × {} × {} × {} bins in {} bytes", n_in, n_out, n_diff, n_phi, in.size()),
        "64 bytes and 12 for each bin");
  const std::size_t rows = n_in * n_out * n_diff, kept = azimuths(n_phi, rows);
  if (kept == 0)
    throw bad_input(in.path(), "byte 0", fmt::format("{} bins at each φ_i", rows),
                    fmt::format("at most {} numbers, {} a bin", most_values, kPerSample));
  Table t;
  t.format = "ngan";
  t.channels = {"r", "g", "b"};
  t.negative_is_noise = false;
  const std::size_t every = n_phi / kept;
  if (every > 1)
    t.warnings.push_back(
        fmt::format("the file has {} bins, more than a table holds: one in {} of the azimuths "
                    "phi_i was read, {} of {}",
                    rows * n_phi, every, kept, n_phi));
  const double diff = h[9] == 1 ? 180 : 360;
  const auto centre = [](std::size_t k, std::size_t n, double span) {
    return span * (static_cast<double>(k) + 0.5) / static_cast<double>(n);
  };
  DirectionList l;
  for (auto* column : {&l.theta_i_deg, &l.phi_i_deg, &l.theta_o_deg, &l.phi_o_deg})
    column->reserve(rows * kept);
  for (std::size_t row = 0; row < rows; ++row)
    for (std::size_t k = 0; k < n_phi; k += every) {
      const double phi_i = centre(k, n_phi, 360), turned = centre(row % n_diff, n_diff, diff);
      l.theta_i_deg.push_back(centre(row / n_diff / n_out, n_in, 90));
      l.phi_i_deg.push_back(phi_i);
      l.theta_o_deg.push_back(centre(row / n_diff % n_out, n_out, 90));
      l.phi_o_deg.push_back(phi_i + turned < 360 ? phi_i + turned : phi_i + turned - 360);
    }
  std::vector<float> line(n_phi);
  for (std::size_t c = 0; c < kNganChannels; ++c) {
    auto& plane = t.values.emplace_back();
    plane.reserve(rows * kept);
    for (std::size_t row = 0; row < rows; ++row) {
      in.read(line.data(), line.size() * sizeof(float));
      for (std::size_t k = 0; k < n_phi; k += every) plane.push_back(static_cast<double>(line[k]));
    }
  }
  t.where = std::move(l);
  return t;
}

}  // namespace gonio
