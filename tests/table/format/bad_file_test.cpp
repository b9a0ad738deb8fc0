// Files that are not what they claim: one error that says so, and never anything else.
#include "image/exr.h"
#include "table/complaint.h"
#include "table/example.h"
#include "table/format/metadata.h"

namespace gonio {
namespace {

using namespace test;

TEST(ReadTable, NamesWhatIsNoFile) {
  const Folder folder;
  EXPECT_COMPLAINT(folder / "missing", "No such file");
  EXPECT_COMPLAINT(folder / "", "a directory");
  EXPECT_COMPLAINT(folder.write("empty", ""), "an empty file");
  EXPECT_COMPLAINT(folder.write("text", "dear reader"), "unknown format: dear reader");
  EXPECT_COMPLAINT(folder.write("zeros", std::string(100, '\0')), "unknown format");
  EXPECT_COMPLAINT("/dev/null", "a device");
}

std::string merl_header(std::int32_t a, std::int32_t b, std::int32_t c) {
  const std::array<std::int32_t, 3> dims{a, b, c};
  return {reinterpret_cast<const char*>(dims.data()), sizeof dims};
}

TEST(MerlFile, ChecksEachDimensionAndTheSize) {
  const Folder folder;
  EXPECT_COMPLAINT(folder.write("short", merl_header(90, 90, 180)),
                   "size: found 12 bytes, expected 34992012");
  EXPECT_COMPLAINT(folder.write("short", merl_header(90, 90, 360) + "x"), "expected 69984012");
  EXPECT_COMPLAINT(folder.write("other", merl_header(2, 1, 3) + std::string(3 * 6 * 8, '\0')),
                   "dimensions (2, 1, 3), expected (90, 90, 180)");
  EXPECT_COMPLAINT(
      folder.write("product", merl_header(180, 90, 90) + std::string(34'992'000, '\0')),
      "dimensions (180, 90, 90)");
  for (const auto& d : {merl_header(-1, -1, 180), merl_header(INT32_MIN, 90, 180),
                        merl_header(0, 0, 0), merl_header(INT32_MAX, INT32_MAX, INT32_MAX)})
    EXPECT_COMPLAINT(folder.write("dims", d + std::string(80, '\0')), "unknown format");
}

std::string mbsdf_header(std::uint32_t type, std::uint32_t n_theta, std::uint32_t n_phi) {
  const std::array<std::uint32_t, 3> h{type, n_theta, n_phi};
  return "NVIDIA ARC MBSDF V1\nMBSDF_DATA_REFLECTION=\n" +
         std::string(reinterpret_cast<const char*>(h.data()), sizeof h);
}

TEST(MbsdfFile, ChecksItsHeaderBeforeItAllocates) {
  const Folder folder;
  const std::string four(16, '\0');
  EXPECT_EQ(complaint(folder.write("good", mbsdf_header(0, 1, 4) + four)), "");
  EXPECT_COMPLAINT(folder.write("type", mbsdf_header(2, 1, 4) + four), "type 2");
  constexpr std::uint32_t huge = 0x80000000, all = 0xffffffff;
  for (const auto& h :
       {mbsdf_header(1, huge, huge), mbsdf_header(1, all, all), mbsdf_header(0, 0, 4),
        mbsdf_header(0, 2, 1), mbsdf_header(0, 1, 0), mbsdf_header(0, 1, huge),
        mbsdf_header(0, huge, 2), mbsdf_header(0, 4, 1), mbsdf_header(1, 1, 4)})
    EXPECT_COMPLAINT(folder.write("dims", h + four), "values in 16 bytes");
  EXPECT_COMPLAINT(folder.write("odd", mbsdf_header(0, 1, 4) + four + "x"), "values in 17 bytes");
  EXPECT_COMPLAINT(folder.write("trans", "NVIDIA ARC MBSDF V1\nMBSDF_DATA_TRANSMISSION=\n" + four),
                   "byte 20: found MBSDF_DATA_TRANSMISSIO");
  EXPECT_COMPLAINT(folder.write("v2", "NVIDIA ARC MBSDF V2\n" + four), "V2");
}

TEST(CsvFile, NamesLineAndColumn) {
  const Folder folder;
  const auto csv = [&](const std::string& text) { return folder.write("t.csv", text); };
  const std::string head = "theta_i,phi_i,theta_o,phi_o,f,weight\n";
  EXPECT_COMPLAINT(csv("theta_i,phi_i,theta_o,f\n0,0,0,0\n"),
                   "line 1, column phi_o: found no such column");
  EXPECT_COMPLAINT(csv("theta_i,phi_i,theta_o,phi_o\n0,0,0,0\n"), "column f: found no such column");
  EXPECT_COMPLAINT(csv("theta_i,phi_i,theta_o,phi_o,f,f\n"), "column f: found a second");
  EXPECT_COMPLAINT(csv("theta_i,phi_i,theta_o,phi_o,f,speed\n"),
                   "column speed: found an unknown column");
  EXPECT_COMPLAINT(csv(head), "found no samples");
  EXPECT_COMPLAINT(csv(head + "1,2,3,4,5,1\n\n1,2,3,4,5\n"), "line 4: found 5 fields, expected 6");
  EXPECT_COMPLAINT(csv(head + "1,2,3,4,5,1,1\n"), "line 2: found 7 fields, expected 6");
  EXPECT_COMPLAINT(csv(head + "1,2,3,4,5,\n"), "line 2, column weight: found ''");
  EXPECT_COMPLAINT(csv(head + "1,2,3,4,1.5x,1\n"), "line 2, column f: found '1.5x'");
  EXPECT_COMPLAINT(csv(head + "1,2,3,4,1e999,1\n"), "column f");
  EXPECT_COMPLAINT(csv(head + "1,2,nan,4,5,1\n"),
                   "line 2, column theta_o: found nan, expected a number in [-180, 180]");
  EXPECT_COMPLAINT(csv(head + "-181,2,3,4,5,1\n"), "column theta_i: found -181");
  EXPECT_COMPLAINT(csv(head + "181,2,3,4,5,1\n"), "column theta_i");
  EXPECT_COMPLAINT(csv(head + "1,361,3,4,5,1\n"),
                   "column phi_i: found 361, expected a number in [-360, 360]");
  EXPECT_COMPLAINT(csv(head + "1,2,3,inf,5,1\n"), "column phi_o");
  EXPECT_COMPLAINT(csv(head + "1,2,3,4,5,-1\n"), "column weight: found -1");
  EXPECT_COMPLAINT(csv(head + "1,2,3,4,5,inf\n"), "column weight: found inf");
  EXPECT_EQ(complaint(csv(head + "1,2,3,4,inf,1\n")), "")
      << "a value may be anything: it is masked";
}

TEST(ImageSlice, ReadsItsChannelsOnceAndNoOthers) {
  const Folder folder;
  write_table(slice_example(), folder / "s.exr");
  Image image = read_exr(folder / "s.exr");
  const auto with_channels = [&](const char* names) {
    image.attributes["gonio:channels"] = names;
    write_exr(folder / "t.exr", image);
    return folder / "t.exr";
  };
  EXPECT_COMPLAINT(with_channels("g,r,g"), "gonio:channels: found G twice");
  EXPECT_COMPLAINT(with_channels("r,R"), "gonio:channels: found R twice");
  EXPECT_COMPLAINT(with_channels("r,y"), "channels: found G, R, x, expected y among them");
  EXPECT_COMPLAINT(with_channels(""), "among them");
  EXPECT_EQ(read_table(with_channels("r")).channels, std::vector<std::string>{"r"});
}

TEST(ImageSlice, OfMoreChannelsThanATableHoldsIsRefused) {
  const Folder folder;
  write_table(slice_example(), folder / "s.exr");
  Image image = read_exr(folder / "s.exr");
  std::string names = "0";
  for (std::size_t i = 1; i <= most_channels; ++i) names += "," + std::to_string(i);
  image.attributes["gonio:channels"] = names;
  write_exr(folder / "t.exr", image);
  EXPECT_COMPLAINT(folder / "t.exr", "gonio:channels: found 4097 channels, expected at most 4096");
}

TEST(ImageSlice, OfMoreValuesThanATableHoldsIsRefused) {
  const Folder folder;
  write_table(slice_example(), folder / "s.exr");
  Image image = read_exr(folder / "s.exr");
  image.width = image.height = 2400;
  image.planes.assign(3, std::vector<float>(image.width * image.height));
  write_exr(folder / "s.exr", image);
  EXPECT_COMPLAINT(folder / "s.exr", "2400 × 2400 pixels × 3 channels");
}

TEST(SideFile, IsNamedWhereItIsBroken) {
  const Folder folder;
  write_table(mbsdf_example(2, 3), folder / "m");
  for (const char* text :
       {"", "{", "[]", "{}", R"({"schema":"gonio.table/2"})",
        R"({"schema":"gonio.table/1","bins":"middle"})", R"({"schema":"gonio.table/1","bins":1})",
        R"({"schema":"gonio.table/1","truth":1})", R"({"schema":"gonio.table/1","bin":"edge"})",
        R"({"schema":"gonio.table/1","notes":{"a":1}})"}) {
    folder.write("m.gonio.json", text);
    EXPECT_COMPLAINT(folder / "m", "m.gonio.json") << text;
  }
  folder.write("m.gonio.json", R"({"bins":"edge"})");
  EXPECT_COMPLAINT(folder / "m",
                   R"(schema: found no such key, expected "schema": "gonio.table/1")");
  folder.write("m.gonio.json", R"({"schema":"gonio.table/1","bin":"edge"})");
  EXPECT_COMPLAINT(folder / "m", "bin: found \"edge\", expected no such key; schema, sha256, bins");
  write_table(csv_example(), folder / "c");
  folder.write("c.gonio.json", R"({"schema":"gonio.table/1","bins":"edge"})");
  EXPECT_COMPLAINT(folder / "c", "this table has no bins");
}

TEST(SideFile, TellsOfATruthThatCannotBe) {
  const Folder folder;
  write_table(mbsdf_example(2, 3), folder / "m");
  const auto with = [&](const std::string& name, const std::string& value) {
    std::string side =
        R"({"schema":"gonio.table/1","truth":{"model":"lambert","parameters":{"kd":1},)"
        R"("noise":0.1,"floor":0.2,"outliers":0.3,"seed":4}})";
    const auto at = side.find("\"" + name + "\":") + name.size() + 3;
    folder.write("m.gonio.json", side.replace(at, side.find_first_of(",}", at) - at, value));
    return folder / "m";
  };
  EXPECT_EQ(complaint(with("noise", "0")), "");
  EXPECT_COMPLAINT(with("noise", "-1"), "truth.noise: found -1, expected a number from 0 on");
  EXPECT_COMPLAINT(with("noise", "null"), "truth.noise: found null");
  EXPECT_COMPLAINT(with("floor", "-1"), "truth.floor: found -1, expected a number from 0 on");
  EXPECT_COMPLAINT(with("outliers", "2"), "truth.outliers: found 2, expected a number in [0, 1]");
  EXPECT_COMPLAINT(with("kd", "null"), "truth.parameters.kd: found null, expected finite numbers");
}

TEST(SideFile, MayBeALinkButNotToNothing) {
  const Folder folder;
  folder.write("t.csv", "theta_i,theta_o,x\n10,20,1\n");
  std::filesystem::create_symlink("elsewhere", folder / "t.csv.gonio.json");
  EXPECT_COMPLAINT(folder / "t.csv",
                   "t.csv.gonio.json: opening: found a link to elsewhere, expected a link to a "
                   "file that is there");
  folder.write("elsewhere", R"({"schema":"gonio.table/1","columns":{"f":"x"}})");
  EXPECT_EQ(complaint(folder / "t.csv"), "");
  std::filesystem::remove(folder / "elsewhere");
  std::filesystem::create_symlink("t.csv.gonio.json", folder / "elsewhere");
  EXPECT_COMPLAINT(folder / "t.csv", "t.csv.gonio.json: opening: found") << "a circle";
}

/// Were each key looked for among all others, one by one, it would take minutes.
TEST(SideFile, OfManyKeysTakesLinearTime) {
  const Folder folder;
  write_table(mbsdf_example(2, 3), folder / "m");
  const auto keys = [&](const std::string& value) {
    std::string text;
    for (int i = 0; i < 500'000; ++i)
      text += (i ? ",\"" : "\"") + std::to_string(i) + "\":" + value;
    return text;
  };
  const std::string head = R"({"schema":"gonio.table/1",)";
  folder.write("m.gonio.json", head + "\"notes\":{" + keys("\"x\"") + "}}");
  const Table t = read_table(folder / "m");
  EXPECT_EQ(t.notes.size(), 500'000U);
  EXPECT_GT(metadata_text(t).size(), 5'000'000U);
  folder.write("m.gonio.json", head + keys("1") + "}");
  EXPECT_COMPLAINT(folder / "m", "0: found 1, expected no such key");
}

TEST(SideFile, OfTooManyBytesIsRefusedBeforeItIsRead) {
  const Folder folder;
  write_table(mbsdf_example(2, 3), folder / "m");
  folder.write("m.gonio.json", R"({"schema":"gonio.table/1"})");
  std::filesystem::resize_file(folder / "m.gonio.json", (1U << 24) + 1);  // a hole
  EXPECT_COMPLAINT(folder / "m",
                   "m.gonio.json: byte 0: found 16777217 bytes, expected at most 16777216");
}

TEST(SideFile, KeepsTheLastOfTwoNotesOfOneName) {
  Table t;
  t.notes = {{"a", "1"}, {"b", "2"}, {"a", "3"}};
  EXPECT_NE(metadata_text(t).find("\"notes\": {\n    \"a\": \"3\",\n    \"b\": \"2\"\n  }"),
            std::string::npos);
}

TEST(SideFile, MayNotNestWithoutEnd) {
  const Folder folder;
  write_table(mbsdf_example(2, 3), folder / "m");
  const auto side = [&](const std::string& text) {
    folder.write("m.gonio.json", text);
    return folder / "m";
  };
  const auto nested = [](std::size_t n) { return std::string(n, '[') + std::string(n, ']'); };
  EXPECT_COMPLAINT(side(std::string(200'000, '[')), "line 1, column 65: found 65 levels");
  EXPECT_COMPLAINT(side("{\n\"schema\":" + nested(200'000) + "}"), "line 2, column 73");
  EXPECT_COMPLAINT(side("{\"schema\":" + nested(63) + "}"),
                   "schema: found an array, expected a string");
  const std::string brackets = "\\\"" + std::string(100, '[');
  EXPECT_EQ(complaint(side(R"({"schema":"gonio.table/1","notes":{"a":")" + brackets + "\"}}")), "")
      << "brackets in a string do not nest";
}

TEST(SideFile, ShowsNoControlCharactersOfItsKeys) {
  const Folder folder;
  write_table(mbsdf_example(2, 3), folder / "m");
  folder.write("m.gonio.json", R"({"schema":"gonio.table/1","notes":{"\n\u001b[31m":1}})");
  EXPECT_COMPLAINT(folder / "m", "notes.\\x0a\\x1b[31m: found 1, expected a string");
}

TEST(ReadTable, NamesADocumentOfGonioAndWhatFitsAStack) {
  const Folder folder;
  EXPECT_COMPLAINT(folder.write("stack.json", R"({"schema": "gonio.stack/1", "images": []})"),
                   "`gonio fit_map` fits a stack");
  EXPECT_COMPLAINT(folder.write("fit.json", R"({
  "model": "lambert", "schema": "gonio.fit/1"})"),
                   "gonio.fit/1");
}

}  // namespace
}  // namespace gonio
