// gonio report: studies of the shipped approximations, each as data and as a page.
#include "reports/report.h"

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "base/file.h"
#include "cli/command.h"
#include "cli/terminal.h"

namespace gonio::cli {
namespace {

struct Options : Common {
  std::string name, output;
  std::vector<std::string> environments;
  bool full = false;
};
constexpr std::string_view all_reports = "all";

/// A folder that is gone again if nothing came into it.
class MadeFolder {
 public:
  explicit MadeFolder(std::filesystem::path path) : path_(std::move(path)) {
    std::error_code error;
    made_ = std::filesystem::create_directories(path_, error);
    if (error)
      throw bad_input(path_.string(), "making the folder", error.message(), "a place to write");
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
/// name.
class Files {
 public:
  Files(const std::string& folder, std::string_view name)
      : path_((std::filesystem::path(folder) / name).string()),
        pictures_(path_),
        page_(path_ + ".html"),
        data_(path_ + ".json"),
        rows_(path_ + ".csv") {}
  void write(const ReportFiles& r) {
    page_.write(r.html);
    data_.write(r.json + "\n");
    rows_.write(rows_csv(r.json));
    for (const auto& f : r.pictures.figures) {
      picture(f.id + ".svg", to_svg(f));
      picture(f.id + ".csv", to_csv(f));
    }
    for (const auto& m : r.pictures.maps) {
      picture(m.id + ".svg", to_svg(m));
      picture(m.id + ".csv", to_csv(m));
      picture(m.id + ".exr", to_exr(m));
    }
    std::vector<OutputFile*> all;
    for (auto& f : files_) all.push_back(f.get());
    for (auto* f : {&rows_, &data_, &page_}) all.push_back(f);
    commit_all(all);
  }
  std::string page_path() const { return path_ + ".html"; }

 private:
  void picture(const std::string& name, std::string_view bytes) {
    files_.push_back(std::make_unique<OutputFile>(pictures_ / name));
    files_.back()->write(bytes);
    files_.back()->close();  // of a report's hundreds, none stays open
  }

  std::string path_;
  MadeFolder pictures_;
  OutputFile page_, data_, rows_;
  std::vector<std::unique_ptr<OutputFile>> files_;
};

ReportFiles make(const ReportKind& kind, const ReportOptions& options, const Options& o) {
  Progress progress(o.quiet);
  const auto begin = std::chrono::steady_clock::now();
  constexpr std::size_t all = 1000;
  auto report = kind.make(options, [&](std::string_view what, double part) {
    const auto done = static_cast<std::size_t>(part * all);
    progress(
        fmt::format("{}: {}, {} %{}", kind.name, what, done / 10, time_left(begin, done, all)));
  });
  progress.clear();
  return report;
}

Exit run(const Options& o) {
  namespace fs = std::filesystem;
  use_jobs(o.jobs);
  if (o.json && o.name == all_reports) throw wrong_usage("--json is for one report");
  ReportOptions options{o.full, {}};
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
  for (const auto& kind : report_kinds()) {
    if (o.name != all_reports && o.name != kind.name) continue;
    Files files(o.output, kind.name);  // nobody waits for a report to learn that it has no place
    const auto report = make(kind, options, o);
    files.write(report);
    if (o.json) {
      fmt::print("{}\n", report.json);
      continue;
    }
    for (const auto& sentence : report.findings) fmt::print("{}\n", sentence);
    fmt::print("{}\n", files.page_path());
  }
  return Exit::done;
}

}  // namespace

void add_report(CLI::App& app, Action& action) {
  auto o = std::make_shared<Options>();
  auto* c = add_command(
      app, action, "report",
      "Studies what shipped approximations cost and lose: a page DIR/NAME.html and its data, "
      "DIR/NAME.json",
      "gonio report energy -o reports", o, run);
  std::vector<std::string> names;
  std::string what;
  for (const auto& kind : report_kinds()) {
    names.emplace_back(kind.name);
    what += fmt::format("{}: {}; ", kind.name, kind.what);
  }
  names.emplace_back(all_reports);
  c->add_option("NAME", o->name, what + "all: each of them")
      ->check(CLI::IsMember(names))
      ->required();
  c->add_option("-o,--output", o->output, "Folder, made where it is not there")->required();
  c->add_option(
       "--environment", o->environments,
       "An environment map, latitude by longitude in OpenEXR: what the split sum is off by "
       "under it; may be given several times")
      ->allow_extra_args(false);
  c->add_flag("--full", o->full, "Finer in roughness and angle, some minutes");
  add_jobs(c, *o);
  add_output(c, *o);
}

}  // namespace gonio::cli
