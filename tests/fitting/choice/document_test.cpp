#include "fitting/choice/document.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace gonio {
namespace {

using nlohmann::json;

/// A model that was compared and one that was not.
ModelChoice two() {
  ModelChoice c;
  c.rows.resize(2);
  c.rows[0].model = "lambert";
  c.rows[0].compared = c.rows[0].converged = true;
  c.rows[0].log_rms = 0.5;
  c.rows[0].ns = 2, c.rows[0].ns_spread = 0.25;
  c.rows[1].model = "gltf";
  c.rows[1].note = "it has no alpha";
  return c;
}

TEST(ModelsDocument, LeavesOutWhatIsNotKnown) {
  const json d = json::parse(to_json(two(), {}, {"t.csv", "0ab1", "csv", "log"}));
  const json &compared = d.at("models")[0], &left_out = d.at("models")[1];
  EXPECT_EQ(compared.at("log_rms"), 0.5);
  EXPECT_EQ(compared.at("ns"), 2);
  EXPECT_EQ(compared.at("ns_spread"), 0.25);
  EXPECT_FALSE(compared.contains("note"));
  EXPECT_FALSE(compared.contains("cv_log_rms"));
  EXPECT_EQ(left_out.at("note"), "it has no alpha");
  EXPECT_FALSE(left_out.contains("log_rms"));
  EXPECT_FALSE(d.contains("recommended"));
}

TEST(ModelsDocument, TakesAPathThatIsNoUtf8) {
  EXPECT_NE(to_json(two(), {}, {"\xff.csv", "0ab1", "csv", "log"}).find("\xef\xbf\xbd.csv"),
            std::string::npos);
}

}  // namespace
}  // namespace gonio
