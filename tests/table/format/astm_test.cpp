// ASTM E1392 text: columns by their names, angles in either unit, and what does not add up.
#include "table/format/astm.h"

#include <cmath>

#include "table/complaint.h"

namespace gonio {
namespace {

using namespace test;

constexpr const char* small =
    "STANDARD ASTM E1392-90\r\nDATE 1 May\r\nNUM_POINTS 2\r\nVARS "
    "theta_i,phi_i,theta_s,phi_s,R,G,B\r\n"
    "0.5,3.14159265358979,0.25,0,1,2,3\r\n0.5,0,-0.25,0.125,4,5,-6\r\n";

Table table_of_astm(const std::string& bytes) {
  const Folder folder;
  return read_table(folder.write("m.astm", bytes));
}
std::string text_with(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, text.npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(AstmFile, HasRadiansAndChannelsByTheirNames) {
  const Table t = table_of_astm(small);
  EXPECT_EQ(t.format, "astm");
  EXPECT_EQ(t.channels, (std::vector<std::string>{"r", "g", "b"}));
  ASSERT_EQ(t.size(), 2U);
  const DirectionList& l = *t.list();
  EXPECT_NEAR(l.theta_i_deg[0], 28.6478897565, 1e-9);
  EXPECT_NEAR(l.phi_i_deg[0], 180, 1e-9);
  EXPECT_NEAR(l.theta_o_deg[0], 14.3239448783, 1e-9);
  EXPECT_NEAR(l.theta_o_deg[1], 14.3239448783, 1e-9) << "a negative θ is the other side …";
  EXPECT_NEAR(l.phi_o_deg[1], 180 + 7.1619724392, 1e-9) << "… half a turn away";
  EXPECT_EQ(t.values[0], (Values{1, 4}));
  EXPECT_EQ(t.values[2], (Values{3, -6}));
  EXPECT_EQ(t.notes.back().second, "radians");
}

TEST(AstmFile, MayHaveItsColumnsInAnyOrderAndAnglesInDegrees) {
  const Table t =
      table_of_astm("VARS Brdf,phi_s,theta_s,phi_i,theta_i\n0.25,180,30,0,5\n0.5,90,2,0,5\n");
  EXPECT_EQ(t.channels, std::vector<std::string>{"f"});
  EXPECT_EQ(t.values[0], (Values{0.25, 0.5}));
  const DirectionList& l = *t.list();
  EXPECT_EQ(l.theta_i_deg, (std::vector<double>{5, 5}));
  EXPECT_EQ(l.theta_o_deg, (std::vector<double>{30, 2}));
  EXPECT_EQ(l.phi_o_deg, (std::vector<double>{180, 90}));
  EXPECT_EQ(t.notes.back().second, "degrees");
  EXPECT_EQ(table_of_astm(text_with(small, "R,G,B", "450nm,550nm,650nm")).channels[1], "550nm");
}

TEST(AstmFile, ThatDoesNotAddUpIsRefusedByItsLine) {
  const Folder folder;
  const auto with = [&](const std::string& from, const std::string& to) {
    return folder.write("m", text_with(small, from, to));
  };
  EXPECT_COMPLAINT(with("POINTS 2", "POINTS 3"),
                   "line 3: found NUM_POINTS 3, expected 2, as there are rows");
  EXPECT_COMPLAINT(with("POINTS 2", "POINTS two"), "line 3: found NUM_POINTS two");
  EXPECT_EQ(complaint(with("NUM_POINTS 2\r\n", "")), "");
  EXPECT_COMPLAINT(with("phi_s", "phi_r"), "no phi_s in VARS");
  EXPECT_COMPLAINT(with(",R,G,B", ",R,G,R"), "'R' twice in VARS");
  EXPECT_COMPLAINT(with("5,0,-0", "x,0,-0"), "line 6");
  EXPECT_COMPLAINT(with(",-6", ""), "line 6");
  EXPECT_COMPLAINT(with("0.5,0,-0.25", "2,0,-0.25"),
                   "row 2: found theta_i 2, expected at most π/2");
  EXPECT_COMPLAINT(with("0.5,0,-0.25", "0.5,361,-0.25"), "361, expected an angle");
  EXPECT_COMPLAINT(with("0.5,0,-0.25", "nan,0,-0.25"), "nan, expected an angle");
  const std::string text = small;
  EXPECT_COMPLAINT(folder.write("m", text.substr(0, text.find("0.5,3"))), "no rows");
  EXPECT_COMPLAINT(folder.write("m", "VARS theta_i,phi_i,theta_s,phi_s\n1,2,1,2\n"),
                   "no values in VARS");
}

}  // namespace
}  // namespace gonio
