#pragma once
/// \file
/// Files that a run leaves behind: a document, a page, or both.

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/file.h"

namespace gonio::cli {

/// A document, and a page NAME.html with its data beside it, NAME.page.json.  Opened before the work:
/// nobody waits for it to learn that its result has no place.
class OutputFiles {
 public:
  /// Refuses what check_outputs() does, and a page of another name: two would share one NAME.page.json.
  /// \param document, page  paths; "" for none
  OutputFiles(const std::vector<std::string>& inputs,
              const std::string& document,
              const std::string& page);

  bool has_page() const { return page_.has_value(); }
  /// Nothing where there is no document.
  void write_document(std::string_view text);
  /// \param data  one JSON document
  void write_page(std::string_view html, std::string_view data);
  /// All are whole before the first takes its name.
  /// \param others  of the same run; nullptr: none
  void commit(std::initializer_list<OutputFile*> others = {});

 private:
  std::optional<OutputFile> document_, page_, page_data_;
};

}  // namespace gonio::cli
