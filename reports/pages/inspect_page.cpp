#include "reports/pages/inspect_page.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/json/describe.h"
#include "base/quantile.h"
#include "image/display.h"
#include "reports/finding/names.h"
#include "reports/page/numbers.h"
#include "reports/page/render.h"
#include "reports/pages/angle_bins.h"
#include "reports/pages/drawn_channels.h"
#include "reports/pages/fields.h"
#include "reports/pages/table_sections.h"
#include "table/health/directional_albedo.h"
#include "table/health/reciprocity.h"

#include <fmt/format.h>

namespace gonio {
namespace {

AngleBins picture_bins(const gonio::Table& t) {
  const Grid* g = t.grid();
  if (!g && !t.between) return {Grid::Kind::half_difference, 45, 30};
  if (!g || g->kind == Grid::Kind::in_out || g->axes[2].size > 1)
    return {Grid::Kind::half_difference, 90, 90};
  return {Grid::Kind::half_difference, std::min<std::size_t>(g->axes[0].size, 180),
          std::min<std::size_t>(g->axes[1].size, 180)};
}

AngleBins trust_bins(const gonio::Table& t) {
  const Grid* g = t.grid();
  if (!g) return {Grid::Kind::in_out, 18, 18};
  const auto few = [&](std::size_t axis) { return std::min<std::size_t>(g->axes[axis].size, 45); };
  return {g->kind, few(0), few(1)};
}

}  // namespace

SlicePicture make_slice_picture(const gonio::Table& t) {
  const AngleBins bins = picture_bins(t);
  const std::size_t cells = bins.x * bins.y;
  SlicePicture p{no_value, bins.x_deg(), bins.y_deg(), {}};
  if (const Grid* g = t.grid(); g || t.between) {
    const bool one = g && g->kind == Grid::Kind::half_difference && g->axes[2].size == 1;
    const double phi_d = one ? g->axes[2].angle(0, g->bins) : std::numbers::pi / 2;
    p.phi_d_deg = phi_d / degree;
    p.value.assign(t.values.size(), std::vector<double>(cells, no_value));
    const Interpolator between(t);
    for (std::size_t h = 0; h < bins.x; ++h)
      for (std::size_t d = 0; d < bins.y; ++d) {
        // The middle on the axis as it is drawn.
        const double root = (static_cast<double>(h) + 0.5) / static_cast<double>(bins.x),
                     part = (static_cast<double>(d) + 0.5) / static_cast<double>(bins.y);
        const auto at =
            directions(HalfDifference{90 * degree * root * root, 0, 90 * degree * part, phi_d});
        if (!(at.wi.z > 0 && at.wo.z > 0)) continue;
        for (std::size_t c = 0; c < t.values.size(); ++c)
          p.value[c][h * bins.y + d] = between(at, c);
      }
    return p;
  }
  const SampleAngles at(t);
  for (const auto& plane : t.values) {
    std::vector<double> sum(cells), count(cells);
    for (std::size_t i = 0; i < t.size(); ++i) {
      const auto a = at(i);
      if (mask(a, plane[i]) != Mask::valid) continue;
      sum[bins.cell(a)] += plane[i];
      ++count[bins.cell(a)];
    }
    for (std::size_t k = 0; k < cells; ++k) sum[k] = count[k] > 0 ? sum[k] / count[k] : no_value;
    p.value.push_back(std::move(sum));
  }
  return p;
}

TrustMap make_trust_map(const gonio::Table& t) {
  const AngleBins bins = trust_bins(t);
  const std::size_t cells = bins.x * bins.y;
  TrustMap map{bins.x_name(),
               bins.y_name(),
               bins.x_deg(),
               bins.y_deg(),
               std::vector<std::size_t>(cells),
               {},
               std::vector<double>(cells),
               std::vector<std::size_t>(cells)};
  for (auto& counts : map.masked) counts.assign(cells, 0);
  const SampleAngles at(t);
  for (std::size_t i = 0; i < t.size(); ++i) {
    const auto a = at(i);
    const std::size_t k = bins.cell(a);
    map.values[k] += t.values.size();
    for (const auto& plane : t.values) ++map.masked[static_cast<std::size_t>(mask(a, plane[i]))][k];
  }
  for_each_reciprocal(t, [&](std::size_t i, std::size_t, double a, double b) {
    const std::size_t k = bins.cell(at(i));
    map.reciprocity[k] += reciprocity_error(a, b);
    ++map.pairs[k];
  });
  for (std::size_t k = 0; k < cells; ++k)
    map.reciprocity[k] =
        map.pairs[k] ? map.reciprocity[k] / static_cast<double>(map.pairs[k]) : no_value;
  return map;
}

InspectPage make_inspect_page(const gonio::Table& t) {
  const auto few = of_drawn_channels(t);
  const gonio::Table& drawn = few ? *few : t;
  return {drawn.channels, make_cuts(drawn), make_slice_picture(drawn), make_trust_map(t),
          albedo_curve(drawn, 5)};
}

std::string to_json(const InspectPage& page, std::string_view health_json) {
  return json_line(InspectPageDocument{{health_json}, page}, Digits::six);
}

std::string inspect_page_schema() {
  return schema_text<InspectPageDocument>("Page of a table");
}

}  // namespace gonio

namespace gonio::page {
namespace {

std::string prospect_name(const std::string& of) {
  constexpr std::pair<std::string_view, std::string_view> names[] = {
      {"alpha", "width of the highlight, alpha"},
      {"f0", "its strength, f0"},
      {"fresnel", "its rise towards grazing, Fresnel"},
      {"kd", "base, kd"},
      {"precision", "precision of the values"},
      {"intervals", "errors shared by an incident angle"}};
  const auto at = std::ranges::find(names, of, [](const auto& n) { return n.first; });
  return at == std::end(names) ? of : std::string(at->second);
}
Section prospects(const Health& h) {
  page::Table t{columns("||because"), {}, "told-by-cell prospects"};
  for (const auto& p : h.prospects)
    t.add(prospect_name(p.of),
          Cell{std::string(name_of(p.verdict)), "", "",
               fmt::format("verdict-{}", name_of(p.verdict))},
          with_signs(p.because));
  return {"What a fit can hope to determine",
          "Only from the data; the fit's own intervals say what other parameters take or leave.",
          {std::move(t)}};
}

Section next_directions(const std::vector<NextDirection>& next) {
  page::Table t{columns(">θ_i [°]|>φ_i [°]|>θ_o [°]|>φ_o [°]|parameter|>before|>after")};
  for (const auto& d : next)
    t.add(plain(d.theta_i_deg, 4), plain(d.phi_i_deg, 4), plain(d.theta_o_deg, 4),
          plain(d.phi_o_deg, 4), d.parameter, width_in_words(d, d.width_before),
          width_in_words(d, d.width_after));
  if (next.empty()) return {};
  return {"What to measure next",
          "Each direction narrows the parameter that is least known by then. Before and after: the "
          "width of its 95 % interval, and that over its value.",
          {std::move(t)}};
}

/// Ends that hold nearly all positive values, and not the horizon's few.
std::pair<double, double> range_of(const SlicePicture& p) {
  std::vector<double> all;
  for (const auto& plane : p.value)
    for (const double v : plane)
      if (v > 0) all.push_back(v);
  if (all.empty()) return {0.1, 1};
  const double low = quantile(all, 0.005), high = quantile(all, 0.995);
  return high > 1.05 * low ? std::pair(low, high) : std::pair(low / 1.05, high * 1.05);
}
/// The table as a picture: of each channel, and in colour where it has colours.  In colour the luminance is on the scale and the
/// channels keep their ratios.
Section picture(const InspectPage& page, Pictures& pictures) {
  const auto& p = page.picture;
  if (!std::ranges::any_of(p.value, [](const auto& plane) {
        return std::ranges::any_of(plane, [](double v) { return std::isfinite(v); });
      }))
    return {};
  const auto [low, high] = range_of(p);
  const bool several = page.channels.size() > 1,
             coloured = page.channels == std::vector<std::string>{"r", "g", "b"};
  Choice c;
  c.controls = {
      {"shown", "Shown", coloured ? "colour" : page.channels[0], page.channels.size() > 6},
      {"scale", "Scale", "logarithmic"}};
  c.look = "";
  Slot slot;
  slot.on_paper = false;
  const auto add = [&](const std::string& shown, bool log, std::vector<double> values) {
    auto m = angle_map("picture", {{"shown", shown}, {"scale", log ? "logarithmic" : "linear"}},
                       "theta_h", p.theta_h_deg, "theta_d", p.theta_d_deg);
    m.title = several ? (shown == "colour" ? "f_r in colour" : "f_r of " + shown) : "f_r";
    m.value = shown == "colour" ? "luminance of f_r [1/sr]" : m.title + " [1/sr]";
    m.scale = log ? FigureMap::Scale::log : FigureMap::Scale::linear;
    m.begin = log ? low : 0;
    m.limit = high;
    m.values = std::move(values);
    slot.each.push_back({{shown, m.choices[1].second}, {Shown{m.family, m.choices}}});
    pictures.maps.push_back(std::move(m));
  };
  for (const bool log : {true, false}) {
    if (coloured) {
      std::vector<double> bright;
      std::vector<std::array<unsigned char, 3>> colours;
      for (std::size_t k = 0; k < p.value[0].size(); ++k) {
        Rgb v{p.value[0][k], p.value[1][k], p.value[2][k]};
        const double y = luminance(v);
        bright.push_back(y);
        double light = std::clamp(
            log ? std::log(std::max(y, 1e-300) / low) / std::log(high / low) : y / high, 0.0, 1.0);
        if (log) light = std::pow(light, 2.2);
        colours.push_back(std::isfinite(y) ? displayed_bytes(v, y > 0 ? light / y : 0)
                                           : std::array<unsigned char, 3>{0x9a, 0x9a, 0x9a});
      }
      add("colour", log, std::move(bright));
      pictures.maps.back().colours = std::move(colours);
    }
    for (std::size_t k = 0; k < page.channels.size(); ++k) add(page.channels[k], log, p.value[k]);
  }
  c.slots.push_back(std::move(slot));
  return {
      "The table as a picture",
      fmt::format("f_r over half and difference angle, {}: the highlight at the left edge, "
                  "Fresnel's rise at the top, retro-reflection at the bottom.{}",
                  std::isfinite(p.phi_d_deg) ? "at φ_d = " + degrees_text(p.phi_d_deg)
                                             : "as the mean of a cell's samples",
                  coloured ? " In colour the luminance is on the scale and the channels keep their "
                             "ratios."
                           : ""),
      {std::move(c)}};
}

Section albedo(const InspectPage& page, Pictures& pictures) {
  Figure f = make_figure("albedo");
  f.title = "Directional albedo";
  f.x = {"θ_i [°]", false, 0, 90};
  f.y = {"albedo"};
  bool known = false;
  for (std::size_t c = 0; c < page.channels.size(); ++c) {
    FigureCurve curve{page.channels[c], {}, {}, FigureCurve::Kind::both};
    for (const auto& a : page.albedo) {
      curve.x.push_back(a.theta_i_deg);
      curve.y.push_back(a.albedo[c]);
      known = known || std::isfinite(a.albedo[c]);
    }
    f.curves.push_back(std::move(curve));
  }
  if (page.albedo.size() < 2 || !known) return {};
  const Shown picture{f.family};
  pictures.figures.push_back(std::move(f));
  return {
      "Directional albedo",
      "∫ f cos θ_o dω_o: how much of the light from θ_i leaves again. Where samples are missing, "
      "their mean stands in; above 1 more light leaves than arrives.",
      {Group{"columns", {picture}}}};
}

Section noise(const InspectPage& page, const Noise& n) {
  const auto bands = [](std::string title, std::string unit, const std::vector<NoiseBand>& list) {
    page::Table t{columns(title + "|>values|>σ of ln f|"), {}, "scroll"};
    double most = 0;
    for (const auto& b : list) most = std::max(most, b.sigma);
    for (const auto& b : list) {
      auto& row = t.rows.emplace_back(
          std::vector{Cell(fmt::format("{}–{}{}", plain(b.from, 4), plain(b.to, 4), unit)),
                      Cell(count_text(b.values)), Cell(percent(b.sigma)), Cell()});
      row.back().mark = bar(b.sigma / most);
    }
    return t;
  };
  std::string channels;
  const auto drawn = drawn_channels(n.channels.size());
  if (!n.bound && drawn.size() > 1)
    for (std::size_t c = 0; c < drawn.size(); ++c)
      channels += fmt::format("{}{} {}", c == 0 ? " By channel: " : ", ", page.channels[c],
                              percent(n.channels[drawn[c]]));
  if (!channels.empty()) channels += ".";
  Section out{
      "Noise",
      fmt::format("{}.{}{}", capital(noise_words(n)), channels,
                  n.sigma ? " Each value is compared with the smooth curve through its four "
                            "neighbours on either side; errors that neighbours share, as of an "
                            "adjustment or of interpolation, are not seen."
                          : ""),
      {}};
  Group beside{"columns", {}};
  if (!n.over_angle.empty())
    beside.parts.emplace_back(bands("larger of θ_i, θ_o", "°", n.over_angle));
  if (!n.over_value.empty()) beside.parts.emplace_back(bands("value [1/sr]", "", n.over_value));
  if (!beside.parts.empty()) out.parts.emplace_back(std::move(beside));
  return out;
}

/// Share in percent of each cell, on the axes of the trust map.
FigureMap share_map(const TrustMap& t,
                    std::string family,
                    FigureChoices choices,
                    std::vector<double> shares) {
  auto m = angle_map(std::move(family), std::move(choices), t.x, t.x_deg, t.y, t.y_deg);
  for (auto& s : shares) s *= 100;
  m.values = std::move(shares);
  return m;
}
Part reciprocity(const InspectPage& page, const Health& h, Pictures& pictures) {
  Group out{"", {Subtitle{"Reciprocity"}}};
  if (!h.reciprocity_error) {
    out.parts.emplace_back(Prose{"Cannot be checked: " + h.reciprocity_note + "."});
    return out;
  }
  auto note = h.reciprocity_note;
  if (const auto at = note.find("median "); at != note.npos) note.erase(at, 7);
  out.parts.emplace_back(
      Prose{fmt::format("|f(wi, wo) − f(wo, wi)| over their mean. Median {}, {}.{}",
                        percent(*h.reciprocity_error), note,
                        h.noise.sigma && !h.noise.bound
                            ? fmt::format(" The noise by itself would make a median of {}.",
                                          percent(0.95 * *h.noise.sigma))
                            : "")});
  auto m = share_map(page.trust, "reciprocity", {}, page.trust.reciprocity);
  m.title = "Mean difference of exchanged directions";
  m.value = "mean relative difference [%]";
  m.limit = limit_of(m.values);
  out.parts.emplace_back(Shown{m.family});
  pictures.maps.push_back(std::move(m));
  return out;
}
Part masks(const InspectPage& page, const Health& h, Pictures& pictures) {
  constexpr std::string_view why_text[] = {
      "", "directions below the surface, whatever is stored there",
      "negative values, which no reflectance is", "not a number, or infinite"};
  Choice c;
  c.controls = {{"mask", "Shown"}};
  c.look = "";
  Slot slot;
  std::string text;
  for (std::size_t why = 1; why < h.masked.size(); ++why) {
    if (h.masked[why] == 0) continue;
    const auto name = words(names_of<Mask>[why]);
    text += fmt::format("{}{} values ({}): {}", text.empty() ? "" : "; ", count_text(h.masked[why]),
                        percent(static_cast<double>(h.masked[why]) / static_cast<double>(h.values)),
                        why_text[why]);
    std::vector<double> shares;
    for (std::size_t k = 0; k < page.trust.values.size(); ++k)
      shares.push_back(page.trust.values[k] == 0 ? no_value
                                                 : static_cast<double>(page.trust.masked[why][k]) /
                                                       static_cast<double>(page.trust.values[k]));
    auto m = share_map(page.trust, "masked", {{"mask", name}}, std::move(shares));
    m.title = "What was masked: " + name;
    m.value = "share of values [%]";
    m.limit = 100;
    slot.each.push_back({{name}, {Shown{m.family, m.choices}}});
    if (c.controls[0].chosen.empty() || why > 1) c.controls[0].chosen = name;
    pictures.maps.push_back(std::move(m));
  }
  Group out{"", {Subtitle{"What was masked, and where"}}};
  if (text.empty()) {
    out.parts.emplace_back(
        Prose{"Nothing: every value is finite, not negative, and above the horizon."});
    return out;
  }
  out.parts.emplace_back(
      Prose{text + ". Masked values are left out everywhere, never taken for black."});
  c.slots.push_back(std::move(slot));
  out.parts.emplace_back(std::move(c));
  return out;
}

Pairs facts(const Health& h) {
  Pairs out{{}, "facts"};
  const auto fact = [&](const char* name, std::string text, std::string more = {}) {
    out.each.emplace_back(name, Cell(std::move(text), {}, std::move(more)));
  };
  fact("valid", percent(static_cast<double>(h.valid) / static_cast<double>(h.values)),
       "of " + count_text(h.values));
  fact("noise", h.noise.sigma ? (h.noise.bound ? "< " : "") +
                                    percent(std::max(*h.noise.sigma, h.noise.bound ? 1e-4 : 0))
                              : "–");
  fact("highlight", h.peak ? degrees_text(h.peak->half_width_deg, 2) : "–",
       h.peak ? "half width" : "");
  fact("reciprocity", h.reciprocity_error ? percent(*h.reciprocity_error) : "–",
       h.reciprocity_error ? "median error" : "");
  for (const auto& a : h.albedo)
    if (std::ranges::all_of(a.albedo, [](double x) { return std::isfinite(x); })) {
      std::string each;
      for (const std::size_t c : drawn_channels(a.albedo.size()))
        each += (each.empty() ? "" : " ") + significant(a.albedo[c], 2);
      fact("albedo", each, "at " + degrees_text(a.theta_i_deg));
      break;
    }
  fact("largest", significant(h.largest), "1/sr");
  return out;
}

}  // namespace
}  // namespace gonio::page

namespace gonio {

std::string inspect_page_html(const gonio::Table& t,
                              const Health& h,
                              const InspectPage& p,
                              const std::vector<NextDirection>& next) {
  using namespace page;
  const auto file = file_name(t.path);
  Pictures pictures;
  Page out{"", "inspect", t.path, file};
  std::string peak =
      h.retro  ? "The highlight sits where the light comes from."
      : h.peak ? fmt::format("The highlight is as wide as that of GGX with **alpha {}**{}.",
                             significant(h.peak->alpha, 2),
                             h.peak->limit == PeakLimit::none ? "" : ", at most")
      : h.peak_profiles > 0 ? "No highlight stands out."
                            : "Too few samples lie near the half vector to see a highlight.";
  out.first.emplace_back(Prose{
      fmt::format("`{}` holds {} valid values of {} over {}. {}{}", file, count_text(h.valid),
                  count_text(h.values), with_signs(layout_text(t)),
                  h.noise.sigma
                      ? fmt::format("Their noise is {} {}. ", h.noise.bound ? "below" : "about",
                                    percent(std::max(*h.noise.sigma, 1e-4)))
                      : "",
                  peak),
      "verdict"});
  if (auto warnings = table_warnings(t, h, nullptr); !warnings.empty())
    out.first.emplace_back(Points{std::move(warnings), "warnings"});
  out.first.emplace_back(facts(h));
  auto pictured = picture(p, pictures);
  auto curves = curves_section(t, p.channels, p.curves, pictures);
  auto returned = albedo(p, pictures);
  page::Group trust{"columns", {reciprocity(p, h, pictures), masks(p, h, pictures)}};
  out.sections = {prospects(h),
                  next_directions(next),
                  std::move(pictured),
                  std::move(curves),
                  std::move(returned),
                  noise(p, h.noise),
                  {"Reciprocity and masks", "", {std::move(trust)}},
                  trust_section(t, h)};
  out.setting =
      "f_r is in 1/sr, without the cosine. Every number of this page is in the .page.json beside "
      "it.";
  return page_html(out, pictures);
}

}  // namespace gonio
