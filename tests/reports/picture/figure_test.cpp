#include "reports/picture/figure.h"

#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "base/base64.h"
#include "base/text.h"
#include "image/exr.h"
#include "reports/picture/document.h"
#include "reports/picture/figure_scale.h"
#include "reports/picture/figure_style.h"
#include "support.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace gonio {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

Figure times() {
  return {"times",
          "Time & error",
          "a <note>",
          {"time [ns]", true},
          {"error, most", true},
          {{"exact", {1, 10, 100}, {1e-3, none, 1e-5}, FigureCurve::Kind::both},
           {.name = "fit \"a\"",
            .x = {2, 20},
            .y = {0.01, 0.02},
            .kind = FigureCurve::Kind::points,
            .labels = {"a, b", "c"},
            .y_error = {0.001, 0.05}}}};
}

FigureMap cells() {
  return {"cells",
          "Cells",
          "",
          {"x", {1, 2, 3}},
          {"y [°]", {10, 20}},
          "F − exact [1]",
          {0, 1, 2, 3, none, -5},
          true};
}

/// As the only picture of its report.
std::string drawn(const Figure& f) {
  return to_svg(f, CurveStyles({&f, 1}));
}

std::size_t occurrences(const std::string& in, const std::string& what) {
  std::size_t n = 0;
  for (auto at = in.find(what); at != std::string::npos; at = in.find(what, at + 1)) ++n;
  return n;
}

TEST(FigureCsv, HasALineForEachPointThatThereIs) {
  EXPECT_EQ(to_csv(times()),
            "curve,time [ns],\"error, most\",label,\"± error, most\"\n"
            "exact,1,0.001,,\n"
            "exact,100,1e-05,,\n"
            "\"fit \"\"a\"\"\",2,0.01,\"a, b\",0.001\n"
            "\"fit \"\"a\"\"\",20,0.02,c,0.05\n");
}

TEST(FigureCsv, HasALineForEachCellThatThereIs) {
  EXPECT_EQ(to_csv(cells()), "x,y [°],F − exact [1]\n1,10,0\n1,20,1\n2,10,2\n2,20,3\n3,20,-5\n");
  auto named = cells();
  named.x.names = {"a,b", "c", "d"};
  EXPECT_NE(to_csv(named).find("\n\"a,b\",10,0\n\"a,b\",20,1\nc,10,2\n"), std::string::npos);
}

TEST(FigureId, IsAFileName) {
  EXPECT_EQ(picture_id("loss", {{"form", "masking.smith_ggx"}, {"angle", "μ = 0.5"}}),
            "loss_masking_smith_ggx_0_5");
}

TEST(FigureSvg, EscapesItsTexts) {
  auto f = times();
  f.curves[0].name = "</svg><script>\x01";
  const std::string svg = drawn(f);
  EXPECT_EQ(occurrences(svg, "<script"), 0U);
  EXPECT_EQ(occurrences(svg, "</svg>"), occurrences(drawn(times()), "</svg>"));
  EXPECT_EQ(svg.find('\x01'), svg.npos);
  EXPECT_NE(svg.find("Time &amp; error"), svg.npos);
  EXPECT_NE(svg.find("a &lt;note&gt;"), svg.npos);
}

/// How far down the label of a point lies, from which a line goes up to the right.
double label_height(bool dashed) {
  Figure f = times();
  f.curves = {{"front", {10, 100}, {0.01, 0.1}, FigureCurve::Kind::line, dashed},
              {.name = "form",
               .x = {10},
               .y = {0.01},
               .kind = FigureCurve::Kind::points,
               .labels = {"a label"}}};
  const std::string svg = drawn(f);
  const auto text = svg.rfind("<text x=", svg.find(">a label</text>"));
  return std::stod(svg.substr(svg.find(" y=\"", text) + 4));
}

TEST(FigureSvg, LaysNoLabelOnADashedLine) {
  EXPECT_GT(label_height(true), label_height(false) + 15) << "below its point";
}

TEST(FigureSvg, DrawsEveryPointItsBarAndItsLabel) {
  const std::string svg = drawn(times());
  EXPECT_EQ(occurrences(svg, "h0"), 4U + 2U) << "points, and those of the legend";
  EXPECT_NE(svg.find(">a, b</text>"), svg.npos);
  const auto bars = svg.substr(svg.find(R"(<path class="bar")"));
  EXPECT_EQ(occurrences(bars.substr(0, bars.find("/>")), "M"), 2U) << "of the second curve";
  EXPECT_EQ(occurrences(svg, R"(class="bar")"), 1U);
  EXPECT_NE(svg.find(">10⁻⁵</text>"), svg.npos);
  EXPECT_EQ(svg.find("nan"), svg.npos);
  EXPECT_EQ(svg.find("inf"), svg.npos);
}

TEST(CurveStyles, ANameLooksTheSameInAllPictures) {
  std::vector<Figure> all(3);
  all[0].family = all[1].family = "by_angle";
  all[0].curves = {{"a", {}, {}}, {"b = c", {}, {}}};
  all[0].curves[1].look = "b";
  all[1].curves = {{"d", {}, {}}, {"b", {}, {}}, {"a", {}, {}}};
  all[1].curves[2].dashed = true;
  all[2].curves = {{"e", {}, {}}, {"d", {}, {}}};
  const CurveStyles styles(all);
  const auto of = [&](std::size_t picture, std::size_t i) {
    return styles.of(all[picture].curves[i]);
  };
  EXPECT_EQ(of(0, 0), 0U);
  EXPECT_EQ(of(0, 1), 1U);
  EXPECT_EQ(of(1, 1), 1U) << "b";
  EXPECT_EQ(of(1, 0), 2U) << "not as a, which is in a neighbouring picture";
  EXPECT_EQ(of(1, 2), 0U) << "the first reference";
  EXPECT_EQ(of(2, 1), 2U) << "d";
  EXPECT_EQ(of(2, 0), 0U) << "alike only names that are nowhere beside each other";
  EXPECT_EQ(figures_json({all, {}})[2]["curves"][1]["colour"], "green") << "as in the SVG";
  const auto colour = [&](const Figure& f) { return occurrences(to_svg(f, styles), "#00795a"); };
  EXPECT_EQ(colour(all[0]), 0U);
  EXPECT_EQ(colour(all[1]), 1U) << "in the legend";
  EXPECT_EQ(colour(all[2]), 1U);
}

TEST(CurveStyles, NamesOfAPictureDiffer) {
  Figure f;
  for (int i = 0; i < 36; ++i) f.curves.push_back({"r = " + std::to_string(i), {}, {}});
  const CurveStyles styles({&f, 1});
  std::set<std::size_t> seen;
  for (const auto& c : f.curves) seen.insert(styles.of(c));
  EXPECT_EQ(seen.size(), 36U);
  EXPECT_EQ(*seen.rbegin(), 35U);
}

/// A set of neighbours for each would take a hundred gigabytes.
TEST(CurveStyles, OfManyNamesTakeLinearTimeAndMemory) {
  Figure f;
  f.curves.resize(50'000);
  for (std::size_t i = 0; i < f.curves.size(); ++i) f.curves[i].name = std::to_string(i);
  const CurveStyles styles({&f, 1});
  for (const std::size_t i : {0U, 11U, 12U, 49'999U}) EXPECT_EQ(styles.of(f.curves[i]), i);
}

TEST(FigureSvg, ALineBreaksWhereAPointIsMissing) {
  for (const auto kind : {FigureCurve::Kind::line, FigureCurve::Kind::both}) {
    const Figure f{"gap", "Gap", "",
                   {"x"}, {"y"}, {{"c", {0, 1, 2, 3, 4}, {1, 2, none, 2, 1}, kind}}};
    const std::string svg = drawn(f);
    const auto begin = svg.find("<path d=\"", svg.find(R"(<g class="k0">)")) + 9;
    const std::string path = svg.substr(begin, svg.find('"', begin) - begin);
    EXPECT_EQ(occurrences(path, "M"), 2U) << path;
    EXPECT_EQ(occurrences(path, "l"), 2U) << path;
  }
}

TEST(FigureSvg, LeavesOutPointsThatLieOnTheLine) {
  Figure f{"line", "Line", "", {"x"}, {"y"}, {{"c", {}, {}}}};
  for (int i = 0; i <= 90; ++i) {
    f.curves[0].x.push_back(i);
    f.curves[0].y.push_back(i < 45 ? 0 : i - 45);
  }
  const std::string svg = drawn(f), curve = svg.substr(svg.find(R"(<g class="k0">)"));
  const auto path = curve.substr(0, curve.find("/>"));
  EXPECT_EQ(occurrences(path, " ") + occurrences(path, "-"), 3U + 3U) << path;
}

/// Numbers of a list in an attribute.
std::vector<double> numbers_of(const std::string& svg, const std::string& attribute) {
  const auto at = svg.find(attribute + "=\"") + attribute.size() + 2;
  std::vector<double> out;
  for (const auto& n : split(svg.substr(at, svg.find('"', at) - at), ' '))
    out.push_back(std::stod(n));
  return out;
}

TEST(PageSvg, SaysWhatItsScriptReads) {
  const auto f = times();
  const std::string svg = page_svg(f, CurveStyles({&f, 1}), 300, {true, true});
  const auto x = x_scale(f);
  EXPECT_NE(svg.find(fmt::format("data-x=\"{:.6g} {:.6g} log\"", x.low, x.high)), svg.npos) << svg;
  EXPECT_NE(svg.find("data-labels=\"a, b|c\""), svg.npos);
  EXPECT_EQ(svg.find('#'), svg.npos) << "a colour that would be the same in the dark";
}

TEST(PageSvg, PlacesLabelsForSeveralWidthsAndThoseOnADashedLineFirst) {
  Figure f{"front", "Front", "", {"x"}, {"y"}, {}};
  FigureCurve points{"forms", {}, {}, FigureCurve::Kind::points};
  for (int i = 0; i < 12; ++i) {
    points.x.push_back(5 + 0.02 * i);
    points.y.push_back(5);
    points.labels.push_back(fmt::format("a form of number {}", i));
  }
  points.x.insert(points.x.end(), {0, 10});
  points.y.insert(points.y.end(), {0, 10});
  points.labels.insert(points.labels.end(), {"first", "last"});
  FigureCurve line{"best", {0, 5.1, 10}, {0, 5, 10}};
  line.dashed = true;
  f.curves = {points, line};
  const auto svg = page_svg(f, CurveStyles({&f, 1}), 300, {true, true});
  ASSERT_EQ(occurrences(svg, "<g class=\"in labels"), 3U);
  std::size_t before = 0;
  for (const char* look : {"labels narrow", "labels", "labels wide"}) {
    const auto at = svg.find(fmt::format("<g class=\"in {}\"", look));
    const auto group = svg.substr(at, svg.find("</g>", at) - at);
    EXPECT_EQ(occurrences(group, ">a form of number 5<"), 1U) << look;
    EXPECT_GE(occurrences(group, "<text"), before) << look;
    before = occurrences(group, "<text");
    const bool of_all = look != std::string("labels narrow");
    EXPECT_EQ(before > occurrences(group, ">a form of number 5<") + occurrences(group, "st<"),
              of_all)
        << look << " names others than those of the line";
  }
}

TEST(PageSvg, IsMadeForTheCurvesThatAreShownAtFirst) {
  Figure f{"two", "Two", "", {"x"}, {"y"}, {{"a", {0, 1}, {0, 1}}, {"b", {0, 1}, {0, 100}}}};
  const CurveStyles styles({&f, 1});
  const std::string all = page_svg(f, styles, 300, {true, true}),
                    one = page_svg(f, styles, 300, {true, false});
  EXPECT_NE(all.find("data-y=\"0 106\""), all.npos);
  EXPECT_NE(one.find("data-y=\"0 1.06\""), one.npos);
  EXPECT_EQ(occurrences(one, " more\""), 1U);
}

TEST(PageSvg, KeepsTheValuesOfItsCells) {
  const auto m = cells();
  const std::string svg = page_svg(m, 0, true);
  const auto at = svg.find("data-cells=\"") + 12;
  const auto bytes = from_base64(svg.substr(at));
  ASSERT_EQ(bytes.size(), 12U);
  for (std::size_t k = 0; k < 6; ++k) {
    const unsigned q = static_cast<unsigned char>(bytes[2 * k]) +
                       256U * static_cast<unsigned char>(bytes[2 * k + 1]);
    if (std::isnan(m.values[k]))
      EXPECT_EQ(q, 65535U);
    else
      EXPECT_NEAR(5 * (q / 32767.0 - 1), m.values[k], 2e-4);
  }
  EXPECT_EQ(numbers_of(svg, "data-xs").size(), 4U);
  EXPECT_LT(page_svg(m, 0, false).size(), svg.size()) << "its script fills them in";
}

TEST(PageSvg, DrawsPointsInTheirOwnColoursWithTheirCurvesRim) {
  Figure f = times();
  f.curves[1].colours = {"#123456", "#abcdef"};
  const std::string svg = page_svg(f, CurveStyles({&f, 1}), 300, {true, true});
  EXPECT_EQ(occurrences(svg, "class=\"rim\""), 1U);
  EXPECT_EQ(occurrences(svg, "style=\"stroke:#123456\""), 1U);
  EXPECT_EQ(drawn(f).find("#123456"), std::string::npos) << "a file has the curve's colour";
}

TEST(PageSvg, DrawsCellsInTheirOwnColoursAsOneImage) {
  FigureMap m = cells();
  m.colours.resize(6);
  for (const bool with_cells : {true, false}) {
    const auto svg = page_svg(m, 0, with_cells);
    EXPECT_EQ(occurrences(svg, "<image "), 1U);
    EXPECT_NE(svg.find("data-cells=\""), svg.npos) << "a pointer reads the values";
  }
  EXPECT_EQ(page_scale(m), "");
}

TEST(CurveStyles, ChannelsHaveTheirColours) {
  Figure f = make_figure("f");
  for (const char* name : {"x", "g", "r", "b"}) f.curves.push_back({name, {0, 1}, {0, 1}});
  const CurveStyles styles({&f, 1});
  EXPECT_EQ(look_of(f.curves[1], styles).colour, "green");
  EXPECT_EQ(look_of(f.curves[2], styles).colour, "red");
  EXPECT_GT(styles.of(f.curves[0]), 2U) << "another has none of theirs";
}

TEST(FigureSvg, IsWholeWithoutAnyPoint) {
  Figure f{"none", "Nothing", "", {"x"}, {"y", true}, {{"empty", {}, {}}, {"nan", {1}, {none}}}};
  for (const bool log : {false, true}) {
    f.x.log = log;
    const std::string svg = drawn(f);
    EXPECT_NE(svg.find("</svg>"), svg.npos);
    EXPECT_EQ(svg.find("nan\""), svg.npos);
  }
}

TEST(FigureSvg, ANumberOnALogarithmicAxisIsAboveZero) {
  Figure f{"log", "Log", "", {"x", true}, {"y", true}, {{"c", {0, 1, 10}, {1, -1, 100}}}};
  const std::string svg = drawn(f);
  EXPECT_EQ(svg.find("nan"), svg.npos);
  EXPECT_EQ(svg.find("inf"), svg.npos);
}

TEST(FigureMapSvg, LeavesOutACellWithoutValue) {
  const std::string svg = to_svg(cells());
  const auto begin = svg.find(R"(<g class="cells)");
  const std::string drawn = svg.substr(begin, svg.find("</g>", begin) - begin);
  EXPECT_EQ(occurrences(drawn, "M"), 5U) << "a stroke for each value";
  EXPECT_NE(svg.find(">−5</text>"), svg.npos) << "the scale of colours";
}

TEST(FigureMapSvg, WritesNumbersIntoASmallMatrix) {
  auto m = cells();
  m.x.names = {"one", "two", "three"};
  m.y.names = {"first", "second"};
  const std::string svg = to_svg(m);
  for (const char* text : {">three</text>", ">second</text>", ">−5</text>", ">3</text>"})
    EXPECT_NE(svg.find(text), svg.npos) << text;
}

TEST(FigureMapSvg, DrawsItsLineBetweenCellsOnEitherSideOfIt) {
  auto m = cells();
  const auto lines = [](const std::string& svg) {
    const auto at = svg.find(R"(class="edge" d=")");
    if (at == svg.npos) return std::ptrdiff_t{0};
    return std::ranges::count(svg.substr(at, svg.find("/>", at) - at), 'M');
  };
  EXPECT_EQ(lines(to_svg(m)), 0) << "without a line";
  EXPECT_FALSE(maps_json({{}, {m}})[0].contains("line"));
  m.x = {"x", {1, 2}};
  m.y = {"y", {1, 2, 3}};
  m.values = {0, 0, 0, 0, 2, 2};
  m.line = 1;
  EXPECT_EQ(lines(to_svg(m)), 3) << "right of (1, 2) and of (1, 3), above (2, 1)";
  EXPECT_EQ(maps_json({{}, {m}})[0]["line"], 1);
}

TEST(FigureMapExr, ReadsBackRightWayUp) {
  const test::Folder folder;
  const auto image = read_exr(folder.write("cells.exr", to_exr(cells())));
  ASSERT_EQ(image.width, 3U);
  ASSERT_EQ(image.height, 2U);
  EXPECT_EQ(image.channels, std::vector<std::string>{"F_exact_1"});
  EXPECT_EQ(image.planes[0][3], 0) << "the lowest row is the last";
  EXPECT_EQ(image.planes[0][0], 1);
  EXPECT_EQ(image.planes[0][2], -5);
  EXPECT_TRUE(std::isnan(image.planes[0][5]));
  EXPECT_EQ(image.attributes.at("x.at"), "1; 2; 3");
  EXPECT_EQ(image.attributes.at("y"), "y [°]");
  EXPECT_EQ(image.attributes.at("value"), "F − exact [1]");
}

TEST(FigureMap, HasASliceAfterTheOther) {
  auto m = cells();
  m.slices = {"r = 0.1", "r = 1"};
  for (int k = 0; k < 6; ++k) m.values.push_back(10 + k);
  EXPECT_NE(to_csv(m).find("r = 0.1,3,20,-5\nr = 1,1,10,10\n"), std::string::npos);
  const std::string svg = to_svg(m);
  EXPECT_NE(svg.find(">r = 0.1</text>"), svg.npos);
  EXPECT_EQ(occurrences(svg, R"(class="ax")"), 2U) << "a frame for each";
  const test::Folder folder;
  const auto image = read_exr(folder.write("cells.exr", to_exr(m)), 1 << 20, {"r_1", "r_0_1"});
  EXPECT_EQ(image.planes[0], (std::vector<float>{11, 13, 15, 10, 12, 14}));
  EXPECT_EQ(image.planes[1][2], -5);
}

TEST(FigureCurve, IsCalledByItsLabelWhereItHasOne) {
  auto f = times();
  f.curves[0].label = "Exact Fresnel";
  EXPECT_NE(drawn(f).find(">Exact Fresnel<"), std::string::npos);
  EXPECT_EQ(drawn(f).find(">exact<"), std::string::npos);
  const auto curves = figures_json({{f}, {}})[0]["curves"];
  EXPECT_EQ(curves[0]["name"], "exact") << "by which it is found";
  EXPECT_EQ(curves[0]["label"], "Exact Fresnel");
  EXPECT_FALSE(curves[1].contains("label"));
}

TEST(FigureJson, GivesAnXOnceForTheCurvesThatShareIt) {
  auto f = times();
  f.curves.push_back(f.curves[1]);
  const auto j = figures_json({{f}, {}})[0];
  EXPECT_TRUE(j["curves"][1].contains("x_ns")) << "of a time, which no run repeats";
  EXPECT_FALSE(j["curves"][2].contains("x_ns"));
  EXPECT_TRUE(j["curves"][0]["y"][1].is_null());
}

TEST(FigureJson, TellsThePageTheScalesThatTheSvgIsDrawnOn) {
  const auto f = times();
  const auto j = figures_json({{f}, {}})[0];
  for (const auto& [axis, scale, most] :
       {std::tuple{"x", x_scale(f), x_ticks_most}, {"y", y_scale(f), y_ticks_most}}) {
    const auto& told = j[axis]["scales"][scale.log ? "log" : "linear"];
    EXPECT_NEAR(told["low"].get<double>(), scale.low, 1e-5 * std::abs(scale.low)) << axis;
    EXPECT_NEAR(told["high"].get<double>(), scale.high, 1e-5 * scale.high) << axis;
    EXPECT_EQ(told["ticks"].size(), scale_ticks(scale, most).size()) << axis;
    EXPECT_LE(told["few"].size(), told["ticks"].size()) << axis;
  }
  EXPECT_TRUE(j["x"]["scales"].contains("linear")) << "a reader may choose it";
}

TEST(FigureJson, TellsNoLogarithmsOfWhatHasNone) {
  Figure f;
  f.curves = {{"a", {0, 1}, {-1, 1}}};
  EXPECT_FALSE(figures_json({{f}, {}})[0]["y"]["scales"].contains("log"));
  f.curves[0].y = {0, 1};
  EXPECT_TRUE(figures_json({{f}, {}})[0]["y"]["scales"].contains("log"));
}

TEST(FigureJson, ScalesOfColoursHoldTheValues) {
  auto m = cells();
  EXPECT_EQ(maps_json({{}, {m}})[0]["low"], -5);
  EXPECT_EQ(maps_json({{}, {m}})[0]["high"], 5);
  m.diverging = false;
  m.values = {1e-4, 0.2, 0.03, 0, none, 0.001};
  m.scale = FigureMap::Scale::log;
  EXPECT_EQ(maps_json({{}, {m}})[0]["low"], 1e-4);
  EXPECT_EQ(maps_json({{}, {m}})[0]["high"], 0.2);
  m.limit = 1;
  EXPECT_EQ(maps_json({{}, {m}})[0]["high"], 1);
}

}  // namespace
}  // namespace gonio
