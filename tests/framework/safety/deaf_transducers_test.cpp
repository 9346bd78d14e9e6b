#include "framework/safety/deaf_transducers.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/framework/safety/velocity_limiter_scenes.hpp"

namespace cairn {
namespace {

constexpr double kRound_s = 0.28;

// A ring of seven, as a Pioneer 1 has it: 0 to the left, 3 ahead, 6 to the right.
constexpr std::array<double, 7> kAngles_deg{90, 30, 15, 0, -15, -30, -90};

class Ring {
 public:
  explicit Ring(const DeafConfig& config = {}) : transducers(config, 1.0) {}

  // A round in which these hear something, and of the silent ones these should have.
  void round(const std::vector<int>& hear, const std::vector<int>& should_hear = {}, double driven_m = 0.0,
             bool is_certain = true) {
    Observation seen;
    seen.stamp_s = stamp_s_ += kRound_s;
    seen.T_odom_robot = {x_m_ += driven_m, 0.0, 0.0};
    std::vector<ExpectedEcho> expected;
    for (int i = 0; i < 7; ++i) {
      const bool hears = std::ranges::find(hear, i) != hear.end();
      seen.ranges.push_back(reading(hears ? 1.5 : kInfinity, radians(kAngles_deg[static_cast<std::size_t>(i)]), i));
    }
    for (const int sensor : should_hear) expected.push_back({sensor, 1.5, is_certain});
    transducers.see(seen, expected);
  }
  void rounds(int count, const std::vector<int>& hear, const std::vector<int>& should_hear) {
    for (int i = 0; i < count; ++i) round(hear, should_hear);
  }

  DeafTransducers transducers;

 private:
  double stamp_s_ = 1.0;
  double x_m_ = 0.0;
};

const std::vector<int> kAll{0, 1, 2, 3, 4, 5, 6};

TEST(DeafTransducers, AnEchoMissedForTooManyRoundsMakesATransducerDeafAndOneEchoMakesItHear) {
  const DeafConfig config;
  Ring ring;
  ring.rounds(config.rounds - 1, {0, 1, 2, 4, 5, 6}, {3});
  EXPECT_TRUE(ring.transducers.deaf().empty());
  ring.rounds(1, {0, 1, 2, 4, 5, 6}, {3});
  EXPECT_EQ(ring.transducers.deaf(), std::vector{3});
  ASSERT_EQ(ring.transducers.changes().size(), 1U);
  EXPECT_TRUE(ring.transducers.changes()[0].is_deaf);
  EXPECT_EQ(ring.transducers.changes()[0].cause, DeafCause::missed_echo);
  ring.round(kAll);
  EXPECT_TRUE(ring.transducers.deaf().empty());
  ASSERT_EQ(ring.transducers.changes().size(), 1U);
  EXPECT_FALSE(ring.transducers.changes()[0].is_deaf);
}

TEST(DeafTransducers, SilenceBeforeOpenSpaceIsNoDeafness) {
  Ring ring;
  ring.rounds(50, {0, 6}, {});
  EXPECT_TRUE(ring.transducers.deaf().empty());
  EXPECT_FALSE(ring.transducers.is_towards(0.0));
}

TEST(DeafTransducers, EchoesFromFarAwayAreNotAskedFor) {
  Ring ring({.within_m = 1.0});
  ring.rounds(20, {0, 6}, {3});
  EXPECT_TRUE(ring.transducers.deaf().empty());
}

TEST(DeafTransducers, AnEchoBetweenMissedOnesBeginsTheCountAfresh) {
  Ring ring;
  for (int i = 0; i < 10; ++i) {
    ring.rounds(DeafConfig{}.rounds - 1, {0, 1, 2, 4, 5, 6}, {3});
    ring.round(kAll);
    EXPECT_TRUE(ring.transducers.deaf().empty());
  }
}

TEST(DeafTransducers, AWholeRingIsFoundSoonerThanOneTransducer) {
  Ring ring;
  ring.round(kAll);
  ring.rounds(2, {}, {2, 3, 4});
  EXPECT_EQ(ring.transducers.deaf(), kAll);
  EXPECT_TRUE(ring.transducers.is_towards(0.0));
}

TEST(DeafTransducers, UncertainEchoesCountLessAndOnlyWhenNobodyOfARingOrHalfHears) {
  Ring one;
  for (int i = 0; i < 50; ++i) one.round({0, 1, 2, 4, 5, 6}, {3}, 0.0, false);
  EXPECT_TRUE(one.transducers.deaf().empty());
  Ring half;
  for (int i = 0; i < 6; ++i) half.round({3, 4, 5, 6}, {0, 1, 2}, 0.0, false);
  EXPECT_EQ(half.transducers.deaf(), (std::vector{0, 1, 2}));
  Ring whole;
  for (int i = 0; i < 3; ++i) whole.round({}, {2, 3, 4}, 0.0, false);
  EXPECT_EQ(whole.transducers.deaf(), kAll);
}

TEST(DeafTransducers, SilenceSpreadsFromADeafOneToSilentNeighboursOnly) {
  Ring ring;
  ring.rounds(DeafConfig{}.rounds, {4, 5, 6}, {0});
  EXPECT_EQ(ring.transducers.deaf(), (std::vector{0, 1, 2, 3})) << "the left half, of which one looks at a wall";
  ring.round({2, 4, 5, 6}, {0});
  EXPECT_EQ(ring.transducers.deaf(), (std::vector{0, 1, 3}));
}

TEST(DeafTransducers, ANeighbourThatHasAnsweredSinceIsNotTakenForDeafAgainBeforeOpenSpace) {
  const DeafConfig config;
  Ring ring;
  ring.rounds(config.rounds, {0, 1, 4, 5, 6}, {3});
  EXPECT_EQ(ring.transducers.deaf(), (std::vector{2, 3})) << "2 was silent as long as 3, and may have failed with it";
  ring.round({0, 1, 2, 4, 5, 6});
  EXPECT_EQ(ring.transducers.deaf(), std::vector{3});
  ring.rounds(50, {0, 1, 4, 5, 6}, {3});
  EXPECT_EQ(ring.transducers.deaf(), std::vector{3});
  ring.rounds(config.rounds, {0, 1, 4, 5, 6}, {2, 3});
  EXPECT_EQ(ring.transducers.deaf(), (std::vector{2, 3})) << "it fails too, by what it misses itself";
}

TEST(DeafTransducers, OneThatIsDeafAloneKeepsNobodyBackWhereItsNeighboursLook) {
  Ring ring;
  ring.rounds(5, {0, 1, 3, 4, 5, 6}, {2});
  EXPECT_EQ(ring.transducers.deaf(), std::vector{2});
  EXPECT_FALSE(ring.transducers.is_towards(0.0));
}

TEST(DeafTransducers, AHalfThatIsDeafIsInTheWayThoughTheOtherLooksAhead) {
  Ring ring;
  ring.rounds(5, {3, 4, 5, 6}, {0, 1, 2});
  EXPECT_TRUE(ring.transducers.is_towards(0.0));
  EXPECT_FALSE(ring.transducers.is_towards(std::numbers::pi)) << "nobody has ever looked there";
}

TEST(DeafTransducers, ABumpBlamesThoseOfItsSideThatWereSilent) {
  Ring ring;
  ring.round({0, 1, 6});
  ring.transducers.feel_bump(0.0);
  EXPECT_EQ(ring.transducers.deaf(), (std::vector{2, 3, 4, 5}));
  EXPECT_EQ(ring.transducers.changes().front().cause, DeafCause::bump);
  ring.round(kAll);
  EXPECT_TRUE(ring.transducers.deaf().empty());
}

TEST(DeafTransducers, ARingThatHearsNothingForMetresIsSilentUntilItHears) {
  Ring ring;
  for (double driven_m = 0.0; driven_m < DeafConfig{}.silent_m - 0.11; driven_m += 0.1) ring.round({}, {}, 0.1);
  EXPECT_FALSE(ring.transducers.is_ring_silent());
  for (int i = 0; i < 3; ++i) ring.round({}, {}, 0.1);
  EXPECT_TRUE(ring.transducers.is_ring_silent());
  EXPECT_TRUE(ring.transducers.deaf().empty()) << "maybe a hall";
  ring.round({5});
  EXPECT_FALSE(ring.transducers.is_ring_silent());
}

TEST(DeafTransducers, AnswersThatFollowEachOtherAtOnceAreOneRound) {
  DeafTransducers transducers({}, 1.0);
  Observation seen;
  seen.ranges = {reading(kInfinity), reading(1.0, 0.5 * std::numbers::pi, 1)};
  const std::vector<ExpectedEcho> expected{{0, 1.0}};
  for (seen.stamp_s = 1.0; seen.stamp_s < 1.0 + 0.2; seen.stamp_s += 0.01) transducers.see(seen, expected);
  EXPECT_TRUE(transducers.deaf().empty());
}

}  // namespace
}  // namespace cairn
