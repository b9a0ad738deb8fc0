// Parts under the programs that share work among machines: Slurm on loopback, Open Job Description,
// GNU parallel.  Each is begun by its own test and ends with it.
#include <cstdlib>

#include "cli/many_tables.h"
#include "cli/program.h"

namespace gonio::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

bool has_program(const std::string& name) {
  return std::system(
             ("PATH=$PATH:/usr/sbin:/sbin command -v " + name + " >/dev/null 2>&1").c_str()) == 0;
}

/// Runs shell lines in the folder; what they say lies there, in `said`.
int run(const Folder& f, const std::string& lines) {
  f.write("lines", "set -eu\n" + lines);
  const int status = std::system(("cd '" + f / "" + "' && bash lines >said 2>&1").c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// Runs shell lines in the folder while a cluster of so many nodes is there.
int run_in_cluster(const Folder& f, int nodes, int seconds, const std::string& lines) {
  const std::string script = project_folder() + "/tests/cli/slurm/cluster.sh";
  fs::create_directory(f / "cluster");
  f.write("within", "set -eu\ncluster='" + script + "'\n" + lines);
  return run(f,
             fmt::format("bash '{}' cluster {} timeout {} bash within\n", script, nodes, seconds));
}

#define GONIO_NEEDS_SLURM()                                            \
  for (const char* name : {"slurmctld", "slurmd", "munged", "sbatch"}) \
    if (!has_program(name))                                            \
  GTEST_SKIP() << "needs Slurm and munge, of which " << name << " is not here"

TEST(Slurm, RunsTheArrayThatIsWrittenForIt) {
  GONIO_NEEDS_SLURM();
  const Folder f;
  write_tables(f, 10);
  ASSERT_EQ(gonio(f, "fit @list -o whole").code, 0);
  ASSERT_EQ(gonio(f, "batch --write slurm @list --parts 4 --results out -o job.sh").code, 0);
  ASSERT_EQ(run_in_cluster(f, 2, 100, "sbatch --wait --time=1 job.sh\n"), 0)
      << read_bytes(f / "said");
  expect_same_documents(f / "out", f / "whole", 10);
  const auto o = gonio(f, "gather out");
  EXPECT_EQ(o.code, 0) << o.out;
  EXPECT_EQ(read_bytes(f / "out/summary.csv"), read_bytes(f / "whole/summary.csv"));
}

/// In place of the tables of write_tables() four of 45,000 values, in turn.
void write_large_tables(const Folder& f, int n) {
  constexpr int different = 4;
  for (int i = 0; i < n; ++i) {
    const std::string name = fmt::format("in/g{}.csv", i);
    fs::remove(f / name);
    if (i >= different) {
      fs::create_hard_link(f / fmt::format("in/g{}.csv", i % different), f / name);
      continue;
    }
    std::string csv = "theta_i,phi_i,theta_o,phi_o,f\n";
    for (int theta = 5; theta < 80; ++theta)
      for (int k = -300; k <= 300; ++k) {
        const double o = k / 4.0, away = o - theta;
        csv += fmt::format("{},0,{},{},{:.6f}\n", theta, std::abs(o), o < 0 ? 0 : 180,
                           0.1 + 2 / (1 + (0.01 + 0.01 * i) * away * away));
      }
    f.write(name, csv);
  }
}

TEST(Slurm, BeginsTheTasksOfALostNodeAgainAndNothingIsLost) {
  if (!std::getenv("GONIO_LONG")) GTEST_SKIP() << "minutes; set GONIO_LONG for it";
  GONIO_NEEDS_SLURM();
  constexpr int tables = 200;
  const Folder f;
  write_tables(f, tables);
  write_large_tables(f, tables);
  // Parts of seconds: there is a middle to lose a node in.
  const std::string how = " @list --model lambert+gtr/smith_ggx.correlated/schlick ";
  ASSERT_EQ(gonio(f, "fit" + how + "-o whole").code, 0);
  ASSERT_EQ(gonio(f, "batch --write slurm" + how + "--parts 8 --results out -o job.sh").code, 0);
  const int code = run_in_cluster(f, 2, 900, R"sh(
    job=$(sbatch --parsable job.sh)
    documents() { ls out 2>/dev/null | grep -c '^g' || true; }
    until [ "$(documents)" -ge 20 ] && [ -n "$(squeue -h -w n2 -t R)" ]; do sleep 0.1; done
    squeue -h -w n2 -t R -o %K > lost_tasks
    bash "$cluster" lost n2
    documents > documents_then
    until [ -z "$(squeue -h)" ]; do sleep 1; done
    scontrol show job "$job" > told
  )sh");
  ASSERT_EQ(code, 0) << read_bytes(f / "said");
  EXPECT_LT(std::stoi(read_bytes(f / "documents_then")), tables) << "it was lost in the middle";
  const std::string told = read_bytes(f / "told"), lost = read_bytes(f / "lost_tasks");
  EXPECT_NE(lost, "");
  std::ptrdiff_t requeued = 0;
  for (std::size_t at = 0; (at = told.find("Restarts=1", at)) != told.npos; ++at) ++requeued;
  EXPECT_EQ(requeued, std::count(lost.begin(), lost.end(), '\n')) << told;
  expect_same_documents(f / "out", f / "whole", tables);
  const auto o = gonio(f, "gather out --json");
  EXPECT_EQ(o.code, 0);
  EXPECT_EQ(o.json()["counts"]["ok"], tables);
  EXPECT_EQ(o.json()["missing"], json::array());
  EXPECT_EQ(read_bytes(f / "out/summary.csv"), read_bytes(f / "whole/summary.csv"));
}

/// Path of openjd, where ./check has fetched it.
std::string openjd() {
  return project_folder() + "/build/openjd/bin/openjd";
}

TEST(OpenJobDescription, TakesTheTemplate) {
  if (!fs::exists(openjd())) GTEST_SKIP() << "needs openjd-cli, which ./check fetches";
  const Folder f;
  write_tables(f, 4);
  ASSERT_EQ(gonio(f, "batch --write openjd @list --parts 2 --fix f0=0.04 -o job.json").code, 0);
  EXPECT_EQ(run(f, "'" + openjd() + "' check job.json\n"), 0) << read_bytes(f / "said");
}

TEST(OpenJobDescription, RunsTheTemplate) {
  if (!std::getenv("GONIO_LONG")) GTEST_SKIP() << "seconds; set GONIO_LONG for it";
  if (!fs::exists(openjd())) GTEST_SKIP() << "needs openjd-cli, which ./check fetches";
  const Folder f;
  write_tables(f, 20);
  ASSERT_EQ(gonio(f, "fit @list -o whole").code, 0);
  ASSERT_EQ(gonio(f, "batch --write openjd @list --results out -o job.json").code, 0);
  ASSERT_EQ(run(f, "'" + openjd() + "' run job.json -p Parts=3\n"), 0) << read_bytes(f / "said");
  expect_same_documents(f / "out", f / "whole", 20);
  EXPECT_EQ(read_bytes(f / "out/summary.csv"), read_bytes(f / "whole/summary.csv"))
      << "its last step gathers";
}

TEST(GnuParallel, RunsTheCommands) {
  if (!std::getenv("GONIO_LONG")) GTEST_SKIP() << "seconds; set GONIO_LONG for it";
  if (std::system("parallel --version 2>/dev/null | grep -q GNU") != 0)
    GTEST_SKIP() << "needs GNU parallel, which is not here";
  const Folder f;
  write_tables(f, 20);
  ASSERT_EQ(gonio(f, "fit @list -o whole").code, 0);
  ASSERT_EQ(gonio(f, "batch --write commands @list --parts 5 --results out -o jobs").code, 0);
  ASSERT_EQ(run(f, "parallel --joblog log < jobs\n"), 0) << read_bytes(f / "said");
  const std::string log = read_bytes(f / "log");
  EXPECT_EQ(std::count(log.begin(), log.end(), '\n'), 6) << log;
  expect_same_documents(f / "out", f / "whole", 20);
  EXPECT_EQ(gonio(f, "gather out").code, 0);
}

}  // namespace
}  // namespace gonio::test
