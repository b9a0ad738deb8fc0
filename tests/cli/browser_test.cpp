// Every kind of page in a browser: nothing fails, everything is drawn, plots tell what is under the
// pointer, and nothing is wider than a narrow window.
#include <algorithm>
#include <cctype>
#include <limits>
#include <map>
#include <set>

#include "cli/program.h"
#include "compared_models.h"
#include "fitting/choice/document.h"
#include "reports/cost/cost.h"
#include "reports/cost/points.h"
#include "reports/cross_fit/cross_fit.h"
#include "reports/diffuse/diffuse.h"
#include "reports/energy/energy.h"
#include "reports/index/index_page.h"
#include "reports/page/page.h"
#include "reports/page/render.h"
#include "reports/pages/models_page.h"
#include "reports/picture/document.h"
#include "reports/remap/remap.h"
#include "reports/scenes/scenes.h"
#include "reports/schlick/schlick.h"

namespace gonio::test {
namespace {

/// The browser's command, or "" where none is found.
std::string browser() {
  for (const char* name : {"chromium", "chromium-browser", "google-chrome"})
    if (std::system(("command -v " + std::string(name) + " >/dev/null 2>&1").c_str()) == 0)
      return name;
  return "";
}

/// Collects what goes wrong from the page's first script on.
constexpr const char* watch = R"(<script>
const problems = [];
addEventListener("error", (e) => problems.push(`error: ${e.message}`));
addEventListener("unhandledrejection", (e) => problems.push(`rejected: ${e.reason}`));
addEventListener("securitypolicyviolation", (e) => problems.push(`policy: ${e.violatedDirective} ${e.blockedURI}`));
for (const how of ["error", "warn"]) console[how] = (...what) => problems.push(`console.${how}: ${what.join(" ")}`);
</script>)";

/// Looks at the page, moves a pointer over each plot, and tells the page around it.
constexpr const char* ask = R"(<script>
addEventListener("load", () => setTimeout(() => {
  const seen = { problems, drawn: 0, blank: [], plots: 0, mute: [], wider: document.documentElement.scrollWidth - innerWidth,
                 places: document.querySelectorAll(".contents a").length, picture: document.querySelector(".plot, .sphere")?.getBoundingClientRect().top ?? null,
                 dead: [...document.querySelectorAll(".contents a")].map((a) => a.getAttribute("href").slice(1)).filter((id) => !document.getElementById(id)),
                 text: document.getElementById("page")?.innerText ?? "" };
  const name = (node) => node.closest("[aria-label]")?.getAttribute("aria-label") ?? node.className;
  const readout_of = (node) => {
    for (; node && node.tagName !== "SECTION"; node = node.parentElement) {
      const found = node.querySelector(":scope > .readout");
      if (found) return found;
    }
    return null;
  };
  const told = (readout) => !readout.querySelector(".hint") && readout.childNodes.length && /\d/.test(readout.textContent);
  const speaks = (node, move) => {
    const readout = readout_of(node), box = node.getBoundingClientRect();
    if (!readout || !box.width) return;
    ++seen.plots;
    for (let x = 0.04; x < 1; x += 0.04)
      for (let y = 0.05; y < 1; y += 0.1) {
        move({ clientX: box.left + x * box.width, clientY: box.top + y * box.height, bubbles: true });
        if (told(readout)) return;
      }
    seen.mute.push(name(node));
  };
  for (const plot of document.querySelectorAll(".plot[tabindex]")) {
    if (!plot.clientWidth) continue;
    ++seen.drawn;
    if (!plot.querySelector("g[class] path, image")) seen.blank.push(name(plot));
    speaks(plot, (at) => plot.dispatchEvent(new PointerEvent("pointermove", at)));
  }
  parent.postMessage([location.pathname.split("/").at(-1), encodeURIComponent(JSON.stringify(seen))], "*");
}, 400));
</script>)";

/// All pages in frames of their own at once: a browser takes a second to start.
class Pages {
 public:
  /// With the two scripts in it.
  void add(const std::string& name, std::string html) {
    html.insert(html.find("<body>") + 6, watch);
    html.insert(html.rfind("</body>"), ask);
    folder_.write(name + ".html", html);
    names_.push_back(name);
  }
  const std::vector<std::string>& names() const { return names_; }

  /// What each page told, by its name.
  std::map<std::string, nlohmann::json> look(const std::string& browser) const {
    // Frames lie on each other: what is out of sight is not drawn.
    std::string page =
        "<!doctype html><title>pages</title><style>iframe { position: absolute; left: 0; top: 0; "
        "width: 500px; height: 2000px; border: 0; }</style><body><script>addEventListener("
        "\"message\", ({ data: [name, text] }) => { const told = document.createElement(\"pre\"); "
        "told.id = name; told.textContent = text; document.body.append(told); });</script>";
    for (const auto& name : names_) page += "<iframe src=\"" + name + ".html\"></iframe>";
    folder_.write("pages.html", page);
    const std::string command =
        "timeout 200 " + browser +
        " --headless --no-sandbox --disable-gpu --no-first-run --disable-background-networking"
        " --disable-component-update --disable-sync --hide-scrollbars --user-data-dir='" +
        folder_ / "profile" +
        "' --virtual-time-budget=6000 --window-size=600,2100 --dump-dom 'file://" +
        folder_ / "pages.html" + "' >'" + folder_ / "dom" + "' 2>'" + folder_ / "log" + "'";
    const int status = std::system(command.c_str());
    EXPECT_EQ(status, 0) << read_bytes(folder_ / "log");
    return told(read_bytes(folder_ / "dom"));
  }

 private:
  static std::string decoded(const std::string& text) {
    std::string out;
    for (std::size_t i = 0; i < text.size(); ++i)
      if (text[i] == '%') {
        out += static_cast<char>(std::stoi(text.substr(i + 1, 2), nullptr, 16));
        i += 2;
      } else {
        out += text[i];
      }
    return out;
  }
  std::map<std::string, nlohmann::json> told(const std::string& dom) const {
    std::map<std::string, nlohmann::json> all;
    for (const auto& name : names_) {
      const std::string open = "<pre id=\"" + name + ".html\">";
      const auto from = dom.find(open);
      if (from == dom.npos) continue;
      const auto begin = from + open.size();
      all[name] =
          nlohmann::json::parse(decoded(dom.substr(begin, dom.find("</pre>", begin) - begin)));
    }
    return all;
  }

  Folder folder_;
  std::vector<std::string> names_;
};

/// Few of everything that its page shows.
EnergyReport small_energy_report() {
  const EnergyOptions few{
      false, {0.3, 0.5, 1}, {0.1, 0.5, 1}, 1024, {"masking.smith_ggx.correlated", "masking.none"}};
  EnergyRows r;
  r.forms = energy_forms(few, [](double) {});
  r.materials = energy_materials(few, [](double) {});
  for (const double ns : {10.0, 100.0})
    r.estimators.push_back({"one integral", 0.5, 0.5, 1e-3, 1 / ns, 0.1, 10, ns, 0.1 * ns});
  for (const std::size_t n : {16U, 64U})
    r.light.table_samples.push_back({n, 0.1, 0.05, 0.02, 0.01});
  for (const std::size_t n : {16U, 64U})
    r.light.irradiance.push_back({"sky", "cosine", n, 0.1, 0.3, 0.01, 50, 1});
  r.compensations.push_back(
      {"kulla_conty", 10, 2, 2048, 4, 0.1, 9, 0.5, 0.02, 0.01, "roughness 1", 0.01});
  r.light.tables.push_back({32, "half", 1e-6, 1e-4, 0.01, 0.002, 0.005});
  LitError lit{};
  lit.environment = "sky", lit.roughness = 0.5, lit.nov = 1, lit.f0 = 1, lit.delta_e = 0.7;
  r.light.lit.push_back(lit);
  return report_of(false, std::move(r));
}

CostReport small_cost_report() {
  CostOptions o;
  o.timing = {1, 1e-9, true};
  o.cache_samples = 16, o.stream_samples = 64;
  o.filter = "fresnel.schlick";
  CostRows r;
  r.machine = this_machine();
  r.rows = measure_costs(o).rows;
  r.points = few_cost_points();
  r.switches.push_back({"Schlick to exact", "fresnel.schlick", "fresnel.dielectric",
                        r.machine.instruction_sets.back(), "float", "cache", "", 1, 0.1, 2, 9, 0.02,
                        0});
  return report_of(false, std::move(r));
}

ScenesReport small_scenes_report() {
  ScenesOptions o;
  o.materials = {"red plastic"};
  o.lights = {"front light", "rim light"};
  o.plan.samples = 512;
  o.plan.fresh = 8192;
  o.plan.cost = scene::Cost::operations;
  o.verified = 1024;
  o.pixels = 16;
  o.picture_samples = 4;
  o.map_angle_deg = {0, 60, 120};
  o.map_roughness = {0.25, 0.6};
  o.map_samples = 256;
  return scenes_report(o);
}

template <class Report>
std::string html_of(const Report& r) {
  return page::page_html(report_page(r), r.pictures);
}

void add_reports(Pages& pages) {
  pages.add("energy", html_of(small_energy_report()));
  pages.add("diffuse",
            html_of(diffuse_report(
                {false, {0, 0.5, 1}, {0.1, 0.5, 1}, 8, {"diffuse.lambert", "diffuse.disney"}})));
  pages.add("schlick", html_of(schlick_report({false, {1.3, 1.5, 2}, 90, {0.5, 1}})));
  pages.add(
      "remap",
      html_of(remap_report({false,
                            {0.5, 1},
                            {0.5},
                            4,
                            0.1,
                            {"masking.smith_ggx.separable", "masking.smith_ggx.correlated",
                             "masking.schlick_ggx.direct", "masking.schlick_ggx.half_alpha"}})));
  pages.add(
      "cross_fit",
      html_of(cross_fit_report({false, {0.5}, {1.5}, {"Au"}, {3}, 12, 64, {"fresnel.schlick"}})));
  pages.add("cost", html_of(small_cost_report()));
  pages.add("scenes", html_of(small_scenes_report()));
  ReportIndex index{{}, "0.1.0", false, 0, {}, {}};
  const auto schlick = schlick_rows({false, {1.5}, 90, {0.1, 1}});
  ReportFiles files;
  files.findings = findings(schlick);
  files.facts = facts(schlick);
  const auto stability = Facts::Precision{"ndf.ggx", "cross", "half, flushed", 0.02, 0.004};
  files.facts.precision.push_back(stability);
  files.facts.precision.push_back(
      {"ggx/smith_ggx.correlated/schlick", "directions", "half", 0.02, 0.2});
  files.facts.setting = Facts::Setting{"a processor", 2, "avx2"};
  files.facts.masking = {{"masking.schlick_ggx.direct", 0.28}, {"masking.smith_ggx.correlated", 0}};
  for (const auto& [id, ns] :
       {std::pair("masking.schlick_ggx.direct", 0.2), {"masking.smith_ggx.correlated", 0.6}})
    files.facts.in_cache.push_back({id, ns, 0.01});
  add_report(index, "schlick", "Schlick against exact Fresnel", 1500, std::move(files));
  pages.add("index", index_page_html(index));
}

/// A page with a script that complains of what is not as it should be.
void add_checked(Pages& pages,
                 const std::string& name,
                 const page::Page& page,
                 const Pictures& pictures,
                 const std::string& script) {
  std::string html = page::page_html(page, pictures);
  html.insert(html.rfind("</body>"),
              "<script>const complain = (of, is) => { if (!is) console.warn(of); };\n" + script +
                  "</script>");
  pages.add(name, beside_index(std::move(html)));
}

/// Eight curves, of which six are shown until all are asked for, and choices of which all are printed.
void add_many(Pages& pages) {
  Figure figure = make_figure("many");
  figure.title = "Many";
  figure.x = {"x"}, figure.y = {"y"};
  for (int i = 0; i < 8; ++i)
    figure.curves.push_back({"c" + std::to_string(i), {0, 1}, {1.0 * i, 2.0 * i}});
  figure.curves.push_back({"truth", {0, 1}, {0, 1}});
  figure.curves.back().dashed = true;
  page::Choice choice;
  choice.controls = {{"a", "A", "1"}, {"b", "B", "x"}};
  page::Slot slot;
  for (const auto& [a, b] : {std::pair("1", "x"), {"1", "y"}, {"2", "y"}, {"3", "z"}})
    slot.each.push_back({{a, b}, {page::Prose{std::string("choice ") + a + b}}});
  choice.slots = {slot};
  page::Page page{"", "report many", "Many", "Many", {"One.", "Two.", "Three.", "Four.", "Five."}};
  page.first = {page::Shown{"many"}};
  page.sections = {{}, {"Of choices, a section", "", {choice}}};
  page.most_shipped = {"c7"};
  add_checked(pages, "many", page, {{figure}, {}}, R"js(
const keys = () => [...document.querySelectorAll(".keys button:not(.all)")].filter((k) => k.checkVisibility()).map((k) => k.textContent).join(" ");
complain("a way back", document.querySelector('.over a[href="index.html"]').checkVisibility());
complain("six curves and the reference", keys() === "c0 c1 c2 c3 c4 c7 truth");
document.querySelector(".keys .all").click();
complain("all curves", keys() === "c0 c1 c2 c3 c4 c5 c6 c7 truth");
const curve = document.querySelectorAll(".plot g.k0")[0];
complain("a curve that is shown", curve.checkVisibility());
document.querySelector(".keys button").click();
complain("a curve that its name has hidden", getComputedStyle(curve).display === "none");
complain("an anchor", document.getElementById("of-choices-a-section"));
const shown = () => document.querySelector(".slot").firstElementChild.textContent.trim(), set = (name, value) => { const c = [...document.querySelectorAll(`input[name="${name}"]`)].find((i) => i.value === value); c.checked = true; c.dispatchEvent(new Event("change", { bubbles: true })); };
complain("what is chosen at first", shown() === "choice 1x");
set("c1", "y");
complain("what is chosen then", shown() === "choice 1y");
set("c0", "2");
complain("the other choice stays where it can", shown() === "choice 2y");
set("c0", "3");
complain("and gives way where it cannot", shown() === "choice 3z");
complain("only what there is can be chosen", document.querySelector('input[value="x"]').closest("label").hidden);
const printed = () => [...document.querySelectorAll(".paper")].map((p) => p.textContent).join("");
complain("nothing for paper yet", printed() === "");
dispatchEvent(new Event("beforeprint"));
complain("the other choices on paper", printed().includes("choice 2y") && printed().includes("choice 1"));
complain("all findings on paper", document.querySelector("details").open);
dispatchEvent(new Event("afterprint"));
complain("paper is put away", printed() === "");
)js");
}

/// A curve on logarithmic axes of which a reader cuts out a part; complains of ticks that are not of that part.
void add_zoom(Pages& pages) {
  FigureCurve curve{"c", {}, {}, FigureCurve::Kind::both};
  for (int i = 0; i <= 100; ++i) {
    curve.x.push_back(std::pow(10, i / 20.0 - 3));
    curve.y.push_back(curve.x.back() * curve.x.back());
  }
  Figure figure = make_figure("zoom");
  figure.title = "Zoom";
  figure.x = {"x", true, 1e-3, 100}, figure.y = {"y", true};
  figure.curves = {curve};
  page::Page page{"", "report zoom", "Zoom", "Zoom", {"One."}};
  page.first = {page::Shown{"zoom"}};
  add_checked(pages, "zoom", page, {{figure}, {}}, R"js(
addEventListener("load", () => {
  const plot = document.querySelector(".plot"), box = plot.getBoundingClientRect();
  const number = (text) => { const [lead, power] = text.replace("−", "-").split("10"); return power ? (lead ? Number(lead.replace("·", "")) : 1) * 10 ** Number([...power].map((c) => "⁰¹²³⁴⁵⁶⁷⁸⁹".indexOf(c) < 0 ? "-" : "⁰¹²³⁴⁵⁶⁷⁸⁹".indexOf(c)).join("")) : Number(text.replace("−", "-")); };
  const ticks = (g) => [...plot.querySelectorAll(g + " text")].map((t) => number(t.textContent === "10" ? "10.0" : t.textContent.replace(/^1?00?0?$/, (s) => s + ".0")));
  const drag = (from, to) => { for (const [what, part] of [["pointerdown", from], ["pointermove", to], ["pointerup", to]])
    plot.dispatchEvent(new PointerEvent(what, { bubbles: true, pointerType: "mouse", clientX: box.left + part * box.width, clientY: box.top + 50 })); };
  const at_first = plot.innerHTML;
  for (const [from, to] of [[0.2, 0.6], [0.5, 0.52]]) {
    drag(from, to);
    const x_at = (part) => 1e-3 * 1e5 ** part, [x0, x1] = [x_at(from), x_at(to)];
    const within = (list, a, b) => list.length > 1 && list.length < 12 && list.every((t) => t > a / 1.05 && t < b * 1.05);
    if (!within(ticks(".xt"), x0, x1)) console.warn(`of ${x0} to ${x1} the ticks are ${ticks(".xt")}`);
    if (!within(ticks(".yt"), x0 * x0 / 2, x1 * x1 * 2)) console.warn(`beside ${x0} to ${x1} the ticks are ${ticks(".yt")}`);
    plot.dispatchEvent(new MouseEvent("dblclick", { bubbles: true }));
    complain("the whole again", plot.firstElementChild.getAttribute("viewBox").startsWith("0 0 "));
  }
});
)js");
}

/// Models compared; complains of a model that is drawn before it is asked for.
void add_models(Pages& pages) {
  const Table t = compared_table();
  const ModelChoice c = compared_models();
  const Advice advice = advise(c);
  std::string html = models_page_html(c, advice, {"tables/t.csv", "0ab1", "csv", "log"},
                                      make_models_page(t, c, advice, compared_spheres(t, c)));
  html.insert(html.rfind("</body>"), R"(<script>
const shown = (what) => [...document.querySelectorAll(what)].filter((node) => node.checkVisibility());
const seventh = () => shown(".panels .keys button").some((key) => key.textContent.startsWith("7"));
addEventListener("load", () => {
  if (seventh()) console.warn("a seventh model among the first");
  shown(".panels .keys .all")[0].click();
  if (!seventh()) console.warn("not all models are drawn");
  const last = () => [...document.querySelectorAll(".panels figure:last-child .plot .more")].every((curve) => getComputedStyle(curve).display !== "none");
  if (!last()) console.warn("the seventh model is drawn in the first panel alone");
  const spheres = () => shown(".spheres h3").length;
  if (spheres() !== 6) console.warn(`${spheres()} spheres at first`);
  document.querySelector("details.more").open = true;
  if (spheres() !== 7) console.warn(`${spheres()} spheres of seven models`);
});
</script>)");
  pages.add("choice", std::move(html));
}

/// Materials of a batch, looked through; complains of one that is shown though it was not asked for, or in another order.
void add_batch(Pages& pages, std::string html) {
  html.insert(html.rfind("</body>"), R"(<script>
addEventListener("load", () => {
  const complain = (of, is) => { if (!is) console.warn(of); };
  const form = document.querySelector(".browse form"), names = (what) => [...document.querySelectorAll(what)].filter((n) => n.checkVisibility()).map((n) => n.querySelector("a").textContent).join(" ");
  const set = (name, use) => { use(form.elements[name]); form.dispatchEvent(new Event("input", { bubbles: true })); };
  complain("both as given", names(".card") === "a.exr b.exr");
  set("falling", (c) => { c.checked = true; });
  complain("both the other way round", names(".card") === "b.exr a.exr");
  set("words", (c) => { c.value = "A.EX"; });
  complain("one by a part of its name", names(".card") === "a.exr");
  set("view", (c) => { c.value = "rows"; });
  complain("one row and no card", names(".card") === "" && names(".rows tbody tr") === "a.exr");
  set("words", (c) => { c.value = ""; });
  document.querySelector(".rows thead th").click();
  complain("rows by name", names(".rows tbody tr") === "a.exr b.exr" || names(".rows tbody tr") === "b.exr a.exr");
  set("view", (c) => { c.value = "cards"; });
});
</script>)");
  pages.add("summary", std::move(html));
}

/// The pages of the other commands, as they make them.
void add_commands(Pages& pages) {
  const Folder f;
  const auto run = [&](const std::string& words, const std::string& page) {
    const auto o = gonio(f, words);
    ASSERT_EQ(o.code, 0) << o.err;
    std::string name = page.substr(page.rfind('/') + 1);
    pages.add(name.substr(0, name.find('.')), read_bytes(f / page));
  };
  ASSERT_EQ(
      gonio(f, "synth " + std::string(paint) + " --layout image_slice --noise 0.02 -o t/a.exr",
            "mkdir t; ")
          .code,
      0);
  run("fit t/a.exr --model lambert+ggx/smith_ggx.correlated/schlick -o fit.json --html fit.html",
      "fit.html");
  ASSERT_EQ(gonio(f,
                  "synth ggx/smith_ggx.correlated/schlick --set alpha=0.3 f0=0.9 --layout in_plane "
                  "--noise 0.02 -o limit.csv")
                .code,
            0);
  run("fit limit.csv --html limit.html", "limit.html");
  ASSERT_EQ(gonio(f,
                  "synth lambert+ggx/smith_ggx.correlated/schlick --set alpha=0.3 f0=0.15 kd=0.98 "
                  "--layout hemisphere -o bright.csv")
                .code,
            0);
  run("fit bright.csv --html bright.html", "bright.html");
  run("inspect t/a.exr --html inspect.html", "inspect.html");
  ASSERT_EQ(gonio(f, "fit t --model lambert+ggx/smith_ggx.correlated/schlick -o batch",
                  "cp t/a.exr t/b.exr; ")
                .code,
            0);
  add_batch(pages, read_bytes(f / "batch/summary.html"));
  f.write("scene.json", R"({"schema": "gonio.scene/1",
    "materials": {"gold": {"model": "ggx/smith_ggx.correlated/conductor",
                           "parameters": {"roughness": 0.4, "metal": "Au"}}},
    "objects": [{"shape": "sphere", "material": "gold"}],
    "lights": [{"type": "directional", "direction": [0, 0, 1], "irradiance": [2, 2, 2]}],
    "view": {"position": [0, 0, 10], "target": [0, 0, 0]}})");
  run("plan scene.json --samples 512 --cost operations --html plan.html", "plan.html");
  run("audit ndf.ggx masking.schlick_ggx.direct model.ue_mobile --html audit.html", "audit.html");
}

TEST(Browser, ShowsEveryPageWholeAndTellsWhatIsUnderThePointer) {
  const std::string command = browser();
  if (command.empty()) GTEST_SKIP() << "needs chromium or Chrome, which is not here";
  Pages pages;
  add_reports(pages);
  add_many(pages);
  add_zoom(pages);
  add_models(pages);
  add_commands(pages);
  const auto told = pages.look(command);
  const std::set<std::string> reports{"energy", "schlick", "remap", "cross_fit", "cost", "scenes"};
  for (const auto& name : pages.names()) {
    if (!told.contains(name)) {
      ADD_FAILURE() << name << ": the page's scripts did not come to their end";
      continue;
    }
    const auto& page = told.at(name);
    EXPECT_TRUE(page["problems"].empty()) << name << ": " << page["problems"].dump();
    EXPECT_TRUE(page["blank"].empty()) << name << ": nothing drawn: " << page["blank"].dump();
    EXPECT_TRUE(page["mute"].empty()) << name << ": tells nothing: " << page["mute"].dump();
    EXPECT_LE(page["wider"], 0) << name << " is wider than 500 px, by so many";
    EXPECT_TRUE(page["dead"].empty()) << name << ": " << page["dead"].dump();
    if (reports.contains(name)) {
      EXPECT_GE(page["places"], 2) << name << " has contents";
      EXPECT_LT(page["picture"], 900)
          << name << ": its first picture is far below: " << page["text"];
    }
    if (name == "audit" || name == "plan") continue;  // no picture is drawn at first
    EXPECT_GT(page["drawn"], 0) << name;
    EXPECT_GT(page["plots"], 0) << name;
  }
  const auto says = [&](const char* name, const std::string& words) {
    return told.contains(name) &&
           told.at(name)["text"].get<std::string>().find(words) != std::string::npos;
  };
  const std::string index = told.contains("index") ? told.at("index")["text"] : "";
  const auto first = index.find("sin² θh from");
  EXPECT_LT(first, index.rfind("Visible error of Fresnel approximations"))
      << "decisions stand first";
  EXPECT_NE(first, index.npos);
  const std::string choice = told.contains("choice") ? told.at("choice")["text"] : "";
  const auto after_contents = choice.find("\nTake ");
  const auto at = [&](const char* words) { return choice.find(words, after_contents); };
  EXPECT_LT(at("Take Lambert + GGX (Schlick): "), at("How near, and how fast")) << choice;
  EXPECT_LT(at("This model has the fewest parameters of the 4 that"), at("How near, and how fast"));
  EXPECT_LT(
      at("The table cannot tell it from Lambert + two GGX (Schlick), Lambert + GGX (Schlick with "
         "F90) and Lambert + GTR (Schlick)."),
      at("How near, and how fast"));
  EXPECT_LT(at("Not compared: Lambert + Anisotropic GGX (Schlick)."), at("How near, and how fast"));
  EXPECT_LT(at("it is anisotropic, and the table is not."), at("Data and models"));
  for (const auto& r : compared_models().rows)
    EXPECT_LT(at(r.model.c_str()), at("Data and models"));
  for (const char* nothing : {"NaN", "undefined", "null", "[object"})
    EXPECT_EQ(at(nothing), choice.npos) << nothing;
  EXPECT_TRUE(says("limit", "≤\u202f0.000"));
  EXPECT_TRUE(says("limit", "values down to 0 do as well"));
  EXPECT_FALSE(says("limit", "What to try next"));
  EXPECT_TRUE(says("bright", "a radiance factor?"));
  EXPECT_TRUE(says("scenes", "Keeps exact Fresnel, "))
      << "what red plastic needs under a rim light";
  EXPECT_TRUE(says("bright", ", above 1")) << "light that the model returns";
}

}  // namespace
}  // namespace gonio::test
