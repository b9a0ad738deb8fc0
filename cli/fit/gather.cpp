// gonio gather: a folder of results in, their summary out; of tiles, their map.
#include "fitting/batch/gather.h"

#include <algorithm>

#include "base/error.h"
#include "base/file.h"
#include "cli/fit/batch_words.h"
#include "cli/fit/map_result.h"
#include "cli/line/command.h"
#include "cli/line/terminal.h"
#include "fitting/batch/batch.h"
#include "reports/pages/batch_page.h"

#include <fmt/format.h>

namespace gonio::cli {
namespace {

struct GatherCall : Common {
  std::string folder, map;
  std::vector<std::string> tables;
};

/// Tables that should have a result: those that were named, else those of the batch that was begun last; and the way in which
/// they are fitted, as that batch says.
std::optional<BatchList> expected(const GatherCall& o) {
  auto list = read_list(o.folder);
  if (o.tables.empty()) return list;
  if (!list) list.emplace();
  list->tables = tables_of(o.tables);
  return list;
}

Exit run(const GatherCall& o) {
  use(o);
  expect_there(o.folder);
  if (has_tiles(o.folder)) {
    if (!o.tables.empty()) throw wrong_usage("tiles of a map are not results of tables: no FILE");
    return gather_map(o.folder, o.map, o);
  }
  if (!o.map.empty())
    throw wrong_usage(o.folder +
                      " holds no tiles of a map, which -o is for; the summary of tables is "
                      "written into their folder");
  Progress progress(o.quiet);
  progress("gathering " + o.folder);
  const auto list = expected(o);
  const BatchSummary s = gather(o.folder, list, batch_page_html);
  progress.clear();
  if (o.json) {
    fmt::print("{}", batch_json(s, false));
  } else {
    print_rows(s, 0);
    if (!s.missing.empty()) say("missing  {}: {}\n", s.missing.size(), some_of(s.missing));
    print_left_out(s);
    say_below("made by  ", s.made_with);
    print_summary_place(o.folder);
  }
  // Where nothing says which tables there are, what cannot be read may be the result of one.
  const auto lost = std::ranges::count(s.left_out, LeftOut::unreadable, &LeftOutDocument::why);
  if (!list && lost > 0)
    throw bad_input(o.folder, "documents", fmt::format("{} that cannot be read", lost),
                    "results of fits");
  return s.outcome();
}

}  // namespace

void add_gather(CommandLine& line) {
  auto [c, o] = line.command<GatherCall>(
      "gather",
      "Makes the summary of a folder of results, whoever wrote them, or joins the tiles of a map; "
      "names what is missing",
      "gonio fit @list.txt --part 1/2 -o results/; gonio fit @list.txt --part 2/2 -o results/\n"
      "  gonio gather results/\n  gonio gather tiles/ -o maps.exr",
      run);
  c.option("DIR", o->folder, "Folder that fits of many tables, or of tiles, wrote into").required();
  c.option("FILE", o->tables,
           "Tables that should have a result: several files, a folder, or @LIST (default: those of "
           "the fit that was begun last in DIR). One without is missing: exit 1");
  c.option("-o,--output", o->map, "OpenEXR file of the map whose tiles lie in DIR");
  add_follow_paths(c, *o);
  add_jobs(c, *o);
  add_output(c, *o);
}

}  // namespace gonio::cli
