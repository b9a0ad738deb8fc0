// gonio verify: a plan on fresh points of its scene.
#include "scene/plan/verify.h"

#include "base/rounded.h"
#include "cli/line/command.h"
#include "cli/line/terminal.h"
#include "scene/plan/confidence.h"

#include <fmt/format.h>

namespace gonio::cli {
namespace {

using namespace scene;

struct VerifyCall : Common {
  std::string scene, plan;
  std::optional<std::size_t> samples;
  std::uint64_t seed = 1;
};

void print(const VerifiedMaterial& m, const Tolerance& t) {
  const auto worst = rounded_up(m.found.worst, 3);
  const auto what =
      m.bounded
          ? fmt::format(
                "by more than {:g}, which is less than {} % of all with {} % confidence; "
                "the worst by {}{}",
                t.limit, rounded_up(100 * m.found.bound), in_percent(t.confidence), worst,
                m.holds || m.found.breaks(t)
                    ? ""
                    : fmt::format(
                          "; {} % is allowed, and more points (--samples) may show that it holds",
                          in_percent(1 - t.quantile)))
          : fmt::format(
                "from {} by more than {:g}, the worst by {}; no walk is known of this "
                "lobe, so that is no bound",
                compensation_in_words(m.reference), t.limit, worst);
  say_below(fmt::format("{}: {}  ", m.name,
                        m.holds             ? "holds"
                        : m.found.breaks(t) ? "is broken"
                                            : "is not shown to hold"),
            fmt::format("{} of {} points differ {}", m.found.exceeding, m.found.samples, what));
}

Exit run(const VerifyCall& o) {
  use(o);
  check_outputs({o.scene, o.plan}, {});
  const Scene s = read_scene(o.scene);
  const std::size_t needed = draws_needed(s.tolerance.quantile, s.tolerance.confidence);
  if (o.samples && *o.samples < needed)
    throw wrong_usage(fmt::format(
        "--samples {}: this scene's quantile and confidence need {} at least", *o.samples, needed));
  const auto planned = read_plan(o.plan, s, looks_of(s));
  TimedProgress progress(o.quiet, "verifying", s.materials.size());
  const auto v = verify(s, planned, o.seed, o.samples, [&](double done) {
    progress(static_cast<std::size_t>(done * static_cast<double>(s.materials.size())));
  });
  progress.clear();
  if (o.json)
    fmt::print("{}", to_json(v));
  else
    for (const auto& m : v.materials) print(m, v.tolerance);
  return v.holds() ? Exit::done : Exit::check_failed;
}

}  // namespace

void add_verify(CommandLine& line) {
  auto [c, o] = line.command<VerifyCall>("verify",
                                         "Judges a plan on fresh points of its scene; exit 1 where "
                                         "the scene's tolerance is broken, or not shown to hold",
                                         "gonio verify scene.json plan.json", run);
  c.option("SCENE", o->scene, "Scene that the plan was made for").required();
  c.option("PLAN", o->plan, "Plan, gonio.plan/2").required();
  c.option("--samples", o->samples, "Fresh points (16384, more where the tolerance needs them)")
      .in(std::size_t{512}, std::size_t{1} << 22);
  c.option("--seed", o->seed, "Seed of the fresh points (1)");
  add_follow_paths(c, *o);
  add_jobs(c, *o);
  add_output(c, *o);
}

}  // namespace gonio::cli
