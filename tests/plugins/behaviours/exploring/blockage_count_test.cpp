#include "plugins/behaviours/exploring/blockage_count.hpp"

#include <gtest/gtest.h>

#include "plugins/behaviours/exploring/travelled.hpp"

namespace cairn::behaviours {
namespace {

ExploreBlockedSettings at_most(int in_a_row) {
  ExploreBlockedSettings settings;
  settings.max_in_a_row = in_a_row;
  return settings;
}

TEST(BlockageCount, CountsBlockagesWithoutADriveBetweenThem) {
  BlockageCount count(at_most(2));
  EXPECT_FALSE(count.is_any());
  for (const double driven_m : {1.0, 1.1, 1.2}) {
    EXPECT_FALSE(count.is_too_many()) << driven_m;
    count.add(driven_m);
  }
  EXPECT_TRUE(count.is_any());
  EXPECT_TRUE(count.is_too_many());
}

TEST(BlockageCount, BeginsAnewAfterADrive) {
  BlockageCount count(at_most(1));
  for (const double driven_m : {1.0, 2.0, 3.0, 4.0}) count.add(driven_m);
  EXPECT_FALSE(count.is_too_many());
}

TEST(BlockageCount, KnowsThePlacesItWasBlockedOnTheWayTo) {
  BlockageCount count(at_most(2));
  EXPECT_FALSE(count.add_failed({1.0, 1.0}));
  EXPECT_FALSE(count.add_failed({2.0, 1.0}));
  EXPECT_TRUE(count.add_failed({1.1, 1.0}));
}

TEST(Travelled, AddsUpDistancesAndTurnsOfEitherDirection) {
  Travelled travelled;
  travelled.add({1.0, 0.0, 0.5});
  travelled.add({1.0, 2.0, 0.25});
  EXPECT_DOUBLE_EQ(travelled.driven_m, 3.0);
  EXPECT_DOUBLE_EQ(travelled.turned_rad, 0.75);
}

}  // namespace
}  // namespace cairn::behaviours
