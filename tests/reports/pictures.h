#pragma once
/// \file
/// What all pictures of a report have in common.

#include <algorithm>
#include <set>

#include "reports/picture/figure.h"

#include <gtest/gtest.h>

namespace gonio::test {

/// Ids are names of files and each there once, so are choices in a family; nothing is without a label, a point or its name.
inline void expect_whole(const Pictures& pictures) {
  std::set<std::string> ids;
  std::set<std::pair<std::string, FigureChoices>> chosen;
  const auto look_at = [&](const auto& p) {
    EXPECT_TRUE(ids.insert(p.id).second) << p.id << " is there twice";
    EXPECT_TRUE(chosen.emplace(p.family, p.choices).second) << p.id << " cannot be chosen alone";
    EXPECT_EQ(p.id.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_"), std::string::npos)
        << p.id;
    for (const auto& text : {p.id, p.title, p.x.label, p.y.label}) EXPECT_NE(text, "") << p.id;
  };
  const auto fits = [](std::size_t n, std::size_t points) { return n == 0 || n == points; };
  for (const auto& f : pictures.figures) {
    look_at(f);
    std::set<std::string> names;
    EXPECT_FALSE(f.curves.empty()) << f.id;
    for (const auto& c : f.curves) {
      EXPECT_TRUE(names.insert(c.name).second) << f.id << ": " << c.name << " is there twice";
      EXPECT_FALSE(c.x.empty()) << f.id << ": " << c.name;
      EXPECT_EQ(c.x.size(), c.y.size()) << f.id << ": " << c.name;
      for (const std::size_t n : {c.labels.size(), c.x_error.size(), c.y_error.size()})
        EXPECT_TRUE(fits(n, c.x.size())) << f.id << ": " << c.name;
    }
  }
  for (const auto& m : pictures.maps) {
    look_at(m);
    EXPECT_NE(m.value, "") << m.id;
    EXPECT_EQ(m.values.size(), m.x.size() * m.y.size() * std::max<std::size_t>(1, m.slices.size()))
        << m.id;
    for (const auto* axis : {&m.x, &m.y}) EXPECT_TRUE(std::ranges::is_sorted(axis->at)) << m.id;
  }
}

}  // namespace gonio::test
