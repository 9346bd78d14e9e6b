#include "plugins/template_matcher/trigger.hpp"

#include <gtest/gtest.h>

namespace cairn::template_matcher {
namespace {

constexpr Cell kHere{3, -2};

TEST(TriggerSinceMatching, FiresOnlyAboveTheThreshold) {
  Trigger trigger(TriggerRule::since_matching, 140.0, 10.0);
  EXPECT_FALSE(trigger.fires(kHere, 140.0));
  EXPECT_TRUE(trigger.fires(kHere, 140.1));
}

TEST(TriggerSinceMatching, WaitsForARiseSinceTheMatchingThatCoveredTheCell) {
  Trigger trigger(TriggerRule::since_matching, 140.0, 10.0);
  trigger.matched(kHere, 150.0);
  EXPECT_FALSE(trigger.fires(kHere, 160.0));
  EXPECT_TRUE(trigger.fires(kHere, 160.5));
}

TEST(TriggerSinceMatching, AddsUpManySmallRises) {
  Trigger trigger(TriggerRule::since_matching, 140.0, 10.0);
  trigger.matched(kHere, 150.0);
  double ol = 150.0;
  int updates = 0;
  while (!trigger.fires(kHere, ol)) {
    ol += 1.0;
    ++updates;
  }
  EXPECT_EQ(updates, 11);
}

TEST(TriggerSinceMatching, CountsAMatchingBelowTheThresholdToo) {
  Trigger trigger(TriggerRule::since_matching, 140.0, 30.0);
  trigger.matched(kHere, 120.0);
  EXPECT_FALSE(trigger.fires(kHere, 145.0));
  EXPECT_TRUE(trigger.fires(kHere, 151.0));
}

TEST(TriggerSinceMatching, IsNotArmedAgainByAFall) {
  Trigger trigger(TriggerRule::since_matching, 140.0, 10.0);
  trigger.matched(kHere, 180.0);
  EXPECT_FALSE(trigger.fires(kHere, 145.0));
  EXPECT_FALSE(trigger.fires(kHere, 185.0));
}

TEST(TriggerSinceMatching, KeepsCellsApart) {
  Trigger trigger(TriggerRule::since_matching, 140.0, 10.0);
  trigger.matched(kHere, 200.0);
  EXPECT_TRUE(trigger.fires({4, -2}, 150.0));
}

TEST(TriggerSinceUpdate, NeedsTheWholeRiseInOneUpdate) {
  Trigger trigger(TriggerRule::since_update, 140.0, 10.0);
  EXPECT_FALSE(trigger.fires(kHere, 130.0));
  EXPECT_FALSE(trigger.fires(kHere, 139.0));
  EXPECT_FALSE(trigger.fires(kHere, 148.0));
  EXPECT_TRUE(trigger.fires(kHere, 158.5));
}

TEST(TriggerSinceUpdate, StartsFromNothingKnown) {
  Trigger trigger(TriggerRule::since_update, 130.0, 10.0);
  EXPECT_FALSE(trigger.fires(kHere, 137.0));
  EXPECT_TRUE(trigger.fires({0, 0}, 137.5));
}

TEST(TriggerSinceUpdate, DoesNotCareAboutMatchings) {
  Trigger trigger(TriggerRule::since_update, 140.0, 10.0);
  trigger.matched(kHere, 200.0);
  EXPECT_TRUE(trigger.fires(kHere, 150.0));
}

}  // namespace
}  // namespace cairn::template_matcher
