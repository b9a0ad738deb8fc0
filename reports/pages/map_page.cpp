#include "reports/pages/map_page.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "base/quantile.h"
#include "base/text.h"
#include "brdf/model/model_names.h"
#include "image/display.h"
#include "image/image_file.h"
#include "reports/page/numbers.h"
#include "reports/page/render.h"
#include "reports/pages/histogram.h"

#include <fmt/format.h>

namespace gonio::page {
namespace {

constexpr std::size_t most_cells = 96;

/// Some texels of a map's channels, at even distances: [channel][column × rows + row from below].
struct Cells {
  std::size_t columns = 0, rows = 0;
  std::vector<std::string> names;
  std::vector<std::vector<double>> values;
  std::vector<double> x, y;  ///< texels, from the left and from below

  const std::vector<double>* find(const std::string& name) const {
    const auto at = std::ranges::find(names, name);
    return at == names.end() ? nullptr : &values[static_cast<std::size_t>(at - names.begin())];
  }
};

Cells cells_of(const std::string& path) {
  const auto file = open_image(path);
  const std::size_t width = file->width(), height = file->height(),
                    step = (std::max(width, height) + most_cells - 1) / most_cells;
  Cells c;
  c.columns = std::max<std::size_t>(width / step, 1);
  c.rows = std::max<std::size_t>(height / step, 1);
  std::vector<std::size_t> channels;
  for (std::size_t k = 0; k < file->channels().size(); ++k) {
    const auto& name = file->channels()[k];
    if (name.find(".status") != name.npos || name.find(".std_error") != name.npos) continue;
    channels.push_back(k);
    c.names.push_back(name);
    c.values.emplace_back(c.columns * c.rows);
  }
  std::vector<std::vector<float>> row(channels.size(), std::vector<float>(width));
  std::vector<float*> into;
  for (auto& r : row) into.push_back(r.data());
  for (std::size_t j = 0; j < c.rows; ++j) {
    const std::size_t from_above = (2 * j + 1) * height / (2 * c.rows);
    file->read({0, from_above, width, 1}, channels, into);
    for (std::size_t i = 0; i < c.columns; ++i)
      for (std::size_t k = 0; k < channels.size(); ++k)
        c.values[k][i * c.rows + (c.rows - 1 - j)] =
            double{row[k][(2 * i + 1) * width / (2 * c.columns)]};
  }
  for (std::size_t i = 0; i < c.columns; ++i) c.x.push_back(static_cast<double>(i * step));
  for (std::size_t j = 0; j < c.rows; ++j) c.y.push_back(static_cast<double>(j * step));
  return c;
}

/// Name of the colour that a channel begins, "kd" of "kd.R"; none where the three channels are not there.
std::optional<std::string> colour_of_channel(const Cells& c, const std::string& name) {
  if (!name.ends_with(".R")) return std::nullopt;
  const std::string of = name.substr(0, name.size() - 2);
  if (of == "normal" || !c.find(of + ".G") || !c.find(of + ".B")) return std::nullopt;
  return of;
}

FigureMap picture_of(const Cells& c, const std::string& shown, std::vector<double> values) {
  FigureMap m = make_map("map", {{"shown", shown}});
  m.title = shown;
  m.value = shown;
  m.x = {"texels from the left", c.x};
  m.y = {"texels from below", c.y};
  m.values = std::move(values);
  return m;
}

std::vector<FigureMap> pictures_of(const Cells& c) {
  std::vector<FigureMap> all;
  for (const auto& name : c.names)
    if (const auto colour = colour_of_channel(c, name)) {
      const auto &r = *c.find(name), &g = *c.find(*colour + ".G"), &b = *c.find(*colour + ".B");
      std::vector<double> bright;
      std::vector<std::array<unsigned char, 3>> bytes;
      for (std::size_t k = 0; k < r.size(); ++k) {
        bright.push_back(luminance({r[k], g[k], b[k]}));
        bytes.push_back(std::isfinite(bright[k]) ? displayed_bytes({r[k], g[k], b[k]}, 1)
                                                 : std::array<unsigned char, 3>{0x9a, 0x9a, 0x9a});
      }
      all.push_back(picture_of(c, *colour + " in colour", std::move(bright)));
      all.back().value = "luminance of " + *colour;
      if (std::ranges::any_of(all.back().values, [](double v) { return !std::isfinite(v); }))
        all.back().note = "grey where it is not known";
      all.back().colours = std::move(bytes);
    }
  for (std::size_t k = 0; k < c.names.size(); ++k) {
    if (c.names[k] == "outcome") continue;
    all.push_back(picture_of(c, c.names[k], c.values[k]));
    if (c.names[k] == "misfit") {
      all.back().note = "above 1 the model is off by more than noise leaves";
      all.back().line = 1;
    }
    all.back().diverging = c.names[k].starts_with("normal.") || c.names[k] == "tangent";
  }
  return all;
}

Figure histogram_of(const std::string& shown,
                    const std::string& name,
                    const std::vector<double>& values) {
  Figure f = make_figure("spread", {{"shown", shown}});
  f.title = "How many texels have which " + name;
  f.x = {name};
  f.y = {"texels of the sample"};
  std::vector<double> known;
  for (const double v : values)
    if (std::isfinite(v)) known.push_back(v);
  if (known.empty()) return f;
  const double low = quantile(known, 0.002), high = quantile(known, 0.998);
  f.note = "median " + significant(median(known));
  f.curves.push_back(histogram_curve("texels", known, low, high, 40));
  return f;
}

Section parameters_of(const MapDocument& d) {
  const auto texels = static_cast<double>(d.width * d.height);
  Table t{columns("parameter|>mean|>standard error of a texel|>found|>at a bound|>not known")};
  const auto part = [&](std::uint64_t n) {
    return n ? percent(static_cast<double>(n) / texels) : std::string();
  };
  for (const auto& p : d.parameters)
    t.add(p.name, significant(p.mean, 4),
          p.fixed ? std::string("held") : significant(p.mean_std_error), part(p.free),
          part(p.at_bound), part(p.not_identifiable));
  return {"Parameters", "Means are over the texels that have a value.", {std::move(t)}};
}

/// Whether the map may be believed; no praise where the azimuth or the model is in doubt.
std::string verdict_of(const MapDocument& d) {
  const std::string azimuth =
      d.azimuth && *d.azimuth != AzimuthCheck::checked
          ? " The lights' azimuth " + std::string(*d.azimuth == AzimuthCheck::open ? "" : "was ") +
                words_of(*d.azimuth) + "."
          : "";
  if (d.judged == 0)
    return "Whether the model fits is not judged: the noise is not known." + azimuth;
  if (misfits(d))
    return fmt::format(
               "**{}** are off by more than noise leaves: the model does not fit there, and "
               "intervals say little.",
               percent(static_cast<double>(d.misfit) / static_cast<double>(d.judged))) +
           azimuth;
  if (!azimuth.empty() || !d.warnings.empty())
    return (d.warnings.empty() ? "" : "Read the warnings below before you believe the map.") +
           azimuth;
  return "The model is off by no more than noise leaves, as far as a sample of the texels knows "
         "the noise.";
}

}  // namespace
}  // namespace gonio::page

namespace gonio {

std::string map_page_html(const MapDocument& d, const std::string& map) {
  using namespace page;
  const Cells cells = cells_of(map);
  const auto texels = static_cast<double>(d.width * d.height);
  Page out{"", "fit_map", "Map of " + file_name(d.path),
           fmt::format("{} fitted to {} × {} texels", model_names(std::array{d.model})[0], d.width,
                       d.height)};
  out.first.emplace_back(
      Prose{fmt::format("`{}`: **{}** of the texels converged. {}", d.model,
                        percent(static_cast<double>(d.converged) / texels), verdict_of(d)),
            "verdict"});
  out.first.emplace_back(Pairs{
      {{"texels", count_text(d.width * d.height)},
       {"not converged", d.not_converged ? count_text(d.not_converged) : ""},
       {"without a value", d.no_data ? count_text(d.no_data) : ""},
       {"rms", std::isnan(d.rms) ? "" : Cell(significant(d.rms), {}, "in the metric's unit")},
       {"left out", d.left_out > 0 ? Cell(percent(d.left_out), {}, "of a sample's values") : ""}},
      "facts"});
  if (!d.warnings.empty()) out.first.emplace_back(Points{d.warnings, "warnings"});

  Pictures pictures;
  Choice shown;
  shown.look = "columns";
  Slot maps, spreads;
  maps.on_paper = spreads.on_paper = true;
  auto drawn = pictures_of(cells);  // the surface's colour first
  std::ranges::stable_partition(
      drawn, [](const FigureMap& m) { return m.choices[0].second.starts_with("kd in"); });
  for (auto& m : drawn) {
    const std::string name = m.choices[0].second;
    maps.each.push_back({{name}, {Shown{m.family, m.choices}}});
    if (shown.controls.empty()) shown.controls = {{"shown", "Shown", name, true}};
    auto spread = histogram_of(name, m.value, m.values);
    spreads.each.push_back({{name}, {Shown{spread.family, spread.choices, 220}}});
    pictures.maps.push_back(std::move(m));
    pictures.figures.push_back(std::move(spread));
  }
  shown.slots = {std::move(maps), std::move(spreads)};
  out.sections.push_back(
      {"The map",
       fmt::format("From {} × {} texels, spread evenly over the map.", cells.columns, cells.rows),
       {std::move(shown)}});
  out.sections.push_back(parameters_of(d));
  return page_html(out, pictures);
}

}  // namespace gonio
