#include "reports/index/index_page.h"

#include <algorithm>
#include <ctime>
#include <utility>

#include "base/rounded.h"
#include "base/text.h"
#include "reports/finding/names.h"
#include "reports/page/numbers.h"
#include "reports/page/render.h"
#include "reports/picture/document.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace gonio {

std::string first_sentence(std::string_view text) {
  for (std::size_t i = text.find(". "); i != text.npos; i = text.find(". ", i + 1)) {
    const auto next = static_cast<unsigned char>(text[i + 2]);
    const bool begins = (next >= 'A' && next <= 'Z') || next == '\'' || next >= 0x80;  // “, Δ
    if (begins) return std::string(text.substr(0, i + 1));
  }
  return std::string(text);
}

namespace {

struct ClaimOf {
  std::string_view report;
  const Claim* claim;
};
std::vector<ClaimOf> claims_of(const ReportIndex& index) {
  std::vector<ClaimOf> out;
  for (const auto& r : index.reports)
    for (const auto& c : r.findings.claims) out.push_back({r.name, &c});
  return out;
}

std::string setting_of(const ReportIndex& i) {
  return i.full ? "full" : i.quick ? "quick" : "standard (no --quick)";
}

/// Sentence that a reader takes away from a report: its own words for that, or those that it begins with.
std::string sentence_of(const ReportIndex::Entry& r) {
  if (!r.findings.headline.empty()) return r.findings.headline;
  return r.findings.sentences.empty() ? "" : first_sentence(r.findings.sentences[0]);
}
/// The first picture as its report's document has it; null where there is none.
Json picture_of(const ReportIndex::Entry& r) {
  const Json all = figures_json(r.first);
  return all.empty() ? Json() : all[0];
}

constexpr const char* fresnel_title = "Visible error of Fresnel approximations";
/// Forms of Fresnel that the grid shows.
constexpr std::string_view shown_forms[] = {"fresnel.schlick", "fresnel.schlick.f90", "fresnel.f82",
                                            "fresnel.lazanyi, corrected"};
std::vector<Facts::Fresnel> fresnel_grid(const ReportIndex& index) {
  std::vector<Facts::Fresnel> out;
  for (const auto form : shown_forms)
    for (const auto& f : index.facts.fresnel)
      if (f.form == form) out.push_back(f);
  return out;
}

/// Greatest colour differences by what is seen of them.
struct Visibility {
  double just_seen, side_by_side;
};

}  // namespace

template <>
inline constexpr auto description<ReportIndex::Entry> =
    FieldList{Field{"name", &ReportIndex::Entry::name, ""},
              Field{"what", &ReportIndex::Entry::what, ""},
              Field{"sentence", sentence_of, "what a reader takes away"},
              Field{"picture", picture_of, "the first, as in the report's document; null: none"},
              Field{"pictures", &ReportIndex::Entry::pictures, "how many"},
              Field{"time_ms", "ms", &ReportIndex::Entry::ms, "that it took"}};
template <>
inline constexpr auto description<ClaimOf> = FieldList{
    Field{"report", &ClaimOf::report, ""},
    Field{"claim", [](const ClaimOf& c) { return c.claim->claim; }, "sentence in circulation"},
    Field{"source", [](const ClaimOf& c) { return c.claim->source; },
          "where it was published; may be empty"},
    Field{"judged", [](const ClaimOf& c) { return name_of(c.claim->judged); },
          "holds, holds in part, does not hold"},
    Field{"figure", [](const ClaimOf& c) { return c.claim->figure; }, "the one that decides"},
    Field{"verdict", [](const ClaimOf& c) { return c.claim->verdict; }, "sentence with figures"},
    Field{"anchor", [](const ClaimOf& c) { return c.claim->anchor; }, "of the report's page"}};
template <>
inline constexpr auto description<Decision> =
    FieldList{Field{"for", &Decision::subject, "what is decided"},
              Field{"take", &Decision::take, "name of the form"},
              Field{"take_id", &Decision::take_id, "of the catalogue"},
              Field{"error", &Decision::error, "that is left; in brackets an aside"},
              Field{"cost", &Decision::cost, "over the cheap form; in brackets an aside"},
              Field{"unless", &Decision::unless, "when another is to be taken, and which"}};
template <>
inline constexpr auto description<Facts::Setting> =
    FieldList{Field{"cpu", &Facts::Setting::cpu, "as it calls itself"},
              Field{"threads", &Facts::Setting::threads, "that run at once"},
              Field{"isa", &Facts::Setting::isa, "instruction set of the costs"},
              Field{"others_busy", &Facts::Setting::others,
                    "processors that other programs kept busy meanwhile; null: not known"},
              Field{"model_ns", "ns", &Facts::Setting::model_ns,
                    "time of a sample of GGX under correlated Smith and Schlick, beside "
                    "which costs stand; null: not known"}};
template <>
inline constexpr auto description<Facts::Fresnel> = FieldList{
    Field{"kind", &Facts::Fresnel::kind, "dielectric, metal"},
    Field{"material", &Facts::Fresnel::material, ""},
    Field{"form", [](const Facts::Fresnel& f) { return name_of_form(f.form); }, "its name"},
    Field{"form_id", &Facts::Fresnel::form, "id, with the difference of a variant"},
    Field{"delta_e", &Facts::Fresnel::delta_e, "greatest CIEDE2000 of the rough surface"},
    Field{"head_on", &Facts::Fresnel::head_on, "the same seen head on"}};
template <>
inline constexpr auto description<Visibility> =
    FieldList{Field{"just_seen", &Visibility::just_seen, "CIEDE2000; below, nobody sees it"},
              Field{"side_by_side", &Visibility::side_by_side,
                    "CIEDE2000; below, a difference shows only side by side"}};
template <>
inline constexpr auto description<ReportIndex> = FieldList{
    constant_text("schema", "gonio.report.index/1"),
    Field{"version", &ReportIndex::version, "of gonio"},
    Field{"full", &ReportIndex::full, setting_meaning},
    Field{"quick", &ReportIndex::quick, "a first look: fewer materials, angles and samples"},
    Field{"at_ms", "ms", &ReportIndex::at_ms, "since 1970"},
    Field{"machine", [](const ReportIndex& i) { return i.facts.setting; }, ""},
    Field{"decisions", [](const ReportIndex& i) { return decisions(i.facts); }, ""},
    Field{"visible",
          [](const ReportIndex&) {
            return Visibility{just_seen, side_by_side};
          },
          "thresholds"},
    Field{"fresnel", [](const ReportIndex& i) { return i.facts.fresnel; },
          "every form by material; the page shows the usual ones"},
    Field{"front", [](const ReportIndex& i) { return figures_json(i.front); },
          "masking's accuracy against time"},
    Field{"reports", &ReportIndex::reports, ""},
    Field{"claims", claims_of, ""}};

void add_report(
    ReportIndex& to, std::string_view name, std::string_view what, double ms, ReportFiles r) {
  join(to.facts, r.facts);
  const auto& figures = r.pictures.figures;
  ReportIndex::Entry entry{
      name, what, ms, std::move(r.findings), figures.size() + r.pictures.maps.size(), {}};
  if (!figures.empty()) entry.first.figures.push_back(figures[0]);
  to.reports.push_back(std::move(entry));
  if (!r.facts.setting) return;
  const auto id = picture_id(
      "masking", {{"number", "float"}, {"set", r.facts.setting->isa}, {"memory", "cache"}});
  const auto at = std::ranges::find(figures, id, &Figure::id);
  if (at == figures.end()) return;
  Figure front = *at;
  // Its first series and that one's front: the forms that stand for GGX.
  front.curves.resize(std::min<std::size_t>(front.curves.size(), 2));
  if (front.curves.size() == 2 && !front.curves[1].dashed) front.curves.pop_back();
  front.note.clear();
  front.y.label = "RMS error of G₂";
  front.y.log = false;
  front.y.from = -0.02;  // the exact form is off by rounding only: decades below the others
  front.curves[0].name = "masking forms for GGX";
  if (front.curves.size() == 2) front.curves[1].name = "best trade-offs";
  to.front.figures = {std::move(front)};
}

std::string to_json(const ReportIndex& index) {
  return page_document(index);
}
std::string index_schema() {
  return schema_text<ReportIndex>("gonio report all: index.json");
}

// --- The page
}  // namespace gonio

namespace gonio::page {
namespace {

std::string page_of(std::string_view report, std::string_view anchor = "") {
  return fmt::format("{}.html{}{}", report, anchor.empty() ? "" : "#", anchor);
}
/// The text, in which no line ends between a number and what it is of.
std::string unbroken(std::string text) {
  for (const auto& [apart, together] : {std::pair("≤ ", "≤\u00a0"),
                                        {"F0 ", "F0\u00a0"},
                                        {" ns", "\u00a0ns"},
                                        {"ΔE ", "ΔE\u00a0"},
                                        {"×/÷ ", "×/÷\u00a0"},
                                        {"|n × h|²", "|n\u00a0×\u00a0h|²"}})
    for (std::size_t at = 0; (at = text.find(apart, at)) != std::string::npos;)
      text.replace(at, std::string_view(apart).size(), together);
  return text;
}
/// A cell whose aside stands small below it.
Cell with_aside(const std::string& broken, std::string look = {}, std::string title = {}) {
  const auto text = unbroken(broken);
  const auto main = without_aside(text);
  return {
      main, std::move(title),
      main.size() == text.size() ? "" : text.substr(main.size() + 2, text.size() - main.size() - 3),
      std::move(look)};
}

/// The time of the same highlight as rows call it "a whole model".
std::string composed_time(const Facts& f) {
  const auto* composed = time_of(f.whole, "ggx/smith_ggx.correlated/schlick");
  return composed
             ? fmt::format(", and {} ns composed of its terms, which “a whole model” stands for",
                           significant(composed->ns, 2))
             : "";
}
/// A quick report times everything in one process.
bool is_timed_in_several_processes(const Facts& f) {
  return std::ranges::any_of(f.in_cache, [](const Facts::Time& t) { return t.each.size() > 1; });
}
std::vector<Part> lead(const ReportIndex& i) {
  const auto& m = i.facts.setting;
  std::string cost = "CPU time of one evaluation in float beyond the usual form";
  if (m)
    cost += fmt::format(", on {} with {}, from cache", m->cpu.empty() ? "this machine" : m->cpu,
                        m->isa);
  cost += ".";
  if (m && m->model_ns)
    cost += fmt::format(" A whole GGX highlight takes {} ns as one function{}.",
                        significant(*m->model_ns, 2), composed_time(i.facts));
  if (m && m->others && *m->others >= 0.25)
    cost += fmt::format(
        " The machine was busy: other programs took {} of {} processors, so times may be too long.",
        plain(*m->others, 2), m->threads);
  const auto colour =
      i.facts.fresnel.empty()
          ? ""
          : fmt::format("CIEDE2000. Nobody sees {} or less. Up to {} is seen only side by side.",
                        plain(just_seen), plain(side_by_side));
  return {
      Prose{"A form is one formula for one part of a material model. For each part the table "
            "names the form to ship.",
            "lead"},
      Pairs{
          {{"Error left",
            {"The distance to exact Fresnel, to height-correlated Smith masking and to all bounces "
             "of light. Diffuse forms are compared with energy-preserving Oren–Nayar (EON). Under "
             "a specular lobe, EON is scaled by the light that the lobe lets through."}},
           {"Costs", {cost}},
           {"Usual forms",
            {"Schlick's Fresnel, Schlick's masking with k = (r+1)²/8, GGX, one bounce, "
             "Lambert."}},
           {"ΔE", {colour}},
           {"G₂", {"Masking and shadowing together."}},
           {"r, cosines", {"Roughness r is √α. Cosines are those to the normal."}}}}};
}

Section what_to_ship(const ReportIndex& i) {
  Table t{columns("for|take|error left|costs|unless"), {}, "told-by-cell decide"};
  for (const auto& d : decisions(i.facts))
    t.add(with_aside(d.subject), Cell{unbroken(d.take), d.take_id, "", "take"}, with_aside(d.error),
          with_aside(d.cost), d.unless.empty() ? "–" : unbroken(d.unless));
  if (t.rows.empty()) return {};
  return {"Decide", "", {t}};
}

/// Returns the colour errors of Fresnel forms, by material.
Section fresnel(const ReportIndex& i) {
  const auto grid = fresnel_grid(i);
  if (grid.empty()) return {};
  Table t{columns(""), {}, "seen-by"};
  for (const auto& name : unique(grid, [](const auto& f) { return name_of_form(f.form); }))
    t.head.push_back({name});
  for (const auto& m : unique(grid, &Facts::Fresnel::material)) {
    auto& row = t.rows.emplace_back(std::vector{Cell{m == "IOR 1.33"  ? "water"
                                                     : m == "IOR 1.5" ? "glass, plastic"
                                                                      : m}});
    for (std::size_t k = 1; k < t.head.size(); ++k) {
      const auto at = std::ranges::find_if(grid, [&](const auto& f) {
        return f.material == m && name_of_form(f.form) == t.head[k].name;
      });
      row.push_back(at == grid.end() ? Cell{"–", {}, {}, "unknown"}
                                     : Cell{rounded_up(at->delta_e),
                                            {},
                                            {},
                                            at->delta_e <= just_seen      ? "unseen"
                                            : at->delta_e <= side_by_side ? "beside"
                                                                          : "shows"});
    }
  }
  return {
      fresnel_title,
      "The greatest ΔE2000 of a rough surface under even light, over roughness and view, rounded "
      "up.",
      {t,
       Markup{fmt::format(
           R"(<p class="small key-of"><span class="unseen">unseen, to {0}</span><span class="beside">side by side, to {1}</span><span class="shows">seen</span><span class="unknown">– not computed</span></p>)",
           plain(just_seen), plain(side_by_side))},
       Prose{fmt::format("The thresholds: {0} is from CIE 142-2001. {1} is the just noticeable "
                         "difference that observers had in CIELAB (Mahy, Van Eycken and "
                         "Oosterlinck 1994), taken for CIEDE2000 here.",
                         plain(just_seen), plain(side_by_side)),
             "small muted"}},
      "fresnel"};
}

Section cards(const ReportIndex& i) {
  std::string html = R"(<div class="cards">)";
  for (const auto& r : i.reports) {
    const auto href = page_of(r.name);
    html += fmt::format(
        R"(<article class="card"><h3><a href="{0}">{1}</a></h3><p>{2}</p><p class="small muted"><a href="{3}.json">JSON</a> · <a href="{3}.csv">CSV</a> · {4} · made in {5}</p></article>)",
        href, markup_text(capital(std::string(r.what))), markup_text(sentence_of(r)), r.name,
        r.first.figures.empty()
            ? many(r.pictures, "picture")
            : fmt::format(R"({2} pictures, <a href="{0}/{1}.svg">the first</a>)", r.name,
                          r.first.figures[0].id, count_text(r.pictures)),
        r.ms >= 1000 ? significant(r.ms / 1000) + "\u202fs" : significant(r.ms) + "\u202fms");
  }
  if (i.reports.empty()) return {};
  return {"The reports", "", {Markup{html + "</div>"}}, "reports"};
}

Section claims(const ReportIndex& i) {
  std::string rows;
  for (const auto& [report, c] : claims_of(i)) {
    using enum Claim::Judged;
    rows += fmt::format(
        R"(<tr><th scope="row"><span class="verdict-{}">{}</span></th><td><details><summary>“{}”</summary><p>{}</p><p>{}<a href="{}">the report</a></p></details></td><td>{}</td></tr>)",
        c->judged == holds    ? "yes"
        : c->judged == partly ? "weakly"
                              : "no",
        name_of(c->judged), markup_text(c->claim), markup_text(capital(c->verdict)),
        c->source.empty() ? "" : markup_text(c->source) + " · ",
        markup_text(page_of(report, c->anchor)), markup_text(c->figure));
  }
  if (rows.empty()) return {};
  return {
      "Claims",
      "Claims in circulation among people who write shaders. A click shows what was tested.",
      {Markup{
          R"(<div class="told-by-cell said"><table><thead><tr><th>verdict</th><th>claim</th><th>figure</th></tr></thead><tbody>)" +
          rows + "</tbody></table></div>"}}};
}

}  // namespace
}  // namespace gonio::page

namespace gonio {

std::string index_page_html(const ReportIndex& i) {
  using namespace page;
  Page out{"", "", "Which shortcuts can you ship?", "Which shortcuts can you ship?"};
  out.first = lead(i);
  out.sections = {what_to_ship(i), fresnel(i)};
  if (!i.front.figures.empty())
    out.sections.push_back(
        {"What masking's accuracy costs",
         std::string("The error of G₂ against height-correlated Smith, over the time of one "
                     "sample. The dashed line joins the best trade-offs. ") +
             (is_timed_in_several_processes(i.facts)
                  ? "Forms are timed in several processes: a form is left off the line if a more "
                    "exact form was as fast in any of them. Bars hold the middle half of the "
                    "processes. "
                  : "A form is left off the line if a more exact form is as fast within both "
                    "spreads. Bars are spreads in one process. ") +
             "If two forms are equally exact, the faster is on the line. Hammon's way to write "
             "Unreal's joint form is a point of its own. The RMS error is over other directions "
             "than that of the masking row.",
         {page::Shown{i.front.figures[0].family, {}, 480}},
         "time"});
  out.sections.push_back(cards(i));
  out.sections.push_back(claims(i));
  out.sections.push_back(
      {"How it was measured",
       "",
       {Pairs{
           {{"Choice",
             {fmt::format(
                 "The cheapest form with a small error: up to ΔE2000 {}, or an RMS error of {} in "
                 "G₂. If none is that near, the nearest. If several with a small error take the "
                 "same time, the usual one, or else the nearest. GGX and the split sum are what "
                 "people ship: no threshold judges them.",
                 plain(side_by_side), plain(small_masking_error))}},
            {"Masking",
             {"The RMS error in G₂ with GGX, over roughness and over both cosines from "
              "0.05 to 1."}},
            {"Fresnel",
             {"Surfaces of roughness 0.1 or more, seen at cosines of 0.1 to 1 under even light of "
              "D65. A metal's true colour is that of its spectrum. Forms at three wavelengths use "
              "650, 550 and 450 nm."}},
            {"Multiple scattering",
             {"Under Schlick's Fresnel, at cosines of 0.1 or more. For image-based light the "
              "reference is the transport of light between facets under even light. For single "
              "lights it is random walks on a ball, lit from 30° and from 120° to the view, and ΔE "
              "includes the walks' error. Under image-based light only Fdez-Agüera's compensation "
              "is compared, which was made for the split sum."}},
            {"Where compensation begins",
             {fmt::format(
                 "At the least roughness where one bounce is off by more than ΔE {0} and "
                 "compensation is nearer there and at all greater roughnesses, under the worse of "
                 "the lights. Under single lights it has to be nearer by more than twice the "
                 "walks' error. Compensation is taken only if it lowers the greatest ΔE2000 by {1} "
                 "or more. Below that roughness one bounce is used. If it is off by more than ΔE "
                 "{0} there and another compensation by at least {1} less, that compensation is "
                 "used.",
                 plain(side_by_side), plain(just_seen))}},
            {"Split sum", {"The exposure gives a white ball half of the display's white."}},
            {"Diffuse",
             {fmt::format(
                 "Colours are those of a ball, where the cosines of light and view are {:g} or "
                 "more; reflected light is computed from cosine {:g} on. A form that reflects "
                 "more than {} of the light is left out. If all do, the one that reflects least "
                 "is taken.",
                 least_colour_cosine, least_diffuse_cosine, page::percent(no_light_made, 4))}},
            {"≤",
             {"The greatest value at the roughnesses, views and points that were computed. "
              "Between them it may be more, most so under single lights."}},
            {"Times",
             {std::string(is_timed_in_several_processes(i.facts)
                              ? "Medians over several processes. Both forms of a cost are timed in "
                                "each process, and the cost is the median of their differences. It "
                                "counts if every process found the same sign, and if it is larger "
                                "than the spread and than 3 % of the time taken. "
                              : "Medians in one process, as --quick asks. A cost "
                                "counts if it is larger than both spreads together. ") +
              "Compensations are timed in one process, one light and view at a time." +
              (i.facts.tails ? " The distribution row times whole highlights." : "")}}}}},
       "about"});
  const std::time_t at = i.at_ms / 1000;
  out.setting = fmt::format(
      "gonio {}, {} setting, made {:%Y-%m-%d %H:%M} UTC. All rows of this page are in index.json "
      "beside it.",
      i.version, setting_of(i), fmt::gmtime(at));
  return page_html(out, i.front);
}

}  // namespace gonio
