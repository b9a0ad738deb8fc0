// gonio audit: what every entry of the catalogue keeps and breaks.
#include "reports/audit/audit.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "cli/line/command.h"
#include "cli/line/output_files.h"
#include "cli/line/reading.h"
#include "cli/line/terminal.h"
#include "reports/own/audit_file.h"
#include "reports/page/numbers.h"

#include <fmt/format.h>

namespace gonio::cli {
namespace {

struct AuditCall : Common {
  ReadingWords reading;
  std::vector<std::string> ids;
  bool all = false;
  std::string html;
};

std::string near_one(const std::optional<Worst>& w) {
  if (!w) return "";
  if (!std::isfinite(w->value)) return "diverges";
  return std::abs(w->value - 1) < 5e-7 ? "1" : fmt::format("{:.4g}", w->value);
}

void print_table(const std::vector<EntryAudit>& entries) {
  fmt::print("{:<40}{:>9} {:>11} {:>10} {:>20} {:>4}  {}\n", "", "∫D cosθ", "reciprocity",
             "albedo ≤", "range", "ops", "verdict");
  for (const auto& e : entries) {
    const std::size_t operations = e.operations ? e.operations->total() : 0;
    fmt::print("{:<40}{:>9} {:>11} {:>10} {:>20} {:>4}  {}\n", e.about->id,
               near_one(e.normalisation),
               !e.reciprocity                ? ""
               : e.reciprocity->value > 1e-9 ? fmt::format("{:.2g}", e.reciprocity->value)
                                             : "yes",
               near_one(e.energy ? e.energy : e.energy_under_lobe),
               e.lowest && e.highest && e.kind != "map"
                   ? fmt::format("{:.3g} … {:.3g}", e.lowest->value, e.highest->value)
                   : "",
               e.operations ? fmt::format("{}", operations) : "", verdict(e));
  }
}

void print_one(const EntryAudit& e) {
  fmt::print("{}  {}\n  {}\n  {}\n", e.about->id, e.about->title, e.about->formula,
             e.about->source);
  const auto line = [](const char* name, const std::string& value) {
    fmt::print("  {:<16}{}\n", name, value);
  };
  const auto worst = [&](const char* name, const std::optional<Worst>& w) {
    if (!w) return;
    line(name, fmt::format(
                   "{}{}",
                   w->error > 0
                       ? fmt::format("{} ± {:.1g}", page::with_error(w->value, w->error), w->error)
                       : fmt::format("{:.7g}", w->value),
                   w->where.empty() ? "" : " at " + w->where));
  };
  if (!e.about->ships.empty()) line("shipped by", std::string(e.about->ships));
  worst("∫ D cos θ", e.normalisation);
  worst("reciprocity", e.reciprocity);
  worst("albedo at most", e.energy);
  if (e.energy) line("", "in the model " + e.energy_of);
  worst("under a lobe", e.energy_under_lobe);
  worst("lowest", e.lowest);
  worst("highest", e.highest);
  worst("value at 90°", e.grazing);
  if (e.not_finite > 0) line("without a value", fmt::format("{} legal inputs", e.not_finite));
  if (e.distance)
    line("distance", fmt::format("{:.4g} at most, RMS {:.4g}, in {} to {}; most at {}",
                                 e.distance->most.value, e.distance->rms, e.distance->measure,
                                 e.distance->reference, e.distance->most.where));
  if (e.operations) {
    std::string text;
    for (std::size_t k = 0; k < operation_names.size(); ++k)
      if (const auto n = e.operations->by_kind[k])
        text += fmt::format("{}{} {}", text.empty() ? "" : ", ", n, operation_names[k]);
    line("operations", text);
  }
  if (e.light_unit != 1)
    line("light", fmt::format("divided by {:.5g}: shipped for lights without 1/π", e.light_unit));
  line("verdict", verdict(e));
}

/// A file's functions have nothing in common with the catalogue's entries but the laws.
Exit run_file(const AuditCall& o) {
  if (o.ids.size() != 1 || o.all || !o.html.empty())
    throw wrong_usage("a shader is audited by itself: gonio audit FILE[:FUNCTION] [--json]");
  Progress progress(o.quiet);
  progress("auditing " + o.ids[0]);
  const auto all = audit_file(read_as(o.ids[0], o.reading), [&](const std::string& function) {
    progress("auditing " + function);
  });
  progress.clear();
  take_foreign_guesses();  // its own lines say them
  const bool any =
      std::ranges::any_of(all, [](const auto& a) { return a.of.function.has_value(); });
  if (o.json)
    fmt::print("{}", to_json(all));
  else
    for (const auto& a : all) fmt::print(any ? stdout : stderr, "{}", text_of(a));
  return any ? Exit::done : Exit::bad_input;
}

Exit run(const AuditCall& o) {
  use(o);
  if (!o.ids.empty() && foreign::is_name(o.ids[0])) return run_file(o);
  if (o.all == !o.ids.empty()) throw wrong_usage("audit takes ids, or --all");
  std::vector<std::string> ids = o.ids;
  if (o.all)
    for (const auto id : auditable_ids()) ids.emplace_back(id);
  OutputFiles out({}, "", o.html);
  TimedProgress progress(o.quiet, "auditing", ids.size());
  const auto entries = audit(ids, [&](std::size_t done) { progress(done); });
  progress.clear();
  const std::string json = to_json(entries);
  if (out.has_page()) out.write_page(audit_page_html(entries), json);
  out.commit();
  if (o.json)
    fmt::print("{}\n", json);
  else if (o.all)
    print_table(entries);
  else
    for (const auto& e : entries) print_one(e);
  return Exit::done;
}

}  // namespace

void add_audit(CommandLine& line) {
  auto [c, o] = line.command<AuditCall>(
      "audit",
      "Measures what entries of the catalogue keep and break: normalisation, "
      "reciprocity, energy, range, and the distance to the form they stand for",
      "gonio audit masking.schlick_ggx.direct\n  gonio audit --all --html audit.html\n  gonio "
      "audit "
      "my.glsl:D_GGX",
      run);
  c.option("ID", o->ids,
           "Terms, maps or models, as `gonio models` lists them; or a shader, FILE[:FUNCTION]");
  add_reading(c, o->reading);
  c.flag("--all", o->all, "The whole catalogue");
  c.option("--html", o->html,
           "A page, NAME.html, and its data beside it, NAME.page.json; of a shader there is none");
  add_jobs(c, *o);
  add_output(c, *o);
}

}  // namespace gonio::cli
