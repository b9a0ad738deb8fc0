// How gonio speaks, wherever somebody reads it: README, docs, --help, man pages, the words of
// terminal, pages and errors.  Habits that made sentences hard to read are counted, and there are
// none.
#include <array>
#include <cctype>
#include <filesystem>
#include <regex>
#include <set>

#include "base/text.h"
#include "cli/program.h"
#include "reports/plain.h"

namespace gonio::test {
namespace {

namespace fs = std::filesystem;

struct Habit {
  const char* pattern;  ///< within one sentence
  const char* better;
};
constexpr std::array habits{
    Habit{"^Of [^,]*, ",
          "begin with the subject: 'Each parameter gets …', not 'Of each parameter, …'"},
    Habit{"\\btold\\b(?!-| apart)|\\btells\\b", "says, shows, reports, warns"},
    Habit{"\\balone\\b", "only, or by itself"},
    Habit{"^What (?!to do)[^?]*\\.$",
          "name the thing: 'Impossible input ends …', not 'What cannot be ends …'"},
    Habit{"\\bsuch an? |\\bthe like\\b", "name the kind"},
    Habit{"\\bshows? most\\b", "largest error at …"},
    Habit{"\\b([Ii]ssue|[Ss]eed) 0?[0-9]{2,}\\b", "say the claim in its own words"}};

/// What a text has of these habits, one a line.
std::string found_in(const std::string& place, std::string_view text) {
  static const std::vector<std::regex> patterns = [] {
    std::vector<std::regex> all;
    for (const auto& h : habits) all.emplace_back(h.pattern);
    return all;
  }();
  std::string out;
  for (const auto& sentence : sentences_of(text))
    for (std::size_t k = 0; k < habits.size(); ++k)
      if (std::regex_search(sentence, patterns[k]))
        out += place + ": " + sentence + "\n    " + habits[k].better + "\n";
  return out;
}

std::string trimmed(const std::string& text) {
  const auto from = text.find_first_not_of(" \t");
  return from == text.npos ? "" : text.substr(from, text.find_last_not_of(" \t") + 1 - from);
}

/// Paragraphs, items and cells of a page in Markdown, without code.
std::vector<std::string> prose_of(const std::string& markdown) {
  static const std::regex code("`[^`]*`"), link(R"(\[([^\]]*)\]\([^)]*\))");
  std::vector<std::string> all{""};
  bool in_block = false;
  for (const auto& line : split(markdown, '\n')) {
    if (line.starts_with("```")) in_block = !in_block;
    if (in_block || line.starts_with("```") || line.starts_with("<!--")) continue;
    auto text = std::regex_replace(std::regex_replace(line, code, "Code"), link, "$1");
    if (text.starts_with("|")) {
      for (const auto& cell : split(text, '|')) all.push_back(trimmed(cell));
    } else if (text.empty() || text.starts_with("- ") || text.starts_with("#")) {
      all.push_back(text.empty() ? "" : text.substr(text.find(' ') + 1));
    } else {
      all.back() += (all.back().empty() ? "" : " ") + text;
    }
  }
  return all;
}

/// Strings of a C++ source as they are printed, those beside each other joined, with their lines.
std::vector<std::pair<std::size_t, std::string>> strings_of(const std::string& source) {
  std::vector<std::pair<std::size_t, std::string>> all;
  std::size_t line = 1;
  bool joins = false;  // only blanks since the last string
  const auto begin = [&] {
    if (!joins) all.emplace_back(line, "");
    joins = true;
  };
  for (std::size_t i = 0; i < source.size(); ++i) {
    const char c = source[i];
    const bool part_of_word = i > 0 && std::isalnum(static_cast<unsigned char>(source[i - 1])) != 0;
    if (c == '\n') {
      ++line;
    } else if (source.compare(i, 2, "//") == 0) {
      i = std::min(source.find('\n', i), source.size()) - 1;
    } else if (source.compare(i, 2, "/*") == 0) {
      const auto end = std::min(source.find("*/", i), source.size());
      line += static_cast<std::size_t>(std::count(source.begin() + static_cast<std::ptrdiff_t>(i),
                                                  source.begin() + static_cast<std::ptrdiff_t>(end),
                                                  '\n'));
      i = end + 1;
    } else if (source.compare(i, 2, "R\"") == 0 && !part_of_word) {
      begin();
      const auto open = source.find('(', i);
      const std::string close = ")" + source.substr(i + 2, open - i - 2) + "\"";
      const auto end = std::min(source.find(close, open), source.size());
      all.back().second += source.substr(open + 1, end - open - 1);
      line += static_cast<std::size_t>(std::count(source.begin() + static_cast<std::ptrdiff_t>(i),
                                                  source.begin() + static_cast<std::ptrdiff_t>(end),
                                                  '\n'));
      i = end + close.size() - 1;
    } else if (c == '"') {
      begin();
      for (++i; i < source.size() && source[i] != '"'; ++i)
        all.back().second += source[i] != '\\' ? source[i] : source[++i] == 'n' ? '\n' : source[i];
    } else if (c == '\'' && !part_of_word) {  // a character, no mark between digits
      i += source[i + 1] == '\\' ? 3 : 1;
      i = std::min(source.find('\'', i), source.size());
      joins = false;
    } else if (std::isspace(static_cast<unsigned char>(c)) == 0) {
      joins = false;
    }
  }
  return all;
}

std::vector<fs::path> files_below(const std::string& folder, const std::set<std::string>& endings) {
  std::vector<fs::path> all;
  for (const auto& e : fs::recursive_directory_iterator(fs::path(project_folder()) / folder))
    if (endings.contains(e.path().extension().string())) all.push_back(e.path());
  return all;
}
std::string name_of_file(const fs::path& path) {
  return fs::relative(path, project_folder()).string();
}

TEST(Prose, FindsTheHabitsThatItCounts) {
  for (const char* bad :
       {"Of the base, 2.56 % would be the tail.", "A model that does not fit is told as one.",
        "It does so from alpha 0.22 on alone.", "What cannot be is one line and exit code 3.",
        "The page tells more.", "It may be of such a kind.", "The error shows most at 14°.",
        "That is issue 42."})
    EXPECT_NE(found_in("", bad), "") << bad;
  for (const char* good :
       {"The tail is 2.56 % of the base, or more.", "What does it cost to switch?",
        "The table cannot tell it from GGX.", "Two widths cannot be told apart."})
    EXPECT_EQ(found_in("", good), "") << good;
  const auto strings =
      strings_of("f(\"of \"  // \"no\"\n  \"two\", R\"(raw \")\", '\"', 1'000, \"x\\n\\\"y\")");
  ASSERT_EQ(strings.size(), 3U);
  EXPECT_EQ(strings[0], std::pair(std::size_t{1}, std::string("of two")));
  EXPECT_EQ(strings[1], std::pair(std::size_t{2}, std::string("raw \"")));
  EXPECT_EQ(strings[2].second, "x\n\"y");
}

TEST(Prose, OfReadmeAndDocsHasNoneOfThem) {
  std::string found;
  std::size_t pages = 0;
  auto files = files_below("docs", {".md"});
  files.push_back(fs::path(project_folder()) / "README.md");
  for (const auto& path : files) {
    ++pages;
    for (const auto& paragraph : prose_of(read_bytes(path.string())))
      found += found_in(name_of_file(path), paragraph);
  }
  EXPECT_GT(pages, 50U);
  EXPECT_EQ(found, "");
}

TEST(Prose, OfTheManualHasNoneOfThem) {
  const Folder f;
  ASSERT_EQ(gonio(f, "manual share").code, 0);
  std::string found;
  std::size_t pages = 0;
  for (const auto& e : fs::directory_iterator(f / "share/man/man1")) {
    ++pages;
    for (const auto& line : split(read_bytes(e.path().string()), '\n'))
      if (!line.starts_with(".")) found += found_in(e.path().filename().string(), line);
  }
  EXPECT_GT(pages, 20U);
  EXPECT_EQ(found, "");
}

TEST(Prose, OfStringsInTheSourcesHasNoneOfThem) {
  std::string found;
  std::size_t sentences = 0;
  for (const char* folder :
       {"src", "data_synth", "fitting", "reports", "validate", "cli", "python"})
    for (const auto& path : files_below(folder, {".cpp", ".h"}))
      for (const auto& [line, text] : strings_of(read_bytes(path.string())))
        if (text.find(' ') != text.npos) {
          ++sentences;
          for (const auto& part : split(text, '\n'))
            found += found_in(name_of_file(path) + ":" + std::to_string(line), part);
        }
  EXPECT_GT(sentences, 3000U);
  EXPECT_EQ(found, "");
}

TEST(Prose, OfThePackageForPythonHasNoneOfThem) {
  std::string found;
  const auto files = files_below("python/gonio", {".py"});
  EXPECT_GT(files.size(), 5U);
  for (const auto& path : files)
    for (const auto& line : split(read_bytes(path.string()), '\n'))
      found += found_in(name_of_file(path), trimmed(line));
  EXPECT_EQ(found, "");
}

}  // namespace
}  // namespace gonio::test
