// gonio explore: models and tables as a page to play with.
#include <filesystem>

#include "base/file.h"
#include "brdf/model/own_files.h"
#include "cli/line/command.h"
#include "cli/line/reading.h"
#include "cli/line/terminal.h"
#include "reports/explore/page.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace gonio::cli {
namespace {

struct ExploreCall : Common {
  std::vector<std::string> what, set;
  std::string output;
  std::optional<Bins> bins;
  bool app = false;
};

Exit run(const ExploreCall& o) {
  use(o);
  if (o.what.size() > most_explored)
    throw wrong_usage(fmt::format("explore: {} models and tables, expected {} at most",
                                  o.what.size(), most_explored));
  if (!o.set.empty() && o.what.size() != 1) throw wrong_usage("--set goes with one model only");
  std::vector<std::string> inputs;
  for (const auto& w : o.what)
    if (std::filesystem::exists(w) || !file_in(w).empty()) inputs.push_back(w);
  check_outputs(inputs, {o.output});
  OutputFile out(o.output);
  Progress progress(o.quiet);
  std::vector<Explored> all;
  nlohmann::ordered_json document{{"page", o.output}, {"items", nlohmann::ordered_json::array()}};
  // Models have as many channels as the tables beside them.
  std::vector<std::optional<ExploredTable>> tables(o.what.size());
  std::optional<std::size_t> channels;
  for (std::size_t i = 0; i < o.what.size(); ++i) {
    if (!names_table(o.what[i])) continue;
    if (!o.set.empty()) throw wrong_usage("--set goes with a model, not with a table");
    progress("reading " + o.what[i]);
    tables[i] = explore_file(o.what[i], o.bins);
    channels = std::max(channels.value_or(1), tables[i]->channels.size());
  }
  for (std::size_t i = 0; i < o.what.size(); ++i) {
    const std::string& w = o.what[i];
    if (auto& t = tables[i]) {
      document["items"].push_back({{"table", w},
                                   {"values", t->values},
                                   {"typical_factor", t->loss},
                                   {"covered", t->covered}});
      all.emplace_back(std::move(*t));
    } else {
      auto m = explore_model(w, parse_settings(o.set), channels);
      const auto spec = to_text(m.model.model.model.spec);
      if (names_own_file(spec))
        throw wrong_usage(
            fmt::format("{}: a page has the catalogue's terms only, no functions of files", spec));
      document["items"].push_back({{"model", w}, {"spec", spec}});
      all.emplace_back(std::move(m));
    }
  }
  out.write(explore_page_html(all, o.app));
  out.commit();
  progress.clear();
  if (o.json) {
    print_document(document);
    return Exit::done;
  }
  for (const auto& e : all)
    if (const auto* t = std::get_if<ExploredTable>(&e))
      say("{}: {} values; resampled for the spheres, typically off by ×/÷ {:.3f}{}\n", t->name,
          t->values, t->loss,
          t->covered < 0.995
              ? fmt::format("; {:.0f} % of the values have no place there", 100 * (1 - t->covered))
              : "");
  say("{}: open it in a browser\n", o.output);
  return Exit::done;
}

}  // namespace

void add_explore(CommandLine& line) {
  auto [c, o] =
      line.command<ExploreCall>("explore",
                                "Makes a page to play with models and tables: sliders, plots and a "
                                "lit sphere, drawn by this program's own code",
                                "gonio explore paint.binary paint.json "
                                "lambert+ggx/smith_ggx.correlated/schlick -o paint.html",
                                run);
  c.option(
      "WHAT", o->what,
      "Models, the fit.json of fits, and tables, eight at most; none for a model to begin with");
  add_set(c, o->set);
  add_bins(c, o->bins);
  c.option("-o,--output", o->output, "Page to write, .html").required();
  c.flag("--app", o->app,
         "The page reads and fits tables that are dropped on it, as one with a table always does: "
         "gonio in a browser");
  add_follow_paths(c, *o);
  add_jobs(c, *o);
  add_output(c, *o);
}

}  // namespace gonio::cli
