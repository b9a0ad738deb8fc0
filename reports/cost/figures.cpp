// Time against error, as pictures.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "brdf/term/term.h"
#include "reports/cost/cost.h"
#include "reports/finding/names.h"
#include "reports/picture/front.h"

#include <fmt/format.h>

namespace gonio {
namespace {

/// Place of what has no error on a log axis.
constexpr double least_error = 1e-17;

using Series = std::vector<std::pair<std::string, std::vector<FrontDot>>>;

/// The dots by series, and through those of each on its front a line.
std::vector<FigureCurve> curves_of(const Series& series) {
  std::vector<FigureCurve> out;
  for (const auto& [name, dots] : series) {
    out.push_back(front_points(name, dots));
    if (auto line = front_line("best trade-offs, " + name, dots)) out.push_back(std::move(*line));
  }
  return out;
}
TimedError drawn(const CostRow& r, double error) {
  return {r.time, std::max(error, least_error), r.each};
}

std::string shown(const CostRow& r) {
  auto name = r.kind == "model" ? r.id : brief_name(r.id);
  if (name.starts_with("model.")) name.erase(0, 6);
  return r.way.empty() ? name : fmt::format("{}, {}", name, r.way);
}

struct Kind {
  std::string_view kind, family, title, error, note;
};
constexpr Kind kinds[] = {
    {"fresnel", "fresnel", "Fresnel terms", "RMS error of F", "by what each stands for"},
    {"masking", "masking", "Masking", "RMS error of G2", "by the exact Smith that each stands for"},
    {"ndf", "distribution", "Distributions", "RMS error of D over its peak",
     "by what each stands for; the mobile ones are π times a D, as shipped"},
    {"model", "model", "Whole models", "RMS error of G2 F", "by their distribution"}};

/// The truth that it is against, which is what it can be compared with.
std::string against(const CostRow& r) {
  const std::string& truth = r.error.truth;
  if (r.kind != "model") return brief_name(truth);
  return fmt::format("{}{}{}", truth.starts_with("beckmann") ? "Beckmann's" : "GGX's",
                     truth.find("/conductor") == truth.npos    ? ", glass"
                     : truth.find("/dielectric") == truth.npos ? ", gold"
                                                               : "",
                     r.channels == 1 ? "" : fmt::format(", {} channels", r.channels));
}

void add_rows_pictures(Pictures& to, const CostRows& report) {
  const auto best = report.machine.instruction_sets.back();
  for (const auto& k : kinds)
    for (const std::string_view number : {"float", "double"})
      for (const auto& [isa, memory] :
           {std::pair<std::string, std::string_view>{best, "cache"}, {best, "streaming"}}) {
        Series series;
        for (const auto& r : report.rows) {
          if (r.kind != k.kind || r.number != number || r.isa != isa || r.memory != memory ||
              is_mistake(r))
            continue;
          const auto name = against(r);
          auto at = std::ranges::find(series, name, [](const auto& s) { return s.first; });
          if (at == series.end()) at = series.insert(at, {name, {}});
          at->second.push_back({shown(r), drawn(r, r.error.rms), r.on_line});
        }
        if (series.empty()) continue;
        FigureChoices choices{
            {"number", std::string(number)}, {"set", isa}, {"memory", std::string(memory)}};
        Figure f;
        f.id = picture_id(k.family, choices);
        f.title = fmt::format("{}: time against error", k.title);
        f.note = fmt::format("{}, {}, {}; {}", number, isa,
                             memory == "cache" ? "in cache" : long_columns(report.options), k.note);
        f.x = {"time of one sample [ns]", true};
        f.y = {std::string(k.error), true};
        f.curves = curves_of(series);
        f.family = k.family;
        f.choices = std::move(choices);
        to.figures.push_back(std::move(f));
      }
}

/// Forms for metals, which have two truths, against the exact conductor.
void add_metals(Pictures& to, const CostRows& report) {
  std::vector<FrontDot> dots;
  for (const auto& [form, rms] : report.metals) {
    const auto* r =
        find_row(report.rows, form, "float", report.machine.instruction_sets.back(), "cache");
    if (!r || is_mistake(*r)) continue;
    const bool exact = r->error.truth == r->id;  // but for what float rounds
    dots.push_back({brief_name(form), drawn(*r, exact ? std::max(rms, r->error.rms) : rms)});
  }
  mark_front(dots);
  if (dots.empty()) return;
  to.figures.push_back(
      {"fresnel_metals",
       "Fresnel terms on metals: time against error",
       "float, in cache; RMS over the angle, all measured metals and their three channels",
       {"time of one sample [ns]", true},
       {"RMS error of F", true},
       curves_of({{"conductor", dots}}),
       "fresnel_metals"});
}

/// Points of one picture, or of one case of it, a curve for each series.
/// \param known_to  what the truth is known to, and errors are told down to
void add_points_picture(Pictures& to,
                        const CostRows& report,
                        std::string_view picture,
                        Figure f,
                        double unit_ns,
                        double known_to = 1e-13) {
  for (const auto& p : report.points) {
    if (p.picture != picture) continue;
    const auto comma = p.series.find(", ");
    const auto series = p.series.substr(0, comma);
    if (!f.choices.empty() && f.choices[0].second != p.series.substr(comma + 2)) continue;
    auto* at =
        &curve_named(f, series,
                     picture == "compensation" || series == "formula" ? FigureCurve::Kind::points
                                                                      : FigureCurve::Kind::both);
    // lines go from the fast to the slow
    const auto k = std::ranges::upper_bound(at->x, p.time.ns / unit_ns) - at->x.begin();
    at->x.insert(at->x.begin() + k, p.time.ns / unit_ns);
    at->y.insert(at->y.begin() + k, std::max(p.error, known_to));
    at->labels.insert(at->labels.begin() + k,
                      picture == "compensation" ? brief_name(p.label) : p.label);
    at->x_error.insert(at->x_error.begin() + k, p.time.spread_ns / unit_ns);
    at->y_error.insert(at->y_error.begin() + k, p.error_spread);
  }
  if (f.family.empty()) f.family = f.id;
  if (!f.curves.empty()) to.figures.push_back(std::move(f));
}

void add_quadrature(Pictures& to, const CostRows& report) {
  std::vector<std::string> cases;
  for (const auto& p : report.points)
    if (p.picture == "quadrature") {
      const auto name = p.series.substr(p.series.find(", ") + 2);
      if (std::ranges::find(cases, name) == cases.end()) cases.push_back(name);
    }
  for (const auto& name : cases) {
    const FigureChoices choices{{"case", name}};
    add_points_picture(
        to, report, "quadrature",
        {picture_id("quadrature", choices),
         "One directional albedo: time against error",
         fmt::format("GGX, correlated Smith, F = 1, {}; by chance: RMS over 32 seeds; drawn "
                     "at 1e-13 where less, which the truth is known to",
                     name),
         {"time [ns]", true},
         {"error of E", true},
         {},
         "quadrature",
         choices},
        1);
  }
}

}  // namespace

Pictures pictures(const CostRows& report) {
  Pictures to;
  add_rows_pictures(to, report);
  add_metals(to, report);
  add_points_picture(to, report, "compensation",
                     {"compensation",
                      "Energy compensation: time against error",
                      "float, one light and view at a time; against all bounces, Schlick's Fresnel",
                      {"time of one evaluation [ns]", true},
                      {"RMS error of E", true},
                      {}},
                     1);
  add_points_picture(
      to, report, "split_sum",
      {"split_sum",
       "Split sum, A + B: time against error",
       "one value in double on one thread; roughness and NoV from 1/16 to 1; drawn at "
       "1e-9 where less, which the truth is known to",
       {"time of one value [ns]", true},
       {"RMS error of A + B", true},
       {}},
      1, 1e-9);
  add_quadrature(to, report);
  add_points_picture(to, report, "fit",
                     {"fit",
                      "Share of a table that a fit uses: time against error",
                      "MERL table with 2 % noise; GGX, Schlick and Lambert; on all threads",
                      {"time of the fit [ms]", true},
                      {"RMS error of alpha, relative", true},
                      {}},
                     1e6);
  return to;
}

}  // namespace gonio
