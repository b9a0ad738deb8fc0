#include "base/file.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <vector>

#include "base/error.h"
#include "base/text.h"
#include "refusal.h"
#include "refused_locks.h"
#include "support.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

namespace {
std::string order;    ///< of what was synced and renamed: (d)ata, (r)enamed, (f)older
unsigned slowly = 0;  ///< microseconds that a renaming takes
}

// In place of the library's, as the room calls them: to see their order.
extern "C" int fdatasync(int file) {
  order += 'd';
  return static_cast<int>(::syscall(SYS_fdatasync, file));
}
extern "C" int fsync(int file) {
  struct stat s {};
  order += ::fstat(file, &s) == 0 && S_ISDIR(s.st_mode) ? 'f' : 'd';
  return static_cast<int>(::syscall(SYS_fsync, file));
}
extern "C" int rename(const char* from, const char* to) noexcept {
  order += 'r';
  ::usleep(slowly);
  return static_cast<int>(::syscall(SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, 0));
}

namespace gonio {
namespace {

using test::Folder, test::refusal;

TEST(InputFile, SaysWhatIsNoRegularFile) {
  const Folder folder;
  EXPECT_NE(refusal([&] { InputFile(folder / "missing"); }).find("No such file"),
            std::string::npos);
  EXPECT_NE(refusal([&] { InputFile(folder / ""); }).find("a directory"), std::string::npos);
  EXPECT_NE(refusal([] { InputFile("/dev/null"); }).find("a device"), std::string::npos);
  EXPECT_NE(refusal([&] { InputFile(folder.write("e", "")); }).find("an empty file"),
            std::string::npos);
}

TEST(InputFile, ReadsAtAnyPlaceAndNamesTheByteWhereItEnds) {
  const Folder folder;
  const InputFile in(folder.write("f", "0123456789"));
  std::string two(2, ' ');
  in.read_at(7, two.data(), 2);
  EXPECT_EQ(two, "78");
  EXPECT_NE(refusal([&] { in.read_at(9, two.data(), 2); }).find("byte 10: found the end"),
            std::string::npos);
}

TEST(InputFile, KnowsWhetherItWasWrittenToMeanwhile) {
  const Folder folder;
  const auto changed = [](const InputFile& in) {
    return refusal([&] { in.expect_unchanged(); }).find("changed meanwhile") != std::string::npos;
  };
  const std::string path = folder.write("f", "0123456789");
  const InputFile in(path);
  EXPECT_FALSE(changed(in));
  std::filesystem::resize_file(path, 5);
  EXPECT_TRUE(changed(in));
  const InputFile again(path);
  std::filesystem::last_write_time(
      path, std::filesystem::last_write_time(path) + std::chrono::seconds(1));
  EXPECT_TRUE(changed(again));
}

TEST(InputFile, ReadsInPiecesAndNamesTheByteWhereItEnds) {
  const Folder folder;
  InputFile in(folder.write("f", "0123456789"));
  EXPECT_EQ(in.size(), 10U);
  EXPECT_EQ(in.peek(3), "012");
  std::string four(4, ' ');
  in.read(four.data(), 4);
  EXPECT_EQ(four, "0123");
  EXPECT_EQ(in.position(), 4U);
  EXPECT_EQ(in.peek(100), "456789");
  std::string many(20, ' ');
  EXPECT_NE(refusal([&] {
              in.read(many.data(), 20);
            }).find("byte 10: found the end of the file, expected 14 more"),
            std::string::npos);
}

TEST(InputFile, RefusesARestThatIsTooLong) {
  const Folder folder;
  InputFile in(folder.write("f", "0123456789"));
  EXPECT_NE(refusal([&] { in.read_rest(9); }).find("found 10 bytes, expected at most 9"),
            std::string::npos);
  EXPECT_EQ(in.read_rest(10), "0123456789");
}

TEST(OutputFile, AppearsWholeOrNotAtAll) {
  const Folder folder;
  {
    OutputFile out(folder / "f");
    out.write("half");
    out.close();
    EXPECT_FALSE(std::filesystem::exists(folder / "f"));
  }
  EXPECT_EQ(folder.entries(), 0U);
  write_file(folder / "f", "old");
  OutputFile out(folder / "f");
  out.write("new");
  EXPECT_EQ(test::read_bytes(folder / "f"), "old");
  out.commit();
  EXPECT_EQ(test::read_bytes(folder / "f"), "new");
  EXPECT_EQ(folder.entries(), 1U);
}

TEST(OutputFile, SaysWhereItCannotWrite) {
  const Folder folder;
  EXPECT_NE(refusal([&] { OutputFile(folder / "none/such"); }).find("No such file"),
            std::string::npos);
  EXPECT_NE(refusal([&] { OutputFile(folder / ""); }).find("a directory"), std::string::npos);
  EXPECT_NE(refusal([&] { OutputFile(""); }).find("no name"), std::string::npos);
  EXPECT_EQ(folder.entries(), 0U);
}

TEST(OutputFile, TwoOfOneNameDoNotMeet) {
  const Folder folder;
  OutputFile a(folder / "f"), b(folder / "f");
  EXPECT_NE(a.temporary_path(), b.temporary_path());
  a.write("aa");
  b.write("b");
  a.commit();
  EXPECT_EQ(test::read_bytes(folder / "f"), "aa");
  b.commit();
  EXPECT_EQ(test::read_bytes(folder / "f"), "b");
  EXPECT_EQ(folder.entries(), 1U);
}

TEST(OutputFile, RefusesADeviceOrPipe) {
  const Folder folder;
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  for (const std::string& path : {folder / "pipe", std::string("/dev/null")})
    EXPECT_TRUE(refusal([&] {
                  OutputFile out(path);
                }).ends_with("writing: found a device or pipe, expected the name of a file"));
  EXPECT_TRUE(std::filesystem::is_fifo(folder / "pipe"));
  EXPECT_EQ(folder.entries(), 1U);
}

TEST(OutputFile, FollowsLinks) {
  const Folder folder;
  std::filesystem::create_directory(folder / "there");
  std::filesystem::create_symlink("there/f", folder / "near");
  std::filesystem::create_symlink(folder / "near", folder / "far");
  for (const char* bytes : {"the first dangles", "the second does not"}) {
    write_file(folder / "far", bytes);
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "far"));
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "near"));
    EXPECT_EQ(test::read_bytes(folder / "there/f"), bytes);
  }
  std::filesystem::create_symlink("circle", folder / "circle");
  EXPECT_NE(refusal([&] { OutputFile(folder / "circle"); }).find("symbolic links"),
            std::string::npos);
}

TEST(OutputFile, ReplacesALinkWhereGonioChoseTheName) {
  const Folder folder;
  folder.write("victim", "mine");
  ASSERT_EQ(::chmod((folder / "victim").c_str(), 0400), 0);
  for (const char* to : {"victim", "nothing", "link"}) {
    std::filesystem::remove(folder / "link");
    std::filesystem::create_symlink(to, folder / "link");
    write_file(folder / "link", "new", NamedBy::gonio);
    EXPECT_FALSE(std::filesystem::is_symlink(folder / "link")) << to;
    EXPECT_EQ(test::read_bytes(folder / "link"), "new") << to;
    EXPECT_NE(std::filesystem::status(folder / "link").permissions(), std::filesystem::perms{0400})
        << "those of the file that the link leads to";
  }
  EXPECT_EQ(test::read_bytes(folder / "victim"), "mine");
  EXPECT_FALSE(std::filesystem::exists(folder / "nothing"));
}

TEST(MakeFolder, RefusesALink) {
  const Folder folder;
  std::filesystem::create_directory(folder / "elsewhere");
  for (const char* to : {"elsewhere", "nothing"}) {
    std::filesystem::remove(folder / "link");
    std::filesystem::create_symlink(to, folder / "link");
    EXPECT_HAS(refusal([&] { make_folder(folder / "link"); }), "link: writing: found a link");
  }
  EXPECT_TRUE(make_folder(folder / "new"));
  EXPECT_FALSE(make_folder(folder / "new")) << "it is there";
  EXPECT_HAS(refusal([&] { make_folder(folder.write("file", "x")); }), "file: writing: found");
}

TEST(OutputFile, IsReadableByWhomTheUserLets) {
  const Folder folder;
  const auto before = ::umask(022);
  write_file(folder / "f", "x");
  ::umask(before);
  EXPECT_EQ(std::filesystem::status(folder / "f").permissions(), std::filesystem::perms{0644});
}

TEST(OutputFile, KeepsTheRightsOfTheFileThatItReplaces) {
  const Folder folder;
  const auto rights = [&](const char* name) {
    return std::filesystem::status(folder / name).permissions();
  };
  for (const int mode : {0600, 0640, 0444, 0666}) {
    folder.write("f", "old");
    ASSERT_EQ(::chmod((folder / "f").c_str(), static_cast<mode_t>(mode)), 0);
    write_file(folder / "f", "new");
    EXPECT_EQ(rights("f"), std::filesystem::perms(mode));
    EXPECT_EQ(test::read_bytes(folder / "f"), "new");
    std::filesystem::remove(folder / "f");
  }
}

TEST(OutputFile, KeepsTheOwnerOfTheFileThatItReplacesWhereItMay) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root may give files away";
  const Folder folder;
  folder.write("f", "old");
  ASSERT_EQ(::chown((folder / "f").c_str(), 12, 34), 0);
  write_file(folder / "f", "new");
  struct stat s {};
  ASSERT_EQ(::stat((folder / "f").c_str(), &s), 0);
  EXPECT_EQ(s.st_uid, 12U);
  EXPECT_EQ(s.st_gid, 34U);
}

TEST(OutputFile, IsOnTheDiskBeforeItTakesItsNameAndItsFolderAfter) {
  const Folder folder;
  order.clear();
  write_file(folder / "f", "x");
  EXPECT_EQ(order, "drf");
  for (int k = 0; k < 20; ++k) write_file(folder / "f", "x");
  EXPECT_LT(std::ranges::count(order, 'f'), 10) << "not once for each of many";
  EXPECT_EQ(std::ranges::count(order, 'd'), 21);
}

TEST(OutputFile, WritesAtOffsetsAndTakesNoNameWhereThatFailed) {
  const Folder folder;
  {
    OutputFile out(folder / "f");
    out.write_at(3, "def");
    out.write_at(0, "abc");
    out.commit();
  }
  EXPECT_EQ(test::read_bytes(folder / "f"), "abcdef");
  const auto before = std::signal(SIGXFSZ, SIG_IGN);
  rlimit limit{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &limit), 0);
  const rlimit four{4, limit.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &four), 0);
  {
    OutputFile out(folder / "f");
    EXPECT_THROW(out.write_at(0, "12345678"), Error);
    EXPECT_THROW(out.commit(), Error) << "though whoever wrote has lost the error";
  }
  ::setrlimit(RLIMIT_FSIZE, &limit);
  std::signal(SIGXFSZ, before);
  EXPECT_EQ(test::read_bytes(folder / "f"), "abcdef");
  EXPECT_EQ(folder.entries(), 1U);
}

TEST(OutputFile, MayHaveTheLongestNameThereIs) {
  const Folder folder;
  const std::string name(255, 'n');
  write_file(folder / name, "x");
  EXPECT_EQ(test::read_bytes(folder / name), "x");
  EXPECT_NE(refusal([&] { OutputFile(folder / (name + "n")); }).find("too long"),
            std::string::npos);
}

/// A file begun by a process that was then killed.  \param flags  of waitid()
std::string left_by_a_kill(const Folder& folder, int flags = 0) {
  EXPECT_EQ(::setenv("GONIO_TEST_FOLDER", (folder / "").c_str(), 1), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    // What the process is called and when it began is asked once: by a new program, not by a copy
    // of this one.
    ::execl("/proc/self/exe", "file_test", "--gtest_also_run_disabled_tests",
            "--gtest_filter=OutputFile.DISABLED_IsBegunAndKilled", nullptr);
    ::_exit(1);
  }
  siginfo_t end{};
  ::waitid(P_PID, static_cast<id_t>(child), &end, WEXITED | flags);
  EXPECT_TRUE(end.si_code == CLD_KILLED && end.si_status == SIGKILL);
  for (const auto& e : std::filesystem::directory_iterator(folder / ""))
    if (e.path().filename().string().starts_with(".gonio.")) return e.path().filename().string();
  ADD_FAILURE() << "nothing left";
  return "";
}

/// Program that left_by_a_kill runs.
TEST(OutputFile, DISABLED_IsBegunAndKilled) {
  const char* const folder = std::getenv("GONIO_TEST_FOLDER");
  if (!folder) GTEST_SKIP() << "run by another test";
  OutputFile out(std::string(folder) + "/f");
  out.write("half");
  ::raise(SIGKILL);
}

TEST(OutputFile, TakesAwayWhatKilledProcessesLeftAndNothingElse) {
  const Folder folder, other;
  const std::string left = left_by_a_kill(folder);
  const auto with = [&](std::size_t part, const std::string& text, const char* start = nullptr) {
    std::vector<std::string> parts = split(left, '.');
    parts[part] = text;
    if (start) parts[4] = start;
    std::string name;
    for (const auto& p : parts) name += (name.empty() ? "" : ".") + p;
    return name.starts_with('.') ? name : "." + name;
  };
  OutputFile elsewhere(other / "f");
  const auto ours = std::filesystem::path(elsewhere.temporary_path()).filename().string();
  // "", gonio, home, process, start, counter, tmp
  const std::vector<std::string> kept{
      with(2, "0123-4"), with(5, "1.0"),      with(6, "bak"), with(6, "json"), with(3, "0"),
      with(3, "x"),      with(3, "-2000000"), ".gonio.tmp",   "f.tmp",         ours};
  const std::string reused = with(3, std::to_string(::getpid()), "1");
  for (const auto& name : kept) folder.write(name, "x");
  folder.write(reused, "of an earlier process of this number");
  OutputFile living(folder / "g");
  EXPECT_FALSE(std::filesystem::exists(folder / left));
  EXPECT_FALSE(std::filesystem::exists(folder / reused));
  for (const auto& name : kept) EXPECT_TRUE(std::filesystem::exists(folder / name)) << name;
  EXPECT_TRUE(std::filesystem::exists(living.temporary_path()));
  // Each folder is looked through once in a run.
  folder.write(reused, "x");
  write_file(folder / "f", "x");
  EXPECT_TRUE(std::filesystem::exists(folder / reused));
}

TEST(OutputFile, TakesAwayWhatKilledProcessesLeftForWhichNobodyWaits) {
  const Folder folder;
  const std::string left = left_by_a_kill(folder, WNOWAIT);
  ASSERT_TRUE(std::filesystem::exists(folder / left));
  write_file(folder / "f", "x");
  EXPECT_FALSE(std::filesystem::exists(folder / left));
  while (::waitpid(-1, nullptr, 0) > 0) {
  }
}

TEST(BadInput, MakesControlCharactersVisibleAndCutsLongOnes) {
  const std::string found = "a\n\x01" + std::string(200, 'x');
  const Error error = bad_input("f", "byte 1", found, "y");
  const std::string line = error.what();
  EXPECT_TRUE(line.starts_with("f: byte 1: found a\\x0a\\x01xx")) << line;
  EXPECT_LT(line.size(), 150U);
}

TEST(BadInput, IsOneHarmlessLineWhateverStandsInItsParts) {
  const std::string evil = "a\n\x1b[31m\xff" + std::string(1000, 'x');
  const std::string line = bad_input(evil, evil, evil, evil).what();
  EXPECT_EQ(line.find_first_of("\n\x1b\xff"), std::string::npos) << line;
  EXPECT_TRUE(line.starts_with("a\\x0a\\x1b[31m\\xff" + std::string(1000, 'x') + ": a\\x0a"))
      << "the file's name is whole";
  EXPECT_LT(line.size(), 1600U);
}

TEST(BadInput, IsNoLongerForANameThatNobodyCanRead) {
  EXPECT_LT(std::string(bad_input(std::string(100'000, 'f'), "a", "b", "c").what()).size(), 1100U);
}

TEST(WrongUsage, IsOneHarmlessLineThatIsShort) {
  const std::string long_word(24'000, 'x'), evil = "a\n\x1b[31m\xe2\x80\xae";
  const std::string line = wrong_usage("no '" + long_word + "' of " + evil).what();
  EXPECT_LT(line.size(), 300U);
  EXPECT_TRUE(line.starts_with("no 'xxx")) << line;
  EXPECT_TRUE(line.ends_with("… of a\\x0a\\x1b[31m\\xe2\\x80\\xae")) << line;
  std::string words;
  for (int k = 0; k < 10'000; ++k) words += "word ";
  EXPECT_LT(std::string(wrong_usage(words).what()).size(), 1010U);
  EXPECT_STREQ(wrong_usage("two  blanks, ω").what(), "two  blanks, ω");
}

TEST(FileGuard, KeepsWhatIsReadFromBeingWritten) {
  const Folder folder;
  const std::string path = folder.write("in", "x");
  std::filesystem::create_symlink("in", folder / "link");
  {
    const FileGuard guard;
    InputFile in(path);
    EXPECT_HAS(refusal([&] { OutputFile out(folder / "link"); }, Exit::usage),
               "would be overwritten");
    EXPECT_HAS(refusal([&] { OutputFile out(folder / "./in"); }, Exit::usage),
               "would be overwritten");
    will_read(folder / "later");
    EXPECT_HAS(refusal([&] { OutputFile out(folder / "later"); }, Exit::usage),
               "would be overwritten");
    OutputFile out(folder / "out");
    folder.write("out", "y");
    EXPECT_HAS(refusal([&] { InputFile again(folder / "out"); }, Exit::usage),
               "would be overwritten");
  }
  write_file(path, "without a guard");
  EXPECT_EQ(test::read_bytes(path), "without a guard");
}

TEST(FileGuard, KnowsAnInputByEachLinkThatLeadsToIt) {
  const Folder folder;
  folder.write("in", "x");
  std::filesystem::create_symlink("in", folder / "near");
  std::filesystem::create_symlink("near", folder / "far");
  std::filesystem::create_symlink("in", folder / "planted");
  const FileGuard guard;
  InputFile in(folder / "far");
  for (const char* name : {"in", "near", "far"})
    EXPECT_HAS(refusal([&] { OutputFile out(folder / name, NamedBy::gonio); }, Exit::usage),
               "would be overwritten");
  EXPECT_HAS(refusal([&] { OutputFile out(folder / "planted"); }, Exit::usage),
             "would be overwritten");
  write_file(folder / "planted", "new", NamedBy::gonio);
  EXPECT_EQ(test::read_bytes(folder / "in"), "x");
}

TEST(FileGuard, KeepsALinkToAnOutputFromBeingOneItself) {
  const Folder folder;
  std::filesystem::create_symlink("there", folder / "link");
  const FileGuard guard;
  OutputFile one(folder / "link");
  for (const char* name : {"link", "there"})
    EXPECT_HAS(refusal([&] { OutputFile two(folder / name, NamedBy::gonio); }, Exit::usage),
               "two outputs");
}

TEST(FileGuard, LetsNoReaderTakeATakenNameForAFaultOfItsDocument) {
  const Folder folder;
  const FileGuard guard;
  OutputFile out(folder.write("f", "x"));
  EXPECT_THROW(
      try { InputFile in(folder / "f"); } catch (const Error&){}, NameTaken);
}

TEST(FileGuard, KeepsTwoFilesFromHavingOneName) {
  const Folder folder;
  const FileGuard guard;
  OutputFile one(folder / "new");
  EXPECT_HAS(refusal([&] { OutputFile two(folder / "./new"); }, Exit::usage), "two outputs");
  one.commit();
  EXPECT_EQ(refusal([&] { InputFile in(folder.write("new", "made here")); }), "");
}

TEST(FileGuard, LetsAnEarlierResultBeReplaced) {
  const Folder folder;
  const FileGuard guard;
  const std::string path = folder.write("result", "x");
  may_replace(path);
  InputFile in(path);
  write_file(path, "new");
  EXPECT_EQ(test::read_bytes(path), "new");
}

TEST(PathBeside, LiesBelowTheDocumentsFolder) {
  const Folder folder;
  std::filesystem::create_directories(folder / "a/b");
  folder.write("outside", "x");
  std::filesystem::create_symlink("../outside", folder / "a/link");
  std::filesystem::create_symlink("b", folder / "a/near");
  const std::string document = folder.write("a/d.json", "{}");
  const auto refused = [&](const std::string& name) {
    return refusal([&] { path_beside(document, name); });
  };
  for (const char* name : {"x", "b/x", "./b/../x", "near/x", "..x"}) EXPECT_EQ(refused(name), "");
  EXPECT_EQ(path_beside(document, "b/x"), folder / "a/b/x");
  for (const std::string& name :
       {std::string("../outside"), std::string("b/../../outside"), std::string("link"),
        folder / "outside", std::string("/etc/passwd"), std::string("missing/../../x")})
    EXPECT_HAS(refused(name), "--follow-paths");
}

TEST(CommitAll, LeavesTheFilesOfOneRunWhereTwoWriteTheSameNames) {
  const Folder folder;
  const auto run = [&](const char* content) {
    const pid_t child = ::fork();
    if (child != 0) return child;
    slowly = 20'000;
    OutputFile table(folder / "table"), beside(folder / "beside");
    table.write(content);
    beside.write(content);
    commit_all(std::array{&table, &beside});
    ::_exit(0);
  };
  for (int round = 0; round < 8; ++round) {
    for (const pid_t child : {run("one"), run("other")}) ::waitpid(child, nullptr, 0);
    EXPECT_EQ(test::read_bytes(folder / "table"), test::read_bytes(folder / "beside"));
  }
}

TEST(CommitAll, AsksForNoLockThatItsRunHasAndForOneThatAnotherHas) {
  const Folder folder;
  const FolderLock lock(folder / "made", FolderLock::Taken::is_refused);
  const auto refused = [&](const FolderLock* held) {
    OutputFile one(folder / "made/one"), other(folder / "made/other");
    test::refused_locks = 0;
    commit_all(std::array{&one, &other}, held);
    return test::refused_locks;
  };
  EXPECT_EQ(refused(&lock), 0);
  EXPECT_GT(refused(nullptr), 1) << "it waits, and then goes on";
}

TEST(FolderLock, IsOfOneAtATime) {
  const Folder folder;
  {
    const FolderLock mine(folder / "made", FolderLock::Taken::is_refused);
    EXPECT_HAS(refusal([&] { FolderLock other(folder / "made", FolderLock::Taken::is_refused); }),
               "another run");
  }
  const FolderLock again(folder / "made", FolderLock::Taken::waits);
}

}  // namespace
}  // namespace gonio
