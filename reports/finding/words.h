#pragma once
/// \file
/// Words that the findings of reports share: shares, counts, places, verdicts.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "base/rounded.h"
#include "reports/finding/report.h"

namespace gonio {

/// "−59.1 %": to so many digits, of large ones to the last before the point.
std::string percent(double share, int digits = 3);
/// A share that somebody gave, with all its digits: "99.5 %".
std::string percent_given(double share);
/// "0.019 %" of 0.000183: a share that something stays below, never read as less.
std::string percent_at_most(double share, int digits = 2);
/// "0.031", "4.2", "120", "under 0.0001": as it is read aloud, without a power of ten.  \param x  not negative
std::string short_text(double x);
/// "≤ 2.5" of 2.41: a bound as it is read, never below the number; of what is smaller "≤ 0.0001".
std::string at_most(double, int digits = 2);
/// "0.10 ns", "7.7 ns", "13 ns": one rounding of a time's size, so that times beside each other agree.
std::string ns_text(double ns);
/// "2", "none"
std::string number_or_none(std::size_t);
/// "2 of 39", "none of 100"
std::string of_all(std::size_t n, std::size_t all);
/// "roughness 0.3, cosine 0.5"
std::string place(double roughness, double mu);
/// "at normal incidence", "at cosine 0.5", of mu 0 "on average"
std::string at_angle(double mu);
/// Ends of a range within [0, 1], rounded inwards: what is said of it holds at its printed ends.
std::string first_text(double from);
std::string last_text(double to);
/// "from 0.42 on", "from 0.57 to 0.80": a range within [0, 1].  \param word  before the first number
std::string range_text(double from, double to, const std::string& word = {});
/// "a", "a and b", "a, b and c".  \param last  what stands before the last
std::string list_text(const std::vector<std::string>& all, std::string_view last = " and ");

/// The verdict on a claim that holds, or else partly does, or fails.
constexpr Claim::Judged verdict(bool holds, bool partly = false) {
  return holds ? Claim::Judged::holds : partly ? Claim::Judged::partly : Claim::Judged::fails;
}
/// The verdict on a claim that something is small: below 0.01 it is, below 0.1 in part.
constexpr Claim::Judged verdict_on_small(double share) {
  return verdict(share < 0.01, share < 0.1);
}

}  // namespace gonio
