#include "framework/landmarks/markers/marker_config.hpp"

#include <gtest/gtest.h>

namespace cairn {
namespace {

ConfigValue categories_in(const std::string& text) {
  return parse_config_text("categories: " + text, "m.yaml").entries.at(0).value;
}

std::string error_of(const std::string& text) {
  try {
    (void)marker_categories_of(categories_in(text));
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "none";
}

TEST(MarkerConfig, CategoriesAreByTheNumbers) {
  const std::map<int, std::string> wanted{{3, "hall end"}, {4, "hall end"}, {2114, "dock"}};
  EXPECT_EQ(marker_categories_of(categories_in("{hall end: [3, 4], dock: [2114]}")), wanted);
}

TEST(MarkerConfig, WhatCannotBeACategoryHasItsPlace) {
  EXPECT_EQ(error_of("[3]"), "m.yaml:1:13: categories must be a map of lists of ids, such as {door: [3, 4]}");
  EXPECT_EQ(error_of("{\"\": [3]}"), "m.yaml:1:14: categories: a category needs a name, such as {door: [3, 4]}");
  EXPECT_EQ(error_of("{\" \": [3]}"), "m.yaml:1:14: categories: a category needs a name, such as {door: [3, 4]}");
  EXPECT_EQ(error_of("{door: [3], dock: [3]}"), "m.yaml:1:32: categories.dock: the id 3 is of category door already");
  EXPECT_EQ(error_of("{dock: [1, 2115]}"),
            "m.yaml:1:24: categories.dock: there is no tag with the id 2115: 36h11 has 0 to 586, 25h9 has 0 to 34, "
            "standard41h12 has 0 to 2114");
}

TEST(MarkerConfig, NumbersAreThoseOfTheFamiliesThatAreLookedFor) {
  const ConfigValue categories = categories_in("{dock: [1, 600]}");
  const std::vector<MarkerFamily> small{MarkerFamily::tag36h11};
  EXPECT_NO_THROW(check_marker_numbers(categories, kMarkerFamilies));
  EXPECT_THROW(check_marker_numbers(categories, small), ConfigError);
}

}  // namespace
}  // namespace cairn
