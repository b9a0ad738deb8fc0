// gonio fit_map: a stack of images in, a map of parameters out.
#include "fitting/map/fit_map.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>
#include <system_error>

#include "base/error.h"
#include "base/file.h"
#include "base/text.h"
#include "cli/fit/map_result.h"
#include "cli/line/command.h"
#include "cli/line/terminal.h"
#include "fitting/map/choose.h"
#include "fitting/map/gather.h"
#include "fitting/map/survey.h"
#include "reports/pages/map_page.h"

#include <fmt/format.h>

namespace gonio::cli {
namespace {

namespace fs = std::filesystem;

struct FitMapCall : Common {
  std::string stack, output, html, tile_size = "256";
  std::vector<std::string> tiles, models;
  TexelOptions texels;
  bool as_given = false;
};

/// Line of how far a map is, and how long still.
class MapProgress {
 public:
  MapProgress(bool quiet, const TileGrid& grid)
      : progress_(quiet), what_(fmt::format("fitting {} × {} texels", grid.width, grid.height)) {}
  void operator()(const MapCount& n) {
    if (n.done != n.texels && since_last_ && since_last_->ms() < 200) return;  // blocks are many
    since_last_ = Stopwatch();
    std::string line = fmt::format(
        "{}, {:.0f} %", what_,
        n.texels == 0 ? 100.0 : 100 * static_cast<double>(n.done) / static_cast<double>(n.texels));
    if (n.kept) line += fmt::format(", {} of {} tiles kept", n.kept, n.tiles);
    progress_(line + time_left(begin_, n.done, n.texels));
  }
  Progress& line() { return progress_; }

 private:
  Progress progress_;
  std::string what_;
  Stopwatch begin_;
  std::optional<Stopwatch> since_last_;
};

/// A folder that is gone at the end if nothing is left in it.
class ScratchFolder {
 public:
  explicit ScratchFolder(fs::path path) : path_(std::move(path)) {}
  ~ScratchFolder() {
    std::error_code not_empty;
    fs::remove(path_, not_empty);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

 private:
  fs::path path_;
};

/// A look at some texels before the work; directions that are not the stack's own end it.
StackSurvey look_at(const StackReader& stack, const FitMapCall& o) {
  Progress progress(o.quiet);
  progress("looking at some texels");
  StackSurvey found = survey(stack, o.texels);
  progress.clear();
  if (found.arrangement.sure && !o.as_given)
    throw Error(Exit::bad_input, fmt::format("{}: {}", printable(stack.stack().path, 1024),
                                             refusal_of(found.arrangement)));
  return found;
}

/// Tiles that were asked for, into a folder.
Exit run_tiles(const FitMapCall& o,
               const StackReader& stack,
               const TileGrid& grid,
               const StackSurvey& found) {
  std::vector<Tile> tiles;
  for (const auto& word : o.tiles) {
    const auto place = two_numbers(word, "--tile", 0, longest_side, false);
    const Tile tile{place[0], place[1]};
    if (tile.column >= grid.columns() || tile.row >= grid.rows())
      throw wrong_usage(fmt::format("--tile {}: the map of {} × {} has the tiles 0,0 to {},{}",
                                    word, grid.width, grid.height, grid.columns() - 1,
                                    grid.rows() - 1));
    if (std::ranges::find(tiles, tile) == tiles.end()) tiles.push_back(tile);
  }
  MapProgress progress(o.quiet, grid);
  const MapCount n =
      fit_tiles(stack, o.texels, grid, tiles, o.output, std::ref(progress), found.noise);
  progress.line().clear();
  TilesDocument d{{}, n.kept, grid.columns(), grid.rows()};
  for (const Tile& t : tiles) d.tiles.push_back((fs::path(o.output) / file_name(t)).string());
  if (o.json)
    fmt::print("{}", to_json(d));
  else
    say("tiles   {} of {} × {} in {}{}\n", tiles.size(), grid.columns(), grid.rows(), o.output,
        n.kept ? fmt::format(", {} there from before", n.kept) : "");
  return Exit::done;
}

/// The options with the model that was chosen, and those that it was chosen from.
std::optional<std::vector<TriedModel>> choose(const StackReader& stack, FitMapCall& o) {
  if (o.models.empty()) return std::nullopt;
  Progress progress(o.quiet);
  progress("comparing models");
  auto tried = try_models(stack, o.texels, o.models);
  o.texels.model = tried.front().model;
  return tried;
}

Exit run(const FitMapCall& call) {
  FitMapCall o = call;
  use(o);
  TexelOptions& t = o.texels;
  const auto tile_size = two_numbers(o.tile_size, "--tile-size", 1, longest_side, true);
  check_outputs({o.stack}, o.html.empty() ? std::vector{o.output} : std::vector{o.output, o.html});
  if (!o.html.empty() && !o.tiles.empty())
    throw wrong_usage("--html: a page is of a whole map, and --tile fits a part");

  Progress progress(o.quiet);
  progress("opening the stack");
  const StackReader stack(read_stack(o.stack));
  expect_no_input(o.output);
  const auto tried = choose(stack, o);
  check(t, stack.channels().size());
  progress.clear();
  const TileGrid grid{stack.width(), stack.height(), tile_size[0], tile_size[1]};
  constexpr std::size_t most_tiles = std::size_t{1} << 16;
  if (grid.columns() * grid.rows() > most_tiles)
    throw wrong_usage(fmt::format("--tile-size {}: {} × {} tiles; at most {} in all", o.tile_size,
                                  grid.columns(), grid.rows(), most_tiles));
  const StackSurvey found = look_at(stack, o);
  if (!o.tiles.empty()) return run_tiles(o, stack, grid, found);

  OutputFile out(o.output);  // before the work: nobody waits to learn that it has no place
  std::optional<OutputFile> page;
  if (!o.html.empty()) page.emplace(o.html);
  // Tiles stay beside it until it is whole: a run that was killed goes on from them.
  const std::string folder = o.output + ".tiles";
  const FolderLock lock(folder, FolderLock::Taken::is_refused);
  const ScratchFolder scratch(folder);  // taken away while the lock is held
  remove_other_tiles(stack, t, grid, folder);
  const auto tiles = grid.all();
  MapProgress line(o.quiet, grid);
  const MapCount n = fit_tiles(stack, t, grid, tiles, folder, std::ref(line), found.noise);
  line.line()("writing " + o.output);
  MapDocument d = gather_tiles(folder, out, threads_in_use());
  d.models = tried;
  d.left_out = found.left_out;
  d.azimuth = found.arrangement.azimuth;
  d.warnings = warnings_of(found, stack.stack(), t.model);
  out.close();  // the page is made from it
  if (page) page->write(map_page_html(d, out.temporary_path()));
  commit_all(std::array{&out, page ? &*page : nullptr});
  line.line().clear();
  print_map(d, o, n.kept ? fmt::format("{} of {} tiles kept from before", n.kept, n.tiles) : "");
  std::error_code kept;
  for (const Tile& tile : tiles)  // this run wrote and read them; what the stack names was refused
    fs::remove(fs::path(folder) / file_name(tile), kept);
  return outcome_of(d);
}

}  // namespace

void add_fit_map(CommandLine& line) {
  auto [c, o] = line.command<FitMapCall>(
      "fit_map", "Fits a model to each texel of a stack of images: a map of each parameter",
      "gonio fit_map stack/stack.json --model lambert+ggx/smith_ggx.correlated/schlick -o "
      "maps.exr\n  gonio fit_map stack/stack.json --tile 2,0 -o tiles/",
      run);
  c.option("STACK", o->stack, "Images and their directions: a document gonio.stack/1").required();
  c.options(o->texels);
  c.option(
       "--models", o->models,
       "Models to choose from, in place of --model: the one that predicts images best which its "
       "fits have not seen, at a sample of the texels")
      .delimiter(',');
  c.option("--tile", o->tiles,
           "COLUMN,ROW of the only tile to fit, into the folder of -o, from 0,0 on top left; "
           "several times for several. gonio gather joins them")
      .one_each();
  c.option("--tile-size", o->tile_size, "WIDTH,HEIGHT of tiles, or one number for both")
      .show_default();
  c.option("-o,--output", o->output, "OpenEXR file of the map; of --tile a folder").required();
  c.option("--html", o->html, "A page of the map: pictures, histograms, where the model fits");
  c.flag("--as-given", o->as_given,
         "Fit even where the images say that the directions are others than the stack has");
  add_follow_paths(c, *o);
  add_jobs(c, *o);
  add_output(c, *o);
}

}  // namespace gonio::cli
