#pragma once
/// \file
/// The rule for what a report says: each sentence can be read aloud.

#include <cctype>
#include <cstddef>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "reports/finding/report.h"

#include <gtest/gtest.h>

namespace gonio::test {

/// Numbers that a reader has to take in: none of those in a name (F0, ΔE2000) or a formula.
inline std::size_t numbers_in(std::string text) {
  for (const std::string name :
       {"(r+1)²/8", "(1+r)/2", "(r+1)/2", "k = α/2", "k = α²/2", "1 − F", "2α⁻² − 2"})
    for (auto at = text.find(name); at != text.npos; at = text.find(name))
      text.erase(at, name.size());
  std::size_t n = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool digit = std::isdigit(static_cast<unsigned char>(text[i])) != 0;
    const auto before = i == 0 ? ' ' : text[i - 1];
    n += digit && std::isalnum(static_cast<unsigned char>(before)) == 0 && before != '.';
  }
  return n;
}

/// Sentences of a text: each ends at a stop that no word in lower case follows.
inline std::vector<std::string> sentences_of(std::string_view text) {
  std::vector<std::string> all{""};
  for (std::size_t i = 0; i < text.size(); ++i) {
    all.back() += text[i];
    const bool stop = text[i] == '.' || text[i] == '?' || text[i] == '!';
    if (stop && i + 2 < text.size() && text[i + 1] == ' ' &&
        std::islower(static_cast<unsigned char>(text[i + 2])) == 0)
      all.emplace_back(), ++i;
  }
  return all;
}

/// Words of a sentence that are an id of the code, as masking.smith_ggx, and no name.
inline std::vector<std::string> ids_in(const std::string& sentence) {
  std::vector<std::string> ids;
  std::istringstream words(sentence);
  for (std::string w; words >> w;) {
    while (!w.empty() && std::ispunct(static_cast<unsigned char>(w.back())) != 0) w.pop_back();
    bool id = w.find('_') != w.npos;
    for (std::size_t i = 1; i + 1 < w.size(); ++i)
      id |= w[i] == '.' && std::islower(static_cast<unsigned char>(w[i - 1])) != 0 &&
            std::islower(static_cast<unsigned char>(w[i + 1])) != 0;
    if (id) ids.push_back(w);
  }
  return ids;
}

constexpr std::size_t most_numbers = 3, most_words = 32;

/// Expects that every sentence of a text can be read aloud: few numbers, few words, names for ids, an end.
inline void expect_plain(const std::string& text) {
  if (text.empty()) return;
  EXPECT_NE(std::string_view(".!?").find(text.back()), std::string_view::npos)
      << "has no end: " << text;
  for (const auto& sentence : sentences_of(text)) {
    EXPECT_LE(numbers_in(sentence), most_numbers) << "numbers: " << sentence;
    std::istringstream words(sentence);
    std::size_t n = 0;
    for (std::string w; words >> w;) ++n;
    EXPECT_LE(n, most_words) << "words: " << sentence;
    for (const auto& id : ids_in(sentence)) ADD_FAILURE() << id << " is no name: " << sentence;
    EXPECT_EQ(sentence.find("(1 times"), sentence.npos) << sentence;
    EXPECT_EQ(sentence.find("’"), sentence.npos) << "apostrophes are straight: " << sentence;
  }
}
/// The same of everything that a report says: its headline, its sentences, its claims' verdicts.
inline void expect_plain(const Findings& said) {
  expect_plain(said.headline);
  for (const auto& sentence : said.sentences) expect_plain(sentence);
  for (const auto& claim : said.claims) {
    expect_plain(claim.verdict);
    EXPECT_LE(numbers_in(claim.figure), most_numbers) << claim.figure;
  }
}

}  // namespace gonio::test
