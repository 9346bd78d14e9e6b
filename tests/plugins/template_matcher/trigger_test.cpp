#include "plugins/template_matcher/trigger.hpp"

#include <gtest/gtest.h>

namespace cairn::template_matcher {
namespace {

constexpr Cell kHere{3, -2};

Config settings(TriggerRule rule, double tau_trigger, double tau_var) {
  Config config;
  config.trigger = rule;
  config.tau_trigger = tau_trigger;
  config.tau_var = tau_var;
  config.tau_again = 4.0;
  return config;
}

TEST(TriggerSinceMatching, FiresOnlyAboveTheThreshold) {
  Trigger trigger(settings(TriggerRule::since_matching, 140.0, 10.0));
  EXPECT_FALSE(trigger.fires(kHere, 140.0));
  EXPECT_TRUE(trigger.fires(kHere, 140.1));
}

TEST(TriggerSinceMatching, WaitsForARiseSinceTheMatchingThatCoveredTheCell) {
  Trigger trigger(settings(TriggerRule::since_matching, 140.0, 10.0));
  trigger.matched(kHere, 150.0, false);
  EXPECT_FALSE(trigger.fires(kHere, 160.0));
  EXPECT_TRUE(trigger.fires(kHere, 160.5));
}

TEST(TriggerSinceMatching, AddsUpManySmallRises) {
  Trigger trigger(settings(TriggerRule::since_matching, 140.0, 10.0));
  trigger.matched(kHere, 150.0, false);
  double ol = 150.0;
  int updates = 0;
  while (!trigger.fires(kHere, ol)) {
    ol += 1.0;
    ++updates;
  }
  EXPECT_EQ(updates, 11);
}

TEST(TriggerSinceMatching, CountsAMatchingBelowTheThresholdToo) {
  Trigger trigger(settings(TriggerRule::since_matching, 140.0, 30.0));
  trigger.matched(kHere, 120.0, false);
  EXPECT_FALSE(trigger.fires(kHere, 145.0));
  EXPECT_TRUE(trigger.fires(kHere, 151.0));
}

TEST(TriggerSinceMatching, IsNotArmedAgainByAFall) {
  Trigger trigger(settings(TriggerRule::since_matching, 140.0, 10.0));
  trigger.matched(kHere, 180.0, false);
  EXPECT_FALSE(trigger.fires(kHere, 145.0));
  EXPECT_FALSE(trigger.fires(kHere, 185.0));
}

TEST(TriggerSinceMatching, LooksAgainSoonerAtWhatFitted) {
  Trigger trigger(settings(TriggerRule::since_matching, 140.0, 10.0));
  trigger.matched(kHere, 180.0, true);
  EXPECT_FALSE(trigger.fires(kHere, 184.0));
  EXPECT_TRUE(trigger.fires(kHere, 184.5));
  EXPECT_FALSE(trigger.fires(kHere, 176.0));
  EXPECT_TRUE(trigger.fires(kHere, 175.5)) << "a fall";
  EXPECT_FALSE(trigger.fires(kHere, 139.0)) << "a fall below tau_trigger";
  trigger.matched(kHere, 180.0, false);
  EXPECT_FALSE(trigger.fires(kHere, 184.5)) << "it fits no longer";
}

TEST(TriggerSinceMatching, NeverLooksSoonerAtWhatFittedWhenAskedSo) {
  Config config = settings(TriggerRule::since_matching, 140.0, 10.0);
  config.tau_again = 255.0;
  Trigger trigger(config);
  trigger.matched(kHere, 180.0, true);
  EXPECT_FALSE(trigger.fires(kHere, 189.0));
  EXPECT_FALSE(trigger.fires(kHere, 145.0));
  EXPECT_TRUE(trigger.fires(kHere, 190.5));
}

TEST(TriggerSinceMatching, KeepsCellsApart) {
  Trigger trigger(settings(TriggerRule::since_matching, 140.0, 10.0));
  trigger.matched(kHere, 200.0, false);
  EXPECT_TRUE(trigger.fires({4, -2}, 150.0));
}

TEST(TriggerSinceUpdate, NeedsTheWholeRiseInOneUpdate) {
  Trigger trigger(settings(TriggerRule::since_update, 140.0, 10.0));
  EXPECT_FALSE(trigger.fires(kHere, 130.0));
  EXPECT_FALSE(trigger.fires(kHere, 139.0));
  EXPECT_FALSE(trigger.fires(kHere, 148.0));
  EXPECT_TRUE(trigger.fires(kHere, 158.5));
}

TEST(TriggerSinceUpdate, StartsFromNothingKnown) {
  Trigger trigger(settings(TriggerRule::since_update, 130.0, 10.0));
  EXPECT_FALSE(trigger.fires(kHere, 137.0));
  EXPECT_TRUE(trigger.fires({0, 0}, 137.5));
}

TEST(TriggerSinceUpdate, DoesNotCareAboutMatchings) {
  Trigger trigger(settings(TriggerRule::since_update, 140.0, 10.0));
  trigger.matched(kHere, 200.0, false);
  EXPECT_TRUE(trigger.fires(kHere, 150.0));
}

TEST(TriggerEveryUpdate, FiresAtEachUpdateWhereThereIsSomethingToLookAt) {
  Config config = settings(TriggerRule::every_update, 200.0, 30.0);
  config.tau_grow = 140.0;
  Trigger trigger(config);
  for (int update = 0; update < 3; ++update) {
    trigger.begin_update();
    EXPECT_FALSE(trigger.fires(kHere, 140.0));
    EXPECT_TRUE(trigger.fires(kHere, 141.0)) << "though it is below tau_trigger and has not risen";
    trigger.matched(kHere, 141.0, false);
    EXPECT_FALSE(trigger.fires(kHere, 250.0)) << "a matching of this update has covered it";
  }
}

}  // namespace
}  // namespace cairn::template_matcher
