#include "reports/pages/fit_page.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>

#include "base/json/describe.h"
#include "base/quantile.h"
#include "base/text.h"
#include "brdf/model/model.h"
#include "brdf/model/model_names.h"
#include "reports/finding/names.h"
#include "reports/page/numbers.h"
#include "reports/page/render.h"
#include "reports/pages/drawn_channels.h"
#include "reports/pages/fields.h"
#include "reports/pages/fit_sections.h"
#include "reports/pages/spheres_section.h"
#include "reports/pages/table_sections.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gonio {

FitPage make_fit_page(const gonio::Table& table, const BoundModel& fitted) {
  const auto few = of_drawn_channels(table);
  const gonio::Table& drawn = few ? *few : table;
  return {drawn.channels, make_cuts(drawn, of_drawn_channels(fitted)),
          make_residual_map(table, fitted), make_spheres(table, {&fitted, 1}),
          !fitted.model.lobes.empty()};
}

std::string to_json(const FitPage& page, std::string_view fit_json, std::string_view health_json) {
  return json_line(FitPageDocument{{fit_json}, {health_json}, page}, Digits::six);
}

std::string fit_page_schema() {
  return schema_text<FitPageDocument>("Page of a fit");
}

}  // namespace gonio

namespace gonio::page {
namespace {

using namespace fit_sections;

/// A parameter of one channel.
struct Row {
  std::string name, label;
  bool first;  ///< of its parameter
  double value, error, low, high, limit, truth;
  ParameterStatus status;
  std::string reason;
  double excluded;  ///< value of the fit beyond the limit
  Range range;      ///< where the formula is defined; NaN where that is not known
};
/// What a table was made with by the model that was fitted; alpha and roughness from each other, alpha = roughness².
double truth_of(const FitDocument& d,
                const gonio::Table& t,
                const std::string& name,
                std::size_t c) {
  if (!t.truth || t.truth->model != d.model) return no_value;
  const auto of = [&](const std::string& parameter) {
    const auto at =
        std::ranges::find(t.truth->parameters, parameter, [](const auto& p) { return p.first; });
    return at == t.truth->parameters.end() || at->second.empty()
               ? no_value
               : at->second[std::min(c, at->second.size() - 1)];
  };
  const double own = of(name);
  if (known(own)) return own;
  if (name.starts_with("roughness")) return std::sqrt(of("alpha" + name.substr(9)));
  if (name.starts_with("alpha")) return std::pow(of("roughness" + name.substr(5)), 2);
  return no_value;
}
std::vector<Row> rows_of(const FitDocument& d, const gonio::Table& t) {
  std::vector<Row> out;
  const auto model =
      d.model.empty() ? Model{} : compose(d.model, std::max<std::size_t>(1, d.channels.size()));
  for (const auto& p : d.parameters) {
    const auto* of_model = model.find(p.name);
    const auto range = of_model ? of_model->about->legal : Range{no_value, no_value};
    for (std::size_t c = 0; c < p.value.size(); ++c) {
      const bool several = p.value.size() > 1;
      out.push_back({p.name, several ? p.name + "." + d.channels[c] : p.name, c == 0, p.value[c],
                     p.std_error[c], p.ci95_low[c], p.ci95_high[c],
                     c < p.limit.size() ? p.limit[c] : no_value, truth_of(d, t, p.name, c),
                     p.status[c], c < p.reason.size() ? p.reason[c] : "",
                     c < p.excluded.size() ? p.excluded[c] : no_value, range});
    }
  }
  return out;
}

/// "≤ 0.01"
std::string limit_text(const Row& r) {
  return fmt::format("{}\u202f{}", r.status == ParameterStatus::upper_limit ? "≤" : "≥",
                     significant(r.limit));
}

/// Options of the program, with what they are given, as code.
std::string with_code(const std::string& text) {
  constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyz-";
  constexpr std::string_view last_of_a_value = "abcdefghijklmnopqrstuvwxyz0123456789";
  std::string coded;
  std::size_t done = 0;
  for (std::size_t at; (at = text.find("--", done)) != text.npos;) {
    std::size_t end = std::min(text.find_first_not_of(letters, at), text.size());
    if (end < text.size() && text[end] == ' ') {
      const std::string_view value =
          std::string_view(text).substr(end, text.find_first_of(" ,;:", end + 1) - end);
      if (const auto last = value.find_last_of(last_of_a_value); last != value.npos)
        end += last + 1;
    }
    coded += text.substr(done, at - done);
    coded += end > at + 2 ? "`" + text.substr(at, end - at) + "`" : text.substr(at, end - at);
    done = end;
  }
  return coded + text.substr(done);
}

Points warnings(const FitDocument& d,
                const gonio::Table& t,
                const Health& h,
                const std::vector<Row>& rows) {
  Points out{{}, "warnings"};
  const auto warn = [&](std::string_view what, const std::string& text) {
    out.each.push_back(fmt::format("**{}** {}", what, text));
  };
  for (const auto& w : d.warnings) warn("Beware:", with_signs(w) + ".");
  if (d.solver.termination != "converged") warn("Not converged.", d.solver.message);
  const auto named = [&](std::initializer_list<ParameterStatus> of) {
    std::vector<std::string> labels;
    for (const auto& r : rows)
      if (std::ranges::find(of, r.status) != of.end()) labels.push_back(r.label);
    return fmt::to_string(fmt::join(labels, ", "));
  };
  using enum ParameterStatus;
  if (const auto who = named({not_identifiable}); !who.empty())
    warn("Not known:", who + ". These data do not determine it; no value is given.");
  std::map<std::string, std::vector<std::string>> limited;  // by the reason
  for (const auto& r : rows)
    if (r.status == upper_limit || r.status == lower_limit)
      limited[r.reason].push_back(r.label + " " + limit_text(r));
  for (const auto& [reason, who] : limited)
    warn("Only a limit (95 %):", fmt::format("{}.{}", fmt::join(who, ", "),
                                             reason.empty() ? "" : " " + capital(reason) + "."));
  std::vector<std::string> ends;
  for (const auto& r : rows)
    if (r.status == at_bound) ends.push_back(fmt::format("{} is {}", r.label, plain(r.value)));
  if (!ends.empty())
    warn("At the end of its range:",
         fmt::format("{}. The data push beyond it.", fmt::join(ends, ", ")));
  if (const auto tied = strongest_correlation(d); tied && std::abs(tied->rho) > 0.95)
    warn("Hardly separable:",
         fmt::format("{} and {} (correlation {}).", tied->a, tied->b, rho_text(tied->rho)));
  for (const auto& s : d.sensitivity) {
    std::string name;
    double most = 0;
    for (const auto& [of, changes] : s.relative_change)
      for (const double x : changes)
        if (std::abs(x) > std::abs(most)) name = of, most = x;
    const auto here = significant(d.residuals.log_rms), there = significant(s.log_rms);
    if (std::abs(most) > 0.01)
      warn("Where samples sit in their bins matters:",
           fmt::format(
               "with samples at the {0} of their bins (--bins {0}), {1} would change by {2}{3}.",
               s.other, name, signed_percent(most),
               here == there
                   ? ""
                   : fmt::format(", and the log RMS would be {} instead of {}", there, here)));
  }
  for (auto& w : table_warnings(t, h, &d.warnings)) out.each.push_back(std::move(w));
  return out;
}

// --- Parameters ----------------------------------------------------------------------------------
/// An interval that ends within a tenth beyond the picture is not seen to leave it: its ends and its value are rounded.
constexpr double seen_beyond = 1.1;
/// An interval around a value on a scale of relative distance; the truth is a tick.  What goes on beyond the scale, or is open,
/// ends in an arrow; a limit begins in the middle.
std::string interval_drawing(
    double low, double high, double truth, double reach, const std::string& text) {
  constexpr double w = 180, h = 16;
  const auto x = [&](double r) { return w / 2 + (w / 2 - 8) * std::clamp(r / reach, -1.0, 1.0); };
  const auto line = [](double x1, double x2, double y1, double y2, std::string_view stroke,
                       double width) {
    return fmt::format(
        R"x(<line x1="{:.1f}" x2="{:.1f}" y1="{}" y2="{}" stroke="var(--{})" stroke-width="{}"/>)x",
        x1, x2, y1, y2, stroke, width);
  };
  const auto arrow = [&](bool right, std::string_view fill) {
    return right ? fmt::format(R"x(<path d="M{} 3l7 5l-7 5z" fill="var(--{})"/>)x", w - 8, fill)
                 : fmt::format(R"x(<path d="M8 3l-7 5l7 5z" fill="var(--{})"/>)x", fill);
  };
  std::string marks =
      line(2, w - 2, h / 2, h / 2, "rule", 1) + line(x(low), x(high), h / 2, h / 2, "accent", 4);
  if (low < -seen_beyond * reach) marks += arrow(false, "accent");
  if (high > seen_beyond * reach) marks += arrow(true, "accent");
  marks += known(low) && known(high)
               ? fmt::format(R"x(<circle cx="{}" cy="{}" r="3" fill="var(--ink)"/>)x", w / 2, h / 2)
               : line(w / 2, w / 2, 2, h - 2, "accent", 3);
  if (known(truth))
    marks += std::abs(truth) <= reach ? line(x(truth), x(truth), 1, h - 1, "red", 2)
                                      : arrow(truth > 0, "red");
  return fmt::format(R"(<svg width="{0}" height="{1}" role="img" aria-label="{2}">{3}</svg>)", w, h,
                     markup_text(text), marks);
}

Section parameters(const FitDocument& d, const std::vector<Row>& rows) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const bool with_truth = std::ranges::any_of(rows, [](const Row& r) { return known(r.truth); });
  const auto relative = [](const Row& r, double x) { return (x - r.value) / std::abs(r.value); };
  const auto bounded = [](const Row& r) {
    return known(r.value) && r.value != 0 && known(r.low) && known(r.high);
  };
  double reach = 0;
  for (const auto& r : rows)
    if (bounded(r)) reach = std::max({reach, -relative(r, r.low), relative(r, r.high)});
  reach = reach > 0 ? std::min(1.0, 1.1 * reach) : 1;
  // An interval that is cut, wider than the error says, or longer to one side has ends of their own
  // size.
  const auto even = [](const Row& r) {
    const auto [least, most] = std::minmax(r.value - r.low, r.high - r.value);
    return most < 1e-3 * std::abs(r.value) ||
           (least > 1.9 * r.error && most < std::min(1.5 * least, 2.8 * r.error));
  };
  const auto number = [&](const Row& r, double x) {
    return !known(r.error) || even(r) ? with_error(x, r.error)
                                      : plain(std::abs(x) < 1e-4 * r.high ? 0 : x, 3);
  };
  // That an interval ends where the formula does; 0 says that by itself.
  const auto cut = [&](const Row& r) -> std::string {
    const bool low = r.low <= r.range.low, high = r.high >= r.range.high;
    return low && high               ? "its whole range"
           : high                    ? plain(r.range.high) + " is the end of its range"
           : low && r.range.low != 0 ? plain(r.range.low) + " is the end of its range"
                                     : "";
  };
  const auto drawing = [&](const Row& r) -> std::string {
    if (known(r.limit) && r.limit > 0) {
      const bool upper = r.status == ParameterStatus::upper_limit;
      return interval_drawing(upper ? -infinity : 0, upper ? 0 : infinity, r.truth / r.limit - 1,
                              reach, limit_text(r));
    }
    if (!bounded(r)) return "";
    const double low = relative(r, r.low), high = relative(r, r.high);
    return interval_drawing(low, high, relative(r, r.truth), reach,
                            fmt::format("95 % interval {} to {} of the value", signed_percent(low),
                                        signed_percent(high)));
  };
  page::Table t{columns(fmt::format("|>value|>standard error|>95 % interval|status|{}picture of "
                                    "the interval, ±{} around the value",
                                    with_truth ? ">truth|>off by|" : "", percent(reach))),
                {},
                "scroll parameters"};
  for (const auto& r : rows) {
    auto& row = t.rows.emplace_back();
    t.row_looks.emplace_back(r.first ? "first" : "");
    row.emplace_back("`" + r.label + "`");
    row.emplace_back(known(r.limit) ? limit_text(r) : known(r.value) ? number(r, r.value) : "–");
    row.emplace_back(known(r.error) ? significant(r.error, 2) : "–");
    row.emplace_back(known(r.limit) ? limit_text(r)
                     : known(r.low) && known(r.high)
                         ? fmt::format("{} … {}", number(r, r.low), number(r, r.high))
                         : "–",
                     "", known(r.limit) ? "" : cut(r));
    std::string why = r.reason;
    const auto add = [&](const std::string& text) { why += (why.empty() ? "" : "; ") + text; };
    if (known(r.excluded)) add("the fit has " + significant(r.excluded));
    if (known(r.limit) && known(r.value)) add("best value " + significant(r.value));
    row.push_back({std::string(status_words(name_of(r.status))), "", std::move(why),
                   fmt::format("status {}", name_of(r.status))});
    if (with_truth) {
      row.emplace_back(plain(r.truth));
      const double off = (r.value - r.truth) / r.error;
      row.emplace_back(known(off) && r.error > 0
                           ? fmt::format("{}{:.1f} σ", off < 0 ? "−" : "", std::abs(off))
                           : "–");
    }
    row.emplace_back();
    row.back().mark = drawing(r);
  }
  const bool has_arrow = std::ranges::any_of(rows, [&](const Row& r) {
    return known(r.limit) ||
           (bounded(r) && std::max(-relative(r, r.low), relative(r, r.high)) > seen_beyond * reach);
  });
  const bool leaves_truth = std::ranges::any_of(rows, [&](const Row& r) {
    return std::abs(known(r.limit) ? r.truth / r.limit - 1 : relative(r, r.truth)) > reach;
  });
  Section out{
      "Parameters",
      fmt::format(
          "Values are rounded as their standard errors allow. Standard errors: "
          "{}.{}{}",
          d.intervals,
          d.misfit.told ? " The misfit widens the intervals, not the standard errors." : "",
          d.clusters > 0 ? fmt::format(" Incident angles: {}.", count_text(d.clusters)) : ""),
      {std::move(t)}};
  out.parts.emplace_back(Prose{
      fmt::format(
          "In the pictures the dot is the value, the bar its interval.{}{}{}",
          has_arrow ? " A blue arrow marks an interval that leaves the picture, or a limit on one "
                      "side."
                    : "",
          with_truth ? " The table is synthetic: the orange tick is the value it was made with."
                     : "",
          leaves_truth ? " An orange arrow says that this lies outside the picture." : ""),
      "small muted"});
  if (d.ratios) {
    page::Table ratios{columns("|>ratio|>95 % interval"), {}, "scroll"};
    for (const auto& r : *d.ratios)
      ratios.rows.push_back({Cell(fmt::format("`{}` / `{}`", r.of, r.to)),
                             Cell(significant(r.value)),
                             Cell(significant(r.ci95_low) + " … " + significant(r.ci95_high))});
    out.parts.emplace_back(Subtitle{"Known up to one factor, as the scale is free"});
    out.parts.emplace_back(std::move(ratios));
  }
  return out;
}

}  // namespace
}  // namespace gonio::page

namespace gonio {

std::string fit_page_html(const FitDocument& d,
                          const gonio::Table& t,
                          const Health& h,
                          const FitPage& p,
                          const std::string& document) {
  using namespace page;
  const auto file = file_name(d.input_path);
  const auto rows = rows_of(d, t);
  const double log_rms = d.residuals.log_rms;
  std::size_t all_values = d.values_used;  // with those that a mask took out of the table
  for (const auto& [why, n] : d.masked) all_values += n;
  struct Words {
    const char *title, *does, *to;
  };
  const Words words_of_verdict =
      d.misfit.told           ? Words{"does not fit", "misses", " by"}
      : d.misfit.too_few      ? Words{"may fit", "may fit (too few to tell)", " to"}
      : d.misfit.outliers > 0 ? Words{"follows outliers of", "follows outliers among", ", to"}
                              : Words{"fitted to", "reproduces", " to"};
  Pictures pictures;
  Page out{
      "", "fit", d.input_path,
      fmt::format("{} {} {}", model_names(std::array{d.model})[0], words_of_verdict.title, file)};
  out.first.emplace_back(Prose{
      fmt::format(
          "`{}` {} the {} values that were used from `{}`{} a typical factor of **{}** (log RMS "
          "{}); the fit {}.{}",
          d.model, words_of_verdict.does, count_text(d.values_used), file, words_of_verdict.to,
          factor_text(log_rms), significant(log_rms),
          d.solver.termination == "converged" ? "converged" : "**did not converge**",
          !p.has_lobe && !parse_model(d.model).lobes.empty()
              ? " Numbers and pictures are of the fit without the lobe."
              : ""),
      "verdict"});
  if (auto all = warnings(d, t, h, rows); !all.each.empty()) out.first.emplace_back(std::move(all));
  if (!d.next.empty()) {
    Points next;
    for (const auto& step : d.next) next.each.push_back(with_code(step) + ".");
    out.first.emplace_back(page::Group{"next", {Subtitle{"What to try next"}, std::move(next)}});
  }
  double total = 0;
  for (const auto& [phase, ms] : d.solver.phase_ms) total += ms;
  const auto beside = [](std::string what, std::string more) {
    return Cell(std::move(what), {}, std::move(more));
  };
  out.first.emplace_back(Pairs{
      {{"typical factor", factor_text(log_rms)},
       {"log RMS", significant(log_rms)},
       {"RMS", beside(significant(d.residuals.rms), "1/sr")},
       {"values used", beside(count_text(d.values_used), "of " + count_text(all_values))},
       {"metric", beside(words(d.metric), d.robust == "none" ? "" : "robust: " + words(d.robust))},
       {"time", milliseconds_text(total)}},
      "facts"});
  out.sections = {parameters(d, rows),
                  curves_section(t, p.channels, p.curves, pictures),
                  spheres_section(p.spheres, "fit"),
                  residuals(d, p.residual_map, pictures),
                  albedo(d, h, pictures),
                  search(d, pictures),
                  confidence(d, pictures),
                  trust_section(t, h, all_values > h.values),
                  solver(d, pictures),
                  input(d, document)};
  out.setting =
      std::string(
          "f_r is in 1/sr, without the cosine. alpha is the width of the distribution, roughness = "
          "√alpha. Every number of this page is in the .page.json beside it") +
      (document.empty() ? "" : ", and those of the fit are also in " + file_name(document)) + ".";
  return page_html(out, pictures);
}

}  // namespace gonio
