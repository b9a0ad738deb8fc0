#pragma once
/// \file
/// Words that say how tables are fitted, for the commands that fit and those that have it done elsewhere.

#include <optional>
#include <string>
#include <vector>

#include "cli/line/command.h"
#include "fitting/batch/batch.h"

namespace gonio::cli {

struct FitWords {
  std::string metric = "log", intervals = "automatic", robust = "none", copies = "leave_out";
  std::string certificate = "auto";
  std::vector<std::string> fix, bounds;
  FitOptions fit;
  std::optional<std::string> bins;
};
/// The tables: files, folders, @LIST.
void add_tables(Command&, std::vector<std::string>& files);
/// --model, --fix, --bounds and --grey, which fits of tables and of texels share.
std::vector<Option> add_model_words(Command&,
                                    std::string& model,
                                    std::vector<std::string>& fix,
                                    std::vector<std::string>& bounds,
                                    std::vector<std::string>& grey);
/// --metric
Option add_metric(Command&, std::string& metric);
/// \return  the options, each of which may be asked for the words that this call gives it
std::vector<Option> add_fit_words(Command&, FitWords&);
/// --pages
Option add_pages(Command&, bool& pages);
/// Refuses words that nobody knows by wrong_usage.
HowFitted how_fitted(const FitWords&);

}  // namespace gonio::cli
