#include "reports/pages/models_page.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>

#include "brdf/model/model_names.h"
#include "fitting/choice/document.h"
#include "reports/finding/names.h"
#include "reports/page/numbers.h"
#include "reports/page/render.h"
#include "reports/pages/fields.h"
#include "reports/pages/spheres_section.h"
#include "reports/pages/table_sections.h"
#include "reports/picture/document.h"
#include "reports/picture/front.h"
#include "table/cut/cuts.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace gonio {
namespace {

/// The document of a choice has its description where it is made.
constexpr JsonForm choice_json{
    [](const void* v) { return Json::parse(static_cast<const Embedded<ModelChoice>*>(v)->text); },
    nullptr,
    [] {
      Json schema = Json::parse(models_schema());
      schema.erase("$schema");
      schema.erase("title");
      return schema;
    }};

}  // namespace

template <>
inline constexpr const JsonForm* json_form<Embedded<ModelChoice>> = &choice_json;

namespace {

/// Document of a page of models.
struct ModelsPageDocument {
  Embedded<ModelChoice> choice;
  const ModelsPage* page;
};
constexpr auto in_page(auto member) {
  return at([](const ModelsPageDocument& d) -> const ModelsPage& { return *d.page; }, member);
}

}  // namespace

template <>
inline constexpr auto description<ModelsPageDocument> = FieldList{
    Field{"choice", &ModelsPageDocument::choice, "the document of the choice, gonio.models/1"},
    Field{"names", in_page(&ModelsPage::names), "of each model, as people say them"},
    Field{"numbers", in_page(&ModelsPage::numbers),
          "of each model, from 1 by its error; 0: not compared"},
    inlined(in_page(&ModelsPage::pictures)),
    Field{"spheres", in_page(&ModelsPage::spheres),
          "the same sphere, table and each model that was compared"}};

namespace {

/// Rows that were compared, by their numbers.
std::vector<std::size_t> by_error(const ModelChoice& choice) {
  std::vector<std::size_t> order;
  for (std::size_t k = 0; k < choice.rows.size(); ++k)
    if (choice.rows[k].compared) order.push_back(k);
  const auto error = [&](std::size_t k) {  // what is not known comes last
    const double e = error_of(choice, choice.rows[k]);
    return std::isnan(e) ? std::numeric_limits<double>::infinity() : e;
  };
  std::ranges::stable_sort(order, {}, error);
  return order;
}

Figure error_and_time(const ModelChoice& choice,
                      const Advice& advice,
                      const std::vector<std::size_t>& order) {
  std::vector<FrontDot> all, recommended, as_good, others;
  std::vector<std::size_t> shown;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const auto& row = choice.rows[order[i]];
    if (const double error = error_of(choice, row); !std::isnan(error)) {
      all.push_back({fmt::to_string(i + 1), {{row.ns, row.ns_spread}, error}});
      shown.push_back(order[i]);
    }
  }
  mark_front(all);
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const auto& model = choice.rows[shown[i]].model;
    const bool is_as_good = std::ranges::find(advice.as_good, model) != advice.as_good.end();
    (model == advice.recommended ? recommended : is_as_good ? as_good : others).push_back(all[i]);
  }
  Figure f = make_figure("error_and_time");
  f.title = "Error left against time";
  f.x = {"time of one sample [ns]", true};
  f.y = {choice.blocks > 0 ? "log RMS on held-out incident angles" : "log RMS over the table",
         true};
  if (auto line = front_line("front", all)) f.curves.push_back(std::move(*line));
  for (const auto& [name, dots] :
       {std::pair(advice.none_fits ? "nearest" : "recommended", &recommended),
        {"as good", &as_good},
        {"other models", &others}})
    if (!dots->empty()) f.curves.push_back(front_points(name, *dots));
  return f;
}

/// Points that have a value.
FigureCurve valued_points(std::string name,
                          const std::vector<double>& x,
                          const std::vector<double>& y) {
  FigureCurve c;
  c.name = std::move(name);
  c.kind = FigureCurve::Kind::points;
  for (std::size_t i = 0; i < x.size(); ++i)
    if (std::isfinite(y[i])) {
      c.x.push_back(x[i]);
      c.y.push_back(y[i]);
    }
  return c;
}

/// Ends of y that hold the data and some room: a model may leave them.
void set_ends(FigureAxis& y, const FigureCurve& data) {
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (std::size_t i = 0; i < data.x.size(); ++i)
    if (std::abs(data.x[i]) <= scale_to_deg && data.y[i] > 0) {
      least = std::min(least, data.y[i]);
      most = std::max(most, data.y[i]);
    }
  if (most == 0) return;
  const double room = 1.6 * std::pow(most / least, 0.05);
  y.from = least / room;
  y.to = most * room;
}

/// A picture for each cut and channel: the data, and each model by its number.
void add_curves(Pictures& to,
                const gonio::Table& t,
                const ModelChoice& choice,
                const std::vector<std::size_t>& order,
                const std::vector<std::string>& channels) {
  std::vector<std::vector<Cut>> cuts;
  for (const std::size_t k : order) cuts.push_back(make_cuts(t, choice.fits[k]));
  if (cuts.empty()) return;
  // Cuts of a list follow the model: an anisotropic one is shown near its own azimuths alone.
  std::size_t frame = 0;
  while (frame < order.size() && choice.fits[order[frame]].model.anisotropic) ++frame;
  if (frame == order.size()) frame = 0;
  for (const auto& channel : channels) {
    const auto c =
        static_cast<std::size_t>(std::ranges::find(t.channels, channel) - t.channels.begin());
    for (const Cut& cut : cuts[frame]) {
      const bool in_plane = cut.along == "theta_o";
      Figure f =
          make_figure("curves", {{"channel", channel}, {"at", fmt::format("{:.4g}", cut.at_deg)}});
      f.title = fmt::format("{} = {:.3g}°", cut.at == "theta_i" ? "θ_i" : "θ_d", cut.at_deg);
      if (cut.within_deg > 0) f.note = fmt::format("data within ±{:.3g}°", cut.within_deg);
      f.x = {in_plane ? "θ_o [°], mirror side positive" : "θ_h [°]", false, in_plane ? -90.0 : 0,
             90};
      f.y = {"f_r [1/sr]", true};
      auto data = valued_points("data", cut.deg, cut.data[c]);
      if (data.x.empty()) continue;
      data.dashed = true;  // what the models are held against
      set_ends(f.y, data);
      f.curves.push_back(std::move(data));
      for (std::size_t m = 0; m < order.size(); ++m) {
        const auto same = std::ranges::find_if(cuts[m], [&](const Cut& other) {
          return other.at == cut.at && other.at_deg == cut.at_deg;
        });
        if (same == cuts[m].end()) continue;
        FigureCurve line;
        line.name = fmt::to_string(m + 1);
        line.x = same->deg;
        line.y = same->model[c];
        f.curves.push_back(std::move(line));
      }
      to.figures.push_back(std::move(f));
    }
  }
}

}  // namespace

double error_of(const ModelChoice& choice, const ModelRow& row) {
  return choice.blocks > 0 ? row.cv_log_rms : row.log_rms;
}

Spheres add_spheres(const gonio::Table& t, ModelChoice& choice) {
  std::vector<BoundModel> models;
  std::vector<ModelRow*> rows;
  for (std::size_t k = 0; k < choice.rows.size(); ++k)
    if (choice.rows[k].compared) {
      models.push_back(choice.fits[k]);
      rows.push_back(&choice.rows[k]);
    }
  Spheres spheres = make_spheres(t, models);
  const auto covered = [](const SpheresUnderLight& l) { return !l.models.empty(); };
  const auto lights = std::ranges::count_if(spheres.lights, covered);
  for (std::size_t k = 0; k < rows.size() && lights > 0; ++k) {
    rows[k]->delta_e_2000 = rows[k]->delta_e_itp = 0;
    for (const auto& l : spheres.lights)
      if (covered(l)) {
        rows[k]->delta_e_2000 += l.models[k].median / static_cast<double>(lights);
        rows[k]->delta_e_itp += l.models[k].itp_median / static_cast<double>(lights);
      }
  }
  return spheres;
}

ModelsPage make_models_page(const gonio::Table& table,
                            const ModelChoice& choice,
                            const Advice& advice,
                            Spheres spheres) {
  ModelsPage page;
  std::vector<std::string> models;
  for (const auto& r : choice.rows) models.push_back(r.model);
  page.names = model_names(models);
  const auto order = by_error(choice);
  page.numbers.assign(choice.rows.size(), 0);
  for (std::size_t i = 0; i < order.size(); ++i) page.numbers[order[i]] = i + 1;
  page.pictures.figures.push_back(error_and_time(choice, advice, order));
  add_curves(page.pictures, table, choice, order, spheres.channels);
  page.spheres = std::move(spheres);
  return page;
}

std::string to_json(const ModelsPage& page, std::string_view choice_json) {
  return page_document(ModelsPageDocument{{choice_json}, &page});
}

std::string models_page_schema() {
  return schema_text<ModelsPageDocument>("Page of models compared on a table");
}

}  // namespace gonio

namespace gonio::page {
namespace {

constexpr std::size_t at_once = 6;  ///< models that are drawn before a reader asks for more

/// A row beside what a page calls it.
struct NamedModel {
  const ModelRow& row;
  const std::string& name;
  std::size_t number;
};

class ModelsSections {
 public:
  ModelsSections(const ModelChoice& c, const Advice& a, const ComparedTable& t, const ModelsPage& p)
      : choice_(c), advice_(a), table_(t), page_(p), predicted_(c.blocks > 0) {
    for (std::size_t n = 1; n <= c.rows.size(); ++n)
      for (std::size_t k = 0; k < c.rows.size(); ++k)
        if (p.numbers[k] == n) compared_.push_back({c.rows[k], p.names[k], n});
    for (std::size_t k = 0; k < c.rows.size(); ++k)
      if (p.numbers[k] == 0) left_out_.push_back({c.rows[k], p.names[k], 0});
  }
  std::string html();

 private:
  const NamedModel& taken() const {
    return *std::ranges::find(
        compared_, advice_.recommended,
        [](const NamedModel& m) -> const auto& { return m.row.model; });
  }
  bool as_good(const NamedModel& m) const {
    return std::ranges::find(advice_.as_good, m.row.model) != advice_.as_good.end();
  }
  /// A sentence of the document, its specs as names; of the recommended one, which has just been named, "this model".
  std::string in_words(std::string text) const {
    std::vector<const NamedModel*> longest;
    for (const auto* list : {&compared_, &left_out_})
      for (const auto& m : *list) longest.push_back(&m);
    std::ranges::sort(longest, std::greater{},
                      [](const NamedModel* m) { return m->row.model.size(); });
    std::string out;
    while (!text.empty()) {
      const auto begins = [&](const NamedModel* m) { return text.starts_with(m->row.model); };
      const bool inside =
          !out.empty() && std::string_view(" ,;:(").find(out.back()) == std::string_view::npos;
      const auto at = inside ? longest.end() : std::ranges::find_if(longest, begins);
      if (at == longest.end()) {
        out += text.front();
        text.erase(0, 1);
      } else {
        out += (*at)->row.model == advice_.recommended ? "this model" : (*at)->name;
        text.erase(0, (*at)->row.model.size());
      }
    }
    return capital(std::move(out));
  }
  std::vector<Part> verdict() const;
  Section models() const;
  Section curves(Pictures&) const;
  Spheres spheres() const;

  const ModelChoice& choice_;
  const Advice& advice_;
  const ComparedTable& table_;
  const ModelsPage& page_;
  bool predicted_;  ///< whether incident angles were left out
  std::vector<NamedModel> compared_, left_out_;
};

std::string in_a_row(const std::vector<std::string>& list) {
  if (list.size() < 2) return list.empty() ? "" : list[0];
  return fmt::format("{} and {}", fmt::join(list.begin(), list.end() - 1, ", "), list.back());
}

std::vector<Part> ModelsSections::verdict() const {
  std::vector<Part> out;
  const auto say = [&](std::string text) { out.emplace_back(Prose{std::move(text), "verdict"}); };
  if (compared_.empty()) return out;
  const auto& m = taken();
  say(fmt::format("{} **{}**: `{}`.",
                  advice_.none_fits ? "No model fits the table. The nearest is" : "Take", m.name,
                  m.row.model));
  say(in_words(advice_.reason));
  if (!predicted_)
    say(fmt::format("On the angles fitted, model and table typically differ by {}.",
                    factor_text(m.row.log_rms)));
  std::vector<std::string> alike, not_compared;
  for (const auto& other : compared_)
    if (as_good(other)) alike.push_back(other.name);
  if (!alike.empty()) say(fmt::format("The table cannot tell it from {}.", in_a_row(alike)));
  for (const auto& d : advice_.disagreement) say(in_words(d));
  Points warnings{{}, "warnings"};
  if (!m.row.converged)
    warnings.each.push_back(fmt::format("**Not converged:** the fit of {}.", m.name));
  for (const auto& b : advice_.beware) warnings.each.push_back("**Beware:** " + in_words(b));
  for (const auto& l : left_out_) not_compared.push_back(l.name);
  if (!not_compared.empty())
    warnings.each.push_back(
        fmt::format("**Not compared:** {}. The list of models says why.", in_a_row(not_compared)));
  if (!warnings.each.empty()) out.emplace_back(std::move(warnings));
  return out;
}

/// Why a model was not compared, where its id has just been written.
std::string note_of(const ModelRow& r) {
  const auto named = fmt::format("model '{}' is", r.model);
  return r.note.starts_with(named) ? " is" + r.note.substr(named.size()) + "."
                                   : ": " + r.note + ".";
}

Section ModelsSections::models() const {
  const bool sphere = std::ranges::any_of(
      compared_, [](const NamedModel& m) { return std::isfinite(m.row.delta_e_2000); });
  page::Table t{
      columns(fmt::format("model{}|>log RMS|>BIC{}|>time [ns]|>free|at the end of its range",
                          predicted_ ? "|>unseen" : "", sphere ? "|>ΔE2000" : "")),
      {},
      "told-by-cell"};
  for (const auto* list : {&compared_, &left_out_})
    for (const auto& m : *list) {
      const auto& r = m.row;
      auto& row = t.rows.emplace_back();
      const bool recommended = r.model == advice_.recommended;
      t.row_looks.emplace_back(recommended ? "chosen" : "");
      row.emplace_back(
          fmt::format("{}{}{}", m.number ? fmt::format("{}\u2002", m.number) : "", m.name,
                      recommended
                          ? advice_.none_fits ? "\u2002**nearest**" : "\u2002**recommended**"
                      : as_good(m) ? "\u2002as good"
                                   : ""),
          "", fmt::format("`{}`{}", r.model, r.note.empty() ? "" : note_of(r)));
      const auto number = [&](double x, const std::string& text) {
        row.emplace_back(std::isfinite(x) ? text : "–");
      };
      if (predicted_) number(r.cv_log_rms, significant(r.cv_log_rms));
      number(r.log_rms, significant(r.log_rms));
      number(r.bic, (r.bic < 0 ? "−" : "") +
                        count_text(static_cast<std::size_t>(
                            std::isfinite(r.bic) ? std::lround(std::abs(r.bic)) : 0)));
      if (sphere) number(r.delta_e_2000, delta_e_text(r.delta_e_2000));
      number(r.ns, significant(r.ns, 2));
      row.emplace_back(m.number ? fmt::to_string(r.parameters) : "–");
      row.emplace_back(m.number == 0 ? "–"
                       : r.parameters_at_bound.empty()
                           ? "none"
                           : fmt::to_string(fmt::join(r.parameters_at_bound, ", ")));
    }
  return {
      "The models",
      fmt::format("The nearest first, {}.",
                  predicted_ ? "on incident angles held out of the fit" : "over the angles fitted"),
      {std::move(t)},
      "models"};
}

Section ModelsSections::curves(Pictures& pictures) const {
  auto channels = values_of(pictures, "curves", "channel");
  Section out{"Data and models", {}, {}};
  if (channels.empty()) {
    out.text = "No valid sample lies in the plane of incidence: there is no curve to draw.";
    return out;
  }
  out.text =
      "Points are the table's samples, lines the fitted models by their numbers, without the "
      "cosine. A "
      "line leaves the picture where its model is far above or below the table.";
  Choice c;
  c.controls = {{"scale", "Scale of f_r", "logarithmic"}, {"channel", "Channel", channels[0]}};
  c.look = "";
  Slot slot;
  slot.on_paper = false;
  std::vector<Figure> drawn;
  for (const bool log : {true, false})
    for (const auto& channel : channels) {
      Group panels{"panels alike", {}};
      for (Figure f : pictures.figures) {
        if (f.family != "curves" || f.choices[0].second != channel) continue;
        f.family = log ? "logarithmic" : "linear";
        f.y.log = log;
        if (!log) f.y.from = 0;
        for (auto& curve : f.curves) {
          if (curve.name == "data") {
            curve.label = "table";
            continue;
          }
          curve.label =
              fmt::format("{}\u2002{}", curve.name, compared_[std::stoul(curve.name) - 1].name);
        }
        panels.parts.emplace_back(Shown{f.family, f.choices, 250});
        drawn.push_back(std::move(f));
      }
      slot.each.push_back({{log ? "logarithmic" : "linear", channel}, {std::move(panels)}});
    }
  std::erase_if(pictures.figures, [](const Figure& f) { return f.family == "curves"; });
  std::ranges::move(drawn, std::back_inserter(pictures.figures));
  c.slots.push_back(std::move(slot));
  out.parts.emplace_back(std::move(c));
  return out;
}

/// The spheres with names for specs, nearest model first.
Spheres ModelsSections::spheres() const {
  Spheres out = page_.spheres;
  std::vector<std::size_t> place;  // of each compared row among the compared ones
  for (std::size_t k = 0; k < page_.numbers.size(); ++k)
    if (page_.numbers[k] > 0) place.push_back(page_.numbers[k] - 1);
  for (std::size_t k = 0; k < place.size(); ++k) out.models[place[k]] = compared_[place[k]].name;
  for (std::size_t l = 0; l < out.lights.size(); ++l)
    for (std::size_t k = 0; k < out.lights[l].models.size(); ++k)
      out.lights[l].models[place[k]] = page_.spheres.lights[l].models[k];
  return out;
}

std::string ModelsSections::html() {
  const auto file = file_name(table_.path);
  Pictures pictures = page_.pictures;
  Page out{"", "fit --models", "Models for " + table_.path, "Which model for " + file};
  out.first = verdict();
  for (const auto& c : compared_) {
    if (c.number > at_once) break;
    out.most_shipped.push_back(fmt::to_string(c.number));
  }
  auto front = Section{
      "How near, and how fast",
      fmt::format(
          "Each point is a model, with its number in the list below. Further down is nearer to the "
          "table, further left is faster. The dashed line joins the models that no other beats in "
          "both. {}",
          predicted_ ? "Nearness is judged on incident angles held out of the fit."
                     : "The table has too few incident angles to leave some out: nearness is that "
                       "over the angles fitted."),
      {Shown{"error_and_time", {}, 380}}};
  auto drawn = curves(pictures);
  Section input{
      "Input, and how it was judged",
      "",
      {Pairs{{{"file", "`" + table_.path + "`"},
              {"SHA-256", "`" + table_.sha256 + "`"},
              {"format", table_.format},
              {"mask", table_.mask.empty() ? "" : "`" + table_.mask + "`"},
              {"metric of the fits", words(table_.metric)},
              {"held out in turn",
               predicted_ ? many(choice_.blocks, "block") + " of neighbouring incident angles"
                          : "nothing: the table has too few incident angles"},
              {"values", std::isfinite(choice_.effective_values)
                             ? fmt::format("as much as {} independent ones, which BIC counts",
                                           count_text(static_cast<std::size_t>(
                                               std::lround(choice_.effective_values))))
                             : ""},
              {"this model's own fit",
               compared_.empty()
                   ? ""
                   : fmt::format("`gonio fit {} --model {}{} -o fit.json --html fit.html`",
                                 path_word(file), taken().row.model,
                                 table_.mask.empty() ? "" : " --mask " + shell_word(table_.mask))},
              {"with sliders",
               compared_.empty() ? ""
                                 : fmt::format("`gonio explore {} {} -o explore.html`",
                                               path_word(file), taken().row.model)}}}}};
  Section meanings{
      "What the words mean",
      "",
      {Pairs{
          {{"log RMS", fmt::format("typical size of ln(model ÷ table): 0.1 is a factor of 1.1. {}",
                                   floor_in_words(choice_))},
           {"free", "parameters that were fitted, counted per channel"},
           {"unseen",
            "log RMS on incident angles that were held out of the fit. It grows where a model has "
            "more parameters than the table can determine"},
           {"as good",
            "said of a model whose `unseen` is at most 5 % above the best (more where values are "
            "few) and within its error over the blocks, or at most 0.1 % above, and whose BIC is "
            "at "
            "most 10 above the least"},
           {"BIC",
            "judges the fit to the whole table, and penalises each free value; less is better, and "
            "only differences count"},
           {"ΔE2000",
            "difference of colour between a sphere of the table and one of the model: half of the "
            "pixels are within it, averaged over three lights. Above 1 it is seen side by side"},
           {"time", "that one sample takes in all channels, in float, on this machine"},
           {"at the end of its range",
            "said of a parameter that the data push beyond what it may be: the model lacks "
            "something"},
           {"front", "models that no other beats in both speed and nearness"}}}},
      "words"};
  out.sections = {std::move(front), models(),
                  std::move(drawn), spheres_section(spheres(), "", at_once),
                  std::move(input), std::move(meanings)};
  out.setting =
      "f_r is in 1/sr, without the cosine. Every number of this page is in the .page.json beside "
      "it.";
  return page_html(out, pictures);
}

}  // namespace
}  // namespace gonio::page

namespace gonio {

std::string models_page_html(const ModelChoice& c,
                             const Advice& a,
                             const ComparedTable& t,
                             const ModelsPage& p) {
  return page::ModelsSections(c, a, t, p).html();
}

}  // namespace gonio
