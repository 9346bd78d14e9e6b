#include "plugins/behaviours/places/place_name.hpp"

#include <gmock/gmock.h>

#include "maps/hierarchy/hierarchies.hpp"

namespace cairn::behaviours {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(PlaceNames, APlaceOfTheMapIsItself) {
  const FoundPlace found = find_place(place_name_of({1.0, 2.5}), LandmarkGraph());
  ASSERT_TRUE(found.place.pose);
  EXPECT_EQ(found.place.pose->position(), Point(1.0, 2.5));
  EXPECT_EQ(place_name_of({1.0, 2.5}).text, "(1.00, 2.50)");
}

TEST(PlaceNames, AnEmptyMapHoldsNothing) {
  EXPECT_EQ(find_landmarks("L3", LandmarkGraph()).unknown, "no landmark \"L3\"; the map holds no landmark");
  EXPECT_EQ(find_landmarks("nearest square", LandmarkGraph()).unknown,
            "no landmark of category \"square\"; the map holds no landmark");
}

TEST(PlaceNames, AClusterIsThoseOfItsLandmarksThatAreLeft) {
  LandmarkGraph graph;
  for (int i = 0; i < 4; ++i) graph.add({});
  const ClusterTree clusters{
      {{1, {1, 1, 0, 1, "kitchen"}}, {2, {2, 1, 0, 3, ""}}}, {{1, 1}, {2, 1}, {3, 2}, {4, 2}}, 3};
  EXPECT_THAT(find_landmarks("kitchen", graph, clusters).place.landmarks, ElementsAre(1, 2));
  EXPECT_THAT(find_landmarks("C1:L3", graph, clusters).place.landmarks, ElementsAre(3, 4));
  EXPECT_EQ(find_landmarks("kitchn", graph, clusters).unknown,
            "no landmark and no cluster \"kitchn\" (did you mean \"kitchen\"?); the map holds L1, L2, L3, L4 and the "
            "clusters kitchen, C1:L3");
  graph.remove(2);
  EXPECT_THAT(find_landmarks("kitchen", graph, clusters).place.landmarks, ElementsAre(1));
}

TEST(PlaceNames, TheWorldsHierarchiesNameItsClusters) {
  LandmarkGraph graph;
  for (int i = 0; i < 2; ++i) graph.add({});
  const ClusterTree clusters{{{1, {1, 1, 0, 1, "kitchen"}}, {2, {2, 1, 0, 2, ""}}}, {{1, 1}, {2, 2}}, 3};
  const Hierarchies hierarchies(graph, clusters, {});
  const OccupancyGrid grid(0.1);
  const RobotModel robot;
  WorldView world{grid, graph, robot, {}};
  EXPECT_THAT(find_landmarks("kitchen", world).unknown, HasSubstr("no landmark \"kitchen\""));
  world.hierarchies = &hierarchies;
  EXPECT_THAT(find_place({"kitchen", std::nullopt}, world).place.landmarks, ElementsAre(1));
}

TEST(PlaceNames, ALongListOfLandmarksIsCut) {
  LandmarkGraph graph;
  for (int i = 0; i < 13; ++i) {
    Landmark landmark;
    landmark.category = "square";
    graph.add(landmark);
  }
  const std::string sentence = find_landmarks("nearest sqare", graph).unknown;
  EXPECT_THAT(sentence, HasSubstr("did you mean"));
  EXPECT_THAT(sentence, HasSubstr("L12 (square), ..."));
  EXPECT_THAT(find_landmarks("L2", graph).place.landmarks, ElementsAre(2));
  EXPECT_EQ(find_landmarks("nearest square", graph).place.landmarks.size(), 13U);
}

TEST(PlaceNames, ATagThatCannotBeIsRefused) {
  const auto error_of = [](const std::string& text) -> std::string {
    const ConfigValue value = parse_config_text("at: " + text, "m.yaml").entries.at(0).value;
    try {
      (void)to_place_name(value, "at");
      (void)to_landmark_name(value, "at");
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "none";
  };
  EXPECT_EQ(error_of("tag 586"), "none");
  EXPECT_EQ(error_of("tag 36h11 587"), "m.yaml:1:5: at: \"tag 36h11 587\": there is no such tag: 36h11 has 0 to 586");
  EXPECT_THAT(error_of("tag 9999"), HasSubstr("standard41h12 has 0 to 2114"));
}

TEST(PlaceNames, ABareCategoryIsItsNearestLandmarkUnlessALandmarkIsCalledSo) {
  LandmarkGraph graph;
  for (const char* category : {"square", "circle", "square"}) {
    Landmark landmark;
    landmark.category = category;
    graph.add(landmark);
  }
  EXPECT_THAT(find_landmarks("square", graph).place.landmarks, ElementsAre(1, 3));
  EXPECT_THAT(find_landmarks("sqare", graph).unknown, HasSubstr("no landmark \"sqare\" (did you mean \"square\"?)"));
  graph.find(2)->name = "square";
  EXPECT_THAT(find_landmarks("square", graph).place.landmarks, ElementsAre(2));
}

}  // namespace
}  // namespace cairn::behaviours
