#include "reports/index/index_page.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <utility>

#include "base/rounded.h"
#include "base/text.h"
#include "reports/finding/names.h"
#include "reports/page/numbers.h"
#include "reports/page/render.h"
#include "reports/picture/document.h"
#include "reports/picture/front.h"

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

/// Masking's accuracy against its time, by what the decision on masking reads; of several ways to write one formula the first, which has
/// the fewest operations.  Empty where no report has both.
Pictures masking_front(const Facts& facts) {
  std::vector<FrontDot> dots;
  for (const auto& m : facts.masking)
    if (const auto* t = time_of(facts.in_cache, m.form);
        t && std::ranges::none_of(dots, [&](const FrontDot& other) {
          return std::abs(other.at.error - m.rms) <= same_error * m.rms;
        }))
      dots.push_back({name_of_form(m.form), {{t->ns, t->spread}, m.rms, t->each}});
  if (dots.empty()) return {};
  mark_front(dots);
  auto f = make_figure("masking");
  f.title = "Masking: time against error";
  f.x = {"time of one sample [ns]", true};
  f.y.label = "RMS error of G₂";
  f.y.from = -0.02;  // the exact form's point is seen whole
  f.curves = {front_points("masking forms for GGX", dots)};
  if (auto line = front_line("best trade-offs", dots)) f.curves.push_back(std::move(*line));
  Pictures out;
  out.figures = {std::move(f)};
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
    Field{"verdict", [](const ClaimOf& c) { return c.claim->verdict; },
          "sentences on what was tested; may be empty"},
    Field{"anchor", [](const ClaimOf& c) { return c.claim->anchor; }, "of the report's page"}};
template <>
inline constexpr auto description<Decision> =
    FieldList{Field{"for", &Decision::subject, "what is decided"},
              Field{"take", &Decision::take, "name of the form"},
              Field{"take_id", &Decision::take_id, "of the catalogue"},
              Field{"error", &Decision::error, "that is left; in brackets an aside"},
              Field{"cost", &Decision::cost, "over the usual form; in brackets an aside"},
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
    Field{"front", [](const ReportIndex& i) { return figures_json(masking_front(i.facts)); },
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

/// A quick report times everything in one process.
bool is_timed_in_several_processes(const Facts& f) {
  return std::ranges::any_of(f.in_cache, [](const Facts::Time& t) { return t.each.size() > 1; });
}
std::vector<Part> lead(const ReportIndex& i) {
  const auto& m = i.facts.setting;
  std::string cost = "How much longer the form by itself takes than the usual one";
  if (m)
    cost += fmt::format(", in float, from cache, on {} with {}",
                        m->cpu.empty() ? "this machine" : m->cpu, m->isa);
  cost += ".";
  if (const auto* whole = time_of(i.facts.whole, "ggx/smith_ggx.correlated/schlick"))
    cost +=
        fmt::format(" A whole GGX model, with height-correlated Smith and Schlick, takes {} ns.",
                    significant(whole->ns, 2));
  cost +=
      " Rows of multiple scattering and the split sum show absolute times. Compare these within a "
      "row, not between rows.";
  if (m && m->others && *m->others >= 0.25)
    cost += fmt::format(
        " The machine was busy: other programs took {} of {} processors, so times may be too long.",
        plain(*m->others, 2), m->threads);
  const auto colour =
      i.facts.fresnel.empty()
          ? ""
          : fmt::format("CIEDE2000. Nobody sees {} or less. Up to {} is seen only side by side.",
                        plain(just_seen), plain(side_by_side));
  return {Prose{"A form is one formula for one part of a material model. For each part the table "
                "names the form to ship.",
                "lead"},
          Pairs{{{"Error left",
                  {"How far a form is from its reference: exact Fresnel, height-correlated Smith "
                   "masking, light with all its bounces, or energy-preserving Oren–Nayar (EON)."}},
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
        R"(<tr><th scope="row"><span class="verdict-{}">{}</span></th><td title="{}">“<a href="{}">{}</a>”</td><td>{}</td></tr>)",
        c->judged == holds    ? "yes"
        : c->judged == partly ? "weakly"
                              : "no",
        name_of(c->judged), markup_text(c->source), markup_text(page_of(report, c->anchor)),
        markup_text(c->claim), markup_text(c->figure));
  }
  if (rows.empty()) return {};
  return {
      "Claims",
      "Claims in circulation among people who write shaders. Each leads to the report that tests "
      "it.",
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
  const auto front = masking_front(i.facts);
  if (!front.figures.empty())
    out.sections.push_back(
        {"What masking's accuracy costs",
         std::string(
             "Vertical: the error of G₂ to height-correlated Smith. Horizontal: the time of "
             "one sample. The dashed line joins the best trade-offs. ") +
             (is_timed_in_several_processes(i.facts)
                  ? "Bars hold the middle half of several processes."
                  : "Bars show how much the times varied."),
         {page::Shown{front.figures[0].family, {}, 480}},
         "time"});
  out.sections.push_back(cards(i));
  out.sections.push_back(claims(i));
  out.sections.push_back(
      {"How it was measured",
       "",
       {Pairs{
           {{"Choice",
             {fmt::format("An error is small up to ΔE2000 {}, or an RMS of {} in G₂. A usual form "
                          "with a small error is kept. Otherwise the table takes the cheapest form "
                          "with a small error. Times that differ by less than a tenth count as "
                          "equal: then the form with the least error is taken. If none has a small "
                          "error, the one with the least is taken.",
                          plain(side_by_side), plain(small_masking_error))}},
            {"Masking",
             {"The RMS error in G₂ with GGX, over roughness and over both cosines from "
              "0.05 to 1."}},
            {"Fresnel",
             {"Surfaces of roughness 0.1 or more, seen at cosines of 0.1 to 1 under even light of "
              "D65. A metal's true colour is that of its spectrum. Forms at three wavelengths use "
              "650, 550 and 450 nm."}},
            {"Multiple scattering",
             {fmt::format(
                 "Fresnel is Schlick's, and cosines are 0.1 or more. A compensation is taken where "
                 "one bounce is off by more than ΔE {} and the compensation is nearer to the "
                 "reference. Gains below ΔE {} are not worth it.",
                 plain(side_by_side), plain(just_seen))}},
            {"Under single lights",
             {"A ball is lit from 30° and from 120° to the view. The reference is random walks of "
              "light. Their error is added to ΔE. Differences between forms count if they are more "
              "than twice that error."}},
            {"Under image-based light",
             {"The light is even. The reference is the transport of light between facets. Only "
              "Fdez-Agüera's compensation is compared: it was made for the split sum."}},
            {"Split sum",
             {"ΔE is averaged over the surface's orientations under the sky, then rounded up. The "
              "row is listed because engines ship it: no threshold judges it. The exposure "
              "makes a white ball half as bright as the display's white."}},
            {"Diffuse",
             {fmt::format(
                 "Below a lobe the reference is EON, scaled by the light that the lobe lets "
                 "through. Colours are those of a ball, where the cosines of light and view are "
                 "{:g} or "
                 "more. Reflected light is computed at cosines of {:g} or more. A form that "
                 "reflects "
                 "more than {} of the light is left out. If all do, the one that reflects least "
                 "is taken.",
                 least_colour_cosine, least_diffuse_cosine, page::percent(no_light_made, 4))}},
            {"≤",
             {"The greatest value that was computed. Between the roughnesses, views and points "
              "that were computed it may be larger."}},
            {"Times",
             {std::string(is_timed_in_several_processes(i.facts)
                              ? "Both forms of a cost are timed in several processes. The cost is "
                                "the median of their differences. It is shown if it has the same "
                                "sign in every process and is larger than the spread and than 3 % "
                                "of the slower form's time. "
                              : "Times are medians of one process (--quick). A cost is shown if it "
                                "exceeds the sum of the spreads of both times. ") +
              (is_timed_in_several_processes(i.facts) ? "Compensations are timed in one process."
                                                      : "") +
              (i.facts.tails
                   ? " The distribution row times whole highlights; no threshold judges it."
                   : "")}}}}},
       "about"});
  const std::time_t at = i.at_ms / 1000;
  out.setting = fmt::format(
      "gonio {}, {} setting, made {:%Y-%m-%d %H:%M} UTC. All rows of this page are in index.json "
      "beside it.",
      i.version, setting_of(i), fmt::gmtime(at));
  return page_html(out, front);
}

}  // namespace gonio
