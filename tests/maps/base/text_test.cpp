#include "maps/base/text.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <set>
#include <vector>

namespace cairn {
namespace {

TEST(Text, TextsAreJoinedInTheirOrder) {
  EXPECT_EQ(joined(std::vector<std::string>{}), "");
  EXPECT_EQ(joined(std::vector<std::string>{"one"}), "one");
  EXPECT_EQ(joined(std::vector<std::string>{"", "b", ""}, "; "), "; b; ");
  EXPECT_EQ(joined(std::set<std::string>{"b", "a"}), "a, b");
}

TEST(Text, OneThingIsNoPlural) {
  EXPECT_EQ(counted(0, "landmark"), "0 landmarks");
  EXPECT_EQ(counted(std::size_t{1}, "landmark"), "1 landmark");
  EXPECT_EQ(counted(std::int64_t{3}, "landmark"), "3 landmarks");
}

TEST(Text, BlanksGoAtBothEndsOnly) {
  EXPECT_EQ(trimmed("\t a b "), "a b");
  EXPECT_EQ(trimmed("\na\n"), "\na\n");
  EXPECT_EQ(trimmed("\na\n", "\n"), "a");
}

// So that its place in a line can be given.
TEST(Text, WhatIsAllBlankIsCutToItsEnd) {
  const std::string_view blank = "  ";
  EXPECT_EQ(trimmed(blank), "");
  EXPECT_EQ(trimmed(blank).data(), blank.data() + blank.size());
}

TEST(Text, ANumberIsTheWholeText) {
  EXPECT_EQ(number_from<double>("-2.5e3"), -2500.0);
  EXPECT_EQ(number_from<int>("12"), 12);
  for (const char* const text : {"", " 1", "1 ", "1x", "+1", "0x10"}) EXPECT_FALSE(number_from<double>(text)) << text;
  EXPECT_FALSE(number_from<int>("3000000000"));
  EXPECT_FALSE(number_from<unsigned>("-1"));
  EXPECT_FALSE(number_from<double>("1e999"));
}

}  // namespace
}  // namespace cairn
