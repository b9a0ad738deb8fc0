// Files cut off, with header fields that lie, with bytes that changed: each is refused in one line,
// or reads as another table.
#include <cstring>
#include <random>

#include "refusal.h"
#include "table/complaint.h"
#include "table/example.h"
#include "table/foreign.h"
#include "table/format/metadata.h"

namespace gonio {
namespace {

using namespace test;

double plain(const DirectionPair& p, std::size_t channel) {
  return 0.1 * static_cast<double>(channel + 1) + 0.05 * p.wi.x * p.wo.x;
}

std::string first_lines(const std::string& text, int n) {
  std::size_t end = 0;
  for (int k = 0; k < n; ++k) end = text.find('\n', end) + 1;
  return text.substr(0, end);
}

struct Sample {
  std::string format, bytes;
  std::size_t header;     ///< bytes before the values
  bool needs_all = true;  ///< whether the file is refused without its last byte
};

/// A small file of each format.
std::vector<Sample> damaged_samples() {
  const Folder folder;
  const auto written = [&](const Table& t) {
    write_table(t, folder / "t");
    return read_bytes(folder / "t");
  };
  RglFile rgl{.size = 3, .f = plain}, spectral = rgl;
  spectral.wavelengths = {400, 700};
  spectral.theta_i = {0, 1};
  spectral.phi_i = {-3.14159F, -1.5F, 0, 1.5F, 3.14159F};
  const std::string klems = KlemsFile{.rings = {{0, 30, 1}, {30, 90, 3}}, .f = plain}.bytes();
  const std::string alta =
      "#FORMAT binary\n#SAMPLE_COUNT 2\n#ENDIAN little\n#DIM 2 1\n#VS 0\n"
      "#PARAM_IN ISOTROPIC_TV_TL\n#PARAM_OUT INV_STERADIAN\n#BEGIN_STREAM\n";
  const std::array<double, 6> stream{0.1, 0.2, 0.3, 0.4, 0.5, 0.6};
  return {
      {"mbsdf", written(mbsdf_example(2, 3)), 55},
      {"exr", written(slice_example()), 400},
      {"rgl", rgl.bytes(), 330},
      {"rgl spectral", spectral.bytes(), 350},
      {"klems", klems.substr(0, klems.size() - 1), klems.size()},
      {"alta", alta + bytes_of(stream), alta.size()},
      {"alta text",
       alta_file("RUSIN_TH_TD_PD", "INV_STERADIAN_COSINE_FACTOR", 3, 1,
                 {{0.1, 0.2, 0.3, 0.4}, {0.5, 0.6, 0.7, 0.8}}),
       150, false},
      {"ngan", ngan_file({2, 1, 3, 2}, false, [](std::size_t k) { return k; }), 64},
      {"astm", "NUM_POINTS 2\nVARS theta_i,phi_i,theta_s,phi_s,f\n0.5,0,0.2,3,1\n0.1,0,0,0,5\n", 80,
       false},
      {"ssdd", ssdd_file("half_difference", "ascii", "1\n2\n"), 160, false},
      {"ssdd binary", ssdd_file("specular", "binary", bytes_of(std::array<float, 2>{1, 2})), 150},
      {"zemax",
       ZemaxFile{.incident = {30}, .azimuth = {0, 90}, .radius = {0, 20}, .f = plain}.bytes(), 200,
       false},
      {"tensor tree", tensor_tree_file(3, "{{1}{2}{3}{4}{5}{6}{7}{1 2 3 4 5 6 7 8}}"), 500, false},
      {"brdf json",
       R"({"head": {}, "data": {"wavelengths": [500], "theta_i": [0, 9], "phi_i": [0, 9], "theta_v": [1, 2], "phi_v": [0, 9], "pol": "sp", "data": [[500, 1, 2]]}})",
       150},
      {"xompt", R"({"brdf": {"lookupTable": [[5e-7, 0.1, 0.2, 3, 0.04]]}})", 40},
      {"csv", first_lines(written(csv_example()), 4), 60, false},
      {"merl", std::string("\x5a\0\0\0\x5a\0\0\0\xb4\0\0\0", 12) + "values", 12}};
}

bool damaged_by_words(std::string_view format) {
  constexpr std::array<std::string_view, 9> texts{
      "klems", "csv", "alta text", "astm", "ssdd", "zemax", "tensor tree", "brdf json", "xompt"};
  return std::ranges::find(texts, format) != texts.end();
}

TEST(DamagedFile, CutAnywhereIsRefused) {
  for (const auto& [format, bytes, header, needs_all] : damaged_samples()) {
    EXPECT_EQ(complaint_about(bytes).empty(), format != "merl") << format;
    for (std::size_t n = 0; n < bytes.size(); ++n) {
      const std::string said = complaint_about(bytes.substr(0, n));
      ASSERT_TRUE(!needs_all || !said.empty()) << format << " at " << n;
    }
  }
}

TEST(DamagedFile, WithAnyNumberInItsHeaderIsReadOrRefused) {
  std::mt19937_64 random(5);
  for (const auto& [format, bytes, header, needs_all] : damaged_samples()) {
    if (damaged_by_words(format) && format != "alta text" && format != "ssdd")
      continue;  // text: see below
    for (std::size_t at = 0; at < std::min(header, bytes.size()); ++at)
      for (const std::uint64_t number :
           {std::uint64_t{0}, ~std::uint64_t{0}, std::uint64_t{1} << 31,
            static_cast<std::uint64_t>(random())})
        for (const std::size_t width : {1U, 4U, 8U}) {
          std::string changed = bytes;
          std::memcpy(changed.data() + at, &number, std::min(width, changed.size() - at));
          complaint_about(changed);  // any other exception fails the test
        }
  }
}

TEST(DamagedFile, WithAnyWordForANumberIsReadOrRefused) {
  for (const auto& [format, bytes, header, needs_all] : damaged_samples()) {
    if (!damaged_by_words(format)) continue;
    for (std::size_t at = 0; at < bytes.size(); ++at) {
      if (!std::isdigit(static_cast<unsigned char>(bytes[at]))) continue;
      for (const char* word : {"0", "-1", "2147483648", "1e308", "nan", "inf", "x", "", ",", "<"})
        complaint_about(bytes.substr(0, at) + word + bytes.substr(at + 1));
    }
  }
}

TEST(DamagedFile, WithChangedBytesIsReadOrRefused) {
  std::mt19937_64 random(11);
  for (const auto& [format, bytes, header, needs_all] : damaged_samples())
    for (int round = 0; round < 300; ++round) {
      std::string changed = bytes;
      for (auto flips = 1 + random() % 4; flips > 0; --flips)
        changed[random() % (round % 2 ? changed.size() : std::min(changed.size(), header))] =
            static_cast<char>(random());
      complaint_about(changed);
    }
}

TEST(DamagedFile, OfUtiasSizeIsReadWhateverItsBytesAre) {
  std::mt19937_64 random(3);
  std::string bytes(1'990'656, '\0');
  for (std::size_t at = 0; at + 8 <= bytes.size(); at += 8) {
    const std::uint64_t number = random();
    std::memcpy(bytes.data() + at, &number, sizeof number);
  }
  bytes[0] = '\xff';  // no text
  EXPECT_EQ(complaint_about(bytes), "");
  EXPECT_NE(complaint_about(bytes + bytes[1]), "");
  EXPECT_NE(complaint_about(bytes.substr(1)), "");
}

TEST(DamagedFile, BesideATableIsAppliedOrRefused) {
  Table t = mbsdf_example(2, 3);
  t.truth = truth_example();
  t.notes = {{"origin", "a test"}};
  const std::string text = metadata_text(t);
  const auto refused = [](const std::string& side) {
    Table other = mbsdf_example(1, 2);
    const auto line = refusal([&] {
      column_map("side", side);
      apply_metadata(other, "side", side);
    });
    return !line.empty();
  };
  EXPECT_FALSE(refused(text));
  for (std::size_t n = 0; n < text.size(); ++n) {
    EXPECT_TRUE(refused(text.substr(0, n)) || text.find_first_not_of(" \n", n) == text.npos) << n;
    for (const char* word : {"0", "-1", "2147483648", "1e999", "null", "[]", "\"", "}"})
      refused(text.substr(0, n) + word + text.substr(n + 1));
  }
}

std::string changed(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, text.npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(RglFile, NamesTheFieldThatIsWrong) {
  const Folder folder;
  const RglFile file{.size = 3, .f = plain};
  const auto with = [&](const std::string& name, const std::function<void(TensorField&)>& change) {
    auto fields = file.fields();
    for (auto& f : fields)
      if (f.name == name) change(f);
    return folder.write("t.bsdf", tensor_file(fields));
  };
  for (const char* name : {"phi_i", "theta_i", "ndf", "sigma", "vndf", "rgb", "jacobian"}) {
    const std::string place = std::string("field ") + name + ": found ";
    EXPECT_COMPLAINT(with(name, [](auto& f) { f.name = "other"; }), place + "no such field");
    EXPECT_COMPLAINT(with(name, [](auto& f) { f.type = 11; }), place + "type 11");
    EXPECT_COMPLAINT(with(name, [](auto& f) { f.shape.push_back(1); }), "dimensions");
    EXPECT_COMPLAINT(with(name, [](auto& f) { f.shape[0] = 0; }), place + "shape 0");
    EXPECT_COMPLAINT(with(name, [](auto& f) { f.shape[0] = std::uint64_t{1} << 62; }),
                     "a field inside the file");
    EXPECT_COMPLAINT(
        with(name, [](auto& f) { f.shape.assign(f.shape.size(), std::uint64_t{1} << 32); }),
        "a field inside the file")
        << "a product of 2^64 is 0";
  }
  const auto set = [&](const std::string& name, std::size_t i, float v) {
    return with(name, [=](auto& f) { std::memcpy(f.data.data() + i * sizeof v, &v, sizeof v); });
  };
  EXPECT_COMPLAINT(set("theta_i", 1, 2), "field theta_i: found 2");
  EXPECT_COMPLAINT(set("theta_i", 1, 0), "ascending");
  EXPECT_COMPLAINT(set("theta_i", 1, NAN), "field theta_i: found nan");
  EXPECT_COMPLAINT(set("phi_i", 0, 7), "field phi_i: found 7");
  EXPECT_COMPLAINT(set("ndf", 0, -1), "field ndf: found -1, expected finite numbers from 0 on");
  EXPECT_COMPLAINT(set("vndf", 0, INFINITY), "field vndf: found inf");
  EXPECT_EQ(complaint(set("rgb", 0, NAN)), "") << "a value may be anything: it is masked";
  EXPECT_EQ(complaint(set("sigma", 0, 0)), "") << "which makes values infinite: masked too";
  EXPECT_COMPLAINT(with("vndf", [](auto& f) { f.shape[1] = 3; }), "field vndf: found shape 1 × 3");
  EXPECT_COMPLAINT(with("rgb", [](auto& f) { f.shape[2] = 2; }), "expected 1 × 4 × 3 × 3 × 3");
  EXPECT_COMPLAINT(with("ndf", [](auto& f) { f.shape = {4, 1}; }), "found 4 × 1 nodes");
  RglFile third = file;
  third.phi_i = {0, 1, 2};
  EXPECT_COMPLAINT(folder.write("t", third.bytes()), "field phi_i: found 0.3183 of a turn");
  third.phi_i.back() += 0.9F;  // nearer to a half than to a third
  EXPECT_COMPLAINT(folder.write("t", third.bytes()), "field phi_i: found 0.4615 of a turn");
  RglFile bands = file;
  for (std::size_t i = 0; i <= most_channels; ++i)
    bands.wavelengths.push_back(static_cast<float>(i));
  EXPECT_COMPLAINT(folder.write("t", bands.bytes()),
                   "field wavelengths: found 4097 channels, expected at most 4096");
  RglFile twice = file;
  twice.wavelengths = {500, 500};
  EXPECT_COMPLAINT(folder.write("t", twice.bytes()), "field wavelengths: found 500 twice");
  const std::string bytes = file.bytes();
  EXPECT_COMPLAINT(
      folder.write("t", changed(bytes, std::string("file\0\1", 6), std::string("file\0\2", 6))),
      "byte 12: found version 2.0");
  EXPECT_COMPLAINT(folder.write("t", bytes.substr(0, 14) + "\xff\xff\xff\xff" + bytes.substr(18)),
                   "4294967295 fields");
}

TEST(RglFile, OfMoreNumbersThanATableHoldsIsRefused) {
  const Folder folder;
  auto fields = RglFile{.size = 3, .f = plain}.fields();
  const auto values = std::ranges::find(fields, "rgb", &TensorField::name);
  std::rotate(values, values + 1, fields.end());
  auto& last = fields.back();
  ASSERT_EQ(last.name, "rgb");
  last.shape[3] = last.shape[4] = 1600;  // with four angles each more than 2^26, without them less
  last.data.clear();
  const std::string head = tensor_file(fields);
  std::uintmax_t bytes = sizeof(float);
  for (const auto n : last.shape) bytes *= n;
  folder.write("t", head);
  std::filesystem::resize_file(folder / "t", head.size() + bytes);  // a hole
  EXPECT_COMPLAINT(folder / "t",
                   "field rgb: found 10240000 samples × 3 channels, expected at most 67108864");
}

TEST(MbsdfFile, OfMoreValuesThanATableHoldsIsRefused) {
  const Folder folder;
  const std::array<std::uint32_t, 3> header{0, 1, most_values + 1};
  std::string bytes = "NVIDIA ARC MBSDF V1\nMBSDF_DATA_REFLECTION=\n";
  bytes.append(reinterpret_cast<const char*>(header.data()), sizeof header);
  folder.write("t", bytes);
  std::filesystem::resize_file(folder / "t", bytes.size() + 4 * (most_values + 1));  // a hole
  EXPECT_COMPLAINT(folder / "t", "found 67108865 values, expected at most 67108864");
}

TEST(KlemsFile, NamesTheNodeThatIsMissingOrWrong) {
  const Folder folder;
  const std::string good = KlemsFile{.rings = {{0, 30, 1}, {30, 90, 3}}, .f = plain}.bytes();
  const auto with = [&](const std::string& from, const std::string& to) {
    return folder.write("t.xml", changed(good, from, to));
  };
  for (const char* name :
       {"Optical", "Layer", "DataDefinition", "IncidentDataStructure", "ThetaBounds", "LowerTheta",
        "UpperTheta", "nPhis", "ColumnAngleBasis", "RowAngleBasis", "ScatteringData"}) {
    std::string text = changed(good, fmt::format("<{}>", name), "<other>");
    EXPECT_COMPLAINT(folder.write("t", changed(text, fmt::format("</{}>", name), "</other>")),
                     fmt::format("no {}, expected one", name));
  }
  EXPECT_COMPLAINT(with("<AngleBasisName>LBNL/Klems Half", "<AngleBasisName>my own"),
                   "no AngleBasis named 'LBNL/Klems Half'");
  EXPECT_COMPLAINT(with("Columns", "TensorTree5"), "IncidentDataStructure: found TensorTree5");
  EXPECT_COMPLAINT(with("Reflection Front", "Transmission Front"),
                   "Layer: found only directions of transmission");
  EXPECT_COMPLAINT(with("<LowerTheta>30", "<LowerTheta>31"), "ThetaBounds: found 31 to 90");
  EXPECT_COMPLAINT(with("<UpperTheta>90", "<UpperTheta>91"), "UpperTheta: found '91'");
  EXPECT_COMPLAINT(with("<UpperTheta>30", "<UpperTheta>-1"), "UpperTheta: found '-1'");
  EXPECT_COMPLAINT(with("<nPhis>3", "<nPhis>0"), "nPhis: found '0'");
  EXPECT_COMPLAINT(with("<nPhis>3", "<nPhis>2147483648"), "nPhis: found '2147483648'");
  EXPECT_COMPLAINT(with("<nPhis>3", "<nPhis>2.5"), "nPhis: found 2.5");
  EXPECT_COMPLAINT(with("<nPhis>3", "<nPhis>4"), "ScatteringData: found 16 numbers, expected 25");
  EXPECT_COMPLAINT(with("<nPhis>3", "<nPhis>2"), "ScatteringData, number 10: found one more");
  EXPECT_COMPLAINT(with("\n0.", "\nO."), "ScatteringData, number 1: found 'O.");
  EXPECT_COMPLAINT(with("</Layer>", "</Lawyer>"), "expected well-formed XML");
  std::string blocks;
  for (int k = 0; k < 90; ++k)
    blocks += fmt::format(
        "<AngleBasisBlock><ThetaBounds><LowerTheta>{}</LowerTheta><UpperTheta>{}"
        "</UpperTheta></ThetaBounds><nPhis>360</nPhis></AngleBasisBlock>",
        k, k + 1);
  EXPECT_COMPLAINT(with("<AngleBasisBlock>", blocks + "<AngleBasisBlock>"), "more patches");
}

TEST(KlemsFile, MayBeNoXmlBomb) {
  const Folder folder;
  std::string laughs = "<!DOCTYPE WindowElement [<!ENTITY a \"ha\">";
  for (char c = 'b'; c < 'z'; ++c) {
    laughs += fmt::format("<!ENTITY {} \"", c);
    for (int k = 0; k < 10; ++k) laughs += fmt::format("&{};", static_cast<char>(c - 1));
    laughs += "\">";
  }
  const std::string good = KlemsFile{.rings = {{0, 90, 1}}, .f = plain}.bytes();
  const std::string head = "<WindowElement>";
  EXPECT_COMPLAINT(folder.write("t", changed(changed(good, head, laughs + "]>" + head),
                                             "<ScatteringData>\n", "<ScatteringData>&y;")),
                   "ScatteringData, number 1: found '&y;");
  std::string nested;
  for (int k = 0; k < 60'000; ++k) nested += "<a>";
  EXPECT_COMPLAINT(folder.write("t", head + nested), "expected well-formed XML");
  for (int k = 0; k < 60'000; ++k) nested += "</a>";
  EXPECT_COMPLAINT(folder.write("t", head + nested + "</WindowElement>"), "no Optical");
  for (int k = 0; k < 20'000; ++k) nested += "<a/>x";
  EXPECT_COMPLAINT(folder.write("t", head + nested + "</WindowElement>"),
                   "document: found '<' 140002 times, expected at most 131072");
  std::string attributes = "<a";
  for (int k = 0; k < 140'000; ++k) attributes += " a=''";
  EXPECT_COMPLAINT(folder.write("t", head + attributes + "/></WindowElement>"),
                   "document: found '=' 140000 times");
}

TEST(AltaFile, NamesTheLineThatIsWrong) {
  const Folder folder;
  const std::string good = alta_file("SPHERICAL_TL_PL_TV_PV", "INV_STERADIAN", 4, 1,
                                     {{0.1, 0.2, 0.3, 0.4, 0.5}, {0.1, 0.2, 0.3, 0.4, 0.5}});
  const auto with = [&](const std::string& from, const std::string& to) {
    return folder.write("t.dat", changed(good, from, to));
  };
  EXPECT_COMPLAINT(
      with("SPHERICAL_TL_PL_TV_PV", "STARK_3D"),
      "line 4: found #PARAM_IN STARK_3D, expected a parametrization of two directions: "
      "SPHERICAL_TL_PL_TV_PV, CARTESIAN, ");
  EXPECT_COMPLAINT(with("INV_STERADIAN", "XYZ_COLOR"), "line 5: found #PARAM_OUT XYZ_COLOR");
  EXPECT_COMPLAINT(with("#PARAM_IN", "#PARAM_INN"),
                   "found no #PARAM_IN, expected one before the samples: SPHERICAL_TL_PL_TV_PV, ");
  EXPECT_COMPLAINT(with("#PARAM_IN", "#PARAM_INN"), "RUSIN_TH_TD or COS_TH_TD");
  EXPECT_COMPLAINT(with("#PARAM_OUT", "#OUT"),
                   "found no #PARAM_OUT, expected one before the samples: INV_STERADIAN, "
                   "INV_STERADIAN_COSINE_FACTOR or RGB_COLOR");
  EXPECT_COMPLAINT(with("#DIM 4 1", "#DIM 4 4097"),
                   "found '4097', expected a whole number from 1 to 4096");
  EXPECT_COMPLAINT(with("#VS 0", "#FORMAT binary\n#SAMPLE_COUNT 67108865"),
                   "found '67108865', expected a whole number from 1 to 67108864");
  EXPECT_COMPLAINT(with("#DIM 4 1", "#DIM 3 1"), "found #DIM 3 …, expected 4 for SPHERICAL");
  EXPECT_COMPLAINT(with("#DIM 4 1", "#DIM 4 -1"), "line 2: found '-1'");
  EXPECT_COMPLAINT(with("#DIM 4 1", "#DIM 4 2147483648"), "line 2: found '2147483648'");
  EXPECT_COMPLAINT(with("#DIM 4 1", "#DIM 4 2"), "line 7: found 5 numbers, expected 6");
  EXPECT_COMPLAINT(with("#VS 0", "#VS 3"), "line 3: found '3'");
  EXPECT_COMPLAINT(with("#ALTA_BEGIN_HEADER", "#ALTA FUNC HEADER"), "line 1: found a function");
  EXPECT_COMPLAINT(folder.write("t", good + "0.1 0.2 0.3 0.4\n"), "line 9: found 4 numbers");
  EXPECT_COMPLAINT(folder.write("t", good + "0.1 0.2 0.3 0.4 0.5 0.6\n"),
                   "line 9: found 6 numbers");
  EXPECT_COMPLAINT(folder.write("t", good + "0.1 0.2 0.3 0.4 0,5\n"), "line 9: found '0,5'");
  EXPECT_COMPLAINT(folder.write("t", good + "30 0.2 0.3 0.4 0.5\n"),
                   "line 9: found 30, expected an angle in radians");
  EXPECT_COMPLAINT(folder.write("t", good + "nan 0.2 0.3 0.4 0.5\n"), "line 9: found nan");
  EXPECT_EQ(complaint(folder.write("t", good + "0.1 0.2 0.3 0.4 nan\n")), "");
  EXPECT_COMPLAINT(folder.write("t", good.substr(0, good.find("0.1"))), "no samples");
  EXPECT_COMPLAINT(
      folder.write("t", alta_file("CARTESIAN", "INV_STERADIAN", 6, 1, {{0, 0, 0, 0, 0, 1, 1}})),
      "a vector of length 0");
  EXPECT_COMPLAINT(
      folder.write("t", alta_file("COS_TH_TD", "INV_STERADIAN", 2, 1, {{1.1, 0.5, 1}})),
      "found 1.1, expected a cosine");
}

}  // namespace
}  // namespace gonio
