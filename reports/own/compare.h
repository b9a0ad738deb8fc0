#pragma once
/// \file
/// A function of a person's file beside ours, or beside another file's.

#include <cstddef>
#include <string>
#include <vector>

#include "reports/own/in_half.h"

namespace gonio {

/// A file's function beside a form of the catalogue, or beside another file's.
struct TermComparison {
  std::string a, b, read_as;  ///< read_as: what was tried and taken, of a masking term G or V
  std::string pairs;          ///< which parameters stand for which
  std::vector<std::string> only_a, only_b;  ///< parameters without one, with what they are at
  double largest = 0, rms = 0;
  std::string measure, at;
  std::string in_channels;  ///< " in one channel", where a function has three
  std::size_t operations_a = 0, operations_b = 0;
  std::string half_a, half_b;
};
/// Parameters stand for one another by name, and a width by each map that its name allows: the one of the least difference is taken.
/// \param domain  ends of parameters; equal ones set it, also of a parameter that only one side has
/// \throws Error  wrong usage of a name that neither side has, or that another stands for
TermComparison compare_terms(const std::string& a, const std::string& b, const Domain&);
/// A file's function that is a whole model beside a model, in the same way.
TermComparison compare_with_model(const std::string& own, const std::string& spec, const Domain&);
/// RMS of the difference of two terms of one role, by the same pairs.
double difference_between(std::size_t own_term, std::size_t other_term, const Domain&);
std::string to_json(const TermComparison&);
std::string text_of(const TermComparison&);
/// True of an id of a term, with its role, or a file's function.
bool is_term_name(const std::string&);

}  // namespace gonio
