#include "fitting/batch/job.h"

#include "base/text.h"
#include "refusal.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace gonio {
namespace {

const Job small{
    "/opt/gonio", "/scan of it", {"@list"}, {"--fix", "f0=0.04", "--grey", "kd"}, "out", 10, 3, 2};

TEST(Job, OfSlurmIsAnArrayWhoseTasksAreBegunAgain) {
  EXPECT_EQ(
      job_text(Engine::slurm, small),
      "#!/bin/bash\n"
      "# gonio fit of 10 tables in 3 parts. When all have ended: /opt/gonio gather out @list\n"
      "#SBATCH --job-name=gonio-fit\n"
      "#SBATCH --array=1-3\n"
      "#SBATCH --cpus-per-task=2\n"
      "#SBATCH --requeue\n"
      "#SBATCH --open-mode=append\n"
      "cd '/scan of it' || exit 3\n"
      "exec /opt/gonio fit @list --fix f0=0.04 --grey kd --part slurm --jobs 2 --quiet -o out\n");
}

TEST(Job, OfCommandsIsALineForEachPart) {
  const auto lines = split(job_text(Engine::commands, small), '\n');
  ASSERT_EQ(lines.size(), 4U);
  EXPECT_EQ(lines[3], "");
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_EQ(lines[k], "cd '/scan of it' && /opt/gonio fit @list --fix f0=0.04 --grey kd --part " +
                            std::to_string(k + 1) + "/3 --jobs 2 --quiet -o out");
}

TEST(Job, OfOpenJobDescriptionHasAStepOfPartsAndOneOfTheSummaryAfterIt) {
  const auto t = nlohmann::json::parse(job_text(Engine::openjd, small));
  EXPECT_EQ(t["specificationVersion"], "jobtemplate-2023-09");
  EXPECT_EQ(t["parameterDefinitions"][0]["default"], 3);
  ASSERT_EQ(t["steps"].size(), 2U);
  const auto &fit = t["steps"][0], &gather = t["steps"][1];
  EXPECT_EQ(fit["parameterSpace"]["taskParameterDefinitions"][0]["range"], "1-{{Param.Parts}}");
  EXPECT_EQ(fit["hostRequirements"]["amounts"][0]["min"], 2);
  EXPECT_EQ(fit["script"]["actions"]["onRun"]["command"], "sh");
  EXPECT_EQ(fit["script"]["actions"]["onRun"]["args"][1],
            "cd '/scan of it' && /opt/gonio fit @list --fix f0=0.04 --grey kd --part "
            "'{{Task.Param.Part}}/{{Param.Parts}}' --jobs 2 --quiet -o out");
  EXPECT_EQ(gather["dependencies"][0]["dependsOn"], "Fit");
  EXPECT_EQ(gather["script"]["actions"]["onRun"]["args"][1],
            "cd '/scan of it' && /opt/gonio gather out @list");
}

TEST(Job, QuotesWhatAShellWouldTakeApart) {
  Job job = small;
  job.inputs = {"it's $(one).csv", "b.csv"};
  job.results = "a b";
  for (const Engine engine : {Engine::slurm, Engine::commands})
    EXPECT_HAS(job_text(engine, job), R"( fit 'it'\''s $(one).csv' b.csv )");
  EXPECT_HAS(job_text(Engine::slurm, job), " -o 'a b'\n");
  EXPECT_EQ(gather_command(job), R"(/opt/gonio gather 'a b' 'it'\''s $(one).csv' b.csv)");
}

TEST(Job, RefusesWordsThatItCannotHold) {
  for (const Engine engine : {Engine::slurm, Engine::openjd, Engine::commands}) {
    Job job = small;
    job.inputs = {"a\nrm -r b"};
    EXPECT_HAS(test::refusal([&] { job_text(engine, job); }, Exit::usage), "control character");
    for (const char* name : {"a\xe2\x80\xae"
                             "b.csv",
                             "a\xff.csv"}) {
      job.inputs = {name};
      EXPECT_HAS(test::refusal([&] { job_text(engine, job); }, Exit::usage), "control character");
    }
    job = small;
    job.folder = "/a\nb";
    EXPECT_HAS(test::refusal([&] { job_text(engine, job); }, Exit::usage), "control character");
  }
  Job job = small;
  job.results = "{{Job.Name}}";
  EXPECT_HAS(test::refusal([&] { job_text(Engine::openjd, job); }, Exit::usage), "replaces");
  EXPECT_HAS(job_text(Engine::slurm, job), "'{{Job.Name}}'");
}

}  // namespace
}  // namespace gonio
