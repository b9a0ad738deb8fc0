#include "reports/scenes/plan_page.h"

#include <algorithm>
#include <limits>
#include <string>

#include "many_fits.h"
#include "reports/finding/words.h"
#include "reports/scenes/cases.h"
#include "reports/scenes/measure.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

const scene::Scene& plastic_scene() {
  static const auto s = scenes::scene_of(scenes::material_of("red plastic"), "front light");
  return s;
}
const scene::Plan& plan() {
  static const auto made = [] {
    scene::PlanOptions o;
    o.cost = scene::Cost::operations;
    o.samples = 1024;
    o.fresh = 16'384;
    return scene::plan_scene(plastic_scene(), o);
  }();
  return made;
}
std::size_t count(const std::string& text, std::string_view what) {
  std::size_t n = 0;
  for (auto at = text.find(what); at != text.npos; at = text.find(what, at + 1)) ++n;
  return n;
}

TEST(PlanPage, SaysWhatWasFoundAndNotWhatWasAskedFor) {
  GONIO_MANY_FITS();
  const auto page = plan_page_html(plastic_scene(), plan());
  const auto& m = plan().materials.at(0);
  EXPECT_NE(page.find("the plan differs by at most ΔE2000 " + rounded_up(m.checked.upper) + ";"),
            page.npos);
  EXPECT_EQ(page.find("nowhere by more than"), page.npos) << "points are no proof";
  EXPECT_EQ(count(page, "data:image/png"), 3U) << "everything on, as planned, the difference";
}

TEST(PlanPage, MarksThePlanAmongTheSetsThatNothingBeats) {
  GONIO_MANY_FITS();
  auto p = plan();
  auto& m = p.materials.at(0);
  ASSERT_GT(m.front.size(), 1U);
  constexpr std::string_view none = "is none of them";
  m.forms = m.front[0].forms;
  EXPECT_EQ(plan_page_html(plastic_scene(), p).find(none), std::string::npos);
  std::erase_if(m.front, [&](const auto& c) { return c.forms == m.forms; });
  ASSERT_GT(m.front.size(), 1U);
  EXPECT_NE(plan_page_html(plastic_scene(), p).find(none), std::string::npos);
}

TEST(PlanPage, SavesNothingByWhatAMaterialHasNot) {
  GONIO_MANY_FITS();
  std::size_t absent = 0;
  for (const auto& e : plan().materials.at(0).effects)
    if (e.why == scene::Why::structural) {
      ++absent;
      EXPECT_EQ(e.ns_saved, 0) << e.reason;
      EXPECT_EQ(e.ops_saved, 0) << e.reason;
    }
  EXPECT_GT(absent, 3U);
}

TEST(PlanPage, NamesAMaterialThatKeepsTheToleranceInNoForm) {
  GONIO_MANY_FITS();
  auto p = plan();
  auto& m = p.materials.at(0);
  p.holds = m.holds = false;
  m.checked.upper = 1.0398, m.reference_error = 0.9635;
  const auto page = plan_page_html(plastic_scene(), p);
  EXPECT_NE(page.find("differs by at most ΔE2000 1.04;"), page.npos) << "1 would be the tolerance";
  EXPECT_NE(page.find("No set of forms keeps ΔE2000 1 for red plastic with a plan's margin"),
            page.npos);
  EXPECT_NE(page.find("Up to 0.964 of red plastic's error may be the reference's own."), page.npos);
}

TEST(PlanPage, CallsABudgetNoImpossibility) {
  GONIO_MANY_FITS();
  auto p = plan();
  auto& m = p.materials.at(0);
  p.holds = m.holds = false;
  m.could_hold = true;
  p.budget = scene::Budget{12, 3, 4.1, true};
  const auto page = plan_page_html(plastic_scene(), p);
  EXPECT_NE(page.find("The budget leaves no set that keeps ΔE2000 1 for red plastic with a plan's "
                      "margin."),
            page.npos);
  EXPECT_EQ(page.find("No set of forms"), page.npos);
  EXPECT_EQ(page.find("does not need"), page.npos) << "it may need what the budget drops";
}

/// The plan with the table, beside a set without it.
scene::Plan with_table(double bound, double worst) {
  auto p = plan();
  auto& m = p.materials.at(0);
  m.forms[scene::Effect::compensation] = scene::Form::tabulated;
  m.speedup = 1 / 74.0;
  m.margin = {0.0075, 3.6};
  scene::JudgedSet set{m.forms, 1.28, 175, {}, m.margin, 0.06};
  set.forms[scene::Effect::compensation] = scene::Form::kulla_conty;
  set.error.bound = bound, set.error.worst = worst, set.error.upper = 0.47;
  m.without_table = set;
  return p;
}
/// Where sentences stand in a page's text.
std::size_t place_of(const std::string& page, const std::string& sentence) {
  const auto at = page.find(sentence);
  EXPECT_NE(at, page.npos) << sentence;
  return at;
}

TEST(PlanPage, SaysWhatRejectsTheNearestSetWithoutTheTable) {
  GONIO_MANY_FITS();
  auto page = plan_page_html(plastic_scene(), with_table(0.0079, 2));
  place_of(page,
           "No forms that shaders have keep the tolerance for red plastic with a plan's margin: it "
           "needs the light between facets as a table, and takes 74\u202f× the time.");
  place_of(page,
           "A set without the table may exceed the limit at 0.79 % of all points, and 0.75 % is "
           "allowed");
  place_of(page, "(kulla conty)");
  place_of(page, "; 99 % of the points are within ΔE2000 0.47.");
  page = plan_page_html(plastic_scene(), with_table(0.001, 5.6));
  place_of(page, "A set without the table differs by 5.6 at its worst point, and 3.6 is allowed");
}

TEST(PlanPage, DoesNotNeedTheTableThatABudgetBought) {
  GONIO_MANY_FITS();
  auto p = with_table(0.001, 1.7);
  p.budget = scene::Budget{300, 218, 0.06, true};
  const auto page = plan_page_html(plastic_scene(), p);
  EXPECT_EQ(page.find("No forms that shaders have"), page.npos);
  EXPECT_EQ(page.find("needs the light between facets"), page.npos);
  EXPECT_LT(
      place_of(page, "The plan of red plastic keeps the light between facets as a table"),
      place_of(page, "A set without the table keeps the tolerance, too, in 1.28 ns. Its forms: "));
}

TEST(PlanPage, SaysFirstThatNothingKeepsTheTolerance) {
  GONIO_MANY_FITS();
  auto p = with_table(0.86, 1.5);
  auto& m = p.materials.at(0);
  p.holds = m.holds = false;
  m.checked.bound = 0.53, m.checked.worst = 1;
  const auto page = plan_page_html(plastic_scene(), p);
  const auto broken = place_of(page,
                               "No set of forms keeps ΔE2000 1 for red plastic with a plan's "
                               "margin: this is the closest plan.");
  EXPECT_LT(broken, place_of(page, "The plan of red plastic may exceed the limit at 53 % of all"));
  EXPECT_LT(broken, place_of(page, "light between facets as a table"));
  EXPECT_EQ(page.find("No forms that shaders have"), page.npos) << "the table does not, either";
  p.budget = scene::Budget{0.1, 3, 4.1, false};
  const auto poor = plan_page_html(plastic_scene(), p);
  EXPECT_LT(place_of(poor, "Even the cheapest forms take"), place_of(poor, "a table, which no"));
}

TEST(PlanPage, CallsTimesThatAClockCannotTellApartTheSame) {
  GONIO_MANY_FITS();
  auto p = plan();
  for (const double ratio : {1.03, 0.97}) {
    p.materials[0].speedup = ratio;
    const auto page = plan_page_html(plastic_scene(), p);
    place_of(page, "red plastic takes as long as with all effects.");
    EXPECT_EQ(page.find("makes red plastic"), page.npos);
  }
  EXPECT_EQ(scenes::speed(1.03), "about as fast");
  EXPECT_EQ(scenes::speed(1 / 6.3), "6.3\u202f× as slow");
}

TEST(PlanPage, WritesADifferenceThatIsTinyAsItIs) {
  GONIO_MANY_FITS();
  auto p = plan();
  p.materials.at(0).checked.worst = 7.91e-7;
  const auto page = plan_page_html(plastic_scene(), p);
  place_of(page, "the worst point differs by 8.0·10⁻⁷.");
}

TEST(PlanPage, CallsNoPlanSlowByWhatItDrops) {
  GONIO_MANY_FITS();
  auto p = plan();
  auto& m = p.materials.at(0);
  m.speedup = 1 / 1.6;
  place_of(plan_page_html(plastic_scene(), p), "The plan makes red plastic 1.6\u202f× as slow.");
  p.cost = scene::Cost::time;
  const auto page = plan_page_html(plastic_scene(), p);
  place_of(page,
           "The plan makes red plastic 1.6\u202f× as slow: no set of forms as fast as all effects "
           "keeps the tolerance with a plan's margin.");
  EXPECT_EQ(page.find("Dropping what this scene does not need"), page.npos);
}

TEST(PlanPage, NamesTheEndsOfTheSpeedsOfManyMaterials) {
  GONIO_MANY_FITS();
  auto p = plan();
  p.materials.resize(3, p.materials.at(0));
  p.materials[0].name = "a", p.materials[0].speedup = 2;
  p.materials[1].name = "b", p.materials[1].speedup = 4;
  p.materials[2].name = "c", p.materials[2].speedup = 2;
  place_of(plan_page_html(plastic_scene(), p),
           "makes 3 materials between 2.0\u202f× as fast (c) and 4.0\u202f× as fast (b).");
}

TEST(PlanPage, AllowsAPlanThatHoldsItsOwnWorstPoint) {
  GONIO_MANY_FITS();
  auto p = plan();
  auto& m = p.materials.at(0);
  m.margin.most_worst = 1.0845, m.checked.worst = 1.0821;
  auto page = plan_page_html(plastic_scene(), p);
  place_of(page, "the worst may differ by 1.1.");
  place_of(page, "the worst point differs by 1.1.");
  p.holds = m.holds = false;
  m.checked.worst = 1.0862;
  place_of(plan_page_html(plastic_scene(), p),
           "differs by 1.087 at its worst point, and 1.085 is allowed");
}

TEST(PlanPage, SaysWhichMarginAPlanKeeps) {
  GONIO_MANY_FITS();
  place_of(plan_page_html(plastic_scene(), plan()),
           "at most 0.757 % may exceed the limit, and the worst may differ by 3.6.");
}

TEST(PlanPage, NamesTheCostThatNoSetBeats) {
  GONIO_MANY_FITS();
  auto p = plan();
  ASSERT_GT(p.materials.at(0).front.size(), 1U);
  EXPECT_NE(plan_page_html(plastic_scene(), p).find("none takes fewer operations and errs less"),
            std::string::npos);
  p.cost = scene::Cost::time;
  EXPECT_NE(plan_page_html(plastic_scene(), p).find("none is faster and errs less"),
            std::string::npos);
}

TEST(PlanPage, CallsNoMaterialNeedierThanOneThatIsTheSame) {
  GONIO_MANY_FITS();
  auto p = plan();
  p.materials.push_back(p.materials[0]);
  p.materials[1].name = "the same";
  const auto page = plan_page_html(plastic_scene(), p);
  EXPECT_NE(page.find("makes red plastic and the same "), page.npos);
  p.materials[1].name = "matte", p.materials[1].ops_saved = 0;
  EXPECT_NE(plan_page_html(plastic_scene(), p).find("matte keeps all effects that it has."),
            std::string::npos);
}

TEST(PlanPage, SaysWhatThePictureLeavesOut) {
  GONIO_MANY_FITS();
  const auto page = plan_page_html(plastic_scene(), plan());
  EXPECT_NE(page.find("leave the reference's own error out"), page.npos);
  EXPECT_NE(page.find("nobody sees ΔE2000 up to 1"), page.npos);
  auto s = plastic_scene();
  auto p = plan();
  p.tolerance.limit = 5;
  EXPECT_EQ(plan_page_html(s, p).find("5, hardly seen"), std::string::npos)
      << "the tolerance is not what people see";
}

TEST(PlanPage, BoundsNothingOfALobeThatNoWalkIsKnownOf) {
  GONIO_MANY_FITS();
  auto p = plan();
  const auto m = p.materials.at(0);
  p.materials.push_back(m);
  p.materials.back().name = "wax";
  auto& wax = p.materials.back();
  wax.bounded = false, wax.reference = "kulla_conty", wax.checked.quantile = 0.79;
  const auto page = plan_page_html(plastic_scene(), p);
  EXPECT_NE(page.find("The plan of wax differs from Kulla and Conty's lobe by ΔE2000 0.79 at"),
            page.npos);
  EXPECT_NE(page.find(", of red plastic; the worst"), page.npos);
  EXPECT_NE(page.find("so that is no bound"), page.npos);
  p.holds = wax.holds = false;
  wax.checked.bound = std::numeric_limits<double>::infinity(), wax.checked.worst = 5;
  EXPECT_NE(plan_page_html(plastic_scene(), p)
                .find("The plan of wax differs by 5 at its worst point, and 3.6 is allowed."),
            std::string::npos);
  wax.checked.worst = 2;
  EXPECT_NE(plan_page_html(plastic_scene(), p)
                .find("The plan of wax exceeds the limit at too many points."),
            std::string::npos);
}

TEST(PlanPage, WritesTheQuantileWithAllItsDigits) {
  GONIO_MANY_FITS();
  auto p = plan();
  p.tolerance.quantile = 0.9995;
  const auto page = plan_page_html(plastic_scene(), p);
  EXPECT_NE(page.find("At 99.95\u00a0% of the fresh points"), page.npos);
  EXPECT_NE(page.find("ΔE2000 at 99.95\u00a0%"), page.npos);
  EXPECT_EQ(page.find("at 100"), page.npos);
}

TEST(PlanPage, SaysOnWhichPointsTheSetsWereCompared) {
  GONIO_MANY_FITS();
  const auto page = plan_page_html(plastic_scene(), plan());
  EXPECT_NE(page.find("Their errors are of the 1\u202f024 points that sets are compared on"),
            page.npos);
}

TEST(PlanPage, SaysWhyAFasterSetIsNotThePlan) {
  GONIO_MANY_FITS();
  auto p = plan();
  p.cost = scene::Cost::time;
  auto& m = p.materials.at(0);
  ASSERT_GT(m.front.size(), 1U);
  m.front.resize(2);
  m.forms = m.front[1].forms;
  m.front[0].error.upper = m.front[0].error.worst = 0.1;
  m.front[0].ns = 1, m.front[0].ns_spread = 0.25, m.ns = m.front[1].ns = 1.1;
  constexpr std::string_view faster = "A set that took less time keeps the tolerance, too.";
  const auto page = plan_page_html(plastic_scene(), p);
  EXPECT_NE(page.find(faster), page.npos);
  EXPECT_NE(page.find("± 0.25"), page.npos);
  m.front[0].error.worst = 100;
  EXPECT_EQ(plan_page_html(plastic_scene(), p).find(faster), std::string::npos);
}

TEST(PlanPage, NamesTheNumberByWhichACheaperSetFailed) {
  GONIO_MANY_FITS();
  auto p = plan();
  auto& m = p.materials.at(0);
  scene::Judgement error;
  error.worst = 4.51, error.bound = 0.001;
  m.passed_over = 26;
  m.failed = scene::JudgedSet{m.front[0].forms, 1.29, 40, error, {0.009, 3.6}, 0};
  m.margin = m.failed->margin;
  m.front[0].failed = {4.51, 0.001};
  auto page = plan_page_html(plastic_scene(), p);
  EXPECT_NE(page.find("The cheapest of them (40 operations) differs by 4.6 at its worst point, and "
                      "3.6 is allowed."),
            page.npos);
  EXPECT_NE(page.find("failed, worst 4.6"), page.npos);
  m.failed->error.worst = 2, m.failed->error.bound = 0.0121;
  page = plan_page_html(plastic_scene(), p);
  EXPECT_NE(page.find("may exceed the limit at 1.21 % of all points, and 0.9 % is allowed"),
            page.npos);
}

TEST(PlanPage, SaysThatNoOtherSetWasFound) {
  GONIO_MANY_FITS();
  auto p = plan();
  p.materials.at(0).only_unseen = true;
  EXPECT_NE(plan_page_html(plastic_scene(), p).find("No other set keeps the tolerance where"),
            std::string::npos);
}

}  // namespace
}  // namespace gonio
