// gonio bench maps: texels a second, beside one Ceres problem for each, in one run.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "brdf/model/evaluate.h"
#include "cli/bench/bench.h"
#include "cli/bench/place.h"
#include "cli/line/terminal.h"
#include "fitting/fit.h"
#include "fitting/map/texels.h"
#include "geometry/half_difference.h"
#include "reports/yardstick/plain_fit.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace gonio::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t images = 64, channels = 3, tile_texels = 4096;

/// A tile of a map that was made up, 2 % of noise in it.
struct Tile {
  BoundModel model;
  std::vector<DirectionPair> directions;
  std::vector<float> light, view;  ///< [image][3]
  std::vector<float> values;
};

Tile make_tile(const std::string& spec) {
  Tile tile{bind_model(spec, {}, channels), {}, {}, {}, {}};
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform;
  std::normal_distribution<double> normal;
  std::vector<FrameAngles<double>> angles;
  while (tile.directions.size() < images) {
    const auto any = [&](double most) {
      return direction(most * degree * std::sqrt(uniform(random)), 360 * degree * uniform(random));
    };
    const Direction l = any(70);
    Direction v = any(65);
    if (tile.directions.size() % 2) {  // near the mirror direction
      const Direction h = any(20);
      const double c = dot(l, h);
      v = {2 * c * h.x - l.x, 2 * c * h.y - l.y, 2 * c * h.z - l.z};
    }
    if (v.z < 0.2) continue;
    tile.directions.push_back({l, v});
    angles.push_back(frame_angles(DirectionPair{l, v}));
    for (const double x : {l.x, l.y, l.z}) tile.light.push_back(static_cast<float>(x));
    for (const double x : {v.x, v.y, v.z}) tile.view.push_back(static_cast<float>(x));
  }
  tile.values.resize(images * channels * tile_texels);
  for (std::size_t t = 0; t < tile_texels; ++t) {
    for (const auto& q : tile.model.model.parameters)
      for (std::size_t c = 0; c < q.count; ++c) {
        const double u = uniform(random);
        tile.model.values[q.first + c] = q.name == "alpha"     ? 0.06 * std::pow(8, u)
                                         : q.name == "alpha_x" ? 0.25 + 0.25 * u
                                         : q.name == "alpha_y" ? 0.06 + 0.1 * u
                                         : q.name == "kd"      ? 0.05 + 0.6 * u
                                         : q.name == "f0"      ? 0.03 + 0.2 * u
                                                               : q.about->start;
      }
    const auto f = evaluate(tile.model, angles);
    for (std::size_t i = 0; i < images; ++i)
      for (std::size_t c = 0; c < channels; ++c)
        tile.values[(i * channels + c) * tile_texels + t] =
            static_cast<float>(f[c][i] * (1 + 0.02 * normal(random)));
  }
  return tile;
}

/// What is timed: a name, a model and a way to fit it.
struct Case {
  const char* name;
  TexelOptions options;
  bool own_directions = false;
};

std::vector<Case> cases() {
  const TexelOptions usual{};
  TexelOptions log, anisotropic, gtr, normals;
  log.metric = Metric::log;
  anisotropic.model = "lambert+ggx_aniso/smith_ggx_aniso.correlated/schlick";
  gtr.model = "lambert+gtr/smith_ggx.correlated/schlick";
  normals.refine_normals = true;
  return {{"shared directions", usual},
          {"directions per texel", usual, true},
          {"logarithms", log},
          {"anisotropic", anisotropic},
          {"GTR", gtr},
          {"normals refined", normals}};
}

/// Seconds that a number of tiles take on all threads.
double time_of(const Case& which, const Tile& tile, std::size_t tiles) {
  // Each of its own memory, as a stack's are.
  std::vector<std::vector<float>> values(tiles, tile.values);
  std::vector<float> light, view;
  if (which.own_directions)
    for (std::size_t k = 0; k < 3 * images; ++k) {
      light.insert(light.end(), tile_texels, tile.light[k]);
      view.insert(view.end(), tile_texels, tile.view[k]);
    }
  const Stopwatch begin;
  tbb::parallel_for(std::size_t{0}, tiles, [&](std::size_t k) {
    TexelSamples s{tile_texels, images, channels, values[k], true, tile.light, tile.view, {}};
    if (which.own_directions) {
      s.shared = false;
      s.light = light;
      s.view = view;
    }
    fit_texels(s, which.options);
  });
  return begin.seconds();
}

/// A texel as a table.
Table table_of(const Tile& tile, std::size_t texel) {
  Table t;
  t.format = "csv";
  t.channels = {"r", "g", "b"};
  DirectionList l;
  for (const auto& d : tile.directions) {
    l.theta_i_deg.push_back(theta_of(d.wi) / degree);
    l.phi_i_deg.push_back(phi_of(d.wi) / degree);
    l.theta_o_deg.push_back(theta_of(d.wo) / degree);
    l.phi_o_deg.push_back(phi_of(d.wo) / degree);
  }
  t.where = std::move(l);
  for (std::size_t c = 0; c < channels; ++c) {
    t.values.emplace_back(images);
    for (std::size_t i = 0; i < images; ++i)
      t.values[c][i] = double{tile.values[(i * channels + c) * tile_texels + texel]};
  }
  return t;
}

/// Seconds of a texel by one Ceres problem of its own: a residual block per value, logarithms, on one thread.
double time_of_plain(const Tile& tile, std::size_t texels) {
  double ms = 0;
  for (std::size_t t = 0; t < texels; ++t) {
    const auto fit = fit_plainly(table_of(tile, t), {0.3, 0.1, 0.1, 0.1, 0.3, 0.3, 0.3}, 1);
    ms += fit.build_ms + fit.solve_ms;
  }
  return ms / 1000 / static_cast<double>(texels);
}

}  // namespace

Exit bench_maps(const FitBench& o, const Common& common) {
  use(common);
  Progress progress(common.quiet);
  const auto threads = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
  const auto all = cases();
  std::vector<Tile> tiles;
  for (const auto& c : all) {
    progress(fmt::format("making up a map: {}", c.name));
    tiles.push_back(make_tile(c.options.model));
  }
  constexpr std::size_t plain_texels = 20;
  std::vector<std::vector<double>> rate(all.size());
  std::vector<double> over_plain;
  for (int i = 0; i < o.repeats; ++i) {
    progress(fmt::format("round {} of {}", i + 1, o.repeats));
    double logarithms = 0;
    for (std::size_t k = 0; k < all.size(); ++k) {
      const std::size_t count = threads * (k < 3 ? 4 : 1);
      const double seconds = time_of(all[k], tiles[k], count);
      rate[k].push_back(static_cast<double>(count * tile_texels) / seconds);
      if (all[k].options.metric == Metric::log) logarithms = 1 / rate[k].back();
    }
    if (o.plain)  // on as many threads, were there nothing in the way
      over_plain.push_back(time_of_plain(tiles[0], plain_texels) / static_cast<double>(threads) /
                           logarithms);
  }
  Json json{{"threads", threads},
            {"instruction_set", std::string(kernels<float>().instruction_set)},
            {"images", images},
            {"channels", channels},
            {"rows", Json::array()}};
  for (std::size_t k = 0; k < all.size(); ++k)
    json["rows"].push_back({{"name", all[k].name},
                            {"model", all[k].options.model},
                            {"texels_per_s", spread_of(rate[k])}});
  if (o.plain) json["ratio_to_a_problem_per_texel"] = spread_of(over_plain);
  progress.clear();
  if (common.json) {
    print_document(json);
    return Exit::done;
  }
  fmt::print(
      "maps of {} images and {} channels, {} on {} threads; thousand texels a second: median "
      "[least, most] of {}\n",
      images, channels, kernels<float>().instruction_set, threads, o.repeats);
  for (std::size_t k = 0; k < all.size(); ++k) {
    const Json s = spread_of(rate[k]);
    fmt::print("{:<28}{:8.0f}  [{:.0f}, {:.0f}]\n", all[k].name, s["median"].get<double>() / 1000,
               s["least"].get<double>() / 1000, s["most"].get<double>() / 1000);
  }
  if (o.plain) {
    const Json s = spread_of(over_plain);
    fmt::print(
        "one Ceres problem per texel over ours, both of logarithms: {:.0f} [{:.0f}, {:.0f}]\n",
        s["median"].get<double>(), s["least"].get<double>(), s["most"].get<double>());
  }
  return Exit::done;
}

}  // namespace gonio::cli
