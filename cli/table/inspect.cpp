// gonio inspect: what a table is and what it can be trusted for.
#include <cmath>
#include <functional>

#include "base/rounded.h"
#include "cli/line/command.h"
#include "cli/line/output_files.h"
#include "cli/line/terminal.h"
#include "fitting/plan/plan_next.h"
#include "reports/pages/inspect_page.h"
#include "table/format/as_one.h"
#include "table/format/formats.h"
#include "table/format/measured_by.h"
#include "table/health/health.h"

#include <fmt/format.h>

namespace gonio::cli {
namespace {

struct InspectCall : Common {
  std::vector<std::string> files;
  std::string html;
  std::optional<Bins> bins;
  AsMeasured measured;
  std::optional<std::string> model;
  std::optional<std::size_t> plan_next;
};

std::string noise_text(const Noise& n) {
  if (!n.sigma) return "unknown: no nine samples lie on a line along one angle";
  const std::string from =
      n.along == "repeats" ? "from repeated samples" : "from neighbours along " + n.along;
  if (n.bound) return fmt::format("below {:.2g} %, {}", std::max(100 * *n.sigma, 0.01), from);
  return fmt::format("about {:.2g} % of each value, {}", 100 * *n.sigma, from);
}

void print(const Table& t, const Health& h) {
  const auto line = [](const char* what, const std::string& text) {
    say("{:<14}{}\n", what, text);
  };
  line("file", t.path);
  line("layout",
       fmt::format("{}, {}, channels {}", t.format, layout_text(t), fmt::join(t.channels, " ")));
  line("values", fmt::format("{} of {} valid ({})", h.valid, h.values, percent(h.valid, h.values)));
  for (std::size_t m = 1; m < names_of<Mask>.size(); ++m)
    if (h.masked[m])
      line("masked", fmt::format("{} {} ({})", h.masked[m], names_of<Mask>[m],
                                 percent(h.masked[m], h.values)));
  for (const auto& [key, text] : t.notes)
    if (key == "mask")
      line("left out", text);
    else if (key == "agreement" || key == "channels" || key == "reference" ||
             key.starts_with("TIS"))
      line(key.c_str(), text);
  if (t.aperture)
    line("aperture", fmt::format("light {:.3g}°, detector {:.3g}°: values are means over both",
                                 t.aperture.light / degree, t.aperture.detector / degree));
  if (!t.errors.empty())
    line("uncertainty",
         fmt::format("stated, typically {} of a value", percent(typical_uncertainty(t))));
  line("range", fmt::format("{:.4g} to {:.4g} 1/sr", h.smallest_positive, h.largest));
  if (h.noise_floor > 0)
    line("noise floor", fmt::format("{:.3g} 1/sr, from the negative values", h.noise_floor));
  for (const auto& [copies, which] :
       {std::pair(h.copied_rows, "incident"), std::pair(h.copied_columns, "outgoing")})
    if (copies > 0)
      line("copies", fmt::format("{} {} {} another value for value", copies, which,
                                 copies == 1 ? "angle repeats" : "angles repeat"));
  for (const auto& a : h.albedo) {
    std::string channels;
    for (const double v : a.albedo)
      channels += std::isnan(v) ? std::string("      –") : fmt::format(" {:.4f}", v);
    line("albedo", fmt::format("{:>4.1f}°:{}{}{}  (samples cover {:.0f} %)", a.theta_i_deg,
                               channels, a.error < 5e-5 ? "" : " ± " + rounded_up(a.error),
                               a.phi_i_deg == 0 ? "" : fmt::format(", phi_i {:.3g}°", a.phi_i_deg),
                               100 * a.coverage));
  }
  for (const auto& why : h.albedo_left_out) line("albedo", "none at " + why);
  line("reciprocity", h.reciprocity_error
                          ? fmt::format("median error {:.1f} %", 100 * *h.reciprocity_error)
                          : h.reciprocity_note);
  line("noise", noise_text(h.noise));
  if (h.retro)
    line("retro", fmt::format("the highlight, {:.3g} 1/sr and {:.3g}° wide, sits at wo = wi",
                              h.retro->height, h.retro->half_width_deg));
  if (h.peak)
    line("peak", peak_in_words(*h.peak));
  else
    line("peak",
         h.peak_profiles == 0
             ? "none seen: too few samples near the half vector to tell"
             : fmt::format("none seen: near the half vector values are {:.3g} times the base",
                           h.peak_contrast));
  if (const Grid* g = t.grid(); g && t.has_bins())
    line("bins",
         fmt::format(
             "samples taken to sit at the {} of theirs{}", name_of(g->bins),
             h.peak && h.peak->bin_sensitivity
                 ? fmt::format("; the other convention changes the peak's alpha by {:+.2f} %",
                               100 * *h.peak->bin_sensitivity)
                 : ""));
  if (t.truth) {
    std::string truth = t.truth->model;
    for (const auto& [name, values] : t.truth->parameters)
      truth += fmt::format(" {}={}", name, fmt::join(values, ","));
    line("truth", truth);
  }
  for (const auto* warnings : {&t.warnings, &h.warnings})
    for (const auto& w : *warnings) line("beware", w);
  say("what a fit can hope to determine\n");
  for (const auto& p : h.prospects) say("  {:<10}{:<8}{}\n", p.of, name_of(p.verdict), p.because);
}

void print(const std::vector<NextDirection>& next, const std::string& model) {
  say("\n");
  say_below(
      "measure next  ",
      fmt::format("{} for a fit of {}: each narrows the parameter that is least known by then; "
                  "before and after: the width of its 95 % interval, and that over its value",
                  next.size() == 1 ? "this direction" : "these directions", model));
  say("  {:>8}{:>8}{:>9}{:>8}  {:<12}{:>18}{:>18}\n", "theta_i", "phi_i", "theta_o", "phi_o",
      "parameter", "before", "after");
  for (const auto& d : next)
    say("  {:>7.1f}°{:>7.1f}°{:>8.1f}°{:>7.1f}°  {:<12}{:>18}{:>18}\n", d.theta_i_deg, d.phi_i_deg,
        d.theta_o_deg, d.phi_o_deg, d.parameter, width_in_words(d, d.width_before),
        width_in_words(d, d.width_after));
}

Exit run(const InspectCall& o) {
  if (o.model && !o.plan_next) throw wrong_usage("--model goes with --plan-next");
  use(o);
  OutputFiles out(o.files, "", o.html);
  Progress progress(o.quiet);
  progress("reading " + o.files[0]);
  Table t = o.files.size() > 1 ? read_as_one(o.files, o.bins) : read_table(o.files[0], o.bins);
  take(t, o.measured);
  progress("inspecting");
  const Health h = inspect(t);
  FitOptions fit;
  if (o.model) fit.model = *o.model;
  std::optional<std::vector<NextDirection>> next;
  if (o.plan_next) next = plan_next(t, fit, *o.plan_next, std::ref(progress));
  const std::string json = to_json(t, h, next);
  if (out.has_page()) {
    progress("making the page");
    const InspectPage page = make_inspect_page(t);
    out.write_page(inspect_page_html(t, h, page, next.value_or(std::vector<NextDirection>{})),
                   to_json(page, json));
  }
  out.commit();
  progress.clear();
  if (o.json) {
    fmt::print("{}", json);
    return Exit::done;
  }
  print(t, h);
  if (next) print(*next, fit.model);
  return Exit::done;
}

}  // namespace

void add_inspect(CommandLine& line) {
  auto [c, o] =
      line.command<InspectCall>("inspect", "What a table holds and what it can be trusted for",
                                "gonio inspect paint.binary --html paint.html", run);
  c.option("FILE", o->files,
           "A table, its format found from the bytes; several are one sample's, taken as one")
      .required();
  c.option("--html", o->html,
           "A page of the table, NAME.html, and its data beside it, NAME.page.json");
  c.option("--plan-next", o->plan_next,
           "Number of directions to measure next: those that narrow most what a fit knows least")
      .in(std::size_t{1}, most_planned);
  c.option("--model", o->model,
           "Model that --plan-next fits; else that of gonio fit: " + FitOptions().model);
  add_bins(c, o->bins);
  c.options(o->measured);
  add_jobs(c, *o);
  add_output(c, *o);
}

}  // namespace gonio::cli
