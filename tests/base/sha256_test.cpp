#include "base/sha256.h"

#include <chrono>
#include <filesystem>

#include "base/error.h"
#include "support.h"

namespace gonio {
namespace {

// The examples of FIPS 180-4.
TEST(Sha256, GivesTheStandardsVectors) {
  EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(sha256(std::string(1'000'000, 'a')),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(Sha256, OfAFileIsThatOfItsBytes) {
  const test::Folder folder;
  const std::string bytes(600'003, 'b');  // in several pieces
  EXPECT_EQ(sha256_of_file(folder.write("b", bytes)), sha256(bytes));
  EXPECT_THROW(sha256_of_file(folder / "missing"), Error);
}

TEST(Sha256, OfAnOpenFileIsTheSameWhateverWasReadAndRefusedOnceTheFileHasChanged) {
  const test::Folder folder;
  const std::string path = folder.write("b", "0123456789");
  InputFile in(path);
  char some[4];
  in.read(some, sizeof some);
  EXPECT_EQ(sha256_of_file(in), sha256("0123456789"));
  EXPECT_EQ(in.position(), 4U);
  std::filesystem::last_write_time(
      path, std::filesystem::last_write_time(path) + std::chrono::seconds(1));
  EXPECT_THROW(sha256_of_file(in), Error);
}

}  // namespace
}  // namespace gonio
