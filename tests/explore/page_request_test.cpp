#include "fitting/ask/page_request.h"

#include "../../src/explore/module/shim/nettle/sha2.h"
#include "base/sha256.h"
#include "refusal.h"
#include "support.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace gonio {
namespace {

using nlohmann::json;

std::string asked(const json& request) {
  return answer_page(request.dump(), [](const std::string&) {});
}
/// A document without what differs from run to run.
json steady(const std::string& text) {
  auto d = json::parse(text);
  d["solver"].erase("time_ms");
  return d;
}

constexpr const char* rough =
    "theta_i,phi_i,theta_o,phi_o,f\n0,0,10,0,0.2\n0,0,30,0,0.1\n30,0,30,180,0.4\n30,0,40,180,0.2\n"
    "30,0,60,0,0.05\n60,0,60,180,0.9\n60,0,30,180,0.1\n60,0,0,0,0.05\n";

TEST(PageRequest, FitIsTheProgramsOwn) {
  const test::Folder f;
  const auto file = f.write("t.csv", rough);
  HowFitted how;
  how.options.model = "lambert";
  how.options.robust = true;
  std::vector<std::string> phases;
  const auto answer = answer_page(json{{"do", "fit"},
                                       {"file", file},
                                       {"options", {{"model", {"lambert"}}, {"robust", {"huber"}}}}}
                                      .dump(),
                                  [&](const std::string& what) { phases.push_back(what); });
  const std::string document = json::parse(answer)["document"];
  EXPECT_EQ(steady(document), steady(to_json(fit_files({file}, how).result.document)));
  EXPECT_EQ(json::parse(answer)["optimum"]["kd"][0], steady(document)["parameters"]["kd"]["value"]);
  EXPECT_EQ(steady(document)["robust"], "huber");
  ASSERT_FALSE(phases.empty());
  EXPECT_EQ(phases[0], "reading " + file);
}

TEST(PageRequest, FitHasTheValuesThatItsPageDraws) {
  const test::Folder f;
  // A single view in the mirror's direction knows no width.
  const auto file =
      f.write("t.csv", "theta_i,phi_i,theta_o,phi_o,f\n30,0,30,180,0.3\n40,0,40,180,0.31\n");
  const auto answer =
      json::parse(asked({{"do", "fit"},
                         {"file", file},
                         {"options", {{"model", {"ggx/smith_ggx.correlated/schlick"}}}}}));
  const auto document = json::parse(answer["document"].get<std::string>());
  EXPECT_TRUE(document["parameters"]["alpha"]["value"].is_null());
  EXPECT_TRUE(answer["optimum"]["alpha"][0].is_number());
}

TEST(PageRequest, ReadsATableAndGuessesColumns) {
  const test::Folder f;
  const auto usual = json::parse(asked({{"do", "read"}, {"file", f.write("t.csv", rough)}}));
  EXPECT_EQ(usual["error"], "");
  EXPECT_EQ(usual["inspection"]["valid"], 8);
  EXPECT_EQ(usual["table"]["channels"], json({"f"}));
  EXPECT_EQ(usual["columns"]["needed"], false);
  EXPECT_EQ(usual["table"]["file"], "");

  std::string other = rough;
  other.replace(0, other.find('\n'), "thetai,phii,thetar,phir,brdf");
  const auto file = f.write("odd.csv", other);
  const auto unread = json::parse(asked({{"do", "read"}, {"file", file}}));
  EXPECT_EQ(unread["table"], json());
  EXPECT_HAS(unread["error"].get<std::string>(), "odd.csv");
  EXPECT_EQ(unread["columns"]["names"], json({"thetai", "phii", "thetar", "phir", "brdf"}));
  EXPECT_EQ(unread["columns"]["map"]["theta_o"], "thetar");
  f.write("odd.csv.gonio.json",
          json{{"schema", "gonio.table/1"}, {"columns", unread["columns"]["map"]}}.dump());
  const auto read = json::parse(asked({{"do", "read"}, {"file", file}}));
  EXPECT_EQ(read["error"], "");
  EXPECT_EQ(read["table"]["values"], usual["table"]["values"]);
  // What is no table at all keeps the line that says so.
  const auto none =
      json::parse(asked({{"do", "read"}, {"file", f.write("t.xml", "<a>\n1 2 3\n4 5\n")}}));
  EXPECT_HAS(none["error"].get<std::string>(), "t.xml");
  EXPECT_EQ(none["columns"], json());
  // Samples that a person leaves out.
  const auto some = json::parse(
      asked({{"do", "read"}, {"file", file}, {"options", {{"mask", {"theta_o > 50"}}}}}));
  EXPECT_EQ(some["inspection"]["valid"], 6);
}

TEST(PageRequest, ComparesModels) {
  const test::Folder f;
  const auto d = json::parse(asked({{"do", "models"},
                                    {"file", f.write("t.csv", rough)},
                                    {"models", {"lambert", "oren_nayar"}}}));
  EXPECT_EQ(d["schema"], "gonio.models/1");
  EXPECT_EQ(d["models"].size(), 2);
  EXPECT_FALSE(d["recommended"].is_null());
}

TEST(PageRequest, RefusesWhatTheProgramRefuses) {
  const test::Folder f;
  const auto file = f.write("t.csv", rough);
  const auto refused = [&](const json& request, Exit code) {
    return test::refusal([&] { asked(request); }, code);
  };
  EXPECT_HAS(refused({{"do", "fly"}, {"file", file}}, Exit::bad_input), "read, fit or models");
  EXPECT_HAS(
      refused({{"do", "fit"}, {"file", file}, {"options", {{"no_such", {"1"}}}}}, Exit::usage),
      "no option '--no-such'; nearest: --");
  EXPECT_EQ(
      refused({{"do", "fit"}, {"file", file}, {"options", {{"fix", json::array()}}}}, Exit::usage),
      "--fix has no value");
  EXPECT_HAS(
      refused({{"do", "fit"}, {"file", file}, {"options", {{"metric", {"none"}}}}}, Exit::usage),
      "metric: found none, expected one of");
  EXPECT_HAS(refused({{"do", "fit"}, {"file", file}, {"options", {{"model", {"ggx/no/schlick"}}}}},
                     Exit::usage),
             "no");
  EXPECT_HAS(refused({{"do", "fit"}, {"file", f / "none.csv"}}, Exit::bad_input), "none.csv");
}

TEST(PageModule, HashesAsNettleDoes) {
  std::string bytes;
  for (int n = 0; n < 200; ++n) {
    sha256_ctx sum;
    sha256_init(&sum);
    const auto* p = reinterpret_cast<const std::uint8_t*>(bytes.data());
    sha256_update(&sum, bytes.size() / 3, p);
    sha256_update(&sum, bytes.size() - bytes.size() / 3, p + bytes.size() / 3);
    std::array<std::uint8_t, SHA256_DIGEST_SIZE> digest;
    sha256_digest(&sum, digest.size(), digest.data());
    std::string digits;
    for (const auto byte : digest)
      for (const int nibble : {byte >> 4, byte & 15}) digits += "0123456789abcdef"[nibble];
    ASSERT_EQ(digits, sha256(bytes)) << n;
    bytes += static_cast<char>(n * 37);
  }
}

}  // namespace
}  // namespace gonio
