#include "reports/pages/models_page.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fitting/choice/document.h"
#include "reports/page/assets.h"
#include "reports/page/page.h"
#include "reports/pages/fields.h"
#include "reports/pages/model_names.h"
#include "reports/picture/document.h"
#include "reports/picture/front.h"
#include "table/cut/cuts.h"

#include <fmt/format.h>
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

}  // namespace

template <>
struct Description<ModelsPageDocument> {
  static constexpr auto fields() {
    using D = ModelsPageDocument;
    return std::tuple{field("choice", "", &D::choice, "the document of the choice, gonio.models/1"),
                      field(
                          "names", "", [](const D& d) -> const auto& { return d.page->names; },
                          "of each model, as people say them"),
                      field(
                          "numbers", "", [](const D& d) -> const auto& { return d.page->numbers; },
                          "of each model, from 1 by its error; 0: not compared"),
                      inlined([](const D& d) { return d.page->pictures; }),
                      field(
                          "spheres", "", [](const D& d) -> const auto& { return d.page->spheres; },
                          "the same sphere, table and each model that was compared")};
  }
};

namespace {

constexpr double grazing_deg = 85;  ///< values beyond would set the scale for all others

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
  std::vector<TimedError> places;
  std::vector<std::size_t> shown;
  for (const std::size_t k : order)
    if (const double error = error_of(choice, choice.rows[k]); !std::isnan(error)) {
      places.push_back({{choice.rows[k].ns, choice.rows[k].ns_spread}, error});
      shown.push_back(k);
    }
  std::vector<FrontDot> all, recommended, as_good, others;
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const auto place = front_place(places, i);
    const auto& model = choice.rows[shown[i]].model;
    const auto number = std::ranges::find(order, shown[i]) - order.begin() + 1;
    all.push_back({fmt::to_string(number), places[i], place.on_line});
    const bool is_as_good = std::ranges::find(advice.as_good, model) != advice.as_good.end();
    (model == advice.recommended ? recommended
     : is_as_good                ? as_good
                                 : others)
        .push_back(all.back());
  }
  Figure f = make_figure("error_and_time");
  f.title = "Error left against time";
  f.x = {"time of one sample [ns]", true};
  f.y = {choice.blocks > 0 ? "log RMS on unseen incident angles" : "log RMS over the table", true};
  if (auto line = front_line("front", all)) f.curves.push_back(std::move(*line));
  for (const auto& [name, dots] :
       {std::pair("recommended", &recommended), {"as good", &as_good}, {"other models", &others}})
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
    if (std::abs(data.x[i]) <= grazing_deg && data.y[i] > 0) {
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
                const Table& t,
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

Spheres add_spheres(const Table& t, ModelChoice& choice) {
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

ModelsPage make_models_page(const Table& table,
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

std::string models_page_html(std::string_view title, std::string_view data) {
  return make_report_page(title, data, std::string(assets::spheres_js).append(assets::models_js));
}

}  // namespace gonio
