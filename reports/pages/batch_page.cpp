#include "reports/pages/batch_page.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <numeric>

#include "base/base64.h"
#include "base/quantile.h"
#include "base/text.h"
#include "image/display.h"
#include "image/png.h"
#include "reports/page/numbers.h"
#include "reports/page/render.h"
#include "reports/pages/histogram.h"
#include "reports/pages/table_sections.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gonio::page {
namespace {

double mean_of(const std::vector<double>& values) {
  double sum = 0, n = 0;
  for (const double v : values)
    if (std::isfinite(v)) sum += v, ++n;
  return sum / n;
}
const BatchParameter* parameter_of(const BatchRow& r, std::string_view name) {
  if (!r.fit) return nullptr;
  const auto at = std::ranges::find(r.fit->parameters, name, &BatchParameter::name);
  return at == r.fit->parameters.end() ? nullptr : &*at;
}
std::size_t masked_of(const BatchFit& f) {
  std::size_t sum = 0;
  for (const auto& [why, n] : f.masked) sum += n;
  return sum;
}

/// A number that each table has.
struct Quantity {
  std::string label;
  std::function<double(const BatchRow&)> of;
};
std::vector<Quantity> quantities_of(const std::vector<std::string>& parameters) {
  std::vector<Quantity> out;
  for (const auto& name : parameters)
    out.push_back({name, [name](const BatchRow& r) {
                     const auto* p = parameter_of(r, name);
                     return p ? mean_of(p->value) : no_value;
                   }});
  const auto of_fit = [](auto get) {
    return [get](const BatchRow& r) { return r.fit ? static_cast<double>(get(*r.fit)) : no_value; };
  };
  out.push_back({"log RMS", of_fit([](const BatchFit& f) { return f.log_rms; })});
  out.push_back({"misfit beyond noise", of_fit([](const BatchFit& f) { return f.misfit; })});
  out.push_back({"albedo at 30°", [](const BatchRow& r) {
                   return r.preview ? mean_of(r.preview->albedo) : no_value;
                 }});
  out.push_back({"values used", of_fit([](const BatchFit& f) { return f.values_used; })});
  out.push_back({"masked", of_fit(masked_of)});
  return out;
}

std::string misfit_text(const BatchFit& f) {
  return !std::isfinite(f.misfit) ? "–" : percent(std::expm1(f.misfit));
}
std::string values_text(const BatchParameter& p) {
  std::vector<std::string> each;
  std::vector<double> known;
  for (std::size_t c = 0; c < p.value.size(); ++c) {
    const bool limit = c < p.limit.size() && std::isfinite(p.limit[c]);
    each.push_back(limit ? fmt::format("{}\u202f{}",
                                       p.status[c] == ParameterStatus::upper_limit ? "≤" : "≥",
                                       significant(p.limit[c]))
                         : significant(p.value[c]));
    if (std::isfinite(p.value[c])) known.push_back(p.value[c]);
  }
  if (each.size() <= 4) return fmt::to_string(fmt::join(each, ", "));
  if (known.empty()) return "–";
  const auto [low, high] = std::ranges::minmax(known);  // a spectrum
  return fmt::format("{} to {}", significant(low), significant(high));
}

/// What a reader should know of a table before using its numbers: in short, and in full.
using Flags = std::vector<std::pair<std::string, std::string>>;
Flags flags_of(const BatchRow& r) {
  Flags out;
  if (r.outcome != Exit::done) out.emplace_back(words(name_of(r.outcome)), r.message);
  if (!r.fit) return out;
  const auto& f = *r.fit;
  if (f.misfit_told)
    out.emplace_back("misfit " + misfit_text(f),
                     "what is left follows the angles, by so much beyond noise");
  constexpr std::pair<ParameterStatus, const char*> states[] = {
      {ParameterStatus::not_identifiable, "the data do not determine it"},
      {ParameterStatus::upper_limit, "the data give only the upper end"},
      {ParameterStatus::lower_limit, "the data give only the lower end"},
      {ParameterStatus::at_bound, "the best value may lie beyond"},
      {ParameterStatus::unbounded, "the model is too wrong to bound it"}};
  for (const auto& [status, full] : states) {
    std::vector<std::string> which;
    for (const auto& p : f.parameters)
      if (!p.name.starts_with("roughness") && std::ranges::find(p.status, status) != p.status.end())
        which.push_back(p.name);
    if (!which.empty())
      out.emplace_back(fmt::format("{}: {}", fmt::join(which, ", "), status_words(name_of(status))),
                       full);
  }
  if (!f.warnings.empty())
    out.emplace_back(many(f.warnings.size(), "warning"),
                     fmt::to_string(fmt::join(f.warnings, "\n")));
  constexpr std::size_t longest = 4000;  // all of it is in the data
  for (auto& [text, full] : out) {
    text = beginning(text, longest);
    full = beginning(full, longest);
  }
  return out;
}
std::string flag_marks(const Flags& flags) {
  std::string out;
  for (const auto& [text, full] : flags)
    out += fmt::format(R"(<span title="{}">{}</span>)", markup_text(full), markup_text(text));
  return out.empty() ? "" : R"(<span class="flags">)" + out + "</span>";
}

// --- How it looks --------------------------------------------------------------------------------
/// Its colour in white light from everywhere.
std::string colour_of(const BatchRow& r) {
  const auto& a = r.preview->albedo;
  Rgb c{};
  if (r.fit->channels == std::vector<std::string>{"r", "g", "b"} && a.size() == 3)
    c = {a[0], a[1], a[2]};
  else
    c.fill(std::isfinite(mean_of(a)) ? mean_of(a) : 0);
  const auto b = displayed_bytes(c, 1);
  return fmt::format("#{:02x}{:02x}{:02x}", b[0], b[1], b[2]);
}
/// Its sphere, of which a preview has the right half.
std::string sphere_of(const BatchRow& r, std::string_view name) {
  const auto bytes = from_base64(r.preview->sphere);
  constexpr std::size_t n = Preview::size;
  if (bytes.size() != 3 * n * n / 2) return "";
  PngImage image{n, n, {}, {}};
  image.pixels.resize(n * n);
  for (std::size_t row = 0, at = 0; row < n; ++row)
    for (std::size_t column = n / 2; column < n; ++column, at += 3)
      for (const std::size_t x : {column, n - 1 - column})
        for (std::size_t k = 0; k < 3; ++k)
          image.pixels[row * n + x][k] = static_cast<unsigned char>(bytes[at + k]);
  return fmt::format(
      R"(<img class="sphere" width="76" height="76" src="data:image/png;base64,{}" alt="sphere of {}">)",
      base64(png_bytes(image)), markup_text(name));
}
/// Data and model in the plane of incidence.
Figure curve_of(const BatchRow& r) {
  const auto& c = *r.preview->curve;
  Figure f = make_figure("thumbnails");
  f.x = {"", false, c.along == "theta_o" ? -90.0 : 0, 90};
  f.y = {"", true};
  constexpr double grazing_deg = 80;
  double low = std::numeric_limits<double>::infinity(), high = 0;
  const auto add = [&](std::string name, const std::vector<double>& deg,
                       const std::vector<double>& y, FigureCurve::Kind kind, std::string look) {
    for (std::size_t i = 0; i < y.size(); ++i)
      if (y[i] > 0 && std::abs(deg[i]) <= grazing_deg)
        low = std::min(low, y[i]), high = std::max(high, y[i]);
    f.curves.push_back({std::move(name), deg, y, kind});
    f.curves.back().look = std::move(look);
  };
  const bool several = r.fit->channels.size() > 1;
  for (std::size_t k = 0; k < c.channels.size() && c.channels[k] < r.fit->channels.size(); ++k) {
    const auto& name = r.fit->channels[c.channels[k]];
    if (k < c.data.size()) add(name, c.data_deg, c.data[k], FigureCurve::Kind::points, "");
    if (k < c.model.size())
      add(name + ", model", c.model_deg, c.model[k], FigureCurve::Kind::line, several ? name : "");
  }
  if (high > 0) f.y.from = std::min(low, high / 10) / 1.1, f.y.to = 1.1 * high;
  return f;
}

// --- All at once ---------------------------------------------------------------------------------
/// Whether values span more than a factor of 20.
bool wide(const std::vector<double>& values) {
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (const double v : values) {
    if (v < 0) return false;
    if (v > 0) least = std::min(least, v), most = std::max(most, v);
  }
  return most > 20 * least;
}
Figure histogram(const Quantity& q, const std::vector<double>& values) {
  Figure f = make_figure("how_many", {{"across", q.label}});
  f.title = "How many have which " + q.label;
  std::vector<double> known;
  const bool log = wide(values);
  for (const double v : values)
    if (std::isfinite(v) && (!log || v > 0)) known.push_back(v);
  f.x = {q.label, log};
  f.y = {"tables"};
  if (known.empty()) return f;
  f.note = "median " + significant(median(known));
  const auto [low, high] = std::ranges::minmax(known);
  const std::size_t bins = std::clamp<std::size_t>(
      static_cast<std::size_t>(2 * std::sqrt(static_cast<double>(known.size()))), 8, 40);
  f.curves.push_back(histogram_curve("tables", known, low, high, bins, log));
  return f;
}
Section overview(const std::vector<const BatchRow*>& fitted,
                 const std::vector<Quantity>& quantities,
                 Pictures& pictures) {
  Choice c;
  const auto first = [&](std::initializer_list<std::string_view> names, std::size_t otherwise) {
    for (const auto name : names)
      if (std::ranges::find(quantities, name, &Quantity::label) != quantities.end())
        return std::string(name);
    return quantities[otherwise].label;
  };
  c.controls = {{"across", "Across", first({"alpha"}, 0), true},
                {"up", "Up", first({"f0", "kd"}, 1), true}};
  c.look = "";
  Slot places, counts;
  places.on_paper = counts.on_paper = false;
  std::vector<std::vector<double>> values;
  for (const auto& q : quantities) {
    auto& v = values.emplace_back();
    for (const auto* r : fitted) v.push_back(q.of(*r));
  }
  for (std::size_t a = 0; a < quantities.size(); ++a) {
    const auto& across = quantities[a];
    for (std::size_t b = a + 1; b < quantities.size(); ++b) {  // each pair once
      const auto& up = quantities[b];
      Figure f = make_figure("materials", {{"across", across.label}, {"up", up.label}});
      f.title = fmt::format("{} by {}", up.label, across.label);
      f.x = {across.label, wide(values[a])};
      f.y = {up.label, wide(values[b])};
      for (const bool misses : {false, true}) {
        FigureCurve dots{misses ? "missed by more than noise" : "within the noise",
                         {},
                         {},
                         FigureCurve::Kind::points};
        for (std::size_t i = 0; i < fitted.size(); ++i) {
          if (fitted[i]->fit->misfit_told != misses) continue;
          dots.x.push_back(values[a][i]);
          dots.y.push_back(values[b][i]);
          dots.labels.push_back(file_name(fitted[i]->path));
          dots.colours.push_back(colour_of(*fitted[i]));
        }
        if (!dots.x.empty()) f.curves.push_back(std::move(dots));
      }
      places.each.push_back({{across.label, up.label}, {Shown{f.family, f.choices, 360}}});
      pictures.figures.push_back(std::move(f));
    }
    auto h = histogram(across, values[a]);
    counts.each.push_back({{across.label, ""}, {Shown{h.family, h.choices, 120}}});
    pictures.figures.push_back(std::move(h));
  }
  c.slots = {std::move(places), std::move(counts)};
  return {"All materials",
          "One dot per table in the colour of its fitted model under white light from everywhere; "
          "its rim "
          "says whether the model misses the table by more than noise. Below, how many have which "
          "value. "
          "Parameters with channels stand for their mean.",
          {std::move(c)}};
}

// --- Each ----------------------------------------------------------------------------------------
std::string encoded(std::string_view name) {
  std::string out;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isalnum(byte) != 0 || std::string_view("-_.~").find(c) != std::string_view::npos)
      out += c;
    else
      out += fmt::format("%{:02X}", byte);
  }
  return out;
}
std::string link(const BatchRow& r) {
  const auto& to = r.page.empty() ? r.document : r.page;
  const auto name = markup_text(file_name(r.path));
  return to.empty() ? name : fmt::format(R"(<a href="./{}">{}</a>)", encoded(to), name);
}
std::string card(const BatchRow& r, const std::vector<std::string>& parameters) {
  if (!r.fit)
    return fmt::format(R"(<h3>{}</h3><p class="small"><b>{}</b> {}</p>)", link(r),
                       words(name_of(r.outcome)), markup_text(r.message));
  std::string pictures, facts;
  if (r.preview) {
    pictures = sphere_of(r, file_name(r.path));
    if (r.preview->curve) pictures += page_small(curve_of(r), 190, 76);
  }
  const auto fact = [&](const std::string& name, const std::string& text) {
    facts += fmt::format("<dt>{}</dt><dd>{}</dd>", markup_text(name), text);
  };
  for (const auto& name : parameters)
    if (const auto* p = parameter_of(r, name); p && !name.starts_with("roughness"))
      fact(name, values_text(*p));
  fact("log RMS", significant(r.fit->log_rms));
  fact("misfit", misfit_text(*r.fit));
  return fmt::format(R"(<h3>{}</h3><div class="pictures">{}</div><dl>{}</dl>{})", link(r), pictures,
                     facts, flag_marks(flags_of(r)));
}
Section each(const BatchSummary& s,
             const std::vector<std::string>& parameters,
             const std::vector<Quantity>& quantities) {
  Browse b;
  b.keys = {"name", "flags"};
  b.rows.head = columns("table");
  b.kinds = {"flagged", "without flags"};
  if (!std::ranges::all_of(s.rows, [](const auto& r) { return r.fit.has_value(); }))
    b.kinds.emplace_back("failed");
  for (const auto& q : quantities) {
    b.keys.push_back(q.label);
    b.rows.head.push_back({q.label, true});
  }
  b.rows.head.push_back({"flags"});
  for (const auto& r : s.rows) {
    const auto flags = flags_of(r);
    Browse::Item item{card(r, parameters),
                      fmt::format("{} {}", r.path, name_of(r.outcome)),
                      !r.fit          ? "failed"
                      : flags.empty() ? "without flags"
                                      : "flagged",
                      {file_name(r.path), fmt::to_string(flags.size())}};
    auto& row = b.rows.rows.emplace_back(std::vector{Cell()});
    row[0].mark =
        (r.fit && r.preview
             ? fmt::format(R"(<span class="swatch" style="background:{}"></span> )", colour_of(r))
             : std::string()) +
        link(r);
    for (std::size_t q = 0; q < quantities.size(); ++q) {
      const double v = quantities[q].of(r);
      item.keys.push_back(std::isfinite(v) ? fmt::format("{:.9g}", v) : "");
      const auto* p = q < parameters.size() ? parameter_of(r, parameters[q]) : nullptr;
      row.emplace_back(p                                                 ? values_text(*p)
                       : r.fit && quantities[q].label.starts_with("mis") ? misfit_text(*r.fit)
                                                                         : significant(v));
    }
    row.emplace_back();
    row.back().mark = flag_marks(flags);
    for (const auto& [text, full] : flags) item.words += " " + text;
    b.items.push_back(std::move(item));
  }
  const bool pages = std::ranges::any_of(s.rows, [](const auto& r) { return !r.page.empty(); });
  return {
      "Each material",
      fmt::format(
          "The sphere shows the fitted model, lit from the upper left under a uniform sky. "
          "Beside it f_r in the plane of incidence on a logarithmic scale, at the angle nearest "
          "to 30°: points are the table's samples, lines the model. A name links to its {}.",
          pages ? "page" : "document"),
      {std::move(b)}};
}

}  // namespace
}  // namespace gonio::page

namespace gonio {

std::string batch_page_html(const BatchSummary& s, const std::string& title) {
  using namespace page;
  std::vector<const BatchRow*> fitted;
  std::vector<std::string> parameters;
  std::vector<double> errors;
  std::size_t values = 0, flagged = 0, far = 0, not_converged = 0;
  double time = 0;
  Points failed{{}, "warnings"}, missing{s.missing, "warnings"};
  // Any two parameters share a picture with a dot for each table.  Documents of strangers may name
  // as many as they like.
  constexpr double most_dots = 1 << 24;
  const auto most = static_cast<std::size_t>(
      std::clamp(std::sqrt(most_dots / static_cast<double>(s.rows.size() + 1)), 8.0, 32.0));
  for (const auto& r : s.rows) {
    if (!r.fit || !r.preview) {
      failed.each.push_back(fmt::format("**{}:** {}", words(name_of(r.outcome)), r.message));
      continue;
    }
    fitted.push_back(&r);
    errors.push_back(r.fit->log_rms);
    values += r.fit->values_used;
    flagged += !flags_of(r).empty();
    far += r.fit->misfit_told;
    not_converged += r.outcome == Exit::not_converged;
    for (const auto& [phase, ms] : r.fit->time_ms) time += ms;
    for (const auto& p : r.fit->parameters)
      if (parameters.size() < most && std::ranges::find(parameters, p.name) == parameters.end())
        parameters.push_back(p.name);
  }
  const auto quantities = quantities_of(parameters);
  Pictures pictures;
  Page out{"", "fit, many tables", title,
           fmt::format("{} fitted to {}", fitted.empty() ? "No model" : fitted[0]->fit->model,
                       many(s.rows.size(), "table"))};
  std::string verdict;
  std::erase_if(errors, [](double e) { return std::isnan(e); });
  if (!errors.empty()) {
    const double typical = median(errors);
    verdict += fmt::format("Half of the fits are within **{}** of their table (log RMS {}). ",
                           factor_text(typical), significant(typical));
  }
  const auto say = [&](std::size_t n, std::string_view what) {
    if (n > 0) verdict += fmt::format(fmt::runtime(what), count_text(n));
  };
  say(far, "The model misses {} of them by more than noise. ");
  say(not_converged, "{} did not converge. ");
  say(failed.each.size(), "{} could not be fitted. ");
  say(s.missing.size(), "{} more still to be fitted. ");
  out.first.emplace_back(Prose{verdict, "verdict"});
  Pairs facts{{{"tables", count_text(s.rows.size())},
               {"fitted", count_text(fitted.size())},
               {"not converged", not_converged ? count_text(not_converged) : ""},
               {"failed", failed.each.empty() ? "" : count_text(failed.each.size())},
               {"missing", s.missing.empty() ? "" : count_text(s.missing.size())},
               {"with flags", count_text(flagged)},
               {"values", count_text(values)},
               {"time of all fits", Cell(milliseconds_text(time), {}, "in sum")}},
              "facts"};
  out.first.emplace_back(std::move(facts));
  if (const auto n = failed.each.size(); n > 6)
    out.first.emplace_back(Fold{many(n, "table") + " could not be fitted", {std::move(failed)}});
  else if (n > 0)
    out.first.emplace_back(std::move(failed));
  if (!s.missing.empty())
    out.first.emplace_back(
        Fold{many(s.missing.size(), "table") + " still to be fitted", {std::move(missing)}});
  if (!fitted.empty()) {
    out.sections.push_back(overview(fitted, quantities, pictures));
    for (const auto* r : fitted)
      if (r->preview->curve) pictures.figures.push_back(curve_of(*r));
  }
  out.sections.push_back(each(s, parameters, quantities));
  out.setting = fmt::format(
      "Made with `{}`. f_r is in 1/sr, without the cosine. alpha is the width of the distribution, "
      "roughness = √alpha. Every number of this page is in summary.page.json and, as a table, in "
      "summary.csv. With sliders: `gonio explore TABLE NAME.json -o explore.html`.",
      s.made_with);
  return page_html(out, pictures);
}

}  // namespace gonio
