#include "framework/planning/coordinates.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cairn {
namespace {

using testing::ElementsAre;
using testing::Optional;

TEST(Coordinates, AreReadWithAndWithoutBrackets) {
  for (const char* text : {"1,-2.5", " 1, -2.5 ", "[1, -2.5]", "[1,-2.5]", " [ 1 , -2.5 ] "})
    EXPECT_THAT(coordinates_in(text), Optional(ElementsAre(1.0, -2.5))) << text;
  EXPECT_THAT(coordinates_in("[1, 2, 90]"), Optional(ElementsAre(1.0, 2.0, 90.0)));
}

TEST(Coordinates, AreNotMadeOfAnythingElse) {
  for (const char* text : {"", "[", "]", "[]", "[1, 2", "1, 2]", "[[1, 2]]", "(1, 2)", "1,", "1,a", "1 2", "[1; 2]"})
    EXPECT_FALSE(coordinates_in(text)) << text;
}

}  // namespace
}  // namespace cairn
