// gonio columns: what a file's columns are is said once, and every command knows it from then on.
#include <cmath>
#include <functional>
#include <random>
#include <sstream>
#include <tuple>

#include "brdf/model/evaluate.h"
#include "cli/program.h"
#include "geometry/half_difference.h"
#include "refusal.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gonio::test {
namespace {

constexpr const char* kText = "nm;in;phi;out;brdf\n500;-30;0;30;0,5\n600;-30;0;30;0,25\n";
constexpr const char* kMap = "--map theta_i=in phi_i=phi theta_o=out phi_o=0 f=brdf channel=nm";

TEST(Columns, AreShownUntilAMapIsGivenAndReadByItAfterwards) {
  const Folder f;
  f.write("t.csv", kText);
  expect_one_line(gonio(f, "inspect t.csv"), 3, "gonio columns FILE --map");
  const auto shown = gonio(f, "columns t.csv --json").json();
  EXPECT_EQ(shown["file_columns"][1]["name"], "in");
  EXPECT_EQ(shown["file_columns"][4]["lowest"], 0.25);
  EXPECT_TRUE(shown["columns"].is_null());
  EXPECT_EQ(f.entries(), 1U) << "showing writes nothing";

  const auto said = gonio(f, std::string("columns t.csv ") + kMap + " --json");
  ASSERT_EQ(said.code, 0) << said.err;
  EXPECT_EQ(said.json()["samples"], 1);
  EXPECT_EQ(said.json()["channels"], (nlohmann::json{"500", "600"}));
  EXPECT_EQ(f.entries(), 2U);
  EXPECT_EQ(gonio(f, "columns t.csv --json").json()["columns"]["theta_i"], "in");
  EXPECT_EQ(gonio(f, "inspect t.csv --json").json()["largest"], 0.5);
  EXPECT_EQ(gonio(f, "fit t.csv --model lambert").code, 0);
}

TEST(Columns, MayBeTwoWhereConstantsStandForTheOthers) {
  const Folder f;
  f.write("run30.txt", "angle brdf\n10 0.4\n20 0.6\n");
  EXPECT_NE(gonio(f, "columns run30.txt").out.find("one angle for all is --map theta_i=30"),
            std::string::npos)
      << "a number in a name says nothing";
  ASSERT_EQ(gonio(f, "columns run30.txt --map theta_i=30 theta_o=angle phi_o=180 f=brdf").code, 0);
  f.write("run40.txt", "angle brdf\n10 0.5\n20 0.7\n");
  ASSERT_EQ(gonio(f, "columns run40.txt --map theta_i=40 theta_o=angle phi_o=180 f=brdf").code, 0);
  const auto set = gonio(f, "inspect run30.txt run40.txt --json").json();
  EXPECT_EQ(set["values"], 4);
  EXPECT_EQ(
      gonio(f, "fit run30.txt run40.txt --as-one --model lambert --json").json()["input"]["path"],
      "run30.txt, run40.txt");
  expect_one_line(gonio(f, "fit run30.txt run40.txt --model lambert"), 2, "-o DIR");
}

TEST(Columns, AreProposedAsACommandThatCanBeRun) {
  const Folder f;
  f.write("my table.csv",
          "wavelength;in;phi;view [deg];brdf\n500;-30;0;30;0,5\n600;-30;0;30;0,25\n");
  const auto proposal = gonio(f, "columns 'my table.csv' --json").json()["proposal"];
  EXPECT_EQ(proposal["needed"], true);
  EXPECT_EQ(proposal["columns"]["theta_o"], "view [deg]");
  const std::string text = gonio(f, "columns 'my table.csv'").out;
  const auto at = text.find("\n  gonio columns ");
  ASSERT_NE(at, text.npos) << text;
  ASSERT_EQ(gonio(f, text.substr(at + 9, text.find('\n', at + 1) - at - 9)).code, 0) << text;
  const auto said = gonio(f, "columns 'my table.csv' --json").json();
  EXPECT_EQ(said["columns"], proposal["columns"]);
  EXPECT_TRUE(said["proposal"].is_null()) << "it has one";
  EXPECT_EQ(gonio(f, "inspect 'my table.csv' --json").json()["channels"],
            (nlohmann::json{"500", "600"}));
  f.write("own.csv", "theta_i,theta_o,f\n10,20,1\n");
  EXPECT_NE(gonio(f, "columns own.csv").out.find("none is needed"), std::string::npos);
}

TEST(Columns, AreProposedBelowTheLinesThatArePassedOver) {
  const Folder f;
  f.write("t.csv", "made by\nsomeone\nIncident_angle,Measure_angle,bsdf\n10,20,1\n10,30,2\n");
  const std::string text = gonio(f, "columns t.csv --skip 2").out;
  const auto at = text.find("\n  gonio columns ");
  ASSERT_NE(at, text.npos) << text;
  const std::string command = text.substr(at + 9, text.find('\n', at + 1) - at - 9);
  EXPECT_TRUE(command.ends_with("--skip 2")) << command;
  ASSERT_EQ(gonio(f, command).code, 0) << command;
  EXPECT_EQ(gonio(f, "inspect t.csv --json").json()["samples"], 2);
}

/// Runs the command that `gonio columns` prints for a file.
void take_proposal(const Folder& f, const std::string& name) {
  const std::string text = gonio(f, "columns '" + name + "'").out;
  const auto at = text.find("\n  gonio columns ");
  ASSERT_NE(at, text.npos) << name << text;
  const std::string command = text.substr(at + 9, text.find('\n', at + 1) - at - 9);
  ASSERT_EQ(gonio(f, command).code, 0) << command;
}

TEST(Columns, OfEachLayoutAreFittedByTheCommandThatIsProposed) {
  const BoundModel paint = bind_model("lambert+ggx/smith_ggx.correlated/schlick",
                                      {{"alpha", {0.3}}, {"f0", {0.05}}, {"kd", {0.3}}}, 1);
  const auto f = [&](const DirectionPair& p) {
    return evaluate(paint, std::vector{angles(p)})[0][0];
  };
  const auto in_plane = [&](double in, double out) {
    return f({direction(in * degree, 0), direction(out * degree, 180 * degree)});
  };
  const auto matrix = [&](const std::string& corner, const char* cell, bool rows_are_light) {
    std::string text = corner;
    const int rows = rows_are_light ? 5 : 15, columns = rows_are_light ? 15 : 5;
    const auto light = [](int k) { return 15 * k; };
    const auto viewer = [](int k) { return 5 * k; };
    for (int c = 0; c < columns; ++c)
      text += ";" + fmt::format(fmt::runtime(cell), rows_are_light ? viewer(c) : light(c));
    for (int r = 0; r < rows; ++r) {
      text += fmt::format("\n{}", rows_are_light ? light(r) : viewer(r));
      for (int c = 0; c < columns; ++c)
        text += fmt::format(";{:.9g}", rows_are_light ? in_plane(light(r), viewer(c))
                                                      : in_plane(light(c), viewer(r)));
    }
    return text + "\n";
  };
  std::string half = "theta_h,theta_d,phi_d,brdf\n", run = "angle brdf\n",
              sure = "aoi,theta_s,phi,BRDF [1/sr],U (k=2) [%]\n";
  for (int h = 0; h < 90; h += 6)
    for (int d = 0; d < 90; d += 6)
      for (int phi = 0; phi < 180; phi += 30)
        half += fmt::format("{},{},{},{:.9g}\n", h, d, phi,
                            f(directions({h * degree, 0, d * degree, phi * degree})));
  for (int out = 0; out < 80; out += 2) run += fmt::format("{} {:.9g}\n", out, in_plane(30, out));
  for (int in = 0; in < 80; in += 20)
    for (int out = 0; out < 80; out += 5)
      sure += fmt::format("{},{},180,{:.9g},3\n", in, out, in_plane(in, out));
  const std::pair<const char*, std::string> files[] = {
      {"matrix.csv", matrix("", "{}", false)},
      {"wide.csv", matrix("", "{}", true)},
      {"zero.txt", matrix("0", "{}", false)},
      {"named.csv", matrix("theta_o", "theta_i={}", false)},
      {"corner.csv", matrix("theta_i \\ theta_o", "{} deg", true)},
      {"half.csv", half},
      {"sample_30deg.txt", run},
      {"gloss thetai30.txt", run},
      {"run2_aoi_30.txt", run},
      {"header.txt", "# Angle of incidence: 30 deg\n" + run},
      {"sure.csv", sure}};
  const Folder folder;
  for (const auto& [name, text] : files) {
    folder.write(name, text);
    take_proposal(folder, name);
    const auto fit = gonio(folder, std::string("fit '") + name + "' --json").json();
    EXPECT_LT(fit["residuals"]["log_rms"], 1e-5) << name;
    EXPECT_NEAR(fit["parameters"]["alpha"]["value"].get<double>(), 0.3, 1e-3) << name;
    EXPECT_EQ(fit["input"]["uncertainty"], text == sure ? "stated" : "none") << name;
  }
  for (const char* name : {"phi_30deg.txt", "30deg_45deg.txt", "sample30.txt", "95deg.txt"}) {
    folder.write(name, run);
    EXPECT_NE(gonio(folder, std::string("columns ") + name).out.find("unclear"), std::string::npos)
        << name << ": no plain incident angle";
  }
}

TEST(Columns, OfSignedAnglesAreTurnedToWhereTheHighlightIs) {
  const BoundModel paint = bind_model("lambert+ggx/smith_ggx.correlated/schlick",
                                      {{"alpha", {0.2}}, {"f0", {0.05}}, {"kd", {0.3}}}, 1);
  const auto angle = [](double deg) {
    return direction(std::abs(deg) * degree, deg < 0 ? M_PI : 0);
  };
  const auto run = [&](double in, double out) {
    return fmt::format(",{:.9g}\n",
                       evaluate(paint, std::vector{angles({angle(in), angle(out)})})[0][0]);
  };
  std::string mirror = "angle,brdf\n", light = mirror, both = "aoi,angle,brdf\n", matt = mirror;
  for (int out = -80; out <= 80; out += 2) {
    mirror += fmt::format("{}", out) + run(30, -out);
    light += fmt::format("{}", out) + run(30, out);
    matt += fmt::format("{},{}\n", out, out > 0 ? 0.13 : 0.1);
    for (const int in : {0, 30, 60}) both += fmt::format("{},{}", in, out) + run(in, -out);
  }
  const Folder f;
  for (const auto& [name, text, turned] : {std::tuple("mirror_30deg.csv", mirror, true),
                                           {"light_30deg.csv", light, false},
                                           {"both.csv", both, true},
                                           {"matt_30deg.csv", matt, false}}) {
    f.write(name, text);
    const auto proposal = gonio(f, std::string("columns ") + name + " --json").json()["proposal"];
    EXPECT_EQ(proposal["said"].dump().find("near theta_o = +theta_i") != std::string::npos, turned);
    take_proposal(f, name);
    const auto said = gonio(f, std::string("columns ") + name + " --json").json()["columns"];
    EXPECT_EQ(said.value("forward", 180.0), turned ? 0 : 180) << name;
    EXPECT_EQ(said, proposal["columns"]) << name;
    if (text == matt) continue;
    const auto fit = gonio(f, std::string("fit ") + name + " --json").json();
    EXPECT_NEAR(fit["parameters"]["alpha"]["value"].get<double>(), 0.2, 1e-3) << name;
  }
}

TEST(Columns, KeepWhatIsSaidOfThemUnderOptionsAfterwards) {
  const Folder f;
  f.write("t.csv", "in,out,brdf\n30,20,1\n30,40,2\n");
  ASSERT_EQ(gonio(f, "columns t.csv --map theta_i=in theta_o=out f=brdf --cosine").code, 0);
  ASSERT_EQ(gonio(f, "columns t.csv --scale 0.5").code, 0);
  EXPECT_NEAR(gonio(f, "inspect t.csv --json").json()["largest"].get<double>(),
              1 / std::cos(40 * M_PI / 180), 1e-9);
  expect_one_line_each(
      f, 3,
      {{"columns t.csv --map theta_i=header theta_o=header", "theta_i and theta_o in the header"},
       {"columns t.csv --map theta_i=30 theta_o=in phi_o=header f=brdf",
        "f beside an angle in the header"},
       {"columns t.csv --map theta_o=in theta_i=header", "no column with a number in its name"},
       {"columns t.csv --map theta_h=in f=brdf", "theta_d"},
       {"columns t.csv --map theta_h=in theta_d=out phi_o=0 f=brdf", "phi_o beside theta_h"}});
}

/// Values of a paint at ten incident angles, half round, as a file has them that is no f.
/// \param rest  of a line, by f, cos θ_i and cos θ_o
std::string paint_as(const std::string& heading,
                     const std::function<std::string(double, double, double)>& rest) {
  const BoundModel paint = bind_model("lambert+ggx/smith_ggx.correlated/schlick",
                                      {{"alpha", {0.2}}, {"f0", {0.05}}, {"kd", {0.3}}}, 1);
  std::string text = "theta_i,phi_i,theta_o,phi_o," + heading + "\n";
  for (int in = 0; in <= 72; in += 8)
    for (int out = 0; out <= 72; out += 8)
      for (int phi = 0; phi <= (out > 0 ? 180 : 0); phi += 15) {
        const auto a =
            angles(DirectionPair{direction(in * degree, 0), direction(out * degree, phi * degree)});
        text += fmt::format("{},0,{},{},{}\n", in, out, phi,
                            rest(evaluate(paint, std::vector{a})[0][0], a.nol, a.nov));
      }
  return text;
}

/// The command that the line with these words gives; "" of none.
std::string command_in(const std::string& text, const std::string& words) {
  const auto said = text.find(words);
  if (said == text.npos) return "";
  const std::string line = text.substr(said, text.find('\n', said) - said);
  const auto at = line.find("gonio ");
  if (at == line.npos) return "";
  std::string command = line.substr(at);
  for (const char* after : {")", ", ", " leaves it out", " says so", " fits that"})
    if (const auto end = command.find(after); end != command.npos) command.resize(end);
  return command;
}
/// Runs it as it is printed.
int run_printed(const Folder& f, const std::string& command) {
  for (std::string rest = command; !rest.empty();) {
    const auto end = rest.find(" && ");
    EXPECT_TRUE(rest.starts_with("gonio ")) << command;
    if (const int code = gonio(f, rest.substr(6, end == rest.npos ? end : end - 6)).code)
      return code;
    rest = end == rest.npos ? "" : rest.substr(end + 4);
  }
  return 0;
}

using Change = std::function<double(double f, double cos_i, double cos_o)>;
std::string changed_paint(const Change& change) {
  return paint_as(
      "f", [&](double f, double i, double o) { return fmt::format("{:.12g}", change(f, i, o)); });
}

TEST(Columns, ThatHoldNoReflectanceAreMendedByTheCommandThatIsPrinted) {
  const std::pair<const char*, Change> cases[] = {
      {"a radiance factor", [](double f, double, double) { return M_PI * f; }},
      {"in percent", [](double f, double, double) { return 100 * M_PI * f; }},
      {"f cos(theta_o)", [](double f, double, double o) { return f * o; }},
      {"f cos(theta_i)", [](double f, double i, double) { return f * i; }},
      {"f cos(theta_i) cos(theta_o)", [](double f, double i, double o) { return f * i * o; }},
      {"f/cos(theta_o)", [](double f, double, double o) { return f / o; }},
      {"f/cos(theta_i)", [](double f, double i, double) { return f / i; }},
      {"f/cos(theta_o)^2", [](double f, double, double o) { return f / (o * o); }},
      {"f/(cos(theta_i) cos(theta_o))", [](double f, double i, double o) { return f / (i * o); }}};
  for (const auto& [said, change] : cases)
    for (const bool named : {false, true}) {
      SCOPED_TRACE(fmt::format("{}{}", said, named ? ", other names" : ""));
      const Folder f;
      std::string text = changed_paint(change);
      if (named) text = "in,pin,out,pout,val" + text.substr(text.find('\n'));
      f.write("a table.csv", text);
      if (named) {
        ASSERT_EQ(gonio(f,
                        "columns 'a table.csv' --map theta_i=in phi_i=pin theta_o=out "
                        "phi_o=pout f=val --scale 1.0000001")
                      .code,
                  0);
      }
      const std::string beware = gonio(f, "inspect 'a table.csv'").out;
      const std::string command = command_in(beware, said);
      ASSERT_TRUE(command.starts_with("gonio columns 'a table.csv' ")) << beware;
      ASSERT_EQ(run_printed(f, command), 0) << command;
      EXPECT_EQ(gonio(f, "inspect 'a table.csv'").out.find("beware"), std::string::npos) << command;
      const auto d = gonio(f, "fit 'a table.csv' --json").json();
      EXPECT_NEAR(d["parameters"]["kd"]["value"].get<double>(), 0.3, 1e-4) << command;
      EXPECT_NEAR(d["parameters"]["alpha"]["value"].get<double>(), 0.2, 1e-4) << command;
    }
}

TEST(Columns, ThatWereSaidWrongAreMendedByTheCommandThatIsPrinted) {
  const std::string right = changed_paint([](double f, double, double) { return f; });
  for (const auto& [options, said] : {std::pair("--cosine", "f/cos(theta_o)"),
                                      {"--cosines=1,0", "f/cos(theta_i)"},
                                      {"--scale 100", "a radiance factor in percent"},
                                      {"--forward 0", "counted otherwise"}}) {
    const Folder f;
    f.write("t.csv", right);
    ASSERT_EQ(gonio(f, std::string("columns t.csv ") + options).code, 0);
    const std::string beware = gonio(f, "inspect t.csv").out, command = command_in(beware, said);
    ASSERT_NE(command, "") << options << beware;
    ASSERT_EQ(run_printed(f, command), 0) << command;
    EXPECT_EQ(gonio(f, "inspect t.csv").out.find("beware"), std::string::npos) << command;
  }
}

TEST(Columns, OfAnglesThatAreNoneAreMendedByTheCommandThatIsPrinted) {
  const std::string text = changed_paint([](double f, double, double) { return f; });
  const auto turned = [&](auto&& angle) {
    std::istringstream lines(text);
    std::string line, all;
    for (bool first = true; std::getline(lines, line); first = false) {
      if (first) {
        all += line + "\n";
        continue;
      }
      std::vector<std::string> fields;
      std::istringstream in(line);
      for (std::string field; std::getline(in, field, ',');) fields.push_back(field);
      for (std::size_t k = 0; k < 4; ++k)
        fields[k] = fmt::format("{:.12g}", angle(k, std::stod(fields[k])));
      all += fmt::format("{}\n", fmt::join(fields, ","));
    }
    return all;
  };
  const std::pair<const char*, std::string> cases[] = {
      {"if they are radians", turned([](std::size_t, double a) { return a * M_PI / 180; })},
      {"counted otherwise", turned([](std::size_t k, double a) { return k == 3 ? 180 - a : a; })},
      {"elevation", turned([](std::size_t k, double a) { return k % 2 == 0 ? 90 - a : a; })}};
  for (const auto& [said, changed] : cases) {
    const Folder f;
    f.write("t.csv", changed);
    const std::string beware = gonio(f, "inspect t.csv").out, command = command_in(beware, said);
    ASSERT_NE(command, "") << said << beware;
    ASSERT_EQ(run_printed(f, command), 0) << command;
    EXPECT_EQ(gonio(f, "inspect t.csv").out.find(said), std::string::npos) << command;
    const auto d = gonio(f, "fit t.csv --json").json();
    EXPECT_NEAR(d["parameters"]["kd"]["value"].get<double>(), 0.3, 1e-3) << command;
  }
}

TEST(Columns, OfOtherFormatsBecomeCsvFirst) {
  const Folder f;
  ASSERT_EQ(gonio(f, "synth lambert --set kd=0.9 --layout mbsdf -o t.mbsdf").code, 0);
  ASSERT_EQ(gonio(f, "convert t.mbsdf t.csv").code, 0);
  ASSERT_EQ(gonio(f, "columns t.csv --scale 3.14159265").code, 0);
  ASSERT_EQ(gonio(f, "convert t.csv u.mbsdf").code, 0);
  const std::string beware = gonio(f, "inspect u.mbsdf").out,
                    command = command_in(beware, "a radiance factor");
  ASSERT_TRUE(command.starts_with("gonio convert u.mbsdf u.mbsdf.csv && ")) << beware;
  ASSERT_EQ(run_printed(f, command), 0) << command;
  EXPECT_EQ(gonio(f, "inspect u.mbsdf.csv").out.find("times the light"), std::string::npos);
}

TEST(Columns, OfCountsAndOfOneStrangeChannelAreFittedByTheCommandThatIsPrinted) {
  const std::string of_three = paint_as("f_r,f_g,f_b", [](double f, double, double) {
    return fmt::format("{:.9g},{:.9g},{:.9g}", f - 0.11, f + 0.1, f + 0.2);
  });
  const std::pair<const char*, std::string> cases[] = {
      {"counts?", changed_paint([](double f, double, double) { return 1e6 * f; })},
      {"relative scale?", changed_paint([](double f, double, double) { return 1e-5 * f; })},
      {"channel r", of_three}};
  for (const auto& [said, text] : cases) {
    const Folder f;
    f.write("t.csv", text);
    const std::string beware = gonio(f, "inspect t.csv").out;
    const std::string command = command_in(beware, said);
    ASSERT_TRUE(command.starts_with("gonio fit t.csv ")) << beware;
    const auto o = gonio(f, command.substr(6));
    EXPECT_EQ(o.code, 0) << command;
    EXPECT_EQ(o.out.find(said), std::string::npos) << command << o.out;
  }
}

TEST(Columns, InJsonKeepTheirNamesAndHaveNoRangeWhereThereIsNoNumber) {
  const Folder f;
  const std::string name = "a name of more than forty characters, \xc2\xb5 and all";
  f.write("t.csv", "x;y;z;" + name + "\n1;2;3;red\n4;5;nan;blue\n");
  const auto columns = gonio(f, "columns t.csv --json").json()["file_columns"];
  EXPECT_EQ(columns[3]["name"], name);
  EXPECT_TRUE(columns[3]["lowest"].is_null());
  EXPECT_TRUE(columns[3]["highest"].is_null());
  EXPECT_EQ(columns[3]["numbers"], 0);
  EXPECT_EQ(columns[2]["numbers"], 1);
  EXPECT_EQ(columns[2]["highest"], 3);
}

TEST(Columns, AreSaidForManyFilesAtOnceOrForNone) {
  const Folder f;
  for (const char* name : {"a.csv", "b.csv"}) f.write(name, kText);
  f.write("c.csv", "x;y;z\n1;2;3\n");
  expect_one_line(gonio(f, std::string("columns a.csv b.csv c.csv ") + kMap), 3,
                  "c.csv: line 1: found no column 'in'");
  EXPECT_EQ(f.entries(), 3U) << "nothing is written where one does not read";
  ASSERT_EQ(gonio(f, std::string("columns a.csv b.csv ") + kMap).code, 0);
  EXPECT_EQ(read_bytes(f / "a.csv.gonio.json"), read_bytes(f / "b.csv.gonio.json"));
}

TEST(Columns, WarnHereAndInEveryResult) {
  const Folder f;
  f.write("t.csv", "theta_i,theta_o,f\n45,-45,0.1\n45,0,0.2\n45,45,5\n");
  const auto said = gonio(f, "columns t.csv --map f=f");
  EXPECT_NE(said.out.find("beware"), std::string::npos);
  EXPECT_NE(gonio(f, "inspect t.csv").out.find("--forward 0"), std::string::npos);
  EXPECT_EQ(gonio(f, "inspect t.csv --json").json()["warnings"].size(), 1U);
  EXPECT_NE(
      gonio(f, "fit t.csv --model lambert --json").json()["warnings"].dump().find("--forward"),
      std::string::npos);
  ASSERT_EQ(gonio(f, "columns t.csv --forward 0").code, 0);
  EXPECT_TRUE(gonio(f, "inspect t.csv --json").json()["warnings"].empty());
}

TEST(Columns, OfInspectAndFitAgreeOnWhatIsBelowTheHorizon) {
  const Folder f;
  f.write("t.csv",
          "theta_i,phi_i,theta_o,phi_o,f\n30,0,30,180,0.3\n30,0,90,180,7\n90,0,30,180,7\n");
  EXPECT_EQ(gonio(f, "inspect t.csv --json").json()["masked"]["below_horizon"], 2);
  EXPECT_EQ(gonio(f, "fit t.csv --model lambert --json").json()["input"]["masked"]["below_horizon"],
            2);
}

TEST(Columns, KeepWhatElseTheSideFileSaysOfThisTable) {
  const Folder f;
  ASSERT_EQ(gonio(f, std::string("synth ") + paint + " --layout in_plane -o t.csv").code, 0);
  ASSERT_EQ(gonio(f, "columns t.csv --scale 2").code, 0);
  EXPECT_FALSE(gonio(f, "inspect t.csv --json").json()["truth"].is_null());
  f.write("t.csv", kText);
  expect_one_line(gonio(f, std::string("columns t.csv ") + kMap), 3, "t.csv.gonio.json: sha256");
}

TEST(Columns, ThatAreTwoAnglesAreRefusedAndTheEarlierSideFileStays) {
  const Folder f;
  f.write("t.csv", kText);
  ASSERT_EQ(gonio(f, std::string("columns t.csv ") + kMap).code, 0);
  const auto before = read_bytes(f / "t.csv.gonio.json");
  expect_one_line(gonio(f, "columns t.csv --map theta_i=in theta_o=in f=brdf"), 3, "two things");
  EXPECT_EQ(read_bytes(f / "t.csv.gonio.json"), before);
}

TEST(Columns, TellWrongWordsFromWrongFiles) {
  const Folder f;
  f.write("t.csv", kText);
  f.write("noise", "dear reader\n");
  expect_one_line_each(f, 2,
                       {{"columns t.csv --map theta=in", "'theta' is none of"},
                        {"columns t.csv --map theta_i", "NAME=COLUMN"},
                        {"columns t.csv --map theta_i=", "NAME=COLUMN"},
                        {"columns t.csv --map f=in f=out", "f twice"},
                        {"columns t.csv --scale 0", "scale"},
                        {"columns t.csv --forward x", "forward"}});
  expect_one_line_each(
      f, 3,
      {{"columns missing", "missing: opening"},
       {"columns noise", "noise: the beginning"},
       {"columns noise --radians", "noise: the beginning"},
       {"columns t.csv --radians --map theta_i=in theta_o=out f=brdf", "radians"}});
  EXPECT_EQ(f.entries(), 2U);
}

/// A table in one plane of a model's values with 1 % noise, that are no f.
std::string in_plane_as(const char* model, const std::vector<Setting>& with, const Change& change) {
  const BoundModel bound = bind_model(model, with, 1);
  std::mt19937_64 random(1);
  std::normal_distribution<double> noise(0, 0.01);
  std::string text = "theta_i,theta_o,f\n";
  for (const int in : {10, 30, 50, 70})
    for (int out = -80; out <= 80; out += 10) {
      const auto a = angles(DirectionPair{direction(in * degree, 0),
                                          direction(std::abs(out) * degree, out < 0 ? 0 : M_PI)});
      const double f = evaluate(bound, std::vector{a})[0][0] * std::exp(noise(random));
      text += fmt::format("{},{},{:.9g}\n", in, -out, change(f, a.nol, a.nov));
    }
  return text;
}
constexpr const char *dull_metal = "ggx/smith_ggx.correlated/schlick",
                     *in_plane_paint = "lambert+ggx/smith_ggx.correlated/schlick";

TEST(Columns, ThatAModelMissesAreMendedByTheCommandThatItsFitProposes) {
  const std::vector<Setting> metal{{"alpha", {0.5}}, {"f0", {0.6}}},
      paint{{"alpha", {0.25}}, {"f0", {0.05}}, {"kd", {0.3}}};
  const Change both = [](double f, double i, double o) { return f * i * o; },
               factor = [](double f, double, double) { return M_PI * f; },
               neither = [](double f, double, double) { return f; };
  for (const auto& [model, with, change, said] :
       {std::tuple(dull_metal, metal, both, "f cos(theta_i) cos(theta_o)"),
        {dull_metal, metal, factor, "radiance factors"},
        {in_plane_paint, paint, factor, "radiance factors"},
        {in_plane_paint, paint, neither, ""},
        {dull_metal, metal, neither, ""}}) {
    SCOPED_TRACE(fmt::format("{} as {}", model, said));
    const Folder f;
    f.write("t.csv", in_plane_as(model, with, change));
    const std::string fit = std::string("fit t.csv --json --model ") + model;
    const auto missed = gonio(f, fit).json();
    const std::string proposed = missed["next"].empty() ? "" : missed["next"][0];
    EXPECT_EQ(missed["misfit"]["told"], *said != 0);
    EXPECT_EQ(proposed.starts_with(fmt::format("values may be {}: read so,", said)), *said != 0)
        << proposed;
    if (!*said) continue;
    ASSERT_EQ(run_printed(f, command_in(proposed, "values may be")), 0) << proposed;
    const auto mended = gonio(f, fit).json();
    EXPECT_EQ(mended["misfit"]["told"], false);
    EXPECT_NEAR(mended["parameters"]["alpha"]["value"].get<double>(), with[0].values[0], 0.02);
    EXPECT_NEAR(mended["parameters"]["f0"]["value"].get<double>(), with[1].values[0], 0.02);
  }
}

TEST(Columns, OfAnyScaleAreFittedAsTheirFitProposes) {
  const Folder f;
  f.write("t.csv", in_plane_as(in_plane_paint, {{"alpha", {0.25}}, {"f0", {0.05}}, {"kd", {0.3}}},
                               [](double value, double, double) { return 0.01 * value; }));
  const std::string fit = std::string("fit t.csv --json --model ") + in_plane_paint;
  const auto missed = gonio(f, fit).json();
  EXPECT_EQ(missed["misfit"]["told"], true);
  ASSERT_TRUE(missed["next"][0].get<std::string>().starts_with("--scale free ")) << missed["next"];
  const auto mended = gonio(f, fit + " --scale free").json();
  EXPECT_EQ(mended["misfit"]["told"], false);
  EXPECT_NEAR(mended["parameters"]["alpha"]["value"].get<double>(), 0.25, 0.02);
  EXPECT_NEAR(mended["parameters"]["f0"]["value"].get<double>(), 0.05, 0.02);
}

TEST(Columns, ArePassedOverUpToTheTableAndSaySo) {
  const Folder f;
  f.write("t.csv", "Instrument 7\nby night\n\nin,out,brdf\n10,20,1\n10,30,2\n10,40,2\n");
  for (const char* skip : {"", " --skip 1"}) {
    EXPECT_HAS(gonio(f, std::string("columns t.csv") + skip).out,
               "t.csv: passes over 3 lines, 'Instrument 7' to 'by night'\n");
    EXPECT_EQ(gonio(f, std::string("columns t.csv --json") + skip).json()["passed_over"], 3);
  }
  f.write("t.csv", "theta_i,theta_o,f\n10,20,1\n");
  EXPECT_EQ(gonio(f, "columns t.csv --json").json()["passed_over"], 0);
  EXPECT_EQ(gonio(f, "columns t.csv").out.find("passes over"), std::string::npos);
}

TEST(Columns, OfWhatIsNoTableAreRefusedByItsName) {
  const Folder f;
  f.write("fit.json", R"({"schema": "gonio.fit/1", "numbers": [1, 2, 3]})");
  f.write("t.xlsx", std::string("PK\x03\x04 xl/ 1 2 3\n"));
  f.write("t.html", "<html>\n1 2 3\n");
  expect_one_line_each(f, 3,
                       {{"columns fit.json", "a document of schema gonio.fit/1"},
                        {"columns t.xlsx", "an Excel workbook"},
                        {"columns t.html", "a web page"}});
}

}  // namespace
}  // namespace gonio::test
