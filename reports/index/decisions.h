#pragma once
/// \file
/// Decisions: which form to ship for each part of a material, by the facts of the reports of one run.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "image/colour_difference.h"
#include "reports/finding/facts.h"
#include "reports/finding/names.h"

namespace gonio {

/// Share of light that a white diffuse term may give back at most: its own, and what an integral is known to.
inline constexpr double no_light_made = 1.001;
/// RMS error of G₂ up to which a masking form is as good as exact.
inline constexpr double small_masking_error = 0.01;

/// Text as shown.  What stands in brackets at the end of a cell is an aside.
struct Decision {
  std::string subject;  ///< "Masking", "Fresnel of gold, silver"
  std::string take;     ///< name of the form
  std::string take_id;  ///< of the catalogue
  std::string error;    ///< that is left
  std::string cost;     ///< over the usual form
  std::string unless;   ///< when another is to be taken, and which; may be empty
};

/// Form that may stand in for another.
struct Candidate {
  std::string form;
  double error;
  double ns, spread;           ///< time of a sample [ns]
  std::vector<double> each{};  ///< the same in each process that measured; empty: one alone
};
/// The usual form, if its error is at most `enough`; else the cheapest of those whose error is, and the nearest of several whose times
/// differ by less than a tenth, or by nothing that survives (timing.h).  If none is good enough, the nearest of all.  nullptr of none.
const Candidate* choose(std::span<const Candidate>, std::string_view usual, double enough);

/// The time of a form or model among these; null: it was not timed.
const Facts::Time* time_of(const std::vector<Facts::Time>&, std::string_view id);

/// Decisions that these facts support, in the order of the page; those that lack a fact are left out.
std::vector<Decision> decisions(const Facts&);

/// A cell without its aside.
std::string without_aside(const std::string& cell);

/// Decisions as a table for a terminal, no line wider than `width` columns: what for, take, error left, cost.
std::string decision_table(std::span<const Decision>, std::size_t width = 100);

}  // namespace gonio
