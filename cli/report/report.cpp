// gonio report: studies of the shipped approximations, each as data and as a page.
#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>
#include <set>
#include <system_error>

#include "base/earlier_file.h"
#include "base/error.h"
#include "base/file.h"
#include "base/process.h"
#include "cli/line/command.h"
#include "cli/line/terminal.h"
#include "reports/index/index_page.h"
#include "reports/index/kinds.h"
#include "reports/page/page.h"

#include <fmt/format.h>

namespace gonio::cli {
namespace {

struct ReportCall : Common {
  std::string name, output, asset;
  std::vector<std::string> environments;
  std::string pictures;
  bool full = false, quick = false;
};
constexpr std::string_view all_reports = "all";

/// A folder that is gone again if nothing came into it.
class MadeFolder {
 public:
  explicit MadeFolder(std::filesystem::path path) : path_(std::move(path)) {
    made_ = make_folder(path_.string());
  }
  ~MadeFolder() {
    std::error_code not_empty;
    if (made_) std::filesystem::remove(path_, not_empty);
  }
  MadeFolder(const MadeFolder&) = delete;
  MadeFolder& operator=(const MadeFolder&) = delete;
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
  bool made_ = false;
};

/// A report under the names of the contract, whole or not at all: page, data, rows, and its pictures in a folder of its
/// name.  What an earlier run's document there names and this one has no more goes when all is written.
class Files {
 public:
  Files(const std::string& folder, std::string_view name)
      : name_(name),
        path_((std::filesystem::path(folder) / name).string()),
        pictures_(path_),
        page_(path_ + ".html", NamedBy::gonio),
        data_(path_ + ".json", NamedBy::gonio),
        rows_(path_ + ".csv", NamedBy::gonio) {}
  void write(const ReportFiles& r) {
    page_.write(r.html);
    data_.write(r.json + "\n");
    rows_.write(r.csv);
    const CurveStyles styles(r.pictures.figures);
    for (const auto& f : r.pictures.figures) {
      if (!r.linked.contains(f.id)) continue;
      picture(f.id + ".svg", to_svg(f, styles));
      picture(f.id + ".csv", to_csv(f));
    }
    for (const auto& m : r.pictures.maps) {
      if (!r.linked.contains(m.id)) continue;
      picture(m.id + ".svg", to_svg(m));
      picture(m.id + ".csv", to_csv(m));
      picture(m.id + ".exr", to_exr(m));
    }
    std::vector<OutputFile*> all;
    for (auto& f : files_) all.push_back(f.get());
    for (auto* f : {&rows_, &data_, &page_}) all.push_back(f);
    const auto earlier = earlier_pictures();
    commit_all(all);
    remove_stale(earlier);
  }
  std::string page_path() const { return path_ + ".html"; }

 private:
  void picture(const std::string& name, std::string_view bytes) {
    files_.push_back(std::make_unique<OutputFile>(pictures_ / name, NamedBy::gonio));
    files_.back()->write(bytes);
    files_.back()->close();  // of a report's hundreds, none stays open
    written_.insert(name);
  }
  std::vector<std::string> earlier_pictures() const {
    constexpr std::uint64_t most = std::uint64_t{1} << 28;
    try {
      may_replace(path_ + ".json");
      return picture_files(InputFile(path_ + ".json").read_rest(most), name_);
    } catch (const Error&) {
      return {};  // there is none, or none of ours
    }
  }
  void remove_stale(const std::vector<std::string>& earlier) const {
    namespace fs = std::filesystem;
    for (const auto& name : earlier) {
      std::error_code error;  // what stays does no harm
      const fs::path path = pictures_ / name;
      if (!written_.contains(name) && fs::is_regular_file(fs::symlink_status(path, error)))
        remove_unless_input(path.string());
    }
  }

  std::string name_, path_;
  MadeFolder pictures_;
  OutputFile page_, data_, rows_;
  std::vector<std::unique_ptr<OutputFile>> files_;
  std::set<std::string> written_;
};

/// Shows what is done of all reports asked for, and how much time is left.
class ReportsProgress {
 public:
  ReportsProgress(bool quiet, double all) : progress_(quiet), all_(all) {}
  /// \param part  of the report that is being made
  void operator()(const ReportKind& kind, std::string_view what, double part) {
    constexpr std::size_t steps = 1000;
    const auto done = static_cast<std::size_t>((before_ + part * kind.weight) / all_ * steps);
    progress_(
        fmt::format("{}: {}, {} %{}", kind.name, what, done / 10, time_left(begin_, done, steps)));
  }
  void finish(const ReportKind& kind) {
    before_ += kind.weight;
    progress_.clear();
  }

 private:
  Progress progress_;
  double all_, before_ = 0;
  Stopwatch begin_;
};

std::int64_t milliseconds_since_1970() {
  using namespace std::chrono;
  return duration_cast<milliseconds>(system_clock::now().time_since_epoch()).count();
}

/// index.html and its data, of all reports together.
class IndexFiles {
 public:
  explicit IndexFiles(const std::filesystem::path& folder)
      : page_path_((folder / "index.html").string()),
        page_(page_path_, NamedBy::gonio),
        data_((folder / "index.json").string(), NamedBy::gonio) {}
  void write(const ReportIndex& index) {
    const std::string json = to_json(index);
    data_.write(json + "\n");
    page_.write(index_page_html(index));
    commit_all(std::array{&data_, &page_});
  }
  const std::string& page_path() const { return page_path_; }

 private:
  std::string page_path_;
  OutputFile page_, data_;
};

Exit run(const ReportCall& o) {
  namespace fs = std::filesystem;
  use(o);
  const bool of_all = o.name == all_reports;
  if (o.json && of_all) throw wrong_usage("--json is for one report");
  if (o.quick && o.full) throw wrong_usage("--quick and --full exclude each other");
  const bool all_files = o.pictures.empty() ? !of_all : o.pictures == "all";
  ReportOptions options{o.full, of_all, o.quick, all_files, {}, o.asset, this_program()};
  for (const auto& path : o.environments) {
    const std::string name = fs::path(path).stem().string();
    if (std::ranges::find(options.environments, name, &ReportOptions::Light::name) !=
        options.environments.end())
      throw wrong_usage(fmt::format("two environments have the name '{}'", name));
    options.environments.push_back({name, read_environment(path)});
  }
  std::error_code error;
  fs::create_directories(o.output, error);
  if (error) throw bad_input(o.output, "making the folder", error.message(), "a place to write");
  std::vector<ReportKind> kinds;
  double all = 0;
  for (const auto& kind : report_kinds())
    if (of_all || o.name == kind.name) {
      kinds.push_back(kind);
      all += kind.weight;
    }
  std::optional<IndexFiles> index_files;
  if (of_all) index_files.emplace(o.output);
  ReportIndex index{{}, GONIO_VERSION, o.full, milliseconds_since_1970(), {}, {}};
  index.quick = o.quick;
  std::vector<std::unique_ptr<Files>>
      files;  // nobody waits for a report to learn that it has no place
  for (const auto& kind : kinds) files.push_back(std::make_unique<Files>(o.output, kind.name));
  const auto index_page = fs::path(o.output) / "index.html";
  const bool has_index = index_files || fs::exists(index_page, error);
  ReportsProgress progress(o.quiet, all);
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    const auto& kind = kinds[k];
    const Stopwatch begin;
    progress(kind, "beginning", 0);
    auto report =
        kind.make(options, [&](std::string_view what, double part) { progress(kind, what, part); });
    const double took_ms = begin.ms();
    if (has_index) report.html = beside_index(std::move(report.html));
    files[k]->write(report);
    progress.finish(kind);
    if (o.json) {
      fmt::print("{}\n", report.json);
      continue;
    }
    if (index_files) {
      add_report(index, kind.name, kind.what, took_ms, std::move(report));
      continue;
    }
    for (const auto& sentence : report.findings.sentences) say("{}\n", sentence);
    say("{}\n", files[k]->page_path());
  }
  if (index_files) {
    index_files->write(index);
    fmt::print("{}", decision_table(decisions(index.facts)));
    say("{}\n", index_files->page_path());
  } else if (has_index && !o.quiet) {
    fmt::print(stderr, "{}: of an earlier run; gonio report all makes it anew\n",
               printable(index_page.string()));
  }
  return Exit::done;
}

}  // namespace

void add_report(CommandLine& line) {
  auto [c, o] = line.command<ReportCall>(
      "report",
      "Studies what shipped approximations cost and lose: a page DIR/NAME.html, "
      "its data DIR/NAME.json "
      "and .csv, its pictures in DIR/NAME/; of all, DIR/index.html leads to them",
      "gonio report energy -o reports", run);
  std::vector<std::string> names;
  std::string what;
  for (const auto& kind : report_kinds()) {
    names.emplace_back(kind.name);
    what += fmt::format("{}: {}; ", kind.name, kind.what);
  }
  names.emplace_back(all_reports);
  c.option("NAME", o->name, what + "all: each of them").one_of(names).required();
  c.option("-o,--output", o->output, "Folder, made where it is not there").required();
  c.option("--environment", o->environments,
           "An environment map, latitude by longitude in OpenEXR: what the split sum is off by "
           "under it; may be given several times")
      .one_each();
  c.option("--asset", o->asset,
           "A glTF file: its materials without textures are among the scenes, others are named");
  c.flag("--full", o->full, "Finer in roughness and angle, some minutes");
  c.flag("--quick", o->quick,
         "A first look: fewer materials, angles and samples; all takes a minute or two");
  c.option(
       "--pictures", o->pictures,
       "Which pictures have files: first, those that the pages show at first; all, those that a "
       "reader chooses, too (default: all of one report, first of all)")
      .one_of({"first", "all"});
  add_follow_paths(c, *o);
  add_jobs(c, *o);
  add_output(c, *o);
}

}  // namespace gonio::cli
