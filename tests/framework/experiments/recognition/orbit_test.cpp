#include "framework/experiments/recognition/orbit.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "framework/experiments/recognition/orbit_table.hpp"

namespace cairn {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;
using testing::UnorderedElementsAre;

const Point kCentre{1.0, 2.0};

ExperimentConfig orbit_of_quarters() {
  ExperimentConfig config;
  config.experiment = ExperimentKind::orbit;
  config.variants = {{"as_is", {}}};
  config.categories = {"circle", "square"};
  config.orbit = OrbitConfig{"square", radians(90.0)};
  return config;
}

World world_with_square() {
  World world;
  WorldObject square;
  square.category = "square";
  square.T_map_object = {kCentre.x(), kCentre.y(), 0.0};
  world.objects = {square};
  return world;
}

// A matching while the robot stands in this direction from the square.
DegreeSample seen_from(double bearing_deg, double square, const Point& region_m = kCentre) {
  DegreeSample sample{0.0, region_m, {{"square", square, 0.0, kCentre}}};
  sample.templates = {{"square", radians(15.0), square}, {"circle", 0.0, 0.3}};
  sample.robot_m = kCentre + Point(std::cos(radians(bearing_deg)), std::sin(radians(bearing_deg)));
  return sample;
}

std::vector<OrbitSample> orbit_from_east(const std::vector<DegreeSample>& samples) {
  return degrees_along_orbit(orbit_of_quarters(), world_with_square(), kCentre + Point(1.0, 0.0), samples);
}

TEST(DegreesAlongOrbit, AnglesAddUpPastHalfATurnEitherWay) {
  for (const double way : {1.0, -1.0}) {
    const auto orbit =
        orbit_from_east({seen_from(way * 100.0, 0.5), seen_from(way * 200.0, 0.6), seen_from(way * 300.0, 0.7)});
    ASSERT_EQ(orbit.size(), 3U);
    EXPECT_NEAR(degrees(orbit[1].angle_rad), 200.0, 1e-9);
    EXPECT_NEAR(degrees(orbit[2].angle_rad), 300.0, 1e-9);
  }
}

TEST(DegreesAlongOrbit, HoldCategoriesInOrderAndTheTemplatesOfTheLandmark) {
  const auto orbit = orbit_from_east({seen_from(100.0, 0.5)});
  EXPECT_THAT(orbit[0].categories, ElementsAre(0.0, 0.5));
  EXPECT_THAT(orbit[0].templates, UnorderedElementsAre(Pair(15, 0.5)));
}

TEST(DegreesAlongOrbit, EndAfterOneLapAndLeaveOutWhatLooksElsewhere) {
  const auto orbit = orbit_from_east({seen_from(120.0, 0.5), seen_from(170.0, 0.9, {3.0, 2.0}), seen_from(240.0, 0.6),
                                      seen_from(359.0, 0.7), seen_from(5.0, 0.8)});
  ASSERT_EQ(orbit.size(), 3U);
  EXPECT_EQ(orbit[2].categories[1], 0.7);
}

TEST(OrbitTable, TheLastMatchingOfABinCountsInEachRun) {
  ExperimentRow first;
  first.mission = "round";
  first.variant = "as_is";
  first.orbit = orbit_from_east({seen_from(10.0, 0.2), seen_from(80.0, 0.4), seen_from(190.0, 0.9)});
  ExperimentRow second = first;
  second.orbit = orbit_from_east({seen_from(20.0, 0.6)});
  const auto categories = orbit_categories(orbit_of_quarters(), {&first, &second});
  ASSERT_EQ(categories.size(), 2U);
  ASSERT_EQ(categories[1].bins.size(), 4U);
  EXPECT_DOUBLE_EQ(categories[1].bins[0]->mean, 0.5) << "0.4 and 0.6";
  EXPECT_FALSE(categories[1].bins[1].has_value());
  EXPECT_DOUBLE_EQ(categories[1].bins[2]->mean, 0.9);
  EXPECT_THAT(orbit_table(orbit_of_quarters(), {first, second}),
              testing::AllOf(HasSubstr("| orbit, deg | square 15 deg |"), HasSubstr("| 90 - 180 | | |\n"),
                             HasSubstr("| 180 - 270 | 0.00 | 0.90 |\n"),
                             HasSubstr("Fits best at the end: square 15 deg in 2 of 2 runs.")));
}

}  // namespace
}  // namespace cairn
