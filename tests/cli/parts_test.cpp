// gonio fit --part, gonio gather, gonio batch.
#include <set>
#include <thread>

#include "cli/many_tables.h"
#include "cli/program.h"

#include <unistd.h>

namespace gonio::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// Runs shell lines in the folder, with $gonio as the program; they may end as they will.
void shell(const Folder& f, const std::string& lines) {
  f.write(".lines", "gonio=" + program() + "\n" + lines);
  [[maybe_unused]] const int status =
      std::system(("cd '" + f / "" + "' && bash .lines >/dev/null 2>&1").c_str());
  fs::remove(f / ".lines");
}
/// Lines that run all parts of the list at once.
std::string at_once(int parts) {
  return fmt::format(
      "for k in $(seq {0}); do $gonio fit @list --part $k/{0} --jobs 1 -o out & done; wait\n",
      parts);
}

TEST(Parts, TwoThenFourAtOnceInOneFolderLoseNothingAndDoubleNothing) {
  const Folder f;
  const auto paths = write_tables(f, 14);
  ASSERT_EQ(gonio(f, "fit @list -o whole").code, 0);
  shell(f, at_once(2));
  expect_same_documents(f / "out", f / "whole", 14);
  EXPECT_FALSE(fs::exists(f / "out/summary.csv"));
  for (const int i : {1, 6, 13}) fs::remove(f / fmt::format("out/g{}.json", i));
  f.write("out/g2.json", R"({"schema": "gonio.fit/1", "mo)");
  shell(f, at_once(4));
  expect_same_documents(f / "out", f / "whole", 14);
  const auto o = gonio(f, "gather out --json");
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(o.json()["counts"]["ok"], 14);
  EXPECT_EQ(read_bytes(f / "out/summary.csv"), read_bytes(f / "whole/summary.csv"));
  EXPECT_EQ(names_in(f / "out"), names_in(f / "whole")) << "no remains";
}

TEST(Parts, TheSamePartTwiceAtOnceIsThePartOnce) {
  const Folder f;
  write_tables(f, 6);
  ASSERT_EQ(gonio(f, "fit @list -o whole").code, 0);
  shell(f, "for k in 1 2 1 2; do $gonio fit @list --part $k/2 --jobs 1 -o out & done; wait\n");
  expect_same_documents(f / "out", f / "whole", 6);
  EXPECT_EQ(gonio(f, "gather out").code, 0);
  EXPECT_EQ(names_in(f / "out"), names_in(f / "whole"));
}

TEST(Parts, KilledAndBegunAgainEndAsIfNothingHadHappened) {
  const Folder f;
  write_tables(f, 12);
  ASSERT_EQ(gonio(f, "fit @list -o whole").code, 0);
  for (const char* after : {"0.05", "0.1", "0.2"})
    shell(f, std::string("for k in 1 2 3; do timeout -s KILL ") + after +
                 " $gonio fit @list --part $k/3 --jobs 1 -o out & done; wait\n");
  shell(f, at_once(3));
  expect_same_documents(f / "out", f / "whole", 12);
  EXPECT_EQ(gonio(f, "gather out").code, 0);
  EXPECT_EQ(names_in(f / "out"), names_in(f / "whole")) << "what the kills left is gone";
}

TEST(Parts, PlainFitsOfOtherTablesAtOnceHaveOneSummary) {
  const Folder f;
  write_tables(f, 8);
  shell(f,
        "for k in 0 2 4 6; do $gonio fit in/g$k.csv in/g$((k + 1)).csv --jobs 1 -o out & done; "
        "wait\n");
  const json page = json::parse(read_bytes(f / "out/summary.page.json"));
  EXPECT_EQ(by_path(page).size(), 8U);
  EXPECT_EQ(page["tables"].size(), 8U);
}

TEST(Parts, OfTheTaskOfAnArrayWhereAsked) {
  const Folder f;
  write_tables(f, 5);
  const std::string task =
      "export SLURM_ARRAY_TASK_ID=8 SLURM_ARRAY_TASK_MIN=7 SLURM_ARRAY_TASK_COUNT=2; ";
  auto o = gonio(f, "fit @list --part slurm -o out --json", task);
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(o.json()["part"], "2/2");
  EXPECT_EQ(by_path(o.json()).size(), 2U);
  EXPECT_EQ(names_in(f / "out"),
            (std::set<std::string>{"g1.json", "g3.json", "summary.list.json"}));
  o = gonio(f, "fit @list -o all --json", task);
  EXPECT_EQ(by_path(o.json()).size(), 5U) << "never from the environment alone";
  EXPECT_TRUE(o.json()["part"].is_null());
}

TEST(Parts, TellWhatTheyDidAndWhatComesNext) {
  const Folder f;
  write_tables(f, 3);
  f.write("list", read_bytes(f / "list") + "nothing.csv\n");
  auto o = gonio(f, "fit @list --part 2/2 -o out");
  EXPECT_EQ(o.code, 3);
  EXPECT_NE(o.out.find("2 of part 2/2: 1 fitted, 1 failed"), o.out.npos) << o.out;
  EXPECT_NE(o.out.find("gonio gather"), o.out.npos) << o.out;
  EXPECT_EQ(o.out.find("summary.html"), o.out.npos) << "there is none: " << o.out;
  o = gonio(f, "fit @list --part 7/7 -o out");
  EXPECT_EQ(o.code, 0);
  EXPECT_NE(o.out.find("0 of part 7/7: 0 fitted"), o.out.npos) << o.out;
}

TEST(Parts, RefuseACallThatCannotBeMeant) {
  const Folder f;
  write_tables(f, 2);
  const std::size_t before = f.entries();
  expect_one_line_each(f, 2,
                       {{"fit @list --part 0/2 -o out", "parts count from 1 to N"},
                        {"fit @list --part 3/2 -o out", "parts count from 1 to N"},
                        {"fit @list --part 1/0 -o out", "parts count from 1 to N"},
                        {"fit @list --part half -o out", "expected K/N"},
                        {"fit @list --part=-1/2 -o out", "expected K/N"},
                        {"fit @list --part 1/2", "-o DIR"},
                        {"fit in/g0.csv --part 1/2 -o out", "many tables"},
                        {"fit in/g0.csv --models lambert --part 1/2", "--models"},
                        {"fit @list --part slurm -o out", "no SLURM_ARRAY_TASK_ID"}});
  expect_one_line(gonio(f, "fit @list --part slurm -o out",
                        "export SLURM_ARRAY_TASK_ID=1 SLURM_ARRAY_TASK_MIN=1 "
                        "SLURM_ARRAY_TASK_COUNT=2 SLURM_ARRAY_TASK_STEP=2; "),
                  2, "the array has gaps");
  expect_one_line_each(f, 3,
                       {{"fit @nothing --part 1/2 -o out", "nothing: opening"},
                        {"fit @list --part 1/2 -o list", "list"},
                        {"fit @list --part 1/2 -o list/out", "list/out"}});
  EXPECT_EQ(f.entries(), before);
}

TEST(Parts, ADiskThatIsFullEndsOneAndLeavesTheRest) {
  const Folder f;
  write_tables(f, 4);
  ASSERT_EQ(gonio(f, "fit @list --part 1/2 -o out").code, 0);
  expect_one_line(gonio(f, "fit @list --part 2/2 -o out", "ulimit -f 2; "), 3, "File too large");
  EXPECT_EQ(names_in(f / "out"),
            (std::set<std::string>{"g0.json", "g2.json", "summary.list.json"}));
}

TEST(GatherCommand, NamesWhatIsMissingAndEndsWithOne) {
  const Folder f;
  write_tables(f, 5);
  ASSERT_EQ(gonio(f, "fit @list --part 1/2 -o out").code, 0);
  auto o = gonio(f, "gather out");
  EXPECT_EQ(o.code, 1);
  EXPECT_EQ(o.err, "");
  EXPECT_NE(o.out.find("missing  2: in/g1.csv, in/g3.csv\n"), o.out.npos) << o.out;
  o = gonio(f, "gather out in/g0.csv in/g3.csv --json");
  EXPECT_EQ(o.code, 1);
  EXPECT_EQ(o.json()["missing"], json{"in/g3.csv"});
  EXPECT_EQ(by_path(o.json()).size(), 3U) << "the others that lie there are in the summary";
  f.write("half", "in/g0.csv\nin/g2.csv\n");
  EXPECT_EQ(gonio(f, "gather out @half").code, 0);
  ASSERT_EQ(gonio(f, "fit @list --part 2/2 -o out").code, 0);
  o = gonio(f, "gather out/");
  EXPECT_EQ(o.code, 0) << o.out;
  EXPECT_EQ(o.out.find("missing"), o.out.npos) << o.out;
  EXPECT_NE(o.out.find("tables   5: 5 fitted\n"), o.out.npos) << o.out;
}

TEST(GatherCommand, EndsAsTheFitsOfItsTablesDid) {
  const Folder f;
  f.write("a.csv", diffuse(0.1, 0.2));
  f.write("broken.csv", "theta_i");
  EXPECT_EQ(gonio(f, "fit a.csv broken.csv --model lambert --part 1/1 -o out").code, 3);
  const auto o = gonio(f, "gather out");
  EXPECT_EQ(o.code, 3);
  EXPECT_EQ(o.err, "");
  EXPECT_NE(o.out.find("failed   broken.csv: "), o.out.npos) << o.out;
}

TEST(GatherCommand, TellsDocumentsOfOtherOptionsOrOfAnotherVersion) {
  const Folder f;
  write_tables(f, 4);
  ASSERT_EQ(gonio(f, "fit in/g3.csv in/g2.csv --metric relative -o out").code, 0);
  std::string old = read_bytes(f / "out/g3.json");
  const std::string key = "\"made_with\": \"gonio ";
  old.insert(old.find(key) + key.size(), "0.0.");
  ASSERT_EQ(gonio(f, "fit in/g0.csv in/g1.csv -o out").code, 0);
  f.write("out/g3.json", old);
  f.write("out/broken.json", "{");
  const auto o = gonio(f, "gather out");
  EXPECT_EQ(o.code, 0) << "all tables of the last fit are there";
  EXPECT_NE(o.out.find("2 documents there, made by another version or with other options, not in "
                       "the summary: g2.json, g3.json"),
            o.out.npos)
      << o.out;
  EXPECT_NE(o.out.find("1 document there, cannot be read"), o.out.npos) << o.out;
  EXPECT_EQ(gonio(f, "gather out @list").code, 1) << "they are missing in this way";
  EXPECT_EQ(read_bytes(f / "out/g3.json"), old) << "nothing is lost";
  fs::remove(f / "out/summary.list.json");
  const auto lost = gonio(f, "gather out");
  EXPECT_EQ(lost.code, 3) << "what cannot be read may be a table's";
  EXPECT_NE(lost.err.find("documents: found 1 that cannot be read"), lost.err.npos) << lost.err;
}

TEST(GatherCommand, RefusesAFolderThatIsNone) {
  const Folder f;
  fs::create_directory(f / "empty");
  f.write("file", "x");
  expect_one_line_each(f, 3,
                       {{"gather nowhere", "nowhere: opening"},
                        {"gather empty", "found no result of a fit"},
                        {"gather file", "file: opening"},
                        {"gather empty @nothing", "nothing: opening"}});
  expect_one_line(gonio(f, "gather"), 2, "DIR");
  EXPECT_TRUE(fs::is_empty(f / "empty"));
}

TEST(BatchCommand, WritesAJobOfTheOptionsThatItIsGiven) {
  const Folder f;
  write_tables(f, 10);
  const std::string options =
      "--model lambert+ggx/smith_ggx.correlated/schlick --fix f0=0.04 --fix kd=0.2 --metric "
      "relative "
      "--grey f0 --certificate none --pages";
  const auto o = gonio(f, "batch --write commands @list " + options + " --parts 2 -o jobs --json");
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(o.json()["tables"], 10);
  EXPECT_EQ(o.json()["parts"], 2);
  EXPECT_EQ(o.json()["begin"], "parallel < jobs");
  const auto lines = read_bytes(f / "jobs");
  EXPECT_NE(lines.find(" fit @list --model lambert+ggx/smith_ggx.correlated/schlick --fix f0=0.04 "
                       "kd=0.2 --grey f0 --metric relative --certificate none --pages --part 1/2 "
                       "--jobs 1 --quiet -o results\n"),
            lines.npos)
      << lines;
  EXPECT_EQ(gonio(f, "batch --write commands @list " + options + " --parts 2").out, lines)
      << "without -o it is printed";
}

TEST(BatchCommand, ItsCommandsFitTheWholeFromAnyFolder) {
  const Folder f;
  write_tables(f, 5);
  ASSERT_EQ(gonio(f, "fit @list --fix f0=0.04 -o whole").code, 0);
  ASSERT_EQ(gonio(f, "batch --write commands @list --fix f0=0.04 --results out -o jobs").code, 0);
  EXPECT_EQ(std::system(("cd / && sh '" + f / "jobs" + "'").c_str()), 0);
  expect_same_documents(f / "out", f / "whole", 5);
  EXPECT_EQ(gonio(f, "gather out").code, 0);
}

TEST(BatchCommand, HasNoMorePartsThanTablesWhereNoneAreNamed) {
  const Folder f;
  write_tables(f, 3);
  EXPECT_EQ(gonio(f, "batch --write slurm @list -o job.sh --json").json()["parts"], 3);
  EXPECT_NE(read_bytes(f / "job.sh").find("\n#SBATCH --array=1-3\n"), std::string::npos);
  EXPECT_EQ(gonio(f, "batch --write slurm @list --parts 9 -o job.sh --json").json()["parts"], 9);
}

TEST(BatchCommand, RefusesACallThatCannotBeMeant) {
  const Folder f;
  write_tables(f, 2);
  const std::size_t before = f.entries();
  expect_one_line_each(f, 2,
                       {{"batch @list", "--write"},
                        {"batch --write condor @list", "slurm"},
                        {"batch --write slurm in/g0.csv", "many tables"},
                        {"batch --write slurm @list --parts 0", "--parts"},
                        {"batch --write slurm @list --jobs 0", "--jobs"},
                        {"batch --write slurm @list --fix gamma=2", "no parameter 'gamma'"},
                        {"batch --write slurm @list --model lambertt", "lambert"},
                        {"batch --write slurm @list --json", "-o FILE"},
                        {"batch --write slurm @list -o list", "is an input"}});
  expect_one_line_each(f, 3,
                       {{"batch --write slurm @nothing -o job.sh", "nothing: opening"},
                        {"batch --write slurm @list -o no/job.sh", "no/job.sh"}});
  EXPECT_EQ(f.entries(), before);
}

}  // namespace
}  // namespace gonio::test
