#include "reports/pages/table_sections.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/few.h"
#include "base/quantile.h"
#include "base/text.h"
#include "reports/page/numbers.h"
#include "reports/pages/drawn_channels.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gonio::page {
namespace {

using page::Group;

constexpr double two_sigma = 1.96;  ///< half a 95 % interval, in standard uncertainties

std::string noise_share(const Noise& n) {
  return percent(std::max(*n.sigma, n.bound ? 1e-4 : 0));
}
std::string copies(const Health& h) {
  std::vector<std::string> parts;
  if (h.copied_rows > 0) parts.push_back(many(h.copied_rows, "incident angle"));
  if (h.copied_columns > 0) parts.push_back(many(h.copied_columns, "outgoing angle"));
  if (parts.empty()) return "";
  return fmt::format("{} repeat their neighbour value for value", fmt::join(parts, " and "));
}
std::size_t masked(const Health& h, Mask why) {
  return h.masked[static_cast<std::size_t>(why)];
}

FigureCurve points_of(std::string name,
                      const std::vector<double>& x,
                      const std::vector<double>& y) {
  return {std::move(name), x, y, FigureCurve::Kind::points};
}

/// Curves of one cut.
Figure cut_figure(const std::vector<std::string>& channels, const Cut& cut, bool log) {
  const bool in_plane = cut.along == "theta_o", several = channels.size() > 1;
  Figure f = make_figure("curves", {{"scale", log ? "logarithmic" : "linear"},
                                    {"at", fmt::format("{:.4g}", cut.at_deg)}});
  f.title = fmt::format("{} = {}", with_signs(cut.at), degrees_text(cut.at_deg, 2));
  if (cut.within_deg > 0) f.note = fmt::format("data within ±{}", degrees_text(cut.within_deg));
  f.x = {in_plane ? "θ_o [°], mirror side positive" : "θ_h [°]", false, in_plane ? -90.0 : 0, 90};
  f.y = {"f_r [1/sr]", log};
  double least = std::numeric_limits<double>::infinity(), most = 0;
  double first = 90, last = -90;  // of the data: those of a gloss tile fill the picture
  for (const auto& data : cut.data)
    for (std::size_t i = 0; i < data.size(); ++i)
      if (std::isfinite(data[i]) && (!log || data[i] > 0)) {
        first = std::min(first, cut.deg[i]);
        last = std::max(last, cut.deg[i]);
      }
  if (constexpr double narrow = 60; first < last && last - first < narrow) {
    f.x.from = std::max(f.x.from, first - 0.1 * (last - first));
    f.x.to = std::min(f.x.to, last + 0.1 * (last - first));
  }
  for (const auto& data : cut.data)
    for (std::size_t i = 0; i < data.size(); ++i)
      if (std::abs(cut.deg[i]) <= scale_to_deg && std::isfinite(data[i]) && (!log || data[i] > 0)) {
        least = std::min(least, data[i]);
        most = std::max(most, data[i]);
      }
  // A model may rise above its table: to be seen, but not to flatten the table.
  constexpr double most_above = 3;
  double model_most = 0;
  for (const auto& model : cut.model)
    for (std::size_t i = 0; i < model.size(); ++i)
      if (std::abs(cut.deg[i]) <= scale_to_deg && std::isfinite(model[i]))
        model_most = std::max(model_most, model[i]);
  if (model_most > most_above * most && most > 0)
    f.note += (f.note.empty() ? "" : "; ") + std::string("the model rises above the picture");
  most = std::max(most, std::min(model_most, most_above * most));
  if (most > 0) {
    const double room = 1.6 * std::pow(most / std::max(least, 1e-12 * most), 0.05);
    f.y.from = log ? least / room : std::min(0.0, 1.06 * least);
    f.y.to = log ? most * room : 1.06 * most;
  }
  std::size_t outside = 0;  // which would squeeze the rest
  for (const auto* values : {&cut.data, &cut.left_out})
    for (const auto& data : *values)
      for (const double y : data)
        if (std::isfinite(y) && (!log || y > 0) && !(y >= f.y.from && y <= f.y.to)) ++outside;
  if (outside && most > 0)
    f.note += fmt::format("{}{} outside the picture", f.note.empty() ? "" : "; ",
                          counted(outside, "value"));
  for (std::size_t c = 0; c < channels.size(); ++c) {
    const auto& name = channels[c];
    f.curves.push_back(points_of(several ? name : "table", cut.deg, cut.data[c]));
    if (!cut.uncertainty.empty())
      for (const double u : cut.uncertainty[c]) f.curves.back().y_error.push_back(two_sigma * u);
    if (cut.model.empty()) continue;
    f.curves.push_back({several ? name + ", model" : "model", cut.deg, cut.model[c]});
    if (several) f.curves.back().look = name;
  }
  FigureCurve left_out{"left out", {}, {}, FigureCurve::Kind::points};
  for (const auto& channel : cut.left_out)
    for (std::size_t i = 0; i < channel.size(); ++i)
      if (std::isfinite(channel[i])) {
        left_out.x.push_back(cut.deg[i]);
        left_out.y.push_back(channel[i]);
      }
  if (!left_out.x.empty()) f.curves.push_back(std::move(left_out));
  if (in_plane && most > 0) {
    f.curves.push_back({"mirror direction", {cut.at_deg, cut.at_deg}, {f.y.from, f.y.to}});
    f.curves.back().dashed = true;
  }
  return f;
}

}  // namespace
}  // namespace gonio::page

namespace gonio {

std::string file_name(std::string_view path) {
  using namespace page;
  return std::string(path.substr(path.rfind('/') + 1));
}

std::string with_signs(std::string text) {
  using namespace page;
  constexpr std::pair<std::string_view, std::string_view> signs[] = {
      {"theta_", "θ_"}, {"phi_", "φ_"}, {"phi", "φ"}};
  for (const auto& [name, sign] : signs)
    for (auto at = text.find(name); at != text.npos; at = text.find(name, at))
      text.replace(at, name.size(), sign);
  return text;
}

std::string_view status_words(std::string_view status) {
  using namespace page;
  constexpr std::pair<std::string_view, std::string_view> words[] = {
      {"free", "fitted"},
      {"fixed", "held"},
      {"at_bound", "at the end of its range"},
      {"not_identifiable", "not known"},
      {"upper_limit", "upper limit"},
      {"unbounded", "not bounded"},
      {"lower_limit", "lower limit"}};
  const auto at = std::ranges::find(words, status, [](const auto& w) { return w.first; });
  return at == std::end(words) ? status : at->second;
}

FigureMap angle_map(std::string family,
                    FigureChoices choices,
                    std::string_view x,
                    const std::vector<double>& x_deg,
                    std::string_view y,
                    const std::vector<double>& y_deg) {
  using namespace page;
  const auto axis = [](std::string_view name, const std::vector<double>& edges) {
    constexpr std::pair<std::string_view, std::string_view> labels[] = {
        {"theta_h", "θ_h [°], half-vector angle"},
        {"theta_d", "θ_d [°], difference angle"},
        {"theta_i", "θ_i [°], incident angle"},
        {"theta_o", "θ_o [°], outgoing angle"}};
    FigureMap::Axis a;
    a.root = name == "theta_h";
    a.label = std::ranges::find(labels, name, [](const auto& l) { return l.first; })->second;
    if (a.root) a.label += " (axis grows as √θ_h)";
    for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
      const double middle = (std::sqrt(edges[i]) + std::sqrt(edges[i + 1])) / 2;
      a.at.push_back(a.root ? middle * middle : (edges[i] + edges[i + 1]) / 2);
    }
    a.from = edges.front(), a.to = edges.back();
    return a;
  };
  FigureMap m = make_map(std::move(family), std::move(choices));
  m.x = axis(x, x_deg), m.y = axis(y, y_deg);
  return m;
}

double limit_of(std::vector<double> sizes) {
  using namespace page;
  std::erase_if(sizes, [](double s) { return !std::isfinite(s); });
  for (auto& s : sizes) s = std::abs(s);
  const double most = sizes.empty() ? 0 : quantile(sizes, 0.95);
  for (double decade = 1e-3; decade < 1e6; decade *= 10)
    for (const double digit : {1.0, 2.0, 5.0})
      if (digit * decade >= most) return digit * decade;
  return most;
}

std::vector<std::string> table_warnings(const gonio::Table& t,
                                        const Health& h,
                                        const std::vector<std::string>* fitted) {
  using namespace page;
  std::vector<std::string> out;
  const auto warn = [&](std::string_view what, std::string_view text) {
    out.push_back(fmt::format("**{}** {}", what, text));
  };
  if (!fitted) {
    for (const auto* list : {&t.warnings, &h.warnings})
      for (const auto& w : *list) warn("Beware:", with_signs(w) + ".");
    if (h.retro)
      warn("Retro-reflective:",
           "the highlight sits at wo = wi and not at the half vector. A microfacet lobe cannot "
           "describe it.");
    if (!copies(h).empty()) warn("Copies:", copies(h) + ": no measurements of their own.");
  }
  const bool known = fitted && std::ranges::any_of(*fitted, [](const auto& w) {
                       return w.find("does not resolve its highlight") != w.npos;
                     });
  if (h.peak && h.peak->limit == PeakLimit::samples && !known)
    warn("Peak not resolved:",
         fmt::format("{} within its half width of {}. It may be narrower.",
                     many(static_cast<std::size_t>(std::lround(h.peak->samples_within)), "sample"),
                     degrees_text(h.peak->half_width_deg, 2)));
  if (h.peak && h.peak->limit == PeakLimit::bins)
    warn("Peak limited by the bins:",
         h.peak->bin_sensitivity ? fmt::format("where samples sit in them changes its alpha by {}.",
                                               signed_percent(*h.peak->bin_sensitivity))
                                 : peak_in_words(*h.peak) + ".");
  const auto above = static_cast<double>(h.values - masked(h, Mask::below_horizon)),
             lost = static_cast<double>(masked(h, Mask::negative) + masked(h, Mask::not_finite));
  if (lost > 0.02 * above)
    warn("Many masked values:", percent(lost / above) + " of those above the horizon.");
  return out;
}

page::Section curves_section(const gonio::Table& t,
                             const std::vector<std::string>& channels,
                             const std::vector<Cut>& cuts,
                             Pictures& pictures) {
  using namespace page;
  const bool with_model = !cuts.empty() && !cuts[0].model.empty();
  const auto has = [&](std::string Cut::*of, std::string_view angle) {
    return std::ranges::any_of(cuts, [&](const Cut& c) { return c.*of == angle; });
  };
  Section out{with_model ? "Data and model" : "Curves", {}, {}};
  if (cuts.empty()) {
    out.text = "No valid sample lies in the plane of incidence.";
    return out;
  }
  const auto any = [&](auto of) {
    return std::ranges::any_of(cuts, [&](const Cut& c) { return !(c.*of).empty(); });
  };
  out.text = fmt::format(
      "Points: the table's samples{}. {}No value includes the cosine.{}{}",
      has(&Cut::at, "theta_i") && t.has_bins()
          ? ", at the grid's own angles θ_i; interpolated in the other angles"
          : "",
      with_model ? "Lines: the fitted model. " : "",
      any(&Cut::uncertainty) ? " Bars are 95 % intervals by the stated uncertainties." : "",
      any(&Cut::left_out) ? " “Left out”: samples that --mask excludes from the fit." : "");
  if (channels.size() < t.channels.size())
    out.text += fmt::format(" Drawn are {} of {} channels, from the first to the last.",
                            channels.size(), count_text(t.channels.size()));
  Choice c;
  c.controls = {{"scale", "Scale of f_r", "logarithmic"}};
  c.look = "";
  Slot slot;
  slot.on_paper = false;
  for (const bool log : {true, false}) {
    Group panels{"panels alike", {}};
    for (const auto& cut : cuts) {
      pictures.figures.push_back(cut_figure(channels, cut, log));
      const auto& f = pictures.figures.back();
      panels.parts.emplace_back(Shown{f.family, f.choices, 230});
    }
    slot.each.push_back({{log ? "logarithmic" : "linear"}, {std::move(panels)}});
  }
  c.slots.push_back(std::move(slot));
  out.parts.emplace_back(std::move(c));
  return out;
}

std::string noise_words(const Noise& n) {
  using namespace page;
  if (!n.sigma) return "cannot be estimated: no nine samples lie on a line along one angle";
  return fmt::format(
      "{} {} of each value, from {}", n.bound ? "below" : "about", noise_share(n),
      n.along == "repeats" ? "repeated samples" : "neighbours along " + with_signs(n.along));
}

page::Section trust_section(const gonio::Table& t, const Health& h, bool part) {
  using namespace page;
  const bool several = t.channels.size() > 1;
  const auto of = [&](std::size_t n) {
    return fmt::format("{} ({})", count_text(n),
                       percent(static_cast<double>(n) / static_cast<double>(h.values)));
  };
  Pairs facts;
  const auto fact = [&](std::string name, std::string text) {
    facts.each.emplace_back(std::move(name), std::move(text));
  };
  fact("samples",
       fmt::format("{}, {}", count_text(h.samples),
                   several ? fmt::format("{} channels ({})", t.channels.size(), few_of(t.channels))
                           : "1 channel"));
  fact("valid values", of(h.valid));
  for (std::size_t m = 1; m < h.masked.size(); ++m)
    if (h.masked[m] > 0) fact(words(names_of<Mask>[m]), of(h.masked[m]));
  fact("range", fmt::format("{} (smallest positive) to {} 1/sr", significant(h.smallest_positive),
                            significant(h.largest)));
  fact("noise floor", h.noise_floor > 0
                          ? significant(h.noise_floor) + " 1/sr, from the negative values"
                          : "unknown: it is estimated from negative values, and there are too few");
  if (h.reciprocity_error)
    fact("reciprocity", fmt::format("{}: change when light and view are exchanged{}{}",
                                    percent(*h.reciprocity_error),
                                    h.reciprocity_note.empty() ? "" : "; ", h.reciprocity_note));
  else
    fact("reciprocity",
         h.reciprocity_note.empty() ? "cannot be checked in this layout" : h.reciprocity_note);
  fact("noise", noise_words(h.noise));
  fact("peak", h.peak ? h.peak_profiles == 1
                            ? peak_in_words(*h.peak)
                            : fmt::format("{}; height typically {} 1/sr over a base of {}",
                                          peak_in_words(*h.peak), significant(h.peak->height),
                                          significant(h.peak->base))
               : h.peak_profiles == 0
                   ? "none found: too few samples near the half vector"
                   : fmt::format("none found: near the half vector values are {} times the base",
                                 significant(h.peak_contrast)));
  if (h.retro)
    fact("retro-reflection",
         fmt::format("the highlight, {} 1/sr high and {} wide, sits at wo = wi",
                     significant(h.retro->height), degrees_text(h.retro->half_width_deg)));
  fact("copies", copies(h));
  if (h.peak && h.peak->bin_sensitivity)
    fact("bin convention", fmt::format("{}; another would change the peak's alpha by {}",
                                       t.has_bins() ? name_of(t.grid()->bins) : "none",
                                       signed_percent(*h.peak->bin_sensitivity)));
  Group beside{"", {}};
  if (!h.albedo.empty()) {
    page::Table albedo{columns("θ_i"), {}, "scroll"};
    const auto drawn = drawn_channels(t.channels.size());
    for (const std::size_t c : drawn)
      albedo.head.push_back({several ? t.channels[c] : "albedo", true});
    albedo.head.push_back({"coverage", true});
    for (const auto& a : h.albedo) {
      auto& row = albedo.rows.emplace_back(std::vector{Cell(degrees_text(a.theta_i_deg))});
      for (const std::size_t c : drawn) row.emplace_back(significant(a.albedo[c]));
      row.emplace_back(percent(a.coverage));
    }
    beside.parts.emplace_back(Subtitle{"Directional albedo of the data"});
    beside.parts.emplace_back(std::move(albedo));
  }
  if (t.truth) {
    beside.parts.emplace_back(Subtitle{"Truth"});
    std::vector<std::string> with;
    for (const auto& [name, values] : t.truth->parameters)
      with.push_back(fmt::format("{} {}", name, fmt::join(values, ", ")));
    beside.parts.emplace_back(Pairs{{{"made by gonio from", "`" + t.truth->model + "`"},
                                     {"with", fmt::to_string(fmt::join(with, "; "))},
                                     {"noise", percent(t.truth->noise)},
                                     {"floor", significant(t.truth->floor) + " 1/sr"},
                                     {"outliers", percent(t.truth->outliers)},
                                     {"seed", fmt::to_string(t.truth->seed)}}});
  }
  return {"What the table can be trusted for",
          fmt::format("These figures need no fit.{}{}",
                      part ? " They count only the samples that the mask keeps." : "",
                      h.albedo.empty() ? ""
                                       : " Coverage is the share of the cosine-weighted hemisphere "
                                         "near valid samples."),
          {Group{"columns", {std::move(facts), std::move(beside)}}}};
}

}  // namespace gonio
