#pragma once
/// \file
/// Requests of a page about tables that people give it: read, fit, compare models.  The program's own functions answer them, with the
/// program's own documents.  Compiled twice, as src/explore is: for tests, and as WebAssembly.

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "base/names.h"
#include "fitting/batch/fit_file.h"

namespace gonio {

enum class PageCommand {
  read,  ///< the table as explorer pages hold it, its inspection, and for text what its columns may
         ///< be
  fit,   ///< gonio.fit/1 as text, and the optimum's values by parameter
  models  ///< gonio.models/1
};
template <>
inline constexpr std::array<std::string_view, 3> names_of<PageCommand>{"read", "fit", "models"};

struct PageRequest {
  PageCommand command = PageCommand::read;
  std::string file;  ///< its side file, if it has one, lies beside it
  std::vector<std::pair<std::string, std::vector<std::string>>>
      options;                      ///< words of the options of HowFitted
  std::vector<std::string> models;  ///< of `models`
};
template <>
inline constexpr auto description<PageRequest> = FieldList{
    Field{"do", &PageRequest::command, "what is asked"},
    Field{"file", &PageRequest::file, "the table", not_empty},
    Field{"options", &PageRequest::options, "words of gonio fit's options", or_default},
    Field{"models", &PageRequest::models, "models to compare", Entries{0, 64}, or_default}};
static_assert(describes_every_member<PageRequest>());

/// The answer to a request in JSON, as JSON.
/// \param phase  called with what is being done
/// \throws Error  as the program ends with
std::string answer_page(const std::string& request,
                        const std::function<void(const std::string&)>& phase);

}  // namespace gonio
