#pragma once
/// \file
/// Plan of a scene: for each material the forms of its effects that keep the scene's tolerance at the least cost.

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/names.h"
#include "brdf/model/own_files.h"
#include "scene/description/scene.h"
#include "scene/plan/difference.h"
#include "scene/surface/surface.h"

namespace gonio::scene {

/// Ground on which a form was chosen: it is the same; it is proved to differ by no more than the tolerance; it was measured.
enum class Why { structural, proved, measured };

/// Effect of a material in a plan.
struct PlannedEffect {
  Effect effect{};
  bool keep = false;  ///< its form is not the cheapest
  std::string form;
  Why why = Why::measured;
  std::string reason;  ///< in words
  double error_if_dropped =
      0;  ///< quantile, all else exact; where it is proved, the bound of any difference
  double ns_saved = 0,
         ops_saved = 0;  ///< by its cheapest form, all else exact, of one direction of light
};

/// What a set that may keep the tolerance where sets are compared failed by on fresh points.
struct FreshError {
  double worst = 0, exceeding_bound = 1;  ///< as a Judgement has them
};

/// Set of forms that was measured.
struct Candidate {
  Forms forms;
  double ns = 0, ns_spread = 0;  ///< of f of one direction of light
  double ops = 0;
  Judgement error;
  std::optional<FreshError> failed = {};
  double counted_ns = 0;  ///< by which sets are put in order, see count_times()

  /// Times that differ by less than this are taken for the same.
  double spread() const;
  /// True where the counted times are too near to each other for a clock: within twice their spreads.
  bool is_as_fast_as(const Candidate&) const;
  /// True where it has fewer operations, of as many fewer effects.
  bool is_simpler_than(const Candidate&) const;
  /// Number of effects that it keeps.
  std::size_t kept() const;
};

/// Counts for each set the least time of itself and of those that have no cheaper form and no fewer operations: a clock that says
/// otherwise is noisy.
void count_times(std::vector<Candidate>&, const Look&);

/// Set that was judged for a plan.
struct JudgedSet {
  Forms forms;
  double ns = 0, ops = 0;  ///< of f of one direction of light
  Judgement error;
  Margin margin;
  double reference_error = 0;  ///< quantile of the reference's own error on the same points

  bool keeps_margin() const { return margin.is_kept(error); }
};

struct MaterialPlan {
  std::string name;
  std::vector<PlannedEffect> effects;
  std::string spec;
  std::vector<std::pair<std::string, std::vector<double>>> parameters;
  double speedup = 1, ops_saved = 0;  ///< the material's effects, exact in float, against the plan:
                                      ///< ratio of times, and the share of operations
  double ns = 0, ns_exact = 0, ops_exact = 0;
  double ns_spread = 0;        ///< of ns, as sets are compared by it; 0: not known
  std::string reference;       ///< form of the light between facets that is compared with
  bool bounded = false;        ///< its error is known, and in what is claimed
  double reference_error = 0;  ///< quantile of that error
  /// Least upper bound of what light between facets in a form that shaders have leaves, all else exact.
  double shipped_upper = 0;
  /// Where it keeps light between facets as a table: of the sets without it the nearest to the margin, on fresh points.
  std::optional<JudgedSet> without_table = {};
  double table_ns_saved = 0, table_ops_saved = 0;  ///< what dropping that table saves
  bool holds =
      false;  ///< the margin is kept; else no set that is offered does, and this is the nearest
  bool could_hold = false;  ///< a set of the front keeps the tolerance: only the budget forbids it
  Judgement checked;        ///< on fresh points
  Margin margin;            ///< that these leave for others
  std::size_t passed_over = 0;  ///< cheaper sets that were checked on fresh points, and failed
  /// The cheapest of these; of none the nearest set with one form cheaper, by the points that sets are compared on.
  std::optional<JudgedSet> failed = {};
  /// No set may keep the tolerance where sets are compared and keeps the margin on fresh points: this drops only what changes nothing.
  bool only_unseen = false;
  double coverage = 0;           ///< of the picture
  double directions = 0;         ///< of light that come to a point, on average
  std::vector<Candidate> front;  ///< none of the others is cheaper and errs less
  std::vector<Candidate> sets;   ///< all that a budget chooses among, the simplest first
  Forms forms;

  /// True where it keeps light between facets as a table, which no shader has.
  bool needs_table() const;
  /// True where no light comes to any of its points, so that every set of forms looks the same.
  bool is_unlit() const { return directions == 0 && checked.worst == 0; }
};
/// "Kulla and Conty's lobe", by the name of a form of compensation.
std::string compensation_in_words(std::string_view form);

/// A time for all materials, and what came of it.
struct Budget {
  double budget_ns = 0;  ///< mean over visible points, weighted by coverage
  double ns = 0;         ///< of the plan
  double error = 0;      ///< the worst of the materials' upper bounds, on fresh points
  bool fits = false;     ///< else every material takes what is cheapest
};

/// Cost by which sets are compared: time as it was measured, or operations, which are the same everywhere.
enum class Cost { time, operations };

struct Plan {
  std::string scene_sha256;
  Tolerance tolerance;
  std::vector<MaterialPlan> materials;
  std::optional<Budget> budget;
  bool holds = false;                 ///< of every material
  std::vector<OwnFile> shaders = {};  ///< files that the materials take functions from
  Cost cost = Cost::time;             ///< by which sets were compared
};

struct PlanOptions {
  std::size_t samples = 4096;   ///< points that sets are compared on
  std::size_t fresh = 65'536;   ///< points that the chosen set is checked on, at least
  std::size_t directions = 64;  ///< of each light that has an extent
  Cost cost = Cost::time;
};
/// Points of a verification, as a rule.
inline constexpr std::size_t verified_samples = 16'384;
/// Points that show that a tolerance is kept: these, or four times as many as its quantile and confidence need.  Bad input of the
/// scene where that is more than 65 536.  \see verify
std::size_t samples_of_verification(const Scene&);
/// Share beyond the limit and worst point up to which a verification is likely to agree.
Margin margin_of(const Scene&);
/// Points that sets are compared on, where a tolerance asks for no more: these, or half of those of a verification.
std::size_t points_of_plan(const Scene&, std::size_t samples);

/// Plan of a scene.  A material that no view shows is wrong: bad_input.
///
///   1  effects that change nothing take their cheapest form
///   2  so do those whose change is proved to be less than a tenth of the tolerance
///   3  of the others, every form that keeps the tolerance while all else is exact is a candidate's; candidates are their
///      combinations, at most 512.  Those that look an environment up are compared with 1024 directions a point.  Errors may
///      cancel: of at most 512 sets of any forms that shaders have, those that keep the tolerance are candidates, too
///   4  the cheapest that these points do not rule out, ties within the spread of times going to fewer operations and then to fewer
///      effects, is checked on fresh points, with the margin by which fresh ones of a verification are likely to agree; where its
///      share beyond the limit is so near to what may be that they do not decide, up to 16 times as many are drawn; if it fails
///      the next is taken; if all do, only what changes no point by a hundredth of the limit is dropped.  A plan that holds keeps
///      the margin, however it was found
///
/// Each point's difference counts with what the reference itself may be off by there.  Where the scene has a budget, all forms are candidates', and in place of 4 those are taken whose worst error is the least that
/// the budget leaves, and what is left of it goes to those that break the tolerance; it may be broken then, which a verification shows.
///
/// \param done  part that is done, in [0, 1]
Plan plan_scene(const Scene&,
                const PlanOptions& = {},
                const std::function<void(double)>& done = {});

}  // namespace gonio::scene

template <>
inline constexpr std::array<std::string_view, 3> gonio::names_of<gonio::scene::Why>{
    "structural", "proved", "measured"};
template <>
inline constexpr std::array<std::string_view, 2> gonio::names_of<gonio::scene::Cost>{"time",
                                                                                     "operations"};
