// gonio plan: the effects that each material of a scene needs.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <optional>

#include "base/error.h"
#include "cli/line/command.h"
#include "cli/line/output_files.h"
#include "cli/line/terminal.h"
#include "fitting/export/materialx_plan.h"
#include "geometry/direction.h"
#include "reports/finding/words.h"
#include "reports/scenes/plan_page.h"
#include "scene/plan/cost.h"
#include "scene/plan/document.h"

#include <fmt/format.h>

namespace gonio::cli {
namespace {

using namespace scene;

struct PlanCall : Common {
  std::string scene, output, page, write;
  PlanOptions options;
  std::optional<std::uint64_t> seed;
};

std::string unit_of(const Tolerance& t) {
  return t.metric == Metric::relative ? "relative" : "ΔE2000";
}

void print(const MaterialPlan& m, const Tolerance& t, Cost cost, bool has_budget) {
  const bool looked_up =
      m.needs_table() ||
      (m.forms[Effect::environment] == Form::split_sum &&
       std::ranges::find(m.effects, Effect::environment, &PlannedEffect::effect)->why ==
           Why::measured);
  const auto operations =
      fmt::format("{}{}",
                  std::abs(m.ops_saved) < 0.005 ? "as many operations"
                  : m.ops_saved < 0 ? fmt::format("{:.2g} × the operations", 1 - m.ops_saved)
                                    : fmt::format("{:.0f} % fewer operations", 100 * m.ops_saved),
                  looked_up ? ", lookups not counted" : "");
  const auto time = is_as_fast(m.speedup)
                        ? std::string("as fast")
                        : fmt::format("{:.3g} × as {}", std::max(m.speedup, 1 / m.speedup),
                                      m.speedup < 1 ? "slow" : "fast");
  const bool by_time = cost == Cost::time;
  say("{}: {}{}, {}\n", m.name, m.holds ? "" : "does not hold; ", by_time ? time : operations,
      by_time ? operations : time);
  if (!m.holds)
    say_below("  beware  ",
              not_kept(m, has_budget, "the tolerance") + "; it " + what_is_exceeded(m));
  say("  take    {}\n", m.spec);
  if (m.needs_table())
    say_below("  beware  ", "no shader has the table of the light between facets that this keeps" +
                                (m.without_table ? "; " + without_table(m, t) : std::string()));
  std::string kept, simpler, dropped, none;
  for (const auto& e : m.effects) {
    auto& list = e.keep                          ? kept
                 : e.why == Why::structural      ? none
                 : is_absence(m.forms[e.effect]) ? dropped
                                                 : simpler;
    const bool named = &list == &kept || &list == &simpler;
    list += fmt::format("{}{}{}", list.empty() ? "" : ", ", name_of(e.effect),
                        named ? fmt::format(" ({})", m.forms.name(e.effect)) : "");
  }
  say_below("  keep    ", kept.empty() ? "nothing" : kept);
  if (!simpler.empty()) say_below("  simpler ", simpler);
  if (!dropped.empty()) say_below("  drop    ", dropped);
  if (!none.empty()) say_below("  absent  ", none);
  if (m.bounded) {
    say_below(
        "  check   ",
        fmt::format("{} % of {} fresh points differ by at most {} {}; the worst by {}",
                    in_percent(t.quantile), m.checked.samples, unit_of(t),
                    rounded_up(m.checked.upper, m.holds ? 2 : 3), rounded_up(m.checked.worst)));
    if (const double part = m.reference_error; part >= 0.1 * m.checked.upper)
      say("          up to {} of that may be the reference's own error\n",
          rounded_up(part, m.holds ? 2 : 3));
  } else {
    say_below(
        "  check   ",
        fmt::format("{} % of {} fresh points differ from {} by {} {:.2g}; no walk is known of "
                    "this lobe, so that is no bound",
                    in_percent(t.quantile), m.checked.samples, compensation_in_words(m.reference),
                    unit_of(t), m.checked.quantile));
  }
  if (m.only_unseen && m.holds)
    say_below("  beware  ",
              "no other set keeps the tolerance where sets are compared and its margin on fresh "
              "points; this one drops only what changes nothing");
  if (m.is_unlit())
    say_below("  beware  ", "no light comes to any point of it: every set of forms looks the same");
  if (m.failed)
    say_below("          ",
              (m.passed_over > 0 ? counted(m.passed_over, "cheaper set") + " failed there; " : "") +
                  why_passed_over(m, cost));
}

/// Path of what is written beside the plan's document.
std::string beside(const std::string& document, const char* ending) {
  return std::filesystem::path(document).replace_extension(ending).string();
}

MaterialxPlan in_materialx(const Scene& s, const Plan& plan, const std::string& document) {
  const auto looks = looks_of(s);
  const auto model = [](Surface surface) {
    return CoatedModel{std::move(surface.base), std::move(surface.coat)};
  };
  std::vector<PlannedModel> all;
  for (const auto& m : plan.materials) {
    const auto at = std::ranges::find(s.materials, m.name, &Material::name);
    const Look& look = looks[static_cast<std::size_t>(at - s.materials.begin())];
    all.push_back({m.name, model(look.surface(look.exact())), model(look.surface(m.forms)),
                   look.turn() / degree});
  }
  return materialx_of(all, document);
}

Exit run(const PlanCall& o) {
  use(o);
  if (!o.write.empty() && o.output.empty())
    throw wrong_usage("--write mtlx needs -o PLAN.json: the materials go beside it, as PLAN.mtlx");
  if (!o.write.empty() && std::filesystem::path(o.output).extension() != ".json")
    throw wrong_usage(fmt::format(
        "--write mtlx -o {}: the plan's name ends in .json; two would share one NAME.mtlx",
        o.output));
  const std::string materialx = o.write.empty() ? "" : beside(o.output, ".mtlx");
  check_outputs({o.scene}, {o.output, o.page});
  OutputFiles files({o.scene}, o.output, o.page);
  std::optional<OutputFile> materials;
  if (!materialx.empty()) materials.emplace(materialx, NamedBy::gonio);
  Scene s = read_scene(o.scene);
  if (s.budget_ns && o.options.cost == Cost::operations)
    throw wrong_usage("--cost operations: the scene's budget_ns is a time");
  if (o.seed) s.seed = *o.seed;
  TimedProgress progress(o.quiet, "planning", s.materials.size());
  const Plan plan = plan_scene(s, o.options, [&](double done) {
    progress(static_cast<std::size_t>(done * static_cast<double>(s.materials.size())));
  });
  progress.clear();
  const auto document = to_json(plan);
  files.write_document(document);
  if (files.has_page()) files.write_page(plan_page_html(s, plan), document);
  MaterialxPlan written;
  if (materials) {
    written = in_materialx(s, plan, document);
    materials->write(written.file);
  }
  files.commit({materials ? &*materials : nullptr});
  if (o.json) {
    fmt::print("{}", document);
  } else {
    for (const auto& m : plan.materials)
      print(m, plan.tolerance, o.options.cost, plan.budget.has_value());
    if (materials) say("{}: each material as planned, and as NAME_exact\n", materialx);
    for (const auto& said : written.differs) say_below("  beware  ", said);
  }
  const Exit held = plan.holds ? Exit::done : Exit::check_failed;
  if (!plan.budget) return held;
  const auto& b = *plan.budget;
  if (!o.json)
    say("budget: {:.4g} ns of {:.4g} a point; the worst material's error is at most {}\n", b.ns,
        b.budget_ns, rounded_up(b.error, 3));
  return b.fits ? held : Exit::check_failed;
}

}  // namespace

void add_plan(CommandLine& line) {
  auto [c, o] =
      line.command<PlanCall>("plan",
                             "Says for each material of a scene which optical effects to simulate "
                             "there, which to drop, and "
                             "what that saves, within the scene's tolerance; exit 1 where no set "
                             "of forms keeps it with a margin",
                             "gonio plan scene.json -o plan.json", run);
  c.option("SCENE", o->scene, "Scene, gonio.scene/1").required();
  c.option("-o,--output", o->output, "The plan as a document, gonio.plan/2");
  c.option("--html", o->page, "The plan as a page: what to keep, what to drop and why");
  c.option("--write", o->write,
           "The planned materials, too, beside the document: mtlx, for MaterialX, in PLAN.mtlx")
      .one_of(std::array<std::string_view, 1>{"mtlx"});
  c.option("--samples", o->options.samples, "Points that sets of effects are compared on (4096)")
      .in(std::size_t{512}, std::size_t{65'536});
  c.option("--cost", o->options.cost,
           "What sets are compared by: time, as measured here, or operations, the same everywhere");
  c.option("--seed", o->seed, "Seed of the points, in place of the scene's");
  add_follow_paths(c, *o);
  add_jobs(c, *o);
  add_output(c, *o);
}

}  // namespace gonio::cli
