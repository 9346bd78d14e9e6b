#include "maps/base/printable.hpp"

#include <gtest/gtest.h>

#include "maps/base/spelling.hpp"

namespace cairn {
namespace {

constexpr std::size_t kNone = std::string_view::npos;

TEST(Printable, TextOfAnyLanguageStaysAsItIs) {
  for (const std::string text :
       {"", "dock 3", "K\xC3\xBC\x63he", "\xF0\x9F\x97\xBA", "\xD7\xA9\xD7\x9C\xD7\x95\xD7\x9D",
        "\xE2\x80\x8F"}) {  // a right-to-left mark turns nothing but itself
    EXPECT_EQ(first_unprintable(text), kNone) << text;
    EXPECT_EQ(printable(text), text);
  }
}

TEST(Printable, WhatSteersATerminalIsEscaped) {
  EXPECT_EQ(printable("a\x1B[2Jb"), "a\\x1b[2Jb");
  EXPECT_EQ(printable(std::string("\0\x07\x7F", 3)), "\\x00\\x07\\u007f");
  EXPECT_EQ(printable("\xC2\x9B"
                      "31m"),
            "\\u009b31m")
      << "CSI as one character";
  EXPECT_EQ(printable("\x9B"
                      "31m"),
            "\\x9b31m")
      << "CSI as one byte, which is not UTF-8";
  EXPECT_EQ(printable("\xE2\x80\xAEtxt\xE2\x81\xA6"), "\\u202etxt\\u2066");
  EXPECT_EQ(printable("cut \xE2\x80"), "cut \\xe2\\x80");
}

TEST(Printable, LinesPassWhereTheyAreAllowed) {
  EXPECT_EQ(printable("a\nb\tc\r"), "a\\x0ab\\x09c\\x0d");
  EXPECT_EQ(printable("a\nb\tc\r", kLineCharacters), "a\nb\tc\r");
  EXPECT_EQ(first_unprintable("a\nb\x1B", kLineCharacters), 3U);
}

TEST(Printable, TheFirstOneIsNamed) {
  EXPECT_EQ(first_unprintable("ab\x1B"), 2U);
  EXPECT_EQ(name_of_unprintable("ab\x1B", 2), "the control character \\x1b");
  EXPECT_EQ(name_of_unprintable("\xE2\x80\xAE", 0), "the control character \\u202e");
  EXPECT_EQ(name_of_unprintable("\xFF", 0), "the byte \\xff");
}

TEST(InQuotes, HoldsNothingThatSteersATerminal) {
  EXPECT_EQ(in_quotes("a\n\x1B[2J\xC2\x9B\xE2\x80\xAE\x9B"), "\"a\\n\\x1b[2J\\u009b\\u202e\\x9b\"");
}

TEST(Printable, AnExcerptIsCutButNotWithinACharacter) {
  EXPECT_EQ(printable_excerpt("abcdef", 3), "abc...");
  EXPECT_EQ(printable_excerpt("abc", 3), "abc");
  EXPECT_EQ(printable_excerpt("a€b", 2), "a...");
  EXPECT_EQ(printable_excerpt("a\x1b[2J", 2), "a\\x1b...");
}

}  // namespace
}  // namespace cairn
