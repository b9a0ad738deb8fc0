#include "base/file.h"

#include <chrono>
#include <filesystem>
#include <functional>

#include "base/error.h"
#include "support.h"

#include <sys/stat.h>

namespace gonio {
namespace {

using test::Folder;

std::string complaint(const std::function<void()>& f) {
  try {
    f();
    return "";
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), Exit::bad_input);
    return e.what();
  }
}

TEST(InputFile, SaysWhatIsNoRegularFile) {
  const Folder folder;
  EXPECT_NE(complaint([&] { InputFile(folder / "missing"); }).find("No such file"),
            std::string::npos);
  EXPECT_NE(complaint([&] { InputFile(folder / ""); }).find("a directory"), std::string::npos);
  EXPECT_NE(complaint([] { InputFile("/dev/null"); }).find("a device"), std::string::npos);
  EXPECT_NE(complaint([&] { InputFile(folder.write("e", "")); }).find("an empty file"),
            std::string::npos);
}

TEST(InputFile, ReadsAtAnyPlaceAndNamesTheByteWhereItEnds) {
  const Folder folder;
  const InputFile in(folder.write("f", "0123456789"));
  std::string two(2, ' ');
  in.read_at(7, two.data(), 2);
  EXPECT_EQ(two, "78");
  EXPECT_NE(complaint([&] { in.read_at(9, two.data(), 2); }).find("byte 10: found the end"),
            std::string::npos);
}

TEST(InputFile, KnowsWhetherItWasWrittenToMeanwhile) {
  const Folder folder;
  const auto changed = [](const InputFile& in) {
    return complaint([&] { in.expect_unchanged(); }).find("changed meanwhile") != std::string::npos;
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
  EXPECT_NE(complaint([&] {
              in.read(many.data(), 20);
            }).find("byte 10: found the end of the file, expected 14 more"),
            std::string::npos);
}

TEST(InputFile, RefusesARestThatIsTooLong) {
  const Folder folder;
  InputFile in(folder.write("f", "0123456789"));
  EXPECT_NE(complaint([&] { in.read_rest(9); }).find("found 10 bytes, expected at most 9"),
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
  EXPECT_NE(complaint([&] { OutputFile(folder / "none/such"); }).find("No such file"),
            std::string::npos);
  EXPECT_NE(complaint([&] { OutputFile(folder / ""); }).find("a directory"), std::string::npos);
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
    EXPECT_TRUE(complaint([&] {
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
  EXPECT_NE(complaint([&] { OutputFile(folder / "circle"); }).find("symbolic links"),
            std::string::npos);
}

TEST(OutputFile, IsReadableByWhomTheUserLets) {
  const Folder folder;
  const auto before = ::umask(022);
  write_file(folder / "f", "x");
  ::umask(before);
  EXPECT_EQ(std::filesystem::status(folder / "f").permissions(), std::filesystem::perms{0644});
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

}  // namespace
}  // namespace gonio
