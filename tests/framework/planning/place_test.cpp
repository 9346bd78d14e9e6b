#include "framework/planning/place.hpp"

#include <gtest/gtest.h>

namespace cairn {
namespace {

LandmarkGraph two_landmarks() {
  LandmarkGraph graph;
  Landmark square;
  square.category = "square";
  square.name = "desk";
  graph.add(square);
  Landmark circle;
  circle.category = "circle";
  graph.add(circle);
  return graph;
}

const std::string kWhatAPlaceIs =
    "; a place is x,y or x,y,angle_deg, a landmark's or cluster's id or name, `tag NUMBER`, or `nearest CATEGORY`";

std::string error_of(const std::string& text) {
  try {
    (void)parse_place(text, two_landmarks());
  } catch (const PlaceError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Place, TwoNumbersAreAPositionWhoseHeadingDoesNotMatter) {
  const Place place = parse_place(" 0.5, -1 ", two_landmarks());
  ASSERT_TRUE(place.pose);
  EXPECT_EQ(*place.pose, (Pose2{0.5, -1.0, 0.0}));
  EXPECT_FALSE(place.heading_matters);
}

TEST(Place, MayStandInBracketsAsInYaml) {
  EXPECT_EQ(*parse_place("[0.5, -1]", two_landmarks()).pose, (Pose2{0.5, -1.0, 0.0}));
  EXPECT_TRUE(parse_place("[1, 2, 90]", two_landmarks()).heading_matters);
  EXPECT_TRUE(reads_as_place("[1, 2]"));
  EXPECT_EQ(error_of("[1, 2"), "place \"[1, 2\" is not made of numbers alone" + kWhatAPlaceIs);
}

TEST(Place, AThirdNumberIsAHeadingInDegrees) {
  const Place place = parse_place("1,2,90", two_landmarks());
  EXPECT_TRUE(place.heading_matters);
  EXPECT_DOUBLE_EQ(place.pose->theta_rad, radians(90.0));
}

TEST(Place, ALandmarkIsNamedByIdOrName) {
  EXPECT_EQ(parse_place("L2", two_landmarks()).landmarks, std::vector<LandmarkId>{2});
  EXPECT_EQ(parse_place("desk", two_landmarks()).landmarks, std::vector<LandmarkId>{1});
}

TEST(Place, ALoneNumberIsALandmarksNameOrAMistake) {
  LandmarkGraph graph = two_landmarks();
  graph.find(2)->name = "0";
  EXPECT_EQ(parse_place("0", graph).landmarks, std::vector<LandmarkId>{2});
  EXPECT_EQ(error_of("0"), "place \"0\" is one number" + kWhatAPlaceIs);
  EXPECT_EQ(error_of("1"), "place \"1\" is one number (did you mean \"L1\"?)" + kWhatAPlaceIs);
}

TEST(Place, WhatReadsAsAPlaceIsNoName) {
  for (const char* text : {"1,2", " 1, 2 ,3", "1,2,3,4", "nearest dock"}) EXPECT_TRUE(reads_as_place(text)) << text;
  for (const char* text : {"", "1", "dock", "1,a", "nearest"}) EXPECT_FALSE(reads_as_place(text)) << text;
}

TEST(Place, NearestTakesEveryLandmarkOfTheCategory) {
  EXPECT_EQ(parse_place("nearest circle", two_landmarks()).landmarks, std::vector<LandmarkId>{2});
}

TEST(Place, ABareCategoryIsItsNearestLandmarkUnlessALandmarkIsCalledSo) {
  EXPECT_EQ(parse_place("circle", two_landmarks()).landmarks, std::vector<LandmarkId>{2});
  EXPECT_TRUE(error_of("circel").starts_with("unknown place \"circel\" (did you mean \"circle\"?)"));
  LandmarkGraph graph = two_landmarks();
  graph.find(1)->name = "circle";
  EXPECT_EQ(parse_place("circle", graph).landmarks, std::vector<LandmarkId>{1});
}

TEST(Place, AClusterIsAnyOfItsLandmarks) {
  const LandmarkGraph graph = two_landmarks();
  const ClusterTree clusters{
      {{1, {1, 1, 3, 1, ""}}, {2, {2, 1, 3, 2, "circle"}}, {3, {3, 2, 0, 1, "desk"}}}, {{1, 1}, {2, 2}}, 4};
  EXPECT_EQ(parse_place("C1:desk", graph, clusters).landmarks, std::vector<LandmarkId>{1});
  EXPECT_EQ(parse_place("C2:L1", graph, clusters).landmarks, (std::vector<LandmarkId>{1, 2}));
  EXPECT_EQ(parse_place("circle", graph, clusters).landmarks, std::vector<LandmarkId>{2}) << "wins over a category";
  EXPECT_EQ(parse_place("desk", graph, clusters).landmarks, std::vector<LandmarkId>{1}) << "a landmark wins";
  EXPECT_THROW(static_cast<void>(parse_place("C1:desk", graph)), PlaceError);
}

TEST(Place, AnUnknownCategoryNamesTheNearestKnownOne) {
  EXPECT_EQ(error_of("nearest sqare"),
            "no landmark of category \"sqare\" (did you mean \"square\"?); the map holds: circle, square");
}

TEST(Place, AnUnknownPlaceSaysWhatAPlaceIs) {
  EXPECT_EQ(error_of("desc"),
            "unknown place \"desc\" (did you mean \"desk\"?); a place is x,y or x,y,angle_deg, a landmark's or "
            "cluster's id or name, `tag NUMBER`, or `nearest CATEGORY`");
}

TEST(Place, WhatIsAPlaceOnNoMapIsMalformed) {
  const auto malformed = [](const std::string& text) -> std::string {
    try {
      (void)parse_place(text, two_landmarks());
    } catch (const MalformedPlace& error) {
      return error.what();
    } catch (const PlaceError&) {
      return "unknown";
    }
    return "no error";
  };
  EXPECT_EQ(malformed("1,2,3,4"), "place \"1,2,3,4\" has 4 numbers" + kWhatAPlaceIs);
  for (const char* text : {"nan,1", "1,inf", "1,2,nan"})
    EXPECT_EQ(malformed(text), std::string("place \"") + text + "\" has a number that is not finite" + kWhatAPlaceIs);
  for (const char* text : {"1,", "1,a", "1;2", "1 2", "1.5, ,2"})
    EXPECT_EQ(malformed(text), std::string("place \"") + text + "\" is not made of numbers alone" + kWhatAPlaceIs);
  EXPECT_EQ(malformed(" "), "place \"\" is empty" + kWhatAPlaceIs);
  EXPECT_EQ(malformed("nearest "), "place \"nearest\" names no category" + kWhatAPlaceIs);
  for (const char* name : {"desc", "L9", "2 desks", "desk,1", "nearest dock"})
    EXPECT_EQ(malformed(name), "unknown") << name;
}

TEST(Place, APrintedTagIsNamedByItsNumber) {
  LandmarkGraph graph = two_landmarks();
  graph.find(2)->marker = MarkerId{MarkerFamily::tag25h9, 7};
  EXPECT_EQ(parse_place("tag 7", graph).landmarks, std::vector<LandmarkId>{2});
  EXPECT_EQ(parse_place("tag 25h9 7", graph).landmarks, std::vector<LandmarkId>{2});
  EXPECT_THROW((void)parse_place("tag 8", graph), PlaceError);
}

}  // namespace
}  // namespace cairn
