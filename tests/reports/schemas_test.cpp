// The schemas that are shipped say what the documents hold.
#include <cstdlib>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "reports/audit/audit.h"
#include "reports/cost/baseline.h"
#include "reports/index/index_page.h"
#include "reports/index/kinds.h"
#include "support.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

std::vector<std::pair<std::string, std::string>> schemas() {
  std::vector<std::pair<std::string, std::string>> out{
      {"audit", audit_schema()}, {"bench", bench_schema()}, {"report.index", index_schema()}};
  for (const auto& kind : report_kinds())
    out.emplace_back("report." + std::string(kind.name), kind.schema());
  return out;
}

TEST(Schemas, ThatAreShippedAreWhatTheDescriptionsGive) {
  const bool write = std::getenv("GONIO_WRITE_SCHEMAS") != nullptr;
  for (const auto& [name, text] : schemas()) {
    const std::string path = test::project_folder() + "/schemas/" + name + ".schema.json";
    if (write) std::ofstream(path, std::ios::binary) << text;
    EXPECT_EQ(test::read_bytes(path), text) << path << ": GONIO_WRITE_SCHEMAS=1 writes it anew";
  }
}

}  // namespace
}  // namespace gonio
