#pragma once
/// \file
/// A report as anyone sees it: its files, its findings, the claims that it judges.

#include <array>
#include <functional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "image/environment.h"
#include "reports/finding/facts.h"
#include "reports/picture/figure.h"

namespace gonio {

struct ReportOptions {
  bool full = false;        ///< finer, some minutes
  bool one_of_all = false;  ///< made with all others: what takes minutes by itself looks at less
  bool quick = false;  ///< a first look, some seconds: fewer materials, angles, samples and repeats
  bool all_files = true;  ///< pictures that a reader of the page chooses have files, too
  struct Light {
    std::string name;
    Environment map;
  };
  std::vector<Light> environments{};  ///< of the reports that light something
  std::string asset{};                ///< glTF file of the report of scenes; empty: none
  std::string program{};  ///< `gonio`, which the report of costs starts again; empty: it measures
                          ///< in one process
};

/// Callback that is told what is being done, and the part of the whole that is done, in [0, 1].
using ReportProgress = std::function<void(std::string_view, double)>;
/// Progress of a part that runs from one share of the whole to another, by what is done of it, in [0, 1].
/// \param done  must outlive it; may be empty   \param what  plain text that outlives it
inline std::function<void(double)> part_of(const ReportProgress& done,
                                           std::string_view what,
                                           double from,
                                           double to) {
  return [&done, what, from, to](double x) {
    if (done) done(what, from + x * (to - from));
  };
}

/// A statement in circulation, judged.
struct Claim {
  std::string claim;   ///< the sentence
  std::string source;  ///< public, where it stands: "Burley 2012, …"; empty: it is common talk
  enum class Judged { holds, partly, fails } judged;
  std::string figure;    ///< the one that decides, with what it is of: "36 % of F, at 55°"
  std::string verdict;   ///< what was tested, beside the figure; empty: the figure says it
  std::string anchor{};  ///< of the report's page, where it is shown; empty: its top
};

template <>
inline constexpr std::array<std::string_view, 3> names_of<Claim::Judged>{"holds", "holds in part",
                                                                         "does not hold"};

/// "“claim” holds: verdict"
std::string sentence(const Claim&);

/// Everything that a report says of its rows.
struct Findings {
  std::vector<std::string> sentences{};  ///< those of the claims among them
  std::vector<Claim> claims{};
  /// Sentence that a reader takes away, of at most three numbers; empty: the first one.
  std::string headline{};

  void say(std::string sentence) { sentences.push_back(std::move(sentence)); }
  /// Keeps a claim, and its sentence among the others.
  void judge(std::string_view claim,
             std::string_view source,
             Claim::Judged,
             std::string figure,
             std::string verdict);
};

/// The plain sum of a report's parts: what was measured, what is said of it, and what is shown of it.
template <class Rows>
struct Report {
  bool full;
  Rows rows;
  Findings findings;
  Pictures pictures;
};
/// The report on these rows, from which alone the rest is made: by findings(rows) and pictures(rows).
template <class Rows>
Report<Rows> report_of(bool full, Rows rows) {
  auto said = findings(rows);
  auto shown = pictures(rows);
  return {full, std::move(rows), std::move(said), std::move(shown)};
}

struct ReportFiles {
  std::string json, html, csv;  ///< csv: the rows
  Findings findings;
  Pictures pictures;
  Facts facts{};
  std::set<std::string> linked{};  ///< ids of the pictures that have files
};

}  // namespace gonio
