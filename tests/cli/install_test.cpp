// What is installed, used where the project is not.
#include <filesystem>

#include "cli/program.h"

namespace gonio::test {
namespace {

namespace fs = std::filesystem;

const fs::path build = fs::path(program_path()).parent_path();

struct Said {
  int code;
  std::string text;
};

Said said_by(const Folder& f, const std::string& command) {
  f.write("script", command);
  const int code = std::system(("cd '" + (f / "") + "' && bash script > said 2>&1").c_str());
  return {code, read_bytes(f / "said")};
}

void install(const Folder& f, const std::string& component) {
  const auto o = said_by(f, "cmake --install '" + build.string() + "' --component " + component +
                                " --prefix \"$PWD/there\"");
  ASSERT_EQ(o.code, 0) << o.text;
}

TEST(Install, LeavesAProgramThatFitsWithoutTheProjectAndWithoutItsTests) {
  const Folder f;
  install(f, "program");
  const auto o =
      said_by(f,
              "set -e\ncd there\nexport PATH=\"$PWD/bin:/usr/bin:/bin\"\n"
              "gonio synth ggx/smith_ggx.correlated/schlick --set alpha=0.3 f0=0.9 --layout "
              "hemisphere -o t.csv\n"
              "gonio fit t.csv --model ggx/smith_ggx.correlated/schlick\n"
              "! ldd bin/gonio | grep -E 'gtest|gmock|benchmark|rapidcheck'\n"
              "ls share/man/man1/gonio-fit.1 share/doc/gonio/LICENSE "
              "share/bash-completion/completions/gonio\n");
  EXPECT_EQ(o.code, 0) << o.text;
  EXPECT_NE(o.text.find("alpha"), o.text.npos) << o.text;
}

TEST(Install, LetsACppProgramFindTheRoomsAndFit) {
  if (std::getenv("GONIO_LONG") == nullptr && build.filename() != "release")
    GTEST_SKIP() << "The rooms of this build are not installed.";
  const Folder f;
  install(f, "development");
  f.write("CMakeLists.txt",
          "cmake_minimum_required(VERSION 3.25)\nproject(user CXX)\n"
          "find_package(gonio 0.1 REQUIRED)\nadd_executable(user user.cpp)\n"
          "target_link_libraries(user PRIVATE gonio::fitting)\n");
  f.write("user.cpp",
          "#include <cstdio>\n#include \"brdf/model/model.h\"\n#include \"fitting/fit.h\"\n"
          "int main() {\n"
          "  const auto model = gonio::compose(\"ggx/smith_ggx.correlated/schlick\", 3);\n"
          "  std::printf(\"%zu\\n\", model.parameters.size());\n}\n");
  const auto o = said_by(f,
                         "set -e\ncmake -S . -B b -G Ninja -DCMAKE_PREFIX_PATH=\"$PWD/there\" "
                         "--log-level=ERROR >/dev/null\nninja -C b >/dev/null\nb/user\n");
  ASSERT_EQ(o.code, 0) << o.text;
  EXPECT_EQ(o.text, "2\n") << "alpha and f0";
}

// A Debian of its own, fetched: minutes.
TEST(Install, AsADebianPackageFitsOnABareDebian) {
  if (std::getenv("GONIO_LONG") == nullptr) GTEST_SKIP() << "without GONIO_LONG";
  if (std::system("command -v debootstrap dpkg-shlibdeps >/dev/null && [ $(id -u) = 0 ]") != 0)
    GTEST_SKIP() << "Without debootstrap and the rights to use it: no bare Debian.";
  const Folder f;
  const auto packed = said_by(f, "cd '" + build.string() + "' && cpack -B \"$OLDPWD/packed\"");
  ASSERT_EQ(packed.code, 0) << packed.text;
  if (said_by(f, "debootstrap --variant=minbase bookworm bare").code != 0)
    GTEST_SKIP() << "No mirror of Debian is within reach.";
  const auto o = said_by(
      f,
      "set -e\ncp packed/gonio_*.deb bare/gonio.deb\ncp /etc/resolv.conf bare/etc/ || true\n"
      "chroot bare apt-get install -y -qq --no-install-recommends /gonio.deb\n"
      "chroot bare sh -c 'cd /tmp && gonio synth ggx/smith_ggx.correlated/schlick --set alpha=0.3 "
      "f0=0.9 --layout hemisphere -o t.csv && gonio fit t.csv --model "
      "ggx/smith_ggx.correlated/schlick'\n"
      "! chroot bare ldd /usr/bin/gonio | grep -E 'not found|gtest|gmock|benchmark|rapidcheck'\n"
      "ls bare/usr/share/man/man1/gonio-fit.1\n");
  EXPECT_EQ(o.code, 0) << o.text;
  EXPECT_NE(o.text.find("alpha"), o.text.npos) << o.text;
}

}  // namespace
}  // namespace gonio::test
