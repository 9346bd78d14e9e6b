#include "framework/experiments/recognition/places.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "framework/experiments/recognition/places_table.hpp"

namespace cairn {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// A square at (1, 2), looked at from two places.
ExperimentConfig two_places() {
  ExperimentConfig config;
  config.experiment = ExperimentKind::places;
  config.variants = {{"as_is", {}}};
  config.categories = {"circle", "square"};
  config.places = {{"P1", "square", {0.4, 0.3}}, {"P2", "square", {0.4, 0.8}}};
  config.expected_matchings = 7;
  return config;
}

World world_with_square() {
  World world;
  WorldObject square;
  square.category = "square";
  square.T_map_object = {1.0, 2.0, 0.0};
  world.objects = {square};
  return world;
}

StepReport step_until(double end_s) {
  return {"drive", {StepState::success, ""}, 0.0, end_s};
}

DegreeSample sample(double time_s, const Point& at_m, double circle, double square) {
  return {time_s, at_m, {{"square", square, 0.0, at_m}, {"circle", circle, 0.0, at_m}}};
}

TEST(DegreesAtPlaces, AreOfTheLastMatchingBeforeThatLookedAtTheLandmark) {
  const std::vector<DegreeSample> samples{sample(1.0, {1.0, 2.1}, 0.3, 0.2), sample(4.0, {1.0, 2.0}, 0.5, 0.6),
                                          sample(5.0, {3.0, 2.0}, 0.9, 0.1), sample(6.5, {1.0, 2.0}, 0.4, 0.7)};
  const auto places = degrees_at_places(two_places(), world_with_square(), samples, {step_until(3.0), step_until(6.0)});
  ASSERT_EQ(places.size(), 2U);
  EXPECT_THAT(places[0].degrees, ElementsAre(0.3, 0.2)) << "as the categories are ordered";
  EXPECT_THAT(places[1].degrees, ElementsAre(0.5, 0.6));
  EXPECT_EQ(places[1].time_s, 4.0);
}

TEST(DegreesAtPlaces, AreNoneBeforeTheLandmarkIsLookedAt) {
  const auto places = degrees_at_places(two_places(), world_with_square(), {}, {step_until(3.0)});
  ASSERT_EQ(places.size(), 1U) << "the second step was not reached";
  EXPECT_THAT(places[0].degrees, IsEmpty());
}

TEST(DegreesAtPlaces, ACategoryThatWasLeftOutHasNone) {
  DegreeSample only_square{1.0, {1.0, 2.0}, {{"square", 0.6, 0.0, {1.0, 2.0}}}};
  const auto places = degrees_at_places(two_places(), world_with_square(), {only_square}, {step_until(3.0)});
  EXPECT_THAT(places[0].degrees, ElementsAre(0.0, 0.6));
}

TEST(PlacesTable, TheMarginIsToTheBestOtherCategory) {
  EXPECT_NEAR(margin_of({0.7, 0.2, 0.5}, 0), 0.2, 1e-12);
  EXPECT_NEAR(margin_of({0.2, 0.3, 0.2}, 2), -0.1, 1e-12);
}

TEST(PlacesTable, TheOrderIsSharedPairByPair) {
  const SharedOrder order = shared_order({0.1, 0.5, 0.4}, {0.2, 0.2, 0.8});
  EXPECT_EQ(order.pairs, 2) << "equal expected degrees say nothing";
  EXPECT_EQ(order.same, 1);
  EXPECT_EQ(shared_order({0.4, 0.4}, {0.1, 0.2}).same, 0) << "a tie is no order";
}

TEST(PlacesTable, StandsBesideWhatWasExpected) {
  ExperimentRow first;
  first.mission = "drive";
  first.variant = "as_is";
  first.result.matchings = 10;
  first.places = {{{}, 0.0}, {{0.4, 0.7}, 5.0}};
  ExperimentRow second = first;
  second.places = {{{0.4, 0.2}, 1.0}, {{0.4, 0.9}, 5.0}};
  const std::string table = places_table(two_places(), {first, second});
  EXPECT_THAT(table, HasSubstr("| P1 | square | 0.40 | 0.20 | 0.4 | 0.3 | -0.20 | -0.1 | 0 | 1 |"));
  EXPECT_THAT(table, HasSubstr("| P2 | square | 0.40 ± 0.00 | 0.80 ± 1.27 | 0.4 | 0.8 | 0.40 ± 1.27 | 0.4 | 2 | 2 |"));
  EXPECT_THAT(table, HasSubstr("100 % differ the same way"));
  EXPECT_THAT(table, HasSubstr("Matchings in a run: 10.0 ± 0.0 (expected 7)."));
}

}  // namespace
}  // namespace cairn
