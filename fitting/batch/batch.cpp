#include "fitting/batch/batch.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <filesystem>
#include <future>
#include <map>
#include <mutex>
#include <new>
#include <unordered_map>
#include <unordered_set>

#include "base/earlier_file.h"
#include "base/file.h"
#include "base/json/describe.h"
#include "base/memory_budget.h"
#include "base/sha256.h"
#include "base/text.h"
#include "brdf/model/own_files.h"
#include "fitting/batch/own_results.h"
#include "table/format/formats.h"
#include "table/format/metadata.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace gonio {
namespace {

namespace fs = std::filesystem;

// --- Inputs and outputs ---

/// True of what may be a table: not a folder, nothing hidden, none of gonio's own documents and pages.
bool may_be_table(const fs::directory_entry& e) {
  std::error_code unknown;
  const std::string name = e.path().filename().string(), ending = e.path().extension().string();
  return !name.starts_with('.') && ending != ".json" && ending != ".html" &&
         !e.is_directory(unknown);
}

std::vector<std::string> in_folder(const std::string& folder) {
  std::vector<std::string> all;
  try {
    for (const auto& e : fs::directory_iterator(folder))
      if (may_be_table(e)) all.push_back(e.path().string());
  } catch (const fs::filesystem_error& e) {
    throw bad_input(folder, "opening", e.code().message(), "a readable folder");
  }
  std::ranges::sort(all);
  if (all.empty()) throw bad_input(folder, "entries", "no files", "tables");
  return all;
}

/// One path a line.
std::vector<std::string> in_list(const std::string& list) {
  constexpr std::size_t most = std::size_t{1} << 20, longest = 4096;
  InputFile file(list);
  const std::string text = file.read_rest(most_document_bytes);
  std::vector<std::string> all;
  for (std::size_t at = 0, end = 0; at < text.size(); at = end + 1) {
    end = std::min(text.find('\n', at), text.size());
    std::string_view line(text.data() + at, end - at);
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (line.find('\0') != line.npos) throw bad_input(list, "a path", std::string(line), "text");
    if (line.empty()) continue;
    if (line.size() >= longest)
      throw bad_input(list, "a path", counted(line.size(), "byte"),
                      fmt::format("fewer than {}", longest));
    if (all.size() == most)
      throw bad_input(list, "lines", fmt::format("more than {} paths", most), "fewer");
    all.emplace_back(line);
  }
  if (all.empty()) throw bad_input(list, "lines", "none", "the path of a table on each");
  return all;
}

/// Refuses results that would overwrite a table, or be taken for tables the next time.
void expect_apart(const Batch& b, const std::vector<std::string>& results) {
  std::error_code none;
  for (const auto& in : b.inputs)
    if (fs::is_directory(in, none) && fs::equivalent(in, b.output, none))
      throw wrong_usage(fmt::format("{} is a folder of tables; results go elsewhere", b.output));
  for (const auto& r : results) expect_no_input((fs::path(b.output) / r).string(), NamedBy::gonio);
}

// --- How many at a time ---

/// Work that goes on behind a lane's next table, one piece at a time, on a thread of its own: it waits for the disk.
class Behind {
 public:
  /// Begins a piece when the one before has ended; throws what that threw.
  template <class Work>
  void begin(Work work) {
    wait();
    running_ = std::async(std::move(work));
  }
  void wait() {
    if (running_.valid()) running_.get();
  }

 private:
  std::future<void> running_;
};

/// Calls one(i, behind) for each table; what was begun behind has ended at the end.
///
/// There is a lane for each thread; a table waits while those of the others have the memory that it needs.  A thread that waits for
/// its table's loops takes none of another table meanwhile (isolate): no more tables are in memory than there are lanes.  Threads without a lane help those that have one.  No
/// exception leaves a lane: it would cancel the loops of the others halfway, and their results would be
/// wrong, not missing.
template <class One>
void in_lanes(const std::vector<std::string>& tables, const One& one) {
  std::atomic<std::size_t> next = 0;
  std::atomic<bool> stop = false;
  std::exception_ptr fatal;
  constexpr std::size_t most = 64;
  MemoryBudget memory(memory_allowed() / 2);
  tbb::parallel_for(
      std::size_t{0},
      std::min({tables.size(), most,
                tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism)}),
      [&](std::size_t) {
        Behind behind;
        try {
          for (std::size_t i; !stop && (i = next++) < tables.size();)
            memory.with(memory_needed(tables[i]),
                        [&] { tbb::this_task_arena::isolate([&] { one(i, behind); }); });
          behind.wait();
        } catch (...) {
          if (!stop.exchange(true)) fatal = std::current_exception();
        }
      },
      tbb::simple_partitioner());
  if (fatal) std::rethrow_exception(fatal);
}

// --- One table ---

struct Place {
  std::string path, name;            ///< of the document
  std::string page_path, page_name;  ///< empty where no pages are made
};

/// The row of a table that was fitted before, in the same way, if it was.
std::optional<BatchRow> kept(const std::string& table, const Place& to, const std::string& made) {
  std::error_code unknown;
  if (!fs::exists(to.path, unknown)) return {};
  auto row = read_batch_document(to.path, sha256_of_file(table), made);
  if (!row) return {};
  row->path = table;
  row->document = to.name;
  if (!to.page_path.empty()) {
    if (!is_page_of(to.page_path, to.path)) return {};
    row->page = to.page_name;
  }
  return row;
}

/// True where a batch made the page that lies beside its document.
bool is_own_page(const std::string& page, const std::string& document) {
  return is_page_of(page, document) && is_page(page);
}

/// Why there is no fit; its document takes the place of that of what the table was before.
BatchRow failed(const std::string& table,
                const Place& to,
                const std::string& made,
                Exit outcome,
                const std::string& line) {
  BatchRow row{table, "", outcome, line, {}, {}};
  std::error_code unknown;
  const bool was_there = fs::exists(to.path, unknown);
  if (was_there && !is_batch_document(to.path)) return row;  // it is somebody's own
  const std::string page = page_name(to.path);
  const bool has_page = was_there && is_own_page(page, to.path);
  write_file(to.path, failure_document(row, made), NamedBy::gonio);
  if (has_page) remove_unless_input(page);
  return row;
}

struct Fitted {
  BatchRow row;
  std::string document, page;
};
Fitted fitted(const Batch& b,
              const BatchHooks& hooks,
              const std::string& table,
              const Place& to,
              const std::string& made) {
  const FittedFile f = fit_files({table}, b.how);
  const FitDocument& d = f.result.document;
  std::string document = batch_document(d, make_preview(f.table, f.result.drawn()), made);
  BatchRow row = parse_document(to.path, document)->row;
  row.path = table;
  row.document = to.name;
  row.page = to.page_name;
  std::string page = hooks.table_page ? hooks.table_page(f) : "";
  return {std::move(row), std::move(document), std::move(page)};
}

/// Both or neither; the page last, so that it is no older than what it shows.
void write(const Place& to, const Fitted& f) {
  OutputFile document(to.path, NamedBy::gonio);
  document.write(f.document);
  std::optional<OutputFile> page;
  if (!to.page_path.empty()) page.emplace(to.page_path, NamedBy::gonio).write(f.page);
  commit_all(std::array{&document, page ? &*page : nullptr});
}

}  // namespace

std::string made_with(const HowFitted& how) {
  /// Nothing where it says nothing.
  const auto nothing = [](const Json& value) {
    return value.empty() || value == Json(false) || value == Json("");
  };
  std::string text = "gonio " GONIO_VERSION;
  const Json described = json_of(how);
  for (const auto& [name, value] : described.items())
    if (!nothing(value))
      text +=
          fmt::format("; {} {}", name, value.is_string() ? value.get<std::string>() : value.dump());
  for (const auto& f : own_files({how.options.model}))
    text += fmt::format("; {} {}", f.file, f.sha256);
  return text;
}

std::vector<std::string> tables_of(const std::vector<std::string>& inputs) {
  std::vector<std::string> all;
  std::error_code none;  // what cannot be looked up is a table that cannot be read
  for (const auto& in : inputs) {
    if (in.starts_with('@'))
      std::ranges::move(in_list(in.substr(1)), std::back_inserter(all));
    else if (fs::is_directory(in, none))
      std::ranges::move(in_folder(in), std::back_inserter(all));
    else
      all.push_back(in);
  }
  std::unordered_set<std::string> seen;
  std::erase_if(all, [&](const std::string& path) { return !seen.insert(path).second; });
  for (const auto& table : all)
    for (const auto& path : {table, side_path(table)}) will_read(path);
  return all;
}

std::vector<std::string> document_names(const std::vector<std::string>& as_named) {
  std::vector<std::string> tables;  // as a list has them, from which they are named once more
  std::ranges::transform(as_named, std::back_inserter(tables), as_in_document);
  constexpr std::size_t longest = 200;  // room for what goes around it while it is written
  std::unordered_map<std::string, int> sharing, next;
  for (const auto& t : tables) ++sharing[fs::path(t).stem().string()];
  std::unordered_set<std::string> taken{"summary.page", "summary.list"};
  std::vector<std::string> names;
  for (const auto& t : tables) {
    const fs::path p(t);
    const bool alone = sharing[p.stem().string()] == 1;
    std::string whole = (alone ? p.stem() : p.filename()).string();
    if (whole.starts_with('.')) whole.insert(0, "_");  // hidden files are no results
    const std::string wanted(beginning(whole, longest));
    std::string name = wanted;
    int& k = next.try_emplace(wanted, 2).first->second;
    while (!taken.insert(name).second) name = fmt::format("{}-{}", wanted, k++);
    names.push_back(name + ".json");
  }
  return names;
}

bool is_batch(const std::vector<std::string>& inputs) {
  std::error_code none;
  return inputs.size() > 1 || inputs[0].starts_with('@') || fs::is_directory(inputs[0], none);
}

BatchResult fit_batch(const Batch& b, const BatchHooks& hooks) {
  if (b.output.empty()) throw wrong_usage("many tables need a folder for their results: -o DIR");
  check(b.how.options);
  const auto all = tables_of(b.inputs);
  const auto all_names = document_names(all);
  const std::string made = made_with(b.how);

  std::vector<std::string> results(summary_names.begin(), summary_names.end());
  results.emplace_back("summary.list.json");
  results.insert(results.end(), all_names.begin(), all_names.end());
  if (hooks.table_page) std::ranges::transform(all_names, std::back_inserter(results), page_name);
  expect_apart(b, results);
  expect_own(b.output, all_names, results);
  const auto place = [&](const std::string& name) { return (fs::path(b.output) / name).string(); };
  const BatchList list{made, all};
  try {
    std::error_code error;
    fs::create_directories(b.output, error);
    if (error) throw bad_input(b.output, "making the folder", error.message(), "a place to write");
    OutputFile(place("summary.csv"),
               NamedBy::gonio);  // nobody waits for a batch to learn that it has no place
  } catch (const Error&) {
    std::ranges::for_each(all, expect_there);  // that is the nearer mistake
    throw;
  }
  write_list(b.output, list);

  std::vector<std::string> tables, names;
  for (const std::size_t i : share_of(b.part.value_or(Part{}), all.size())) {
    tables.push_back(all[i]);
    names.push_back(all_names[i]);
  }
  std::vector<BatchRow> rows(tables.size());
  BatchCount count{tables.size()};
  std::mutex counting;
  const auto say = [&] {
    if (hooks.progress) hooks.progress(count);
  };
  const auto add = [&](const BatchRow& row, bool was_kept) {
    const std::lock_guard lock(counting);
    ++count.done;
    count.kept += was_kept;
    count.failed += row.document.empty();
    say();
  };
  say();
  const auto one = [&](std::size_t i, Behind& behind) {
    Place to{place(names[i]), names[i], "", ""};
    if (hooks.table_page) {
      to.page_name = page_name(names[i]);
      to.page_path = place(to.page_name);
    }
    std::optional<Fitted> fresh;
    try {
      const std::string how = with_side_file(made, tables[i]);
      if (auto row = kept(tables[i], to, how)) {
        rows[i] = std::move(*row);
        return add(rows[i], true);
      }
      fresh = fitted(b, hooks, tables[i], to, how);
    } catch (const Error& e) {
      rows[i] = failed(tables[i], to, made, e.code(), e.what());
    } catch (const NameTaken&) {
      throw;
    } catch (const std::bad_alloc&) {
      rows[i] =
          failed(tables[i], to, made, Exit::bad_input, printable(tables[i]) + ": out of memory");
    } catch (const std::exception& e) {
      rows[i] = failed(tables[i], to, made, Exit::bad_input,
                       printable(tables[i]) + ": " + printable(e.what()));
    }
    if (!fresh) return add(rows[i], false);
    behind.begin([&, i, to = std::move(to), done = std::move(*fresh)]() mutable {
      write(to, done);
      rows[i] = std::move(done.row);
      add(rows[i], false);
    });
  };

  in_lanes(tables, one);
  if (b.part) return {{made, std::move(rows), {}, {}, text_of(*b.part)}, count};
  std::map<std::string, BatchRow> known;
  for (std::size_t i = 0; i < rows.size(); ++i) known.emplace(names[i], std::move(rows[i]));
  BatchResult result{gather(b.output, list, hooks.page, std::move(known)), count};
  result.others = result.rows.size() - tables.size();
  result.rows.resize(tables.size());
  return result;
}

}  // namespace gonio
