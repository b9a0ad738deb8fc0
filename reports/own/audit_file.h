#pragma once
/// \file
/// The audit of a person's file: which laws each function keeps, where it fails in half, what it costs, which form it is.

#include <optional>
#include <string>
#include <vector>

#include "answer/file_functions.h"
#include "reports/own/nearest.h"
#include "reports/own/nearest_model.h"

namespace gonio {

/// A largest or smallest value and where it is.
struct FoundAt {
  double value = 0;
  std::string at;
};

struct FunctionAudit {
  FileFunction of;
  std::optional<FoundAt> normalisation;  ///< ∫ D cos θ dω, furthest from 1
  std::optional<FoundAt>
      reciprocity;                  ///< largest relative difference with light and view exchanged
  std::optional<FoundAt> albedo;    ///< the largest of a part: one colour at its upper bound
  std::optional<FoundAt> together;  ///< the largest of all parts, where it is more
  std::optional<FoundAt> darkest;   ///< the smallest, all colours at their upper bounds
  std::optional<FoundAt>
      usual;  ///< the albedo with defaults, at NoV 0.5, the largest of its channels
  /// Albedo of the highlight alone with F0 = 1 along the normal, at the narrowest width: 1 of a right one.
  std::optional<FoundAt> highlight;
  std::optional<FoundAt> lowest;  ///< below 0, else none
  std::size_t not_finite = 0;     ///< of the inputs looked at, in double
  std::string not_finite_at;      ///< the first of them
  std::string half;               ///< what it keeps in half, in a sentence
  std::optional<NearestForm> nearest;
  std::optional<NearestModel> model;  ///< of a whole model
  std::string no_model;               ///< why none of ours is beside it
  std::vector<std::string> slips;
  std::vector<std::string> to_check;       ///< right or wrong by what the caller passes
  std::vector<std::string> not_looked_at;  ///< what could not be, and why
};

/// Every function of a file, or the one that is named.
std::vector<FunctionAudit> audit_file(const std::string& name);
std::string to_json(const std::vector<FunctionAudit>&);
std::string text_of(const FunctionAudit&);

/// A file's function beside a form of the catalogue, or beside another file's.
struct TermComparison {
  std::string a, b, read_as;  ///< read_as: what was tried and taken, of a masking term G or V
  std::string pairs;          ///< which parameters stand for which, of whole models
  double largest = 0, rms = 0;
  std::string measure, at;
  std::size_t operations_a = 0, operations_b = 0;
  std::string half_a, half_b;
};
/// \param domain  ends of parameters, by name whatever its case
TermComparison compare_terms(const std::string& a,
                             const std::string& b,
                             const std::vector<std::pair<std::string, Range>>& domain);
/// A file's function that is a whole model beside a model: parameters by name, a width also as roughness, in three channels.
TermComparison compare_with_model(const std::string& own,
                                  const std::string& spec,
                                  const std::vector<std::pair<std::string, Range>>& domain);
std::string to_json(const TermComparison&);
std::string text_of(const TermComparison&);
/// True of an id of a term, with its role, or a file's function.
bool is_term_name(const std::string&);

}  // namespace gonio
