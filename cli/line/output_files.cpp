#include "cli/line/output_files.h"

#include <filesystem>
#include <vector>

#include "base/json/reader.h"
#include "cli/line/command.h"

#include <fmt/format.h>

namespace gonio::cli {

OutputFiles::OutputFiles(const std::vector<std::string>& inputs,
                         const std::string& document,
                         const std::string& page) {
  const std::filesystem::path path(page);
  const std::string data =
      page.empty() ? "" : std::filesystem::path(path).replace_extension(".page.json").string();
  check_outputs(inputs, {document, page});
  if (!page.empty() && path.extension() != ".html")
    throw wrong_usage(fmt::format("--html {}: a page's name ends in .html", page));
  if (!document.empty()) document_.emplace(document);
  if (page.empty()) return;
  page_.emplace(page);
  page_data_.emplace(data, NamedBy::gonio);
}

void OutputFiles::write_document(std::string_view text) {
  if (!document_) return;
  if (text.size() > most_document_bytes)
    throw bad_input(document_->path(), "writing", fmt::format("{} bytes", text.size()),
                    fmt::format("at most {}, which are read", most_document_bytes));
  document_->write(text);
}

void OutputFiles::write_page(std::string_view html, std::string_view data) {
  page_->write(html);
  page_data_->write(data);
  page_data_->write("\n");
}

void OutputFiles::commit(std::initializer_list<OutputFile*> others) {
  std::vector<OutputFile*> all(others);
  for (auto* f : {&document_, &page_data_, &page_})
    if (*f) all.push_back(&**f);
  commit_all(all);
}

}  // namespace gonio::cli
