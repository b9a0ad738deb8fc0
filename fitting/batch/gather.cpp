#include "fitting/batch/gather.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <filesystem>
#include <set>
#include <tuple>
#include <unordered_map>

#include "base/file.h"
#include "base/json/describe.h"
#include "base/memory_budget.h"
#include "base/sha256.h"
#include "fitting/batch/batch.h"
#include "fitting/batch/own_results.h"
#include "table/format/metadata.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

namespace gonio {

template <>
inline constexpr auto description<BatchList> = FieldList{
    constant_text("schema", "gonio.list/1"),
    Field{"made_with", &BatchList::made_with,
          "all that determines a result beside the table's bytes"},
    Field{"tables", &BatchList::tables, "paths of the tables of the batch that was begun last"}};

namespace {

namespace fs = std::filesystem;

constexpr std::string_view list_name = "summary.list.json", page_data_name = summary_names[1];
constexpr std::string_view side_part = "; side file ";

std::string place(const std::string& folder, std::string_view name) {
  return (fs::path(folder) / name).string();
}

/// Key of a kept result less what its side file adds.
std::string without_side_file(const std::string& made_with) {
  return made_with.substr(0, made_with.rfind(side_part));
}

// --- What lies in the folder ---

/// Document that may be of a batch.
struct Found {
  std::string name;
  fs::file_time_type written{};
  std::optional<ReadDocument> read =
      {};  ///< of a batch; its row is whole only if it was made in the way that was asked for
  std::string fault = {};  ///< why it cannot be read
  bool listed = false;     ///< it has the name that the list gives its table
};

/// Documents in the order of their names, but the summary's and those of known rows; none is read yet.
std::vector<Found> documents_in(const std::string& folder,
                                const std::map<std::string, BatchRow>& known) {
  std::vector<Found> all;
  try {
    for (const auto& e : fs::directory_iterator(folder)) {
      const std::string name = e.path().filename().string();
      std::error_code gone;
      if (e.path().extension() != ".json" || name.starts_with('.') || name == list_name ||
          name == page_data_name || known.contains(name) || !e.is_regular_file(gone))
        continue;
      all.push_back({name, e.last_write_time(gone)});
    }
  } catch (const fs::filesystem_error& e) {
    throw bad_input(folder, "opening", e.code().message(), "a readable folder");
  }
  std::ranges::sort(all, {}, &Found::name);
  return all;
}

bool is_made(const Found& d, const std::string& way) {
  return d.read && without_side_file(d.read->made_with) == way;
}

void read(const std::string& folder, Found& d) {
  try {
    d.read = read_document(path_beside(place(folder, d.name), d.name));  // no link to elsewhere
  } catch (const Error& e) {
    d.read.reset();
    d.fault = e.what();
  }
}

/// Documents of a batch: what is one, or was to be one and cannot be read; anything else is not for a summary.  Of those that were not
/// made in that way only the table's path is kept.
std::vector<Found> read_all(const std::string& folder,
                            std::vector<Found> all,
                            const std::string& way) {
  MemoryBudget memory(memory_allowed() / 2);
  std::atomic<std::size_t> kept = 0;
  tbb::parallel_for(std::size_t{0}, all.size(), [&](std::size_t i) {
    Found& d = all[i];
    std::error_code unknown;
    constexpr double times_the_file = 33;  // of brackets within brackets
    memory.with(times_the_file * static_cast<double>(fs::file_size(place(folder, d.name), unknown)),
                [&] { read(folder, d); });
    if (!d.read) return;
    if (!is_made(d, way)) d.read->row = {std::move(d.read->row.path), "", {}, "", {}, {}};
    if ((kept += memory_of(*d.read)) > most_of_all_rows)
      throw bad_input(folder, "documents",
                      fmt::format("more than {} bytes that a summary shows", most_of_all_rows),
                      "fewer");
  });
  std::erase_if(all, [](const Found& d) { return !d.read && d.fault.empty(); });
  return all;
}

/// The way in which most documents were made; of equals the first by its words.
std::string usual_way(const std::vector<Found>& all) {
  std::map<std::string, int> count;
  for (const auto& d : all)
    if (d.read) ++count[without_side_file(d.read->made_with)];
  const auto most = std::ranges::max_element(count, {}, &std::pair<const std::string, int>::second);
  return most == count.end() ? "" : most->first;
}

/// Documents of a folder without a list, and the way that is usual.  Most often it is that of the first: then each is read once.
std::pair<std::vector<Found>, std::string> read_all(const std::string& folder,
                                                    const std::vector<Found>& all) {
  std::string way;
  for (Found first : all) {
    read(folder, first);
    if (!first.read) continue;
    way = without_side_file(first.read->made_with);
    break;
  }
  auto found = read_all(folder, all, way);
  std::string usual = usual_way(found);
  if (usual != way) found = read_all(folder, all, usual);
  return {std::move(found), std::move(usual)};
}

/// Row of a document, with what lies beside it.
BatchRow row_of(const std::string& folder, Found& d) {
  BatchRow row = std::move(d.read->row);
  if (!row.fit) return row;
  row.document = d.name;
  if (const auto page = page_name(d.name); is_page_of(place(folder, page), place(folder, d.name)))
    row.page = page;
  return row;
}

BatchSummary summary_of(const std::string& folder,
                        const std::optional<BatchList>& list,
                        std::map<std::string, BatchRow> known) {
  BatchSummary s;
  std::vector<Found> found = documents_in(folder, known);
  if (list) {
    s.made_with = list->made_with;
    found = read_all(folder, std::move(found), s.made_with);
  } else {
    std::tie(found, s.made_with) = read_all(folder, found);
  }
  const auto tables = list ? list->tables : std::vector<std::string>();
  const auto names = document_names(tables);

  // The best document of each table, by the table's path; one that the list names, by its place
  // there, too: two tables may have one path in documents, where bytes that are no text are
  // replaced.
  constexpr std::size_t unlisted = 0;
  std::map<std::pair<std::string, std::size_t>, Found*> best;
  const auto leave_out = [&](const Found& d, LeftOut why) {
    s.left_out.push_back(
        {d.name, why, d.read ? d.read->row.path : "", d.read ? d.read->made_with : "", d.fault});
  };
  std::unordered_map<std::string_view, std::size_t> table_of_name;
  std::vector<std::string> in_document;
  for (std::size_t i = 0; i < tables.size(); ++i) {
    table_of_name[names[i]] = i;
    in_document.push_back(as_in_document(tables[i]));
  }
  const auto before = [](const Found& a, const Found& b) {
    return std::tuple(a.listed, a.written) > std::tuple(b.listed, b.written);
  };
  for (auto& d : found) {
    if (!d.read) {
      leave_out(d, LeftOut::unreadable);
    } else if (!is_made(d, s.made_with)) {
      leave_out(d, LeftOut::made_otherwise);
    } else {
      const auto own = table_of_name.find(d.name);
      d.listed = own != table_of_name.end() && in_document[own->second] == d.read->row.path;
      auto& taken = best[{d.read->row.path, d.listed ? own->second + 1 : unlisted}];
      if (taken) leave_out(before(d, *taken) ? *taken : d, LeftOut::another_of_its_table);
      if (!taken || before(d, *taken)) taken = &d;
    }
  }

  for (std::size_t i = 0; i < tables.size(); ++i) {
    auto at = best.find({in_document[i], i + 1});
    const auto other = best.find({in_document[i], unlisted});
    if (at == best.end()) {
      at = other;
    } else if (other != best.end()) {
      leave_out(*other->second, LeftOut::another_of_its_table);
      best.erase(other);
    }
    if (const auto row = known.find(names[i]); row != known.end()) {
      if (at != best.end()) leave_out(*at->second, LeftOut::another_of_its_table);
      s.rows.push_back(std::move(row->second));
    } else if (at != best.end()) {
      s.rows.push_back(row_of(folder, *at->second));
      s.rows.back().path = tables[i];
    } else {
      s.missing.push_back(tables[i]);
    }
    if (at != best.end()) best.erase(at);
  }
  for (const auto& [path, d] : best) s.rows.push_back(row_of(folder, *d));
  std::ranges::sort(s.left_out, {}, &LeftOutDocument::document);
  return s;
}

/// Name of a folder as its page's title.
std::string title_of(const std::string& folder) {
  const auto path = fs::path(folder).lexically_normal();
  return (path.has_filename() ? path : path.parent_path()).filename().string();
}

}  // namespace

void write_list(const std::string& folder, const BatchList& list) {
  const std::string path = place(folder, list_name), text = json_text(list);
  if (text.size() > most_document_bytes)
    throw bad_input(path, "writing", fmt::format("{} tables", list.tables.size()),
                    fmt::format("names in at most {} bytes, which are read", most_document_bytes));
  std::error_code unknown;
  may_replace(path);
  if (fs::file_size(path, unknown) == text.size() && !unknown &&
      InputFile(path).read_rest() == text)
    return;
  write_file(path, text, NamedBy::gonio);
}

std::optional<BatchList> read_list(const std::string& folder) {
  const std::string path = place(folder, list_name);
  may_replace(path);
  try {
    BatchList list;
    read_record(JsonDocument(path).root(), list);
    return list;
  } catch (const Error&) {
    return {};  // not there, or not what a batch writes
  }
}

std::string list_schema() {
  return schema_text<BatchList>("Tables of a batch");
}

std::string page_name(const std::string& document) {
  return fs::path(document).replace_extension(".fit.html").string();
}

bool is_page_of(const std::string& page, const std::string& document) {
  std::error_code unknown;
  return fs::exists(page, unknown) &&
         fs::last_write_time(page, unknown) >= fs::last_write_time(document, unknown) && !unknown;
}

std::string with_side_file(const std::string& made_with, const std::string& table) {
  std::error_code unknown;
  const auto side = side_path(table);
  if (!fs::exists(side, unknown)) return made_with;
  constexpr std::uint64_t most = std::uint64_t{1} << 24;  // as it is read
  return fmt::format("{}{}{}", made_with, side_part, sha256_of_file(InputFile(side), most));
}

BatchSummary gather(const std::string& folder,
                    const std::optional<BatchList>& list,
                    const SummaryPage& page,
                    std::map<std::string, BatchRow> known) {
  const FolderLock lock(folder, FolderLock::Taken::waits);
  BatchSummary s = summary_of(folder, list, std::move(known));
  if (!list && s.rows.empty() && s.left_out.empty())
    throw bad_input(folder, "entries", "no result of a fit", "documents of gonio fit -o DIR");
  expect_own(folder, {}, {summary_names.begin(), summary_names.end()});
  OutputFile csv(place(folder, "summary.csv"), NamedBy::gonio),
      page_data(place(folder, page_data_name), NamedBy::gonio);
  csv.write(batch_csv(s.rows));
  page_data.write(batch_json(s, true));
  page_data.write("\n");
  std::optional<OutputFile> html;
  if (page)
    html.emplace(place(folder, "summary.html"), NamedBy::gonio).write(page(s, title_of(folder)));
  commit_all(std::array{&csv, &page_data, html ? &*html : nullptr}, &lock);
  return s;
}

}  // namespace gonio
