#include "reports/finding/names.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>

#include "brdf/catalogue/registry.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

TEST(FormNames, AreApartWithinARole) {
  std::map<std::string, std::set<std::string>> of_role;
  for (const auto& term : catalogue()) {
    const std::string form(term.id()), name = name_of_form(form);
    EXPECT_FALSE(name.empty()) << form;
    EXPECT_TRUE(of_role[form.substr(0, form.find('.'))].insert(name).second) << name << " twice";
  }
}

TEST(FormNames, KeepWhatTellsAVariantFromItsForm) {
  EXPECT_EQ(name_of_form("masking.smith_gtr.separable, gamma 1"),
            "Smith for GTR, separable, gamma 1");
  EXPECT_EQ(name_of_form("fresnel.lazanyi, corrected"), "Lazányi's corrected form")
      << "it has a name of its own";
  EXPECT_EQ(name_of_form("a form of tomorrow"), "a form of tomorrow");
}

TEST(FormNames, AreBriefWhereThereIsLittleRoom) {
  EXPECT_EQ(brief_name("masking.smith_ggx.correlated"), "Height-correlated Smith");
  EXPECT_EQ(brief_name("masking.kelemen"), "Kelemen–Szirmay-Kalos");
  EXPECT_EQ(brief_name("diffuse.lambert.coupled"), "lambert.coupled") << "its title is long";
  EXPECT_EQ(brief_name("ggx/smith_ggx.correlated/exact"), "ggx/smith_ggx.correlated/exact")
      << "a combination is told whole";
}

}  // namespace
}  // namespace gonio
