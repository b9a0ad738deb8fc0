#include "fitting/batch/own_results.h"

#include <filesystem>
#include <string_view>
#include <unordered_set>

#include "base/error.h"
#include "base/file.h"
#include "fitting/batch/batch.h"

namespace gonio {
namespace {

/// True of a file that begins like those that gonio writes.
bool begins_with(const std::string& path, std::string_view what, std::size_t within) {
  may_replace(path);
  try {
    return InputFile(path).peek(within).find(what) != std::string::npos;
  } catch (const Error&) {
    return false;
  }
}

}  // namespace

bool is_page(const std::string& path) {
  return begins_with(path, R"(<meta name="generator" content="gonio">)", 1024);
}

void expect_own(const std::string& folder,
                const std::vector<std::string>& documents,
                const std::vector<std::string>& results) {
  std::unordered_set<std::string> own;
  if (const auto earlier = read_list(folder)) {
    own = {summary_names.begin(), summary_names.end()};
    for (auto& name : document_names(earlier->tables)) {
      own.insert(page_name(name));
      own.insert(std::move(name));
    }
  }
  const std::unordered_set<std::string> of_tables(documents.begin(), documents.end());
  std::error_code none;
  for (const auto& name : results) {
    const std::string path = (std::filesystem::path(folder) / name).string();
    if (std::filesystem::is_symlink(path, none))
      throw bad_input(path, "writing", "a link", "a file of the folder itself (remove the link)");
    if (!std::filesystem::is_regular_file(path, none)) continue;
    // Of a file that an earlier run listed the beginning is enough.
    const bool is_known = own.contains(name);
    const bool made_by_gonio = of_tables.contains(name) && !is_known ? is_batch_document(path)
                               : name.ends_with(".html")             ? is_page(path)
                               : name.ends_with(".csv")
                                   ? begins_with(path, "path,document,status", 32)
                                   : begins_with(path, "\"gonio.", 1024);
    if (!made_by_gonio)
      throw bad_input(path, "writing", "a file that no batch made",
                      "another folder for results, or that file elsewhere");
  }
}

}  // namespace gonio
