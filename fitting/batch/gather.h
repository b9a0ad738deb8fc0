#pragma once
/// \file
/// Summaries of a folder of results, made from the documents that lie there, whoever wrote them.

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fitting/batch/batch_document.h"

namespace gonio {

/// Files of a folder's summary.
inline constexpr std::array<const char*, 3> summary_names{"summary.csv", "summary.page.json",
                                                          "summary.html"};

/// Tables that a folder of results is to hold: those of the batch that was begun last; and the way in which they are fitted.
struct BatchList {
  std::string made_with;
  std::vector<std::string> tables;
};
/// Document of schema "gonio.list/1", summary.list.json of the folder; not written again where it says the same.
void write_list(const std::string& folder, const BatchList&);
/// No value where there is none, or none that can be read.
std::optional<BatchList> read_list(const std::string& folder);
/// JSON Schema of it.
std::string list_schema();

/// Name of a table's page, which no document nor the summary has.
std::string page_name(const std::string& document);
/// True where the page is there and was written after the document: what it shows is that.
bool is_page_of(const std::string& page, const std::string& document);

/// Key of a kept result as a table's own is made of it: a change of its side file is a change of the input.
std::string with_side_file(const std::string& made_with, const std::string& table);

/// Page of a summary, HTML.
using SummaryPage = std::function<std::string(const BatchSummary&, const std::string& title)>;

/// Makes the summary of a folder, as summary.csv, .html and .page.json: the tables of the list in its order, then all others
/// of which a document of the same version and options lies there, by their paths.  Of two documents of one table the one under the name that
/// the list gives it is taken, else the newer.
///
/// Two processes that do this at once do it one after the other, where the file system can lock a folder: the later knows
/// what both wrote.
///
/// \param list   of no list the tables are those of the documents, and the way is that of most of them
/// \param known  rows by their documents' names, which are not read; one for each table of the list, if any
/// \param page   without it none is made
/// \throws bad_input  of a folder that cannot be read or written, or has no result and no list
BatchSummary gather(const std::string& folder,
                    const std::optional<BatchList>& list,
                    const SummaryPage& page,
                    std::map<std::string, BatchRow> known = {});

}  // namespace gonio
