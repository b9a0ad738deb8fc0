#include "cli/fit/fit_options.h"

namespace gonio::cli {

void add_tables(Command& c, std::vector<std::string>& files) {
  c.option("FILE", files,
           "A table, its format found from the bytes; or many: several files, a "
           "folder, or @LIST with a path on each line")
      .required();
}

Option add_pages(Command& c, bool& pages) {
  return c.flag("--pages", pages,
                "With many tables: a page of each, NAME.fit.html, to which summary.html links");
}

}  // namespace gonio::cli
