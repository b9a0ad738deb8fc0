#include "reports/pages/batch_page.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

TEST(BatchPage, AHostileNameStaysText) {
  const std::string name = "</script><img src=x onerror=alert(1)>.csv";
  const std::string html = batch_page_html(name, "{\"path\": \"" + name + "\"}");
  EXPECT_EQ(html.find("<img"), html.npos);
}

}  // namespace
}  // namespace gonio
