// What a page has not: files that are written, OpenEXR and XML, and a clock that is fine enough to
// time models by.
#include <limits>

#include "base/earlier_file.h"
#include "base/error.h"
#include "base/file.h"
#include "table/format/exr_slice.h"
#include "table/format/klems.h"
#include "timing/timing.h"

namespace gonio {

void will_read(const std::string&) {}
void may_replace(const std::string&) {}
void expect_no_input(const std::string&, NamedBy) {}
bool remove_unless_input(const std::string&) {
  return false;
}
OutputFile::OutputFile(std::string path, NamedBy by) : by_(by) {
  throw wrong_usage(path + ": a page writes no files");
}
OutputFile::~OutputFile() = default;
void OutputFile::write(std::string_view) {}
void OutputFile::close() {}
void OutputFile::commit() {}
void write_file(const std::string& path, std::string_view, NamedBy) {
  OutputFile out(path);
}
std::string path_beside(const std::string& document, const std::string&) {
  throw wrong_usage(document + ": a page reads no files that another names");
}

Table read_exr_slice(const std::string& path) {
  throw bad_input(path, "byte 0", "OpenEXR",
                  "a file that a page reads: gonio convert makes CSV of it");
}
void write_exr_slice(const Table&, const std::string& path) {
  OutputFile out(path);
}
bool is_klems(std::string_view head) {
  return head.find("<WindowElement") != head.npos;
}
Table read_klems(InputFile& in) {
  throw bad_input(in.path(), "the beginning", "XML",
                  "a file that a page reads: gonio convert makes CSV of it");
}

std::vector<Timing> time_all(const std::vector<Timed>& all,
                             const TimingOptions&,
                             const std::function<void(double)>&) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  return std::vector<Timing>(all.size(), {unknown, unknown});
}

}  // namespace gonio
