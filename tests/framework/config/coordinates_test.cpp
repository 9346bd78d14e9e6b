#include "framework/config/coordinates.hpp"

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

std::optional<Point> point_of(const char* yaml) {
  return point_in(parse_config_text(yaml, "mission.yaml"), "goto");
}

TEST(Coordinates, OfAMissionAreAListOrText) {
  for (const char* text : {"[1, -2.5]", "'1,-2.5'", "1, -2.5", "'[1, -2.5]'"})
    EXPECT_THAT(point_of(text), Optional(Point(1.0, -2.5))) << text;
  for (const char* text : {"L3", "3", "nearest square", "{a: 1}", "kitchen, left"})
    EXPECT_FALSE(point_of(text)) << text;
}

TEST(Coordinates, OfAMissionAreTwoWithinTheRange) {
  EXPECT_THROW((void)point_of("'1,2,90'"), ConfigError);
  EXPECT_THROW((void)point_of("'1e9,2'"), ConfigError);
}

}  // namespace
}  // namespace cairn
