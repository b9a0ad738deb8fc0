#include "reports/pages/fit_sections.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "base/quantile.h"
#include "base/text.h"
#include "fitting/judge/warnings.h"
#include "reports/page/numbers.h"
#include "reports/pages/table_sections.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gonio::fit_sections {

using namespace page;
using page::Group;

namespace {

/// True of a parameter whose correlations are not known, as where it stands at a bound.
bool stands_by_itself(const FitDocument& d, std::size_t i) {
  for (std::size_t j = 0; j < d.free_names.size(); ++j)
    if (j != i && known(d.correlations[std::max(i, j)][std::min(i, j)])) return false;
  return true;
}

/// Rows of the correlations that are of known parameters.
std::vector<std::size_t> rows_of_known(const FitDocument& d) {
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < d.free_names.size(); ++i) {
    const auto& name = d.free_names[i];
    const auto is_unknown = [&](const FittedParameter& p) {
      for (std::size_t c = 0; c < p.status.size(); ++c)
        if (p.status[c] == ParameterStatus::not_identifiable &&
            (name == p.name || (c < d.channels.size() && name == p.name + "." + d.channels[c])))
          return true;
      return false;
    };
    if (std::ranges::none_of(d.parameters, is_unknown) && !stands_by_itself(d, i))
      rows.push_back(i);
  }
  return rows;
}

}  // namespace
std::optional<Tied> strongest_correlation(const FitDocument& d) {
  std::optional<Tied> best;
  const auto rows = rows_of_known(d);
  for (const std::size_t i : rows)
    for (const std::size_t j : rows) {
      if (j >= i) break;
      if (const double rho = d.correlations[i][j];
          known(rho) && (!best || std::abs(rho) > std::abs(best->rho)))
        best = Tied{d.free_names[j], d.free_names[i], rho};
    }
  return best;
}
std::string rho_text(double rho) {
  return (rho < 0 ? "−" : "") + fmt::format("{:.3f}", std::abs(rho));
}

// --- Where the model is off ----------------------------------------------------------------------
namespace {

std::string map_words(const ResidualMap& m) {
  std::vector<double> sizes;
  std::size_t worst = m.mean.size();
  for (std::size_t k = 0; k < m.mean.size(); ++k)
    if (known(m.mean[k])) {
      sizes.push_back(std::abs(m.mean[k]));
      if (worst == m.mean.size() || sizes.back() > std::abs(m.mean[worst])) worst = k;
    }
  if (sizes.empty()) return "No cell has valid values.";
  const auto count = sizes.size();
  const std::size_t nd = m.theta_d_deg.size() - 1;
  const auto middle = [](const std::vector<double>& edges, std::size_t i) {
    return degrees_text((edges[i] + edges[i + 1]) / 2);
  };
  return fmt::format(
      "In half of the {} cells the model is off by at most ×/÷ {}. Worst single cell, "
      "which may be one bad sample: {}, at θ_h {}, θ_d {}.",
      count, typical_factor(median(sizes)), deviation_in_words(std::exp(m.mean[worst])),
      middle(m.theta_h_deg, worst / nd), middle(m.theta_d_deg, worst % nd));
}

}  // namespace

Section residuals(const FitDocument& d, const ResidualMap& m, Pictures& pictures) {
  Choice c;
  c.controls = {{"shown", "Shown", "model ÷ table"}};
  c.look = "";
  Slot slot;
  for (const bool mean : {true, false}) {
    const auto* shown = mean ? "model ÷ table" : "typical factor";
    auto map = angle_map("residuals", {{"shown", shown}}, "theta_h", m.theta_h_deg, "theta_d",
                         m.theta_d_deg);
    map.title = mean ? "Model ÷ table" : "Typical factor between model and table";
    map.value = mean ? "model ÷ table, geometric mean of the cell" : "typical factor of the cell";
    map.scale = FigureMap::Scale::log;
    map.diverging = mean;
    map.begin = 1;
    const auto& logs = mean ? m.mean : m.rms;
    map.limit = 1 + limit_of([&] {
                  auto sizes = logs;
                  for (auto& s : sizes) s = std::expm1(std::abs(s));
                  return sizes;
                }());
    for (const double v : logs) map.values.push_back(std::exp(v));
    slot.each.push_back({{shown}, {Shown{map.family, map.choices}}});
    pictures.maps.push_back(std::move(map));
  }
  c.slots.push_back(std::move(slot));
  Group maps{"", {std::move(c), Prose{map_words(m), "small muted"}}}, beside{"columns map", {}},
      bands{"bands", {}};
  beside.parts.emplace_back(std::move(maps));
  double most = 1e-12;
  for (const auto& b : d.residuals.bands)
    if (b.values > 0 && known(b.log_rms)) most = std::max(most, b.log_rms);
  for (const auto& angle : unique(d.residuals.bands, &ResidualBand::angle)) {
    page::Table t{columns(with_signs(angle) + " [°]|>values|>RMS [1/sr]|>log RMS|"), {}, "scroll"};
    for (const auto& b : d.residuals.bands) {
      if (b.angle != angle) continue;
      const bool there = b.values > 0;
      auto& row = t.rows.emplace_back(
          std::vector{Cell(plain(b.from_deg, 3) + "–" + plain(b.to_deg, 3)),
                      Cell(count_text(b.values)), Cell(there ? significant(b.rms, 2) : "–"),
                      Cell(there && known(b.log_rms) ? significant(b.log_rms) : "–"), Cell()});
      if (there && known(b.log_rms)) row.back().mark = bar(b.log_rms / most);
    }
    bands.parts.emplace_back(std::move(t));
  }
  if (!m.measured.empty()) {
    Figure f = make_figure("predicted", {});
    f.title = "Predicted against measured";
    f.note = m.measured.size() == d.values_used
                 ? "all " + count_text(d.values_used) + " values used"
                 : count_text(m.measured.size()) + " values, evenly spread over the table";
    f.x = {"table [1/sr]", true};
    f.y = {"model [1/sr]", true};
    f.curves.push_back({"value", m.measured, m.predicted, FigureCurve::Kind::points});
    const auto [low, high] = std::ranges::minmax(m.measured);
    f.curves.push_back({"equal", {low, high}, {low, high}});
    f.curves.back().dashed = true;
    beside.parts.emplace_back(Shown{f.family, f.choices, 260});
    pictures.figures.push_back(std::move(f));
  }
  return {
      "Where the model is off",
      "Each cell compares model and data by their ratio, over all channels and all valid positive "
      "values in it. Blue: the model is too dark; orange: too bright.",
      {std::move(beside), std::move(bands),
       Prose{"Ranges include their upper end.", "small muted"}}};
}

// --- Directional albedo -----------------------------------------------------------------------
Section albedo(const FitDocument& d, const Health& h, Pictures& pictures) {
  const auto& p = d.physics;
  if (p.theta_i_deg.empty()) return {};
  const std::size_t all = d.channels.size(), most = std::min<std::size_t>(4, all);
  std::vector<std::size_t> shown;  // of many channels a few
  for (std::size_t k = 0; k < most; ++k)
    shown.push_back(all == most ? k : (2 * k * (all - 1) + most - 1) / (2 * (most - 1)));
  const bool several = all > 1;
  const auto share = [](double v) { return significant(v, v > 0.995 && v < 1.095 ? 4 : 3); };
  const auto above = [](double v) { return v > 1.001; };
  double top = -1, largest = 0;
  std::size_t at = 0, channel = 0;
  bool has_data = false;
  for (std::size_t k = 0; k < p.theta_i_deg.size(); ++k)
    for (std::size_t c = 0; c < all; ++c) {
      if (p.model_albedo[k][c] > top) top = p.model_albedo[k][c], at = k, channel = c;
      has_data = has_data || known(p.data_albedo[k][c]);
      largest = std::max(
          {largest, p.model_albedo[k][c], known(p.data_albedo[k][c]) ? p.data_albedo[k][c] : 0});
    }
  Figure f = make_figure("albedo");
  f.title = "Directional albedo";
  f.x = {"θ_i [°], incident angle", false, -2, 90};  // a point at 0 is seen whole
  f.y = {"share of the light that is reflected"};
  const auto column = [&](const std::vector<std::vector<double>>& of, std::size_t c) {
    std::vector<double> out;
    for (const auto& row : of) out.push_back(row[c]);
    return out;
  };
  page::Table t{columns("θ_i [°]"), {}, "scroll"};
  for (const std::size_t c : shown) {
    const auto& name = d.channels[c];
    if (has_data) {
      f.curves.push_back({several ? name : "table", p.theta_i_deg, column(p.data_albedo, c),
                          FigureCurve::Kind::points});
    }
    f.curves.push_back(
        {several ? name + ", model" : "model", p.theta_i_deg, column(p.model_albedo, c)});
    if (several) f.curves.back().look = name;
    t.head.push_back({several ? "model " + name : "model", true});
    if (has_data) t.head.push_back({several ? "table " + name : "table", true});
  }
  if (largest > 0.8) {
    f.curves.push_back({"all of the light", {0, 90}, {1, 1}});
    f.curves.back().dashed = true;
  }
  const double last = p.theta_i_deg.size() > 12 ? 10 : 0;  // of many angles some
  double next = -1;
  for (std::size_t k = 0; k < p.theta_i_deg.size(); ++k) {
    if (k != at && p.theta_i_deg[k] < next) continue;
    if (p.theta_i_deg[k] >= next) next = p.theta_i_deg[k] + last - 1e-6;
    auto& row = t.rows.emplace_back(std::vector{Cell(plain(p.theta_i_deg[k], 3))});
    const auto cell = [&](double v) {
      row.push_back(above(v) ? Cell(share(v) + ", above 1", {}, {}, "told")
                             : Cell(known(v) ? share(v) : "–"));
    };
    for (const std::size_t c : shown) {
      cell(p.model_albedo[k][c]);
      if (has_data) cell(p.data_albedo[k][c]);
    }
  }
  const auto data = std::ranges::find(h.albedo, p.theta_i_deg[at], &AlbedoSample::theta_i_deg);
  const bool has_error = data != h.albedo.end() && data->error > 0;
  std::string words = fmt::format(
      "Among the angles shown, the fitted model reflects most at θ_i {}{}: {} of the light{}.{}",
      degrees_text(p.theta_i_deg[at]), several ? " in channel " + d.channels[channel] : "",
      share(top),
      known(p.data_albedo[at][channel])
          ? fmt::format("; the table reflects {}{}", share(p.data_albedo[at][channel]),
                        has_error ? fmt::format(" (error of this integral: at most {})",
                                                significant(data->error, 2))
                                  : "")
          : "",
      above(top) ? " Above 1 more light leaves than arrives: no surface "
                   "does that."
                 : "");
  std::vector<double> ratios;
  for (const double r : p.peak_ratio)
    if (known(r)) ratios.push_back(r);
  if (!ratios.empty()) {
    const auto [low, high] = std::ranges::minmax(ratios);
    const auto a = plain(low, 2), b = plain(high, 2);
    words += fmt::format(
        " At the table's samples, the model's greatest f_r is {}{} times the table's greatest{}.",
        a == b ? "" : a + " to ", b, a == b ? "" : " (by channel)");
  }
  const Shown picture{f.family, {}, 260};
  pictures.figures.push_back(std::move(f));
  return {
      "Directional albedo",
      fmt::format("Share of the light from one direction that is reflected into all others. {}",
                  has_data ? "Where samples are missing or too far apart, the table gives no value."
                  : h.albedo.empty()
                      ? "The table has too few directions for it."
                      : "The table's own stands under “What the table can be trusted for”."),
      {Prose{std::move(words)}, Group{"columns light", {picture, std::move(t)}}}};
}

// --- How sure ------------------------------------------------------------------------------------
Section search(const FitDocument& d, Pictures& pictures) {
  if (!d.certificate) return {};
  const auto& c = *d.certificate;
  constexpr auto title = "Whether other values fit better";
  if (c.cells.empty())
    return {title, "No width, exponent or index is free: nothing was searched.", {}};
  std::vector<std::string> fitted;
  double first = no_value;
  for (const auto& name : c.parameters) {
    const auto p = std::ranges::find(d.parameters, name, &FittedParameter::name);
    if (p == d.parameters.end() || p->value.empty()) continue;
    const double value =
        p->excluded.empty() || !known(p->excluded[0]) ? p->value[0] : p->excluded[0];
    if (!known(value)) continue;
    if (fitted.empty()) first = value;
    fitted.push_back(fmt::format("{} {}", name, significant(value)));
  }
  const bool lies = c.lowest >= d.cost * (1 - 1e-6);
  auto words = fmt::format(
      "For each of {} of {}, the other parameters were fitted to a part of the table. The best few "
      "were fitted to the whole table, too, with {} held. {} fits better than this page's fit{}. "
      "The lowest "
      "cost (half the sum of squares) that the search found is {}, the fit's own is {}.{} This is "
      "a search, not a proof.",
      many(c.cells.size(), c.parameters.size() == 1 ? "value" : "pair"),
      fmt::join(c.parameters, " and "), fmt::join(c.parameters, " and "), lies ? "None" : "One",
      fitted.empty() ? "" : fmt::format(" ({})", fmt::join(fitted, ", ")), significant(c.lowest, 6),
      significant(d.cost, 6),
      c.moves > 0 ? fmt::format(" The fit began anew from a better one {}.",
                                many(static_cast<std::size_t>(c.moves), "time"))
                  : "");
  double least = c.thinned_cost;
  for (const auto& cell : c.cells)
    if (known(cell.cost)) least = std::min(least, cell.cost);
  const auto above = [&](const CertificateCell& cell) {
    return known(cell.cost) && least > 0 ? std::max(1.0, cell.cost / least) : no_value;
  };
  if (!(least > 0)) return {title, std::move(words), {}};  // nothing to draw beside it
  std::vector<std::vector<double>> places(c.parameters.size());
  for (std::size_t a = 0; a < places.size(); ++a) {
    for (const auto& cell : c.cells) places[a].push_back(cell.at[a]);
    std::ranges::sort(places[a]);
    places[a].erase(std::ranges::unique(places[a]).begin(), places[a].end());
  }
  if (places.size() == 1) {
    Figure f = make_figure("search");
    f.title = "Least cost at each " + c.parameters[0];
    f.x = {c.parameters[0], places[0][0] > 0};
    f.y = {"least cost, relative to the lowest known", true};
    FigureCurve curve{"least cost", {}, {}, FigureCurve::Kind::both};
    for (const auto& cell : c.cells) {
      curve.x.push_back(cell.at[0]);
      curve.y.push_back(above(cell));
    }
    const auto [low, high] = std::ranges::minmax(curve.y);
    f.curves.push_back(std::move(curve));
    if (known(first)) {
      f.curves.push_back({"fit", {first, first}, {std::max(low, 1.0), std::max(high, 1.01)}});
      f.curves.back().dashed = true;
    }
    const Shown picture{f.family};
    pictures.figures.push_back(std::move(f));
    return {title, std::move(words), {picture}};
  }
  FigureMap m = make_map("search");
  m.title = "Least cost of each cell";
  m.value = "relative to the lowest known";
  m.scale = FigureMap::Scale::log;
  for (auto* axis : {&m.x, &m.y}) {
    const std::size_t a = axis == &m.x ? 0 : 1;
    axis->label = c.parameters[a];
    axis->log = places[a][0] > 0;
    axis->at = places[a];
  }
  std::vector<double> sizes;
  m.values.assign(m.x.size() * m.y.size(), no_value);
  for (const auto& cell : c.cells) {
    const auto place = [&](std::size_t a) {
      return static_cast<std::size_t>(std::ranges::find(places[a], cell.at[a]) - places[a].begin());
    };
    m.values[place(0) * m.y.size() + place(1)] = above(cell);
    sizes.push_back(above(cell) - 1);
  }
  m.begin = 1;
  m.limit = 1 + limit_of(std::move(sizes));
  const Shown picture{m.family};
  pictures.maps.push_back(std::move(m));
  return {title, std::move(words), {picture}};
}

Section confidence(const FitDocument& d, Pictures& pictures) {
  const auto rows = rows_of_known(d);
  const auto tied = strongest_correlation(d);
  Group beside{"columns", {}};
  if (rows.size() > 1) {
    FigureMap m = make_map("correlation");
    m.title = "Correlation of the estimates";
    if (rows.size() < d.free_names.size())
      m.note = "without parameters that are not known, or stand at a bound";
    m.value = "correlation";
    m.diverging = true;
    m.limit = 1;
    for (const std::size_t i : rows) m.x.names.push_back(d.free_names[i]);
    m.y.names = {m.x.names.rbegin(), m.x.names.rend()};
    for (const std::size_t i : rows)
      for (auto j = rows.rbegin(); j != rows.rend(); ++j)
        m.values.push_back(*j < i ? no_value : i == *j ? 1 : d.correlations[*j][i]);
    beside.parts.emplace_back(Shown{m.family});
    pictures.maps.push_back(std::move(m));
  }
  for (const auto& s : d.sensitivity) {
    page::Table t{columns("|>relative change"), {}, "scroll"};
    for (const auto& [name, changes] : s.relative_change) {
      std::vector<std::string> texts;
      for (const double x : changes) texts.push_back(known(x) ? signed_percent(x) : "–");
      t.add("`" + name + "`", fmt::to_string(fmt::join(texts, ", ")));
    }
    t.add("log RMS then", significant(s.log_rms));
    beside.parts.emplace_back(Group{
        "",
        {Subtitle{fmt::format("If samples sat at the {} of their bins", s.other)}, std::move(t)}});
  }
  if (beside.parts.empty()) return {};
  return {"How well the parameters are separated",
          tied && std::abs(tied->rho) > 0.005
              ? fmt::format("The pair hardest to tell apart: {} and {}, correlation {}. 0 is "
                            "best. Near −1 or 1 only a combination of both is known.",
                            tied->a, tied->b, rho_text(tied->rho))
              : "",
          {std::move(beside)}};
}

// --- Solver and input ----------------------------------------------------------------------------
namespace {

/// What a phase of a fit does, by its name in the document.
std::string phase_words(std::string name) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 7> plain{
      {{"load", "reading"},
       {"digest", "hash of the file"},
       {"columns", "angles"},
       {"start", "starting values"},
       {"certificate", "search for better values"},
       {"limits", "one-sided limits"},
       {"physics", "albedo"}}};
  if (name.ends_with("_ms")) name.resize(name.size() - 3);
  const auto at = std::ranges::find(plain, name, [](const auto& p) { return p.first; });
  return at == plain.end() ? words(name) : std::string(at->second);
}

}  // namespace

Section solver(const FitDocument& d, Pictures& pictures) {
  const auto& s = d.solver;
  Group beside{"columns", {}};
  const auto& cost = s.cost_per_iteration;
  if (cost.size() > 1) {
    const auto [low, high] = std::ranges::minmax(cost);
    const auto steps = many(cost.size() - 1, "step");
    if (high / low - 1 > 0.01) {
      Figure f = make_figure("cost_per_iteration");
      f.title = "Cost per iteration";
      f.note = fmt::format("{} → {}", significant(cost.front()), significant(d.cost));
      f.x = {"iteration"};
      f.y = {"cost", low > 0};
      std::vector<double> at(cost.size());
      std::iota(at.begin(), at.end(), 0);
      f.curves.push_back({"cost", std::move(at), cost});
      beside.parts.emplace_back(Shown{f.family, {}, 200});
      pictures.figures.push_back(std::move(f));
    } else {
      beside.parts.emplace_back(Prose{fmt::format(
          "The cost changed by {} over {}, so there is no plot.", percent(high / low - 1), steps)});
    }
  }
  double total = 0;
  for (const auto& [phase, ms] : s.phase_ms) total += ms;
  if (total > 0) {
    page::Table t{columns("|>time|>share|"), {}, "scroll"};
    for (const auto& [phase, ms] : s.phase_ms) {
      auto& row =
          t.rows.emplace_back(std::vector{Cell(phase_words(phase)), Cell(milliseconds_text(ms)),
                                          Cell(percent(ms / total)), Cell()});
      row.back().mark = bar(ms / total);
    }
    beside.parts.emplace_back(
        Group{"", {Subtitle{"Time, " + milliseconds_text(total)}, std::move(t)}});
  }
  beside.parts.emplace_back(
      Pairs{{{"termination", words(s.termination)},
             {"iterations", count_text(static_cast<std::size_t>(s.iterations))},
             {"cost", significant(d.cost, 6)},
             {"instruction set", s.instruction_set},
             {"passes over the data", count_text(static_cast<std::size_t>(s.passes))},
             {"metric", words(d.metric)},
             {"log offset", d.log_offset > 0 ? significant(d.log_offset) + " 1/sr" : ""},
             {"robust loss", words(d.robust)}}});
  return {"How the solver got there",
          s.iterations == 0 && s.termination == "converged"
              ? "The starting values were already at this minimum: the solver changed nothing."
              : s.message,
          {std::move(beside)}};
}
Section input(const FitDocument& d, const std::string& document) {
  std::vector<std::string> left_out;
  for (const auto& [why, n] : d.masked)
    if (n > 0) left_out.push_back(count_text(n) + " " + words(why));
  return {
      "Input",
      "",
      {Pairs{
          {{"file", "`" + d.input_path + "`"},
           {"SHA-256", "`" + d.input_sha256 + "`"},
           {"format", d.input_format},
           {"bins", d.bins == "none" ? "none: samples are points"
                                     : fmt::format("samples at the {} of their bins", d.bins)},
           {"values used", count_text(d.values_used)},
           {"left out", left_out.empty() ? "none" : fmt::to_string(fmt::join(left_out, ", "))},
           {"mask", d.mask ? "`" + *d.mask + "`" : ""},
           {"with sliders", document.empty() ? ""
                                             : fmt::format("`gonio explore {} {} -o explore.html`",
                                                           path_word(file_name(d.input_path)),
                                                           path_word(file_name(document)))}}}}};
}

}  // namespace gonio::fit_sections
