#include "table/format/formats.h"

#include <cstdio>
#include <exception>
#include <filesystem>
#include <set>
#include <string_view>

#include "base/earlier_file.h"
#include "base/error.h"
#include "base/file.h"
#include "base/json/reader.h"
#include "base/sha256.h"
#include "table/format/delimited.h"
#include "table/format/metadata.h"
#include "table/format/no_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tbb/task_arena.h>

namespace gonio {
namespace {

bool is_exr(std::string_view head) {
  return head.starts_with(std::string_view("\x76\x2f\x31\x01", 4));
}

/// Format of a table's file.
struct Format {
  std::string_view name;   ///< as Table::format
  std::string_view title;  ///< as its users call it
  bool (*is)(std::string_view head, std::uint64_t size);
  Table (*read)(InputFile&);
  void (*write)(const Table&, OutputFile&, const std::string& path) = nullptr;  ///< null: read only
  bool in_columns = false;  ///< lines of text, which a column map reads as CSV
};

template <bool (*is)(std::string_view)>
bool by_head(std::string_view head, std::uint64_t) {
  return is(head);
}

/// A file is of the first format whose `is` says so.
constexpr Format formats[]{
    {"exr", "OpenEXR image slice", by_head<is_exr>,
     [](InputFile& in) { return read_exr_slice(in.path()); }},  // written by write_table
    {"mbsdf", "MBSDF", by_head<is_mbsdf>, read_mbsdf, write_mbsdf},
    {"rgl", "RGL", by_head<is_rgl>, read_rgl, write_rgl},
    {"klems", "Klems or tensor tree XML", by_head<is_klems>, read_klems},
    {"alta", "ALTA", by_head<is_alta>, read_alta, nullptr, true},
    {"zemax", "Zemax BSDF", by_head<is_zemax>, read_zemax, write_zemax},
    {"brdf_json", "BRDF-JSON", by_head<is_brdf_json>, read_brdf_json},
    {"xompt", "OpenMATERIAL", by_head<is_xompt>, read_xompt},
    {"astm", "ASTM E1392", by_head<is_astm>, read_astm, nullptr, true},
    {"ssdd", "SSDD", by_head<is_ssdd>, read_ssdd, nullptr, true},
    {"merl", "MERL", is_merl, read_merl, write_merl},
    {"ngan", "MIT CSAIL", by_head<is_ngan>, read_ngan},
    {"csv", "CSV", by_head<is_csv>, [](InputFile& in) { return read_csv(in); },
     [](const Table& t, OutputFile& out, const std::string&) { write_csv(t, out); }, true},
    {"utia", "UTIA", [](std::string_view, std::uint64_t size) { return is_utia(size); }, read_utia,
     write_utia}};  // known by its size alone: the last

constexpr std::uint64_t most_table_bytes = std::uint64_t{1} << 31;

/// "CSV, MERL or RGL"
std::string one_of(std::string_view Format::*name, bool (*those)(const Format&)) {
  std::vector<std::string_view> names;
  for (const auto& f : formats)
    if (those(f)) names.push_back(f.*name);
  const auto last = names.back();
  names.pop_back();
  return fmt::format("{} or {}", fmt::join(names, ", "), last);
}

Table read_by_format(InputFile& in, const ColumnMap* map) {
  const std::string head = in.peek(1 << 16);
  for (const auto& f : formats) {
    if (f.name == "csv") expect_no_foreign_format(in.path(), head);
    if (map && f.name == "csv") return read_csv(in, map);
    if (!(map && f.in_columns) && f.is(head, in.size())) return f.read(in);
  }
  expect_no_utf16(in.path(), head);
  throw bad_input(in.path(), "byte 0", "an unknown format: " + head.substr(0, 24),
                  "a table as " + one_of(&Format::title, [](const Format&) { return true; }));
}

void write_by_format(const Table& t, OutputFile& out, const std::string& path) {
  for (const auto& f : formats)
    if (f.write && f.name == t.format) return f.write(t, out, path);
  throw wrong_usage(
      fmt::format("unknown table format '{}': use exr, {}", t.format,
                  one_of(&Format::name, [](const Format& f) { return f.write != nullptr; })));
}

}  // namespace

std::string side_text(const std::string& path) {
  namespace fs = std::filesystem;
  const std::string side = side_path(path);
  std::error_code why;
  const auto there = fs::symlink_status(side, why);
  // A name that is too long is nobody's.
  if (there.type() == fs::file_type::not_found || why == std::errc::filename_too_long) return "";
  if (fs::is_symlink(there) && !fs::exists(side, why))
    throw bad_input(side, "opening", "a link to " + fs::read_symlink(side).string(),
                    "a link to a file that is there, or none");
  return InputFile(side).read_rest(std::uint64_t{1} << 24);
}

/// SHA-256 of an open file, made by whichever thread has nothing else to do.
/// Digest of a file, made by a thread of its own where more than one may run: waiting for one needs no memory, which for a task of
/// TBB's it may.
class TableAndDigest::Digest {
 public:
  explicit Digest(const std::string& path) : file_(path) {
    file_.expect_at_most(most_table_bytes);  // before all of it is read for its name
  }
  ~Digest() {
    if (work_.joinable()) work_.join();
  }
  InputFile& file() { return file_; }
  void begin() {
    if (tbb::this_task_arena::max_concurrency() == 1) return;
    try {
      work_ = std::thread([this] { make(); });
    } catch (const std::system_error&) {  // no thread to be had: whoever waits makes it
    }
  }
  const std::string& wait() {
    if (work_.joinable())
      work_.join();
    else if (digits_.empty())
      make();
    if (failure_) std::rethrow_exception(failure_);
    return digits_;
  }

 private:
  void make() {
    try {
      digits_ = sha256_of_file(file_);
    } catch (...) {
      failure_ = std::current_exception();
    }
  }

  InputFile file_;
  std::thread work_;
  std::string digits_;
  std::exception_ptr failure_;
};

namespace {

/// Table as its file alone has it.  \param side  says how to read the columns
Table read_open(InputFile& in, const std::string& side) {
  const auto map = side.empty() ? std::nullopt : column_map(side_path(in.path()), side);
  Table t = read_by_format(in, map ? &*map : nullptr);
  in.expect_unchanged();
  std::set<std::string_view> names;
  for (const auto& name : t.channels)
    if (!names.insert(name).second)
      throw bad_input(in.path(), "channels", fmt::format("two named '{}'", name),
                      "one of each name");
  t.path = in.path();
  return t;
}

void describe(Table& t, const std::string& side, std::optional<Bins> bins) {
  if (!side.empty()) apply_metadata(t, side_path(t.path), side);
  if (auto* g = std::get_if<Grid>(&t.where); g && bins) g->bins = *bins;
}

/// Refuses to write a table where someone described another by hand: that would be lost, or speak of the wrong one.
void expect_own_side(const std::string& path) {
  const std::string side = side_path(path);
  std::error_code why;
  if (!std::filesystem::exists(std::filesystem::symlink_status(side, why))) return;
  expect_no_input(side, NamedBy::gonio);
  may_replace(side);
  try {
    if (JsonDocument(side, side_text(path)).root().has("sha256"))
      return;               // so far only gonio names its table
  } catch (const Error&) {  // nothing that gonio wrote
  }
  throw bad_input(side, "writing the table beside it", "a side file that was written by hand",
                  "none, or one that gonio wrote (move it, or name another output)");
}

/// An image has its metadata in itself.
std::string side_text_of(InputFile& in) {
  return is_exr(in.peek(4)) ? "" : side_text(in.path());
}

/// True of text whose first line has hundreds of columns.
bool is_wide(std::string_view head) {
  constexpr std::ptrdiff_t many = 100;
  return std::ranges::count(head.substr(0, head.find('\n')), ',') > many;
}

}  // namespace

double memory_needed(const std::string& path) {
  try {
    InputFile in(path);
    constexpr double times_the_file = 8, of_json = 40,
                     of_zemax = 64,  // a value has two bytes, and its direction none
        of_wide = 100,               // so has one of hundreds of channels, and a fit takes more
        of_image = 3e8;              // an image may be packed to nothing
    const std::string head = in.peek(1 << 16);
    return (is_brdf_json(head) || is_xompt(head) ? of_json
            : is_zemax(head)                     ? of_zemax
            : is_wide(head)                      ? of_wide
                                                 : times_the_file) *
               static_cast<double>(in.size()) +
           (is_exr(head) ? of_image : 0);
  } catch (const Error&) {
    return 0;  // it will not be read either
  }
}

Table read_table(const std::string& path, std::optional<Bins> bins) {
  TableAndDigest::Digest file(path);
  const std::string side = side_text_of(file.file());
  if (!side.empty()) file.begin();
  Table t = read_open(file.file(), side);
  if (!side.empty()) t.sha256 = file.wait();
  describe(t, side, bins);
  return t;
}

TableAndDigest::TableAndDigest(const std::string& path, std::optional<Bins> bins)
    : digest_(new Digest(path)), side_(side_text_of(digest_->file())) {
  digest_->begin();
  table = read_open(digest_->file(), side_);
  try {
    describe(table, side_, bins);
  } catch (const Error&) {
    finish();  // what another table's side file says is beside the point
    throw;
  }
}
TableAndDigest::TableAndDigest(Table whole) : table(std::move(whole)) {}
TableAndDigest::~TableAndDigest() = default;
TableAndDigest::TableAndDigest(TableAndDigest&&) noexcept = default;

void TableAndDigest::finish() {
  if (!digest_) return;
  table.sha256 = digest_->wait();
  if (!side_.empty()) expect_same_table(table, side_path(table.path), side_);
}

void write_table(const Table& t, const std::string& path) {
  if (t.format == "exr") return write_exr_slice(t, path);
  expect_own_side(path);
  OutputFile out(path);
  write_by_format(t, out, path);
  out.close();
  // The side file goes first and an old one of ours never stays: between the two steps, or after a
  // failure, a table may lack what was said about it, but has nothing false beside it for long.
  const std::string side = side_path(path);
  if (needs_metadata(t))
    write_file(side, metadata_text(t, sha256_of_file(out.temporary_path())), NamedBy::gonio);
  else
    remove_unless_input(side);
  try {
    out.commit();
  } catch (...) {
    remove_unless_input(side);
    throw;
  }
}

}  // namespace gonio
