#include "framework/config/named_category.hpp"

#include <gtest/gtest.h>

namespace cairn {
namespace {

const std::vector<std::string> kCategories{"circle", "square"};

std::string error_of(const std::string& text, const std::vector<std::string>& categories = kCategories) {
  try {
    check_named_categories(parse_config_text("at: " + text, "m.yaml").find("at")[0], "goto", categories);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "fine";
}

TEST(NamedCategory, IsOneOfTheTemplates) {
  const std::string sentence = ": goto: the mission has no template of category ";
  EXPECT_EQ(error_of("nearest squar"),
            "m.yaml:1:5" + sentence + "\"squar\" (did you mean \"square\"?); it has circle, square");
  EXPECT_EQ(error_of("[[1, 2], nearest square, nearest lamp]"),
            "m.yaml:1:30" + sentence + "\"lamp\"; it has circle, square");
  EXPECT_EQ(error_of("'nearest '"), "m.yaml:1:5" + sentence + "\"\"; it has circle, square");
  EXPECT_EQ(error_of("'nearest '", {}), "m.yaml:1:5" + sentence + "\"\"");
}

TEST(NamedCategory, WhatOnlyAMapKnowsIsFine) {
  for (const char* fine : {"nearest square", "L3", "squar", "nearest", "[1, 2]", "[nearest circle, L1]", "", "{a: b}"})
    EXPECT_EQ(error_of(fine), "fine") << fine;
  EXPECT_EQ(error_of("nearest squar", {}), "fine") << "nobody knows the categories";
}

}  // namespace
}  // namespace cairn
