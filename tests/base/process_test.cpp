#include "base/process.h"

#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>
#include <vector>

#include "base/file.h"
#include "support.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

namespace gonio {
namespace {

TEST(Program, ReadsItsInputAndGivesItsOutputAndStatus) {
  const auto cat = run_program("cat", {}, "one\ntwo", 10);
  ASSERT_TRUE(cat);
  EXPECT_EQ(cat->status, 0);
  EXPECT_EQ(cat->output, "one\ntwo");
  const std::vector<std::string> arguments{"a b", "-e"};
  const auto grep = run_program("grep", arguments, "", 10);
  ASSERT_TRUE(grep);
  EXPECT_NE(grep->status, 0);
  EXPECT_FALSE(grep->output.empty()) << "what it says of its errors is part of it";
}

TEST(Program, IsGivenItsWordsAsTheyAre) {
  const std::vector<std::string> arguments{"%s", "$(id) `id` ; * \"x\""};
  EXPECT_EQ(run_program("printf", arguments, "", 10)->output, arguments[1]);
}

TEST(Program, ThatIsNotThereIsNoResult) {
  EXPECT_FALSE(run_program("gonio-no-such-program", {}, "", 10));
}

TEST(Program, ThatIsNotThereIsNoResultOfAShellEither) {
  const std::vector<std::string> arguments{"-c", "exit 127"};
  EXPECT_FALSE(run_program("sh", arguments, "", 10));
  EXPECT_EQ(run_program("sh", std::vector<std::string>{"-c", "exit 126"}, "", 10)->status, 126);
}

TEST(Program, ThatRunsTooLongIsEnded) {
  const std::vector<std::string> arguments{"60"};
  const auto start = std::chrono::steady_clock::now();
  const auto sleep = run_program("sleep", arguments, "", 0.05);
  ASSERT_TRUE(sleep);
  EXPECT_TRUE(sleep->out_of_time);
  EXPECT_EQ(sleep->status, -1);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(30));
}

TEST(Copy, GivesWhatItReturnsOrNothingWhereItDoesNot) {
  EXPECT_EQ(answer_of_copy([] { return std::string(200'000, 'x'); }, 1 << 20),
            std::string(200'000, 'x'));
  EXPECT_EQ(answer_of_copy([]() -> std::string { ::_exit(1); }, 10), "");
  EXPECT_EQ(answer_of_copy(
                []() -> std::string {
                  ::raise(SIGKILL);
                  return "x";
                },
                10),
            "");
}

TEST(Copy, EndsWithItsProcess) {
  const test::Folder f;
  const pid_t middle = ::fork();
  if (middle == 0) {
    answer_of_copy(
        [&] {
          f.write("copy", std::to_string(::getpid()) + "\n");
          std::this_thread::sleep_for(std::chrono::seconds(60));
          return std::string();
        },
        10);
    ::_exit(0);
  }
  std::string number;
  for (int k = 0; k < 1000 && !number.ends_with('\n'); ++k) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    if (std::filesystem::exists(f / "copy")) number = test::read_bytes(f / "copy");
  }
  ASSERT_TRUE(number.ends_with('\n'));
  number.pop_back();
  ::kill(middle, SIGKILL);
  ::waitpid(middle, nullptr, 0);
  // A process that has ended may stay as a zombie where nobody waits for it.
  const auto lives = [&] {
    std::ifstream file("/proc/" + number + "/stat");
    const std::string stat{std::istreambuf_iterator<char>(file), {}};
    const auto at = stat.rfind(") ");
    return at != stat.npos && stat[at + 2] != 'Z';
  };
  for (int k = 0; k < 1000 && lives(); ++k)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_FALSE(lives());
}

TEST(Copy, LeavesTheFilesOfItsProcessWhereASignalEndsIt) {
  const test::Folder f;
  OutputFile out(f / "a");
  remove_unfinished_files_on_signals();
  EXPECT_EQ(answer_of_copy(
                []() -> std::string {
                  ::raise(SIGTERM);
                  return "x";
                },
                10),
            "");
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) ::signal(signal, SIG_DFL);
  EXPECT_TRUE(std::filesystem::exists(out.temporary_path()));
  out.write("whole");
  out.commit();
}

TEST(Program, KnowsItself) {
  const auto found =
      run_program(this_program(), std::vector<std::string>{"--gtest_list_tests"}, "", 30);
  ASSERT_TRUE(found);
  EXPECT_NE(found->output.find("KnowsItself"), std::string::npos);
}

TEST(Program, EndsWithTheProgramThatRunsIt) {
  const test::Folder folder;
  const std::string number = folder / "number";
  const pid_t runs = ::fork();
  if (runs == 0) {
    remove_unfinished_files_on_signals();
    run_program("sh", std::vector<std::string>{"-c", "echo $$ >" + number + "; exec sleep 60"}, "",
                60);
    ::_exit(0);
  }
  std::string text;
  for (int k = 0; k < 1000 && !text.ends_with('\n'); ++k) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    if (std::filesystem::exists(number)) text = test::read_bytes(number);
  }
  ASSERT_TRUE(text.ends_with('\n'));
  ::kill(runs, SIGTERM);
  int status = 0;
  ASSERT_EQ(::waitpid(runs, &status, 0), runs);
  EXPECT_EQ(WTERMSIG(status), SIGTERM);
  // Whoever is no longer there, or waits for nobody to ask, has ended.
  const auto state = [&] {
    std::ifstream in("/proc/" + std::to_string(std::stoi(text)) + "/stat");
    std::string number_of_it, name, letter = "Z";
    in >> number_of_it >> name >> letter;
    return letter;
  };
  for (int k = 0; k < 1000 && state() != "Z"; ++k)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_EQ(state(), "Z");
}

}  // namespace
}  // namespace gonio
