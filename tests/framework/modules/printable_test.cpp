#include "framework/modules/printable.hpp"

#include <gtest/gtest.h>

namespace cairn {
namespace {

TEST(Printable, TextStaysAsItIs) {
  EXPECT_EQ(printable(""), "");
  EXPECT_EQ(printable("no licence: \"x\" ~"), "no licence: \"x\" ~");
  EXPECT_EQ(printable("fünf €"), "fünf €");
}

TEST(Printable, ControlCharactersAreShownByNumber) {
  EXPECT_EQ(printable("a\nb\r\x1b[2J\x7f"), "a\\nb\\x0d\\x1b[2J\\x7f");
  EXPECT_EQ(printable("\xc2\x9b"
                      "2J"),
            "\\xc2\\x9b2J")
      << "the one-character form of ESC [";
  EXPECT_EQ(printable("\xc2\xa0"), "\xc2\xa0");
}

TEST(Printable, WhatIsNotUtf8IsShownByNumber) {
  EXPECT_EQ(printable("f\xfcnf"), "f\\xfcnf");
}

TEST(Printable, ALongTextIsCutButNotWithinACharacter) {
  EXPECT_EQ(printable("abcdef", 3), "abc...");
  EXPECT_EQ(printable("abc", 3), "abc");
  EXPECT_EQ(printable("a€b", 2), "a...");
}

}  // namespace
}  // namespace cairn
