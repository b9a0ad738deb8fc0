#include "reports/index/index_page.h"

#include <algorithm>
#include <utility>

#include "reports/page/assets.h"
#include "reports/page/page.h"
#include "reports/picture/document.h"

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
struct Description<ReportIndex::Entry> {
  static constexpr auto fields() {
    using E = ReportIndex::Entry;
    return std::tuple{
        field("name", "", &E::name, ""),
        field("what", "", &E::what, ""),
        field("sentence", "", sentence_of, "what a reader takes away"),
        field("picture", "", picture_of, "the first, as in the report's document; null: none"),
        field("pictures", "", &E::pictures, "how many"),
        field("time_ms", "ms", &E::ms, "that it took")};
  }
};
template <>
struct Description<ClaimOf> {
  static constexpr auto fields() {
    using C = ClaimOf;
    return std::tuple{
        field("report", "", &C::report, ""),
        field(
            "claim", "", [](const C& c) { return c.claim->claim; }, "sentence in circulation"),
        field(
            "source", "", [](const C& c) { return c.claim->source; }, "where it stands"),
        field(
            "judged", "", [](const C& c) { return name_of(c.claim->judged); },
            "holds, holds in part, does not hold"),
        field(
            "figure", "", [](const C& c) { return c.claim->figure; }, "the one that decides"),
        field(
            "verdict", "", [](const C& c) { return c.claim->verdict; }, "sentence with figures"),
        field(
            "anchor", "", [](const C& c) { return c.claim->anchor; }, "of the report's page")};
  }
};
template <>
struct Description<Decision> {
  static constexpr auto fields() {
    using D = Decision;
    return std::tuple{field("for", "", &D::subject, "what is decided"),
                      field("take", "", &D::take, "name of the form"),
                      field("take_id", "", &D::take_id, "of the catalogue"),
                      field("error", "", &D::error, "that is left; in brackets an aside"),
                      field("cost", "", &D::cost, "over the cheap form; in brackets an aside"),
                      field("unless", "", &D::unless, "when another is to be taken, and which")};
  }
};
template <>
struct Description<Facts::Setting> {
  static constexpr auto fields() {
    using S = Facts::Setting;
    return std::tuple{field("cpu", "", &S::cpu, "as it calls itself"),
                      field("threads", "", &S::threads, "that run at once"),
                      field("isa", "", &S::isa, "instruction set of the costs"),
                      field("others_busy", "", &S::others,
                            "processors that other programs kept busy meanwhile; null: not known"),
                      field("model_ns", "ns", &S::model_ns,
                            "time of a sample of GGX under correlated Smith and Schlick, beside "
                            "which costs stand; null: not known")};
  }
};
template <>
struct Description<Facts::Fresnel> {
  static constexpr auto fields() {
    using F = Facts::Fresnel;
    return std::tuple{field("kind", "", &F::kind, "dielectric, metal"),
                      field("material", "", &F::material, ""),
                      field(
                          "form", "", [](const F& f) { return name_of_form(f.form); }, "its name"),
                      field("form_id", "", &F::form, "id, with what tells a variant from it"),
                      field("delta_e", "", &F::delta_e, "greatest CIEDE2000 of the rough surface"),
                      field("head_on", "", &F::head_on, "the same seen head on")};
  }
};
template <>
struct Description<Visibility> {
  static constexpr auto fields() {
    using V = Visibility;
    return std::tuple{field("just_seen", "", &V::just_seen, "CIEDE2000; below, nobody sees it"),
                      field("side_by_side", "", &V::side_by_side, "below, it is seen so alone")};
  }
};
template <>
struct Description<ReportIndex> {
  static constexpr auto fields() {
    using I = ReportIndex;
    return std::tuple{constant_text("schema", "gonio.report.index/1"),
                      field("version", "", &I::version, "of gonio"),
                      field("full", "", &I::full, setting_meaning),
                      field("at_ms", "ms", &I::at_ms, "since 1970"),
                      field(
                          "machine", "", [](const I& i) { return i.facts.setting; }, ""),
                      field(
                          "decisions", "", [](const I& i) { return decisions(i.facts); }, ""),
                      field(
                          "visible", "",
                          [](const I&) {
                            return Visibility{just_seen, side_by_side};
                          },
                          "thresholds"),
                      field("fresnel", "", fresnel_grid, "forms by material"),
                      field(
                          "front", "", [](const I& i) { return figures_json(i.front); },
                          "masking's accuracy against time"),
                      field("reports", "", &I::reports, ""),
                      field("claims", "", claims_of, "")};
  }
};

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
  front.curves[0].name = "masking forms for GGX";
  if (front.curves.size() == 2) front.curves[1].name = "the front";
  to.front.figures = {std::move(front)};
}

std::string to_json(const ReportIndex& index) {
  return page_document(index);
}
std::string index_schema() {
  return schema_text<ReportIndex>("gonio report all: index.json");
}

std::string index_page_html(std::string_view data) {
  return make_report_page("Which shortcuts can you ship?", data, assets::index_js);
}

}  // namespace gonio
