// README.md and docs/: every command block is run as it stands there, one test a page, and what is
// shown beside it is what is printed.
//
//   ```sh       run in the order of the page, in one shell, in a folder of its own.
//               A line that ends in "# exit 1" ends so.
//   ```text     directly below: what that block prints, standard output and error.
//               A line "…" stands for lines left out.  Numbers of four digits and errors may
//               differ by one in the last; those before ns, ms, s, × and "times" as they will.
//   ```python   the same as sh, but that each block is a program of its own, run with the module
//               for Python; left out with a line where that is not built.
//   ```json     a document, parsed
//   ```yaml     a file of docs/examples, whole, which a comment above names: <!-- file:
//   docs/examples/… -->
//   ```console  not run, below a comment that says why: <!-- not run: it builds gonio -->
//
// Above a block <!-- long --> keeps it for GONIO_LONG, <!-- long under a sanitizer --> for runs
// without one.  <!-- yours: sky.exr --> brings a file, or a folder of docs/examples, that a reader
// has.
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <map>
#include <numbers>
#include <regex>
#include <set>
#include <sstream>

#include "base/text.h"
#include "cli/module.h"
#include "cli/outside.h"
#include "cli/program.h"
#include "image/exr.h"
#include "reports/plain.h"
#include "table/foreign.h"

namespace gonio::test {
namespace {

namespace fs = std::filesystem;

const fs::path root = project_folder();

/// README.md and the pages of docs, relative to the project.
std::vector<std::string> pages() {
  std::vector<std::string> all{"README.md"};
  for (const auto& e : fs::recursive_directory_iterator(root / "docs"))
    if (e.path().extension() == ".md") all.push_back(fs::relative(e.path(), root).string());
  std::sort(all.begin() + 1, all.end());
  return all;
}

struct Block {
  std::string kind;    ///< sh, python, text, json, yaml, console
  std::string before;  ///< the comment above, or nothing
  std::size_t line;    ///< of its first line, from 1
  std::vector<std::string> lines;
  bool follows = false;  ///< nothing but empty lines is between it and the block above
};

struct Document {
  std::vector<Block> blocks;
  std::vector<std::string> prose;  ///< paragraphs, without tables, headings and code
  std::set<std::string> yours, downloaded, links;
};

std::string inner(const std::string& line, const std::string& head) {
  return line.substr(head.size(), line.size() - head.size() - 4);  // less " -->"
}

Document read_document(const std::string& page) {
  Document d;
  const auto lines = split(read_bytes((root / page).string()), '\n');
  bool in_block = false, only_empty = false;
  std::string paragraph, comment;
  const auto end_paragraph = [&] {
    if (!paragraph.empty()) d.prose.push_back(paragraph);
    paragraph.clear();
  };
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const std::string& line = lines[k];
    if (line.starts_with("```")) {
      end_paragraph();
      if (!in_block) d.blocks.push_back({line.substr(3), comment, k + 2, {}, only_empty});
      comment.clear();
      in_block = !in_block;
      only_empty = true;
    } else if (in_block) {
      d.blocks.back().lines.push_back(line);
    } else if (line.starts_with("<!-- yours: ")) {
      std::istringstream names(inner(line, "<!-- yours: "));
      for (std::string n; names >> n;) d.yours.insert(n);
    } else if (line.starts_with("<!-- public: ")) {
      d.downloaded.insert(inner(line, "<!-- public: "));
    } else if (line.starts_with("<!--")) {
      comment = line;
    } else if (line.empty()) {
      end_paragraph();
    } else {
      only_empty = false;
      static const std::regex link(R"(\]\(([^)]*)\))");
      for (std::sregex_iterator at(line.begin(), line.end(), link), none; at != none; ++at)
        d.links.insert((*at)[1]);
      const bool item =
          line.starts_with("- ") || std::regex_search(line, std::regex("^[0-9]+\\. "));
      if (item) end_paragraph();
      if (line.starts_with("#") || line.starts_with("|") || line.starts_with("!["))
        end_paragraph();
      else
        paragraph += (paragraph.empty() ? "" : " ") + line;
    }
  }
  end_paragraph();
  EXPECT_FALSE(in_block) << page << ": a block has no end";
  return d;
}

/// A sky that is bright above and dark below, with a sun.
std::string sky(const std::string& path) {
  Image image{32, 16, {"R", "G", "B"}, {}, {}};
  for (int c = 0; c < 3; ++c) {
    auto& plane = image.planes.emplace_back(image.width * image.height, 0.1F);
    for (std::size_t k = 0; k < plane.size() / 2; ++k) plane[k] = 0.5F;
    plane[5 * image.width + 9] = 40.0F;
  }
  return exr_bytes(path, image);
}

/// A body without textures.
constexpr const char* car =
    R"({"asset": {"version": "2.0"}, "materials": [{"name": "Body", "pbrMetallicRoughness":
  {"baseColorFactor": [0.6, 0.05, 0.04, 1], "metallicFactor": 0, "roughnessFactor": 0.3}}]})";

/// A matt surface with a wide highlight.
double satin(const DirectionPair& p, std::size_t channel) {
  const Direction sum{p.wi.x + p.wo.x, p.wi.y + p.wo.y, p.wi.z + p.wo.z};
  const double noh = sum.z / std::sqrt(dot(sum, sum));
  return (0.3 - 0.1 * static_cast<double>(channel)) / std::numbers::pi + 0.3 * std::pow(noh, 20);
}

/// MIT CSAIL's layout with few bins.
std::string velvet() {
  constexpr std::array<std::int32_t, 4> bins{9, 9, 18, 12};
  return ngan_file(bins, true, [&](std::size_t k) {
    using std::numbers::pi;
    constexpr std::array spans{pi / 2, pi / 2, pi, 2 * pi};
    std::array<double, 4> centre{};
    for (std::size_t axis = 4; axis-- > 0;) {
      const auto n = static_cast<std::size_t>(bins[axis]);
      centre[axis] = (static_cast<double>(k % n) + 0.5) * spans[axis] / static_cast<double>(n);
      k /= n;
    }
    const auto [theta_i, theta_o, difference, phi_i] = centre;
    return satin({direction(theta_i, phi_i), direction(theta_o, phi_i + difference)}, k);
  });
}

/// Lays a file that readers bring into the folder.
void bring(const Folder& f, const std::string& name) {
  if (name == "sky.exr") {
    f.write(name, sky(f / name));
  } else if (name == "car.gltf") {
    f.write(name, car);
  } else if (name == "felt.bsdf") {
    RglFile rgl;
    rgl.f = satin;
    rgl.size = 16;
    f.write(name, rgl.bytes());
  } else if (name == "blind.xml") {
    KlemsFile klems;
    klems.f = [](const DirectionPair& p, std::size_t) { return satin(p, 0); };
    f.write(name, klems.bytes());
  } else if (name == "velvet.dat") {
    f.write(name, velvet());
  } else if (name == "vinyl.bsdf") {
    f.write(name, ZemaxFile{.incident = {0, 15, 30, 45, 60},
                            .azimuth = {0, 30, 60, 90, 120, 150, 180},
                            .radius = {0, 5, 10, 15, 20, 30, 40, 50, 60, 70},
                            .f = satin}
                      .bytes());
  } else if (name == "tile.json") {
    f.write(
        name,
        R"({"head": {"date": "3.4.2025"}, "data": {"wavelengths": [650, 450], "theta_i": [0, 45],
      "phi_i": [0, 0], "theta_v": [45, 0], "phi_v": [0, 0], "data": [[0.31, 0.32], [0.28, 0.29]]}})");
  } else if (name == "spectrum.csv" || name == "ratios.csv") {
    std::string text = "theta_i,theta_o";
    for (int nm = 400; nm <= 700; nm += 50) text += fmt::format(",f_{}", nm);
    for (int theta_i = 10; theta_i <= 70; theta_i += 10)
      for (int theta_o = -75; theta_o <= 75; theta_o += 5) {
        text += fmt::format("\n{},{}", theta_i, theta_o);
        const DirectionPair p{direction(theta_i * degree, 0),
                              direction(theta_o * degree, std::numbers::pi)};
        for (int nm = 400; nm <= 700; nm += 50)
          text += fmt::format(",{:.5g}", satin(p, 0) * nm / 500);
      }
    f.write(name, text + "\n");
  } else if (fs::is_directory(root / "docs/examples" / name)) {
    fs::copy(root / "docs/examples" / name, f / name, fs::copy_options::recursive);
  } else {
    ADD_FAILURE() << "no test knows how to bring " << name;
  }
}

/// A line in pieces: numbers, and what stands between them with blanks made one.
struct Piece {
  std::string text;
  bool number = false, time = false;
};
std::vector<Piece> pieces(const std::string& line) {
  static const std::regex number(R"([0-9]+(?:,[0-9]{3})*(?:\.[0-9]+)?(?:e[-+]?[0-9]+)?)");
  static const std::regex blanks("\\s+"), unit("^ ?(ns|ms|s|min|×|times|x)\\b.*|^ ?×.*");
  std::vector<Piece> all;
  std::size_t end = 0;
  const auto between = [&](std::size_t from, std::size_t to) {
    const auto text = std::regex_replace(line.substr(from, to - from), blanks, " ");
    if (!text.empty()) all.push_back({text});
  };
  for (std::sregex_iterator at(line.begin(), line.end(), number), none; at != none; ++at) {
    const auto begin = static_cast<std::size_t>(at->position());
    between(end, begin);
    end = begin + static_cast<std::size_t>(at->length());
    all.push_back({at->str(), true, std::regex_match(line.substr(end), unit)});
  }
  between(end, line.size());
  return all;
}

double value(std::string text) {
  std::erase(text, ',');
  return std::stod(text);
}

/// One in the last digit that is shown.
double last_digit(const std::string& text) {
  const auto e = text.find('e');
  const auto point = text.find('.');
  double unit = 1;
  if (point != text.npos)
    unit = std::pow(10, -static_cast<double>(std::min(e, text.size()) - point - 1));
  return e == text.npos ? unit : unit * std::pow(10, std::stod(text.substr(e + 1)));
}

/// True of two numbers that are the same, or as near as another processor's rounding brings figures of many digits, and errors.
bool same_number(const std::string& shown, const std::string& printed) {
  constexpr std::ptrdiff_t many = 4;
  if (value(shown) == value(printed)) return true;
  const bool error = shown.find('e') != shown.npos;
  const auto digits = std::ranges::count_if(shown, [](unsigned char c) { return std::isdigit(c); });
  return (error || digits >= many) &&
         std::abs(value(shown) - value(printed)) <= 1.01 * last_digit(shown);
}

bool same_line(const std::string& shown, const std::string& printed) {
  const auto a = pieces(shown), b = pieces(printed);
  if (a.size() != b.size()) return false;
  for (std::size_t k = 0; k < a.size(); ++k) {
    if (a[k].number != b[k].number) return false;
    if (a[k].number ? !a[k].time && !same_number(a[k].text, b[k].text) : a[k].text != b[k].text)
      return false;
  }
  return true;
}

/// Expects printed lines as they are shown, where "…" stands for any.
void expect_shown(const std::vector<std::string>& shown, const std::vector<std::string>& printed) {
  std::size_t at = 0;
  bool any = false;
  const auto all = [&] {
    std::string text;
    for (const auto& l : printed) text += l + "\n";
    return text;
  };
  for (const auto& line : shown) {
    if (line == "…") {
      any = true;
      continue;
    }
    if (any)
      while (at < printed.size() && !same_line(line, printed[at])) ++at;
    any = false;
    if (at == printed.size() || !same_line(line, printed[at])) {
      ADD_FAILURE() << "shown:   " << line
                    << "\nprinted: " << (at < printed.size() ? printed[at] : "nothing more")
                    << "\nall of it:\n"
                    << all();
      return;
    }
    ++at;
  }
  EXPECT_TRUE(any || at == printed.size()) << "is printed and not shown: " << printed[at];
}

/// Lines of a text, without what ends the last.
std::vector<std::string> lines_of(const std::string& text) {
  auto all = split(text, '\n');
  while (!all.empty() && all.back().empty()) all.pop_back();
  return all;
}

/// Codes that lines end with which say so: "# exit 1".
std::map<std::size_t, int> expected_codes(const Block& b) {
  std::map<std::size_t, int> all;
  static const std::regex said(".*# exit ([0-9]+)");
  for (std::size_t k = 0; k < b.lines.size(); ++k)
    if (std::smatch m; std::regex_match(b.lines[k], m, said)) all[b.line + k] = std::stoi(m[1]);
  return all;
}

/// Why a block is left out here; nothing where it is run.
std::string left_out(const Block& b) {
  if (b.before == "<!-- long -->" && std::getenv("GONIO_LONG") == nullptr)
    return "without GONIO_LONG";
  if (b.kind == "python" && python().empty()) return "without the module for Python and NumPy";
#ifdef __SANITIZE_ADDRESS__
  if (b.before.starts_with("<!-- long")) return "under a sanitizer";
#endif
  return "";
}

class Page : public testing::TestWithParam<std::string> {};

TEST_P(Page, IsRunAsWrittenAndPrintsWhatItShows) {
  const auto document = read_document(GetParam());
  const Folder f;
  for (const auto& name : document.yours) bring(f, name);
  for (const auto& name : document.downloaded) {
    const auto path = shared("data/" + name);
    if (path.empty())
      GTEST_SKIP() << GetParam() << " needs ../shared/data/" << name << ", which is not here";
    f.write(fs::path(name).filename().string(), read_bytes(path));
  }
  // One script whose lines have the page's numbers, so that what fails is told by its line there.
  std::string script;
  std::size_t line = 1, run = 0;
  const auto at_line = [&](std::size_t wanted) {
    for (; line < wanted; ++line) script += "\n";
  };
  std::map<std::size_t, int> expected;
  std::vector<const Block*> ran;
  for (const auto& b : document.blocks) {
    if (b.kind != "sh" && b.kind != "python") continue;
    if (const auto without = left_out(b); !without.empty()) {
      std::cout << GetParam() << ":" << b.line << ": left out " << without << "\n";
      continue;
    }
    at_line(b.line - 1);
    script += "exec >'" + f / (".out" + std::to_string(run++)) + "' 2>&1";
    if (b.kind == "python") script += "; " + python() + " - <<'END_OF_BLOCK'";
    script += "\n", ++line;
    for (const auto& l : b.lines) script += l + "\n", ++line;
    if (b.kind == "python") script += "END_OF_BLOCK\n", ++line;
    expected.merge(expected_codes(b));
    ran.push_back(&b);
  }
  if (ran.empty()) return;
  script += "exec >/dev/null\ntrue\n";  // what fails last is told once
  const std::string file = f.write(".page.sh", script), codes = f / ".codes";
  const std::string program = fs::path(program_path()).parent_path().string();
  const std::string command = "cd '" + f / "" + "' && PATH='" + program + "':$PATH GONIO_CODES='" +
                              codes +
                              "' bash -c 'trap '\\''echo $LINENO $? >>$GONIO_CODES'\\'' ERR; "
                              "set -E -o pipefail; . ./.page.sh' </dev/null >.shell 2>&1";
  const int status = std::system(command.c_str());
  static_cast<void>(status);  // every command's own is looked at
  std::map<std::size_t, int> found;
  std::istringstream in(read_bytes(codes));
  for (std::size_t at = 0, code = 0; in >> at >> code;) found[at] = static_cast<int>(code);
  const auto printed = [&](std::size_t k) { return read_bytes(f / (".out" + std::to_string(k))); };
  EXPECT_EQ(read_bytes(f / ".shell"), "");
  for (const auto& [at, code] : found)
    if (!expected.contains(at) || expected.at(at) != code) {
      std::string out;
      for (std::size_t k = 0; k < ran.size(); ++k)
        if (ran[k]->line <= at + 1 && at < ran[k]->line + ran[k]->lines.size()) out = printed(k);
      ADD_FAILURE() << GetParam() << ":" << at << ": exit " << code << "\n" << out;
    }
  for (const auto& [at, code] : expected)
    EXPECT_TRUE(found.contains(at)) << GetParam() << ":" << at << ": no exit " << code;
  for (const auto& e :
       fs::directory_iterator(f / ""))  // what was exported, by its target's own code
    if (const auto name = e.path().filename().string();
        name.ends_with(".gltf") || name.ends_with(".mtlx") || name.ends_with(".usda") ||
        name.ends_with(".glsl")) {
      const auto faults = outside_faults(f, name);
      if (!faults) std::cout << GetParam() << ": " << name << " is not looked at: run ./check\n";
      EXPECT_EQ(faults.value_or(""), "") << name;
    }
  for (std::size_t k = 0, r = 0; k < document.blocks.size() && r < ran.size(); ++k) {
    if (&document.blocks[k] != ran[r]) continue;
    const std::string out = printed(r++);
    if (k + 1 == document.blocks.size() || document.blocks[k + 1].kind != "text") continue;
    SCOPED_TRACE(GetParam() + ":" + std::to_string(document.blocks[k + 1].line));
    expect_shown(document.blocks[k + 1].lines, lines_of(out));
  }
}

TEST_P(Page, HasOnlyBlocksThatAreRunOrSayWhyNot) {
  const auto document = read_document(GetParam());
  const std::string* above = nullptr;
  for (const auto& b : document.blocks) {
    SCOPED_TRACE(GetParam() + ":" + std::to_string(b.line));
    if (b.kind == "console") {
      EXPECT_TRUE(b.before.starts_with("<!-- not run: ")) << b.before;
    } else if (b.kind == "json") {
      std::string text;
      for (const auto& l : b.lines) text += l + "\n";
      EXPECT_TRUE(nlohmann::json::accept(text));
    } else if (b.kind == "yaml") {
      ASSERT_TRUE(b.before.starts_with("<!-- file: ")) << b.before;
      std::string text;
      for (const auto& l : b.lines) text += l + "\n";
      EXPECT_EQ(text, read_bytes((root / inner(b.before, "<!-- file: ")).string()));
    } else if (b.kind == "text") {
      EXPECT_TRUE(b.follows && above && (*above == "sh" || *above == "python"))
          << "of which block?";
    } else {
      EXPECT_TRUE(b.kind == "sh" || b.kind == "python") << b.kind;
    }
    above = &b.kind;
  }
}

TEST_P(Page, CanBeReadAloudAndLeadsSomewhere) {
  const auto document = read_document(GetParam());
  static const std::regex code("`[^`]*`"), link(R"(\[([^\]]*)\]\([^)]*\))"), mark("\\*\\*?|^- ");
  for (const auto& paragraph : document.prose) {
    auto text = std::regex_replace(paragraph, link, "$1");
    text = std::regex_replace(std::regex_replace(text, code, "Code"), mark, "");
    if (text.ends_with(':') || text.ends_with(';')) text.back() = '.';
    expect_plain(text);
  }
  for (const auto& to : document.links) {
    if (to.starts_with("https://") || to.starts_with("#")) continue;
    const auto path = (root / GetParam()).parent_path() / to.substr(0, to.find('#'));
    EXPECT_TRUE(fs::exists(path)) << GetParam() << ": no " << to;
  }
}

/// "docs_task_fit"
std::string test_name(const testing::TestParamInfo<std::string>& page) {
  std::string name = page.param.substr(0, page.param.size() - std::string(".md").size());
  std::ranges::replace_if(
      name, [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return name;
}
INSTANTIATE_TEST_SUITE_P(Docs, Page, testing::ValuesIn(pages()), test_name);

TEST(Docs, AreAllNamedInTheContents) {
  std::set<std::string> named{"README.md", "docs/README.md"};
  for (const auto& to : read_document("docs/README.md").links)
    named.insert((fs::path("docs") / to).lexically_normal().string());
  for (const auto& page : pages()) EXPECT_TRUE(named.contains(page)) << page;
}

TEST(Docs, HaveAPageForEverySchema) {
  std::string documents;
  for (const auto& page : pages())
    if (page.starts_with("docs/document/")) documents += read_bytes((root / page).string());
  const Folder f;
  for (const auto& name : split(gonio(f, "schema").out, '\n'))
    if (!name.empty()) {
      EXPECT_NE(documents.find("`gonio schema " + name + "`"), documents.npos) << name;
    }
}

}  // namespace
}  // namespace gonio::test
